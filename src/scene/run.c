// A scene, simulated and recorded: load -> build -> open recorders -> step and write -> close.
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/log.h"
#include "base/timer.h"
#include "model/model.h"
#include "record/recorder.h"
#include "scene/scene.h"
#include "solve/blas.h"

// The columns that every run has, in this order; then three for each probe.
static const JnColumn fixed_columns[] = {
	{"step", "", true},
	{"t", "s", false},
	{"dt", "s", false},
	{"kinetic", "J", false},
	{"elastic", "J", false},
	{"gravity", "J", false},
	{"total", "J", false},
	{"specific_error", "J/kg", false},
	{"newton", "", true},
	{"factorizations", "", true},
	{"solves", "", true},
	{"rejected", "", true},
	{"momentum.x", "kg m/s", false},
	{"momentum.y", "kg m/s", false},
	{"momentum.z", "kg m/s", false},
	{"angular.x", "kg m^2/s", false},
	{"angular.y", "kg m^2/s", false},
	{"angular.z", "kg m^2/s", false},
};
enum { FIXED_COLUMNS = sizeof fixed_columns / sizeof *fixed_columns };

typedef struct Run {
	const JnScene* scene;
	const JnRunOptions* options;
	JnArena arena;
	JnSim* sim;
	JnRecordInfo info;
	JnRecorders recorders;
	JnRecordEnd end;
	int* probe_nodes;
	double* values; // one a column
	double total_at_start;
	double next_frame; // time of the next frame that is due [s]
	bool frame_is_written, recorders_are_open;
} Run;

// Make a folder and those above it.
static JnStatus make_directory(const char* path) {
	char part[4096];
	const size_t length = strlen(path);
	if (length == 0 || length >= sizeof part) return jn_error(JN_IO_FAILED, "%s: no usable folder name", path);
	for (size_t i = 1; i <= length; ++i) {
		if (path[i] != '/' && path[i] != '\0') continue;
		memcpy(part, path, i);
		part[i] = '\0';
		if (mkdir(part, 0777) != 0 && errno != EEXIST)
			return jn_error(JN_IO_FAILED, "%s: cannot make this folder: %s", part, strerror(errno));
	}
	struct stat about;
	if (stat(path, &about) != 0 || !S_ISDIR(about.st_mode))
		return jn_error(JN_IO_FAILED, "%s: is no folder; choose another output with -o", path);
	if (access(path, W_OK) != 0)
		return jn_error(JN_IO_FAILED, "%s: cannot write here: %s; choose another output with -o", path,
						strerror(errno));
	return JN_OK;
}

static JnStatus name_columns(Run* run) {
	const JnItems* probes = &run->scene->def.probes;
	JnColumn* columns;
	run->info.column_count = FIXED_COLUMNS + 3 * probes->count;
	JN_NEW(&run->arena, columns, run->info.column_count);
	JN_NEW(&run->arena, run->values, run->info.column_count);
	JN_NEW(&run->arena, run->probe_nodes, probes->count + 1);
	memcpy(columns, fixed_columns, sizeof fixed_columns);
	for (int i = 0; i < probes->count; ++i) {
		const JnProbeDef* probe = (const JnProbeDef*)probes->data + i;
		run->probe_nodes[i] = jn_model_nearest(jn_sim_model(run->sim), probe->at);
		for (int axis = 0; axis < 3; ++axis) {
			char name[256];
			snprintf(name, sizeof name, "probe.%s.%c", probe->name, 'x' + axis);
			JnColumn* column = &columns[FIXED_COLUMNS + 3 * i + axis];
			*column = (JnColumn){.name = jn_arena_text(&run->arena, name), .unit = "m"};
			if (column->name == NULL) return JN_OUT_OF_MEMORY;
		}
	}
	run->info.columns = columns;
	return JN_OK;
}

static JnStatus list_bodies(Run* run, const JnModel* model) {
	JnRecordBody* bodies;
	JN_NEW(&run->arena, bodies, model->body_count);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		bodies[b] = (JnRecordBody){.name = body->name,
								   .shape = body->mesh.shape,
								   .first_node = body->first_node,
								   .node_count = body->mesh.node_count,
								   .cell_count = body->mesh.cell_count,
								   .cells = body->cells};
	}
	run->info.body_count = model->body_count;
	run->info.bodies = bodies;
	return JN_OK;
}

// The file's text with the overrides as comments at its end.
static JnStatus annotate_text(Run* run) {
	const JnScene* scene = run->scene;
	size_t length = strlen(scene->document.text) + 2;
	for (int i = 0; i < scene->set_count; ++i) length += strlen(scene->sets[i]) + 16;
	char* text;
	JN_NEW(&run->arena, text, length);
	char* end = text + snprintf(text, length, "%s", scene->document.text);
	for (int i = 0; i < scene->set_count; ++i)
		end += snprintf(end, length - (size_t)(end - text), "# --set %s\n", scene->sets[i]);
	run->info.scene_text = text;
	return JN_OK;
}

static JnStatus describe_run(Run* run) {
	const JnModel* model = jn_sim_model(run->sim);
	char* blas;
	JN_NEW(&run->arena, blas, 96);
	jn_blas_name(blas, 96);
	run->info.directory = run->options->directory;
	run->info.scene_name = run->scene->def.name;
	run->info.scene_path = run->scene->document.path;
	run->info.method = run->scene->def.sim.integrator.row->name;
	run->info.node_count = model->node_count;
	run->info.nodes = model->rest;
	run->info.wants_plots = run->scene->def.record.plots;
	run->info.total_mass = model->total_mass;
	run->info.threads = jn_sim_threads(run->sim);
	run->info.simd_width = jn_kernel_best_width();
	run->info.blas = blas;
	JN_TRY(annotate_text(run));
	JN_TRY(list_bodies(run, model));
	return name_columns(run);
}

static void fill_values(Run* run) {
	const JnReport* report = jn_sim_last_report(run->sim);
	const JnState* state = jn_sim_state(run->sim);
	const JnEnergies e = jn_model_energies(jn_sim_model(run->sim), state);
	const double total = e.kinetic + e.elastic + e.gravity;
	const bool at_start = jn_sim_steps(run->sim) == 0;
	if (at_start) run->total_at_start = total;
	run->end.specific_error = fabs(total - run->total_at_start) / run->info.total_mass;
	run->end.specific_error_max = fmax(run->end.specific_error_max, run->end.specific_error);
	const double values[FIXED_COLUMNS] = {(double)jn_sim_steps(run->sim),
										  state->t,
										  jn_sim_last_dt(run->sim),
										  e.kinetic,
										  e.elastic,
										  e.gravity,
										  total,
										  run->end.specific_error,
										  at_start ? 0 : report->newton,
										  at_start ? 0 : report->factorizations,
										  at_start ? 0 : report->solves,
										  at_start ? 0 : report->rejected,
										  e.momentum[0],
										  e.momentum[1],
										  e.momentum[2],
										  e.angular[0],
										  e.angular[1],
										  e.angular[2]};
	memcpy(run->values, values, sizeof values);
	for (int i = 0; i < run->scene->def.probes.count; ++i)
		memcpy(run->values + FIXED_COLUMNS + 3 * i, state->x + 3 * (size_t)run->probe_nodes[i], 3 * sizeof(double));
}

static void count_step(Run* run) {
	const JnReport* report = jn_sim_last_report(run->sim);
	run->end.steps = jn_sim_steps(run->sim);
	run->end.newton += report->newton;
	run->end.factorizations += report->factorizations;
	run->end.solves += report->solves;
	run->end.forces += report->forces;
	run->end.tangents += report->tangents;
	run->end.indefinite += report->indefinite;
	run->end.rejected += report->rejected;
}

static JnStatus write_record(Run* run, const double* values, bool is_frame) {
	const JnState* state = jn_sim_state(run->sim);
	const JnRecordStep step = {.step = jn_sim_steps(run->sim),
							   .t = state->t,
							   .is_frame = is_frame,
							   .x = state->x,
							   .v = state->v,
							   .values = values};
	run->frame_is_written = is_frame;
	run->end.frames += is_frame;
	run->end.t = state->t;
	return jn_recorders_write(&run->recorders, &step);
}

// A frame is due at the first step at or after each multiple of the interval.
static JnStatus write_step(Run* run) {
	const double interval = run->scene->def.record.interval, t = jn_sim_state(run->sim)->t;
	const double slack = 1e-9 * (jn_sim_last_dt(run->sim) + interval);
	const bool is_due = t >= run->next_frame - slack;
	if (is_due) run->next_frame = interval > 0 ? interval * (floor((t + slack) / interval) + 1) : t;
	fill_values(run);
	return write_record(run, run->values, is_due || jn_sim_is_done(run->sim));
}

static bool wants_more(Run* run, double began) {
	run->end.wall_seconds = jn_seconds() - began;
	if (run->options->progress == NULL) return true;
	const JnProgress progress = {.steps = run->end.steps,
								 .t = run->end.t,
								 .t_end = run->end.t_end,
								 .dt = jn_sim_last_dt(run->sim),
								 .wall_seconds = run->end.wall_seconds,
								 .newton = jn_sim_last_report(run->sim)->newton,
								 .specific_error = run->end.specific_error};
	return run->options->progress(run->options->user, &progress);
}

static JnStatus step_to_end(Run* run, JnRunResult* result) {
	const double began = jn_seconds();
	JN_TRY(write_step(run));
	while (!jn_sim_is_done(run->sim) && !result->was_stopped) {
		JN_TRY(jn_sim_step(run->sim));
		count_step(run);
		JN_TRY(write_step(run));
		result->was_stopped = !wants_more(run, began);
	}
	return JN_OK;
}

static JnStatus prepare(Run* run) {
	const double began = jn_seconds();
	JN_TRY(jn_sim_create(&run->scene->def.sim, run->options->threads, &run->sim));
	JN_TRY(describe_run(run));
	JN_TRY(make_directory(run->options->directory));
	run->end.t_end = run->scene->def.sim.duration;
	JN_TRY(jn_recorders_open(&run->recorders, &run->arena, &run->info));
	run->recorders_are_open = true;
	run->end.setup_seconds = jn_seconds() - began;
	return JN_OK;
}

// The last state is on disk also when the run ended between two frames.
static JnStatus finish(Run* run, JnStatus status, bool was_stopped) {
	if (!run->recorders_are_open) return status;
	JnStatus written = JN_OK;
	if (status != JN_IO_FAILED && !run->frame_is_written) written = write_record(run, NULL, true);
	run->end.outcome = status != JN_OK ? "failed" : was_stopped ? "interrupted" : "done";
	run->end.message = status != JN_OK ? jn_status_name(status) : "";
	const JnStatus closed = jn_recorders_close(&run->recorders, &run->end);
	if (status == JN_OK) status = written;
	return status == JN_OK ? closed : status;
}

static int element_count(const JnModel* model) {
	int count = 0;
	for (int b = 0; b < model->body_count; ++b) count += model->bodies[b].group.count;
	return count;
}

JnStatus jn_scene_run(const JnScene* scene, const JnRunOptions* options, JnRunResult* result) {
	Run run = {.scene = scene, .options = options};
	*result = (JnRunResult){0};
	JnStatus status = prepare(&run);
	if (status == JN_OK) status = step_to_end(&run, result);
	status = finish(&run, status, result->was_stopped);
	result->steps = run.end.steps;
	result->frames = run.end.frames;
	result->rejected = run.end.rejected;
	result->newton = run.end.newton;
	result->factorizations = run.end.factorizations;
	result->t = run.end.t;
	result->wall_seconds = run.end.wall_seconds;
	result->specific_error = run.end.specific_error;
	if (run.sim != NULL) {
		result->nodes = jn_model_node_count(jn_sim_model(run.sim));
		result->elements = element_count(jn_sim_model(run.sim));
	}
	jn_sim_destroy(run.sim);
	jn_arena_free(&run.arena);
	return status;
}
