// plan -> jobs (each case is a child `jounce run`) -> report; the cases lie in runs/ of the study's folder.
#include "reproduce/study.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/folder.h"
#include "base/log.h"
#include "compare_files.h"
#include "compare_recording.h"
#include "compare_report.h"

enum { MOST_CASES = 512, MOST_SETS = 64 };

static const char* join(JnArena* arena, const char* folder, const char* name) {
	char path[JN_PATH_SIZE];
	return jn_path_join(folder, name, path) == JN_OK ? jn_arena_text(arena, path) : NULL;
}

CompareRun* study_add(StudyRun* run, const char* scene, const char* name, const char* label, double steps) {
	JnArena* arena = &run->plan.arena;
	if (run->plan.run_count == MOST_CASES) run->status = jn_error(JN_BAD_INPUT, "%s: too many cases", run->study->name);
	if (run->status != JN_OK) return NULL;
	CompareRun* added = &run->plan.runs[run->plan.run_count];
	*added = (CompareRun){.label = jn_arena_text(arena, label),
						  .name = jn_arena_text(arena, name),
						  .scene = join(arena, run->options->scenes, scene),
						  .sets = jn_arena_take(arena, MOST_SETS, sizeof *added->sets),
						  .dt = NAN,
						  .work = steps};
	if (added->label == NULL || added->name == NULL || added->scene == NULL || added->sets == NULL) {
		run->status = JN_OUT_OF_MEMORY;
		return NULL;
	}
	++run->plan.run_count;
	study_set(run, "record.plots=no");
	return added;
}

void study_set(StudyRun* run, const char* format, ...) {
	char text[512];
	va_list values;
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	if (run->status != JN_OK) return;
	CompareRun* last = &run->plan.runs[run->plan.run_count - 1];
	if (last->set_count == MOST_SETS) run->status = jn_error(JN_BAD_INPUT, "%s: too many overrides", last->name);
	char* copy = jn_arena_text(&run->plan.arena, text);
	if (copy == NULL) run->status = JN_OUT_OF_MEMORY;
	if (run->status == JN_OK) last->sets[last->set_count++] = copy;
}

void study_extend(StudyRun* run, const char* name, const char* label) {
	char text[256];
	if (run->status != JN_OK) return;
	CompareRun* last = &run->plan.runs[run->plan.run_count - 1];
	snprintf(text, sizeof text, "%s_%s", last->name, name);
	last->name = jn_arena_text(&run->plan.arena, text);
	snprintf(text, sizeof text, "%s, %s", last->label, label);
	last->label = jn_arena_text(&run->plan.arena, text);
	if (last->name == NULL || last->label == NULL) run->status = JN_OUT_OF_MEMORY;
}

void study_allow_failure(StudyRun* run) {
	if (run->plan.run_count > 0) run->plan.runs[run->plan.run_count - 1].may_fail = true;
}

int study_find(const StudyRun* run, const char* name) {
	for (int i = 0; i < run->plan.run_count; ++i)
		if (strcmp(run->plan.runs[i].name, name) == 0) return i;
	return -1;
}

bool study_is_done(const StudyRun* run, int index) {
	return index >= 0 && run->jobs.list[index].state == COMPARE_DONE;
}

const char* study_folder(const StudyRun* run, int index) {
	return run->jobs.list[index].folder;
}

double study_number(const StudyRun* run, int index, const char* name) {
	char path[JN_PATH_SIZE];
	if (!study_is_done(run, index) || jn_path_join(study_folder(run, index), "summary.json", path) != JN_OK) return NAN;
	char* summary = compare_file_read(path);
	const double number = compare_summary_number(summary, name);
	free(summary);
	return number;
}

// ---- carrying out ----

static void tell_start(const StudyRun* run) {
	if (run->options->is_quiet) return;
	printf("%s: %s\n%d runs", run->study->name, run->study->doc, run->plan.run_count);
	if (run->jobs.kept > 0) printf(", %d of them done already", run->jobs.kept);
	if (run->jobs.kept < run->plan.run_count) printf(", %d at a time", run->jobs.limit);
	printf(", in %s\n", run->plan.directory);
	fflush(stdout);
}

static bool is_failure(const StudyRun* run, int index) {
	return run->jobs.list[index].state == COMPARE_FAILED && !run->plan.runs[index].may_fail;
}

static void tell_end(const StudyRun* run) {
	for (int i = 0; i < run->plan.run_count; ++i)
		if (is_failure(run, i))
			jn_warn("%s: %s: %s", run->study->name, run->plan.runs[i].label, run->jobs.list[i].message);
	if (run->options->is_quiet) return;
	if (run->jobs.was_stopped)
		printf("stopped as asked, with %d of %d runs done; the same command goes on from there\n", run->jobs.done,
			   run->plan.run_count);
	printf("wrote %s: index.html, page.md, tables and pictures\n", run->plan.directory);
	fflush(stdout);
}

static JnStatus report(StudyRun* run) {
	Page page;
	bool has_report = false;
	JN_TRY(page_open(&page, run->plan.directory, run->study->name, run->study->doc));
	if (run->options->is_quick)
		page_text(&page, "Quick form: meshes are coarser and runs shorter than in the paper, so that numbers are not "
						 "comparable with it; leave out --quick for those that are.");
	page_heading(&page, "What the paper shows");
	page_text(&page, "%s", run->study->shown);
	page_heading(&page, "What comes out here");
	JnStatus status = run->study->report(run, &page);
	if (status == JN_OK) page_runs(&page, &run->plan, &run->jobs);
	if (status == JN_OK) status = compare_report_write(run->study->name, &run->jobs, &has_report);
	if (has_report) page_link(&page, "report.html", "The runs side by side: curves, statistics, scenes");
	const JnStatus closed = page_close(&page, &run->job_options);
	return status != JN_OK ? status : closed;
}

static JnStatus prepare(StudyRun* run) {
	run->job_options =
		(CompareOptions){.jobs = run->study->is_timed && run->options->jobs == 0 ? 1 : run->options->jobs,
						 .threads = run->options->threads,
						 .is_quiet = run->options->is_quiet};
	run->plan.dt_key = -1;
	run->plan.runs = jn_arena_take(&run->plan.arena, MOST_CASES, sizeof *run->plan.runs);
	run->plan.directory = join(&run->plan.arena, run->options->directory, run->study->name);
	if (run->plan.runs == NULL || run->plan.directory == NULL) return JN_OUT_OF_MEMORY;
	JN_TRY(run->study->plan(run));
	JN_TRY(run->status);
	return jn_folder_make(run->plan.directory);
}

JnStatus study_carry_out(const Study* study, const ReproduceOptions* options, int* failed, bool* was_stopped) {
	StudyRun run = {.study = study, .options = options};
	JnStatus status = prepare(&run);
	if (status == JN_OK) status = compare_jobs_prepare(&run.job_options, &run.plan, &run.jobs);
	if (status == JN_OK) {
		run.jobs.ended = study->ended;
		run.jobs.user = &run;
		tell_start(&run);
		status = compare_jobs_run(&run.jobs);
	}
	if (status == JN_OK) status = report(&run);
	if (status == JN_OK) tell_end(&run);
	*failed = 0;
	for (int i = 0; run.jobs.list != NULL && i < run.plan.run_count; ++i) *failed += is_failure(&run, i);
	*was_stopped = run.jobs.was_stopped;
	compare_jobs_free(&run.jobs);
	compare_plan_free(&run.plan);
	return status;
}
