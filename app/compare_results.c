// Errors against the reference: e = sqrt(sum_i |x_i - r_i|^2 / n) and max_i |x_i - r_i| over the nodes, and the order
// log(e_coarse / e_fine) / log(dt_coarse / dt_fine) between neighbouring steps.
#include "compare_results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "compare_files.h"
#include "compare_recording.h"

static const CompareResult unknown = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NULL};

static void read_summary(const char* folder, CompareResult* result) {
	char path[JN_PATH_SIZE];
	char* text = jn_path_join(folder, "summary.json", path) == JN_OK ? compare_file_read(path) : NULL;
	const struct {
		const char* name;
		double* value;
	} entries[] = {
		{"steps", &result->steps},
		{"rejected", &result->rejected},
		{"newton", &result->newton},
		{"factorizations", &result->factorizations},
		{"solves", &result->solves},
		{"forces", &result->forces},
		{"wall_seconds", &result->wall_seconds},
		{"specific_error", &result->energy_end},
		{"specific_error_max", &result->energy_max},
	};
	for (size_t i = 0; i < sizeof entries / sizeof *entries; ++i)
		*entries[i].value = compare_summary_number(text, entries[i].name);
	free(text);
}

// Distances of the nodes of `a` from those of `b`.
static void measure_nodes(int count, const double* a, const double* b, double* rms, double* max) {
	double sum = 0, largest = 0;
	for (int i = 0; i < count; ++i) {
		double square = 0;
		for (int k = 3 * i; k < 3 * i + 3; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
		sum += square;
		largest = fmax(largest, square);
	}
	*rms = sqrt(sum / count);
	*max = sqrt(largest);
}

static double path_distance(const CompareProbe* a, int row, const CompareProbe* b, int other) {
	double square = 0;
	for (int k = 0; k < 3; ++k) square += (a->at[k][row] - b->at[k][other]) * (a->at[k][row] - b->at[k][other]);
	return sqrt(square);
}

// Both series go forward in time; what differs by rounding alone is one time.
static ComparePath measure_path(const CompareRecording* run, const CompareRecording* reference, int probe) {
	const double slack = 1e-9 * fabs(reference->t);
	double sum = 0, largest = 0;
	int count = 0;
	for (int i = 1, j = 1; i < run->row_count && j < reference->row_count;) {
		const double ahead = run->times[i] - reference->times[j];
		if (fabs(ahead) <= slack) {
			const double distance = path_distance(&run->probes[probe], i++, &reference->probes[probe], j++);
			sum += distance * distance;
			largest = fmax(largest, distance);
			++count;
		} else if (ahead < 0)
			++i;
		else
			++j;
	}
	return count > 0 ? (ComparePath){sqrt(sum / count), largest} : (ComparePath){NAN, NAN};
}

// The plan was checked before; this guards against files that were exchanged since.
static const char* find_difference(const CompareRecording* run, const CompareRecording* reference) {
	if (run->node_count != reference->node_count) return "its mesh is not that of the reference";
	if (memcmp(run->rest, reference->rest, 3 * (size_t)run->node_count * sizeof(double)) != 0)
		return "its mesh is not that of the reference";
	if (fabs(run->t - reference->t) > 1e-9 * fabs(reference->t)) return "its final time is not that of the reference";
	return NULL;
}

static bool has_probe(const CompareRecording* recording, int index, const char* name) {
	return index < recording->probe_count && strcmp(recording->probes[index].name, name) == 0;
}

static void mark_failed(CompareJobs* jobs, CompareJob* job, const char* message) {
	if (job->state == COMPARE_DONE) {
		--jobs->done;
		++jobs->failed;
	}
	job->state = COMPARE_FAILED;
	snprintf(job->message, sizeof job->message, "%s", message);
}

static void keep_message(void* user, JnLogLevel level, const char* message) {
	CompareJob* job = user;
	if (level == JN_LOG_ERROR) snprintf(job->message, sizeof job->message, "%s", message);
}

// JN_IO_FAILED, and the job is failed, when the recording cannot be used.
static JnStatus open_recording(CompareJobs* jobs, CompareJob* job, CompareRecording* recording) {
	jn_log_set_sink(keep_message, job);
	const JnStatus status = compare_recording_open(job->folder, recording);
	jn_log_set_sink(NULL, NULL);
	char message[sizeof job->message];
	snprintf(message, sizeof message, "%s", job->message);
	if (status != JN_OK) mark_failed(jobs, job, message);
	return status;
}

static JnStatus measure_run(CompareResults* results, CompareJobs* jobs, int index, const CompareRecording* reference) {
	CompareRecording run;
	CompareResult* result = &results->list[index];
	const JnStatus status = open_recording(jobs, &jobs->list[index], &run);
	const char* difference = status == JN_OK ? find_difference(&run, reference) : NULL;
	if (difference != NULL) mark_failed(jobs, &jobs->list[index], difference);
	if (status == JN_OK && difference == NULL) {
		measure_nodes(run.node_count, run.x, reference->x, &result->position_rms, &result->position_max);
		measure_nodes(run.node_count, run.v, reference->v, &result->velocity_rms, &result->velocity_max);
		for (int p = 0; p < results->probe_count; ++p)
			if (has_probe(&run, p, results->probes[p])) result->paths[p] = measure_path(&run, reference, p);
	}
	compare_recording_close(&run);
	return status == JN_IO_FAILED ? JN_OK : status;
}

static JnStatus list_probes(CompareResults* results, const CompareRecording* reference) {
	results->probe_count = reference->probe_count;
	JN_NEW(&results->arena, results->probes, reference->probe_count + 1);
	for (int p = 0; p < reference->probe_count; ++p) {
		results->probes[p] = jn_arena_text(&results->arena, reference->probes[p].name);
		if (results->probes[p] == NULL) return JN_OUT_OF_MEMORY;
	}
	for (int i = 0; i < results->plan->run_count; ++i) {
		JN_NEW(&results->arena, results->list[i].paths, reference->probe_count + 1);
		for (int p = 0; p < reference->probe_count; ++p) results->list[i].paths[p] = (ComparePath){NAN, NAN};
	}
	return JN_OK;
}

static JnStatus measure_all(CompareResults* results, CompareJobs* jobs) {
	const int last = results->plan->run_count - 1;
	CompareRecording reference;
	JnStatus status = open_recording(jobs, &jobs->list[last], &reference);
	results->has_errors = status == JN_OK;
	if (status == JN_OK) status = list_probes(results, &reference);
	for (int i = 0; i < last && status == JN_OK; ++i)
		if (jobs->list[i].state == COMPARE_DONE) status = measure_run(results, jobs, i, &reference);
	compare_recording_close(&reference);
	return status == JN_IO_FAILED ? JN_OK : status;
}

static void find_orders(CompareResults* results) {
	for (int i = 0; i < results->plan->run_count && results->has_errors; ++i) {
		const int coarser = compare_run_coarser(results->plan, i);
		if (coarser < 0) continue;
		const double ratio = results->list[coarser].position_rms / results->list[i].position_rms;
		const double order = log(ratio) / log(results->plan->runs[coarser].dt / results->plan->runs[i].dt);
		results->list[i].order = isfinite(order) ? order : NAN;
	}
}

JnStatus compare_results_read(CompareJobs* jobs, CompareResults* results) {
	const ComparePlan* plan = jobs->plan;
	*results = (CompareResults){.plan = plan, .jobs = jobs};
	JN_NEW(&results->arena, results->list, plan->run_count);
	for (int i = 0; i < plan->run_count; ++i) {
		results->list[i] = unknown;
		const CompareState state = jobs->list[i].state;
		if (state != COMPARE_WAITING) read_summary(jobs->list[i].folder, &results->list[i]);
	}
	if (plan->has_reference && jobs->list[plan->run_count - 1].state == COMPARE_DONE)
		JN_TRY(measure_all(results, jobs));
	find_orders(results);
	return JN_OK;
}

void compare_results_free(CompareResults* results) {
	jn_arena_free(&results->arena);
}

double compare_result_error(const CompareResults* results, int run) {
	if (results->jobs->list[run].state != COMPARE_DONE) return NAN;
	return results->has_errors ? results->list[run].position_rms : results->list[run].energy_max;
}

int compare_run_coarser(const ComparePlan* plan, int run) {
	int coarser = -1;
	const double dt = plan->runs[run].dt;
	for (int i = 0; i < plan->run_count; ++i) {
		if (plan->runs[i].group != plan->runs[run].group || !(plan->runs[i].dt > dt)) continue;
		if (coarser < 0 || plan->runs[i].dt < plan->runs[coarser].dt) coarser = i;
	}
	return coarser;
}

double compare_group_slope(const CompareResults* results, int group) {
	double count = 0, x = 0, y = 0, xx = 0, xy = 0;
	for (int i = 0; i < results->plan->run_count; ++i) {
		const CompareRun* run = &results->plan->runs[i];
		const double error = compare_result_error(results, i);
		if (run->group != group || !(run->dt > 0) || !(error > 0)) continue;
		const double lx = log(run->dt), ly = log(error);
		count += 1;
		x += lx;
		y += ly;
		xx += lx * lx;
		xy += lx * ly;
	}
	const double spread = count * xx - x * x;
	return count > 1 && spread > 1e-12 * count * xx ? (count * xy - x * y) / spread : NAN;
}
