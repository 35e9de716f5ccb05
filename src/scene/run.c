// A scene, simulated and recorded: load -> build -> open recorders -> step and write -> close.
#include "scene/run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/folder.h"
#include "base/log.h"
#include "base/space.h"
#include "base/timer.h"
#include "model/model.h"
#include "scene/checkpoint.h"

static void count_step(JnRun* run) {
	const JnReport* report = jn_sim_last_report(run->sim);
	run->end.steps = jn_sim_steps(run->sim);
	run->end.newton += report->newton;
	run->end.factorizations += report->factorizations;
	run->end.solves += report->solves;
	run->end.iterations += report->iterations;
	for (int way = 0; way < JN_WAY_COUNT; ++way) run->end.served[way] += report->served[way];
	run->end.changes += report->changes;
	run->end.forces += report->forces;
	run->end.tangents += report->tangents;
	run->end.indefinite += report->indefinite;
	run->end.rejected += report->rejected;
	run->end.minimized += report->minimized;
	run->end.seconds_predict += report->seconds_predict;
	run->end.seconds_detect += report->seconds_detect;
	run->end.seconds_factor += report->seconds_factor;
	run->end.seconds_qp += report->seconds_qp;
}

static JnStatus write_record(JnRun* run, const JnState* state, const double* values, bool is_frame) {
	const JnRecordStep step = {.step = jn_sim_steps(run->sim),
							   .t = state->t,
							   .is_frame = is_frame,
							   .x = state->x,
							   .v = state->v,
							   .values = values,
							   .fields = run->fields};
	jn_run_find_fields(run);
	run->frame_is_written = is_frame;
	run->end.frames += is_frame;
	run->end.t = jn_sim_state(run->sim)->t;
	return jn_recorders_write(&run->recorders, &step);
}

// Frames stand at the multiples of the interval: those within the step are interpolated, with the fields of the step, and one
// at its end is the end itself. Interval 0: every end.
static JnStatus write_step(JnRun* run) {
	static const double most = 1000; // frames within a step
	const JnState* state = jn_sim_state(run->sim);
	const double interval = run->scene->def.record.interval, t = state->t;
	if (interval > 0 && t - run->next_frame > most * interval)
		return jn_error(
			JN_RUN_FAILED,
			"record.interval: %g s makes %.3g frames within the step of %g s that ends at t = %g s; use a longer "
			"one, or 0 for every step",
			interval, (t - run->next_frame) / interval, jn_sim_last_dt(run->sim), t);
	const double slack = 1e-9 * (jn_sim_last_dt(run->sim) + interval);
	for (; interval > 0 && run->next_frame < t - slack; run->next_frame = interval * ++run->frames_due) {
		jn_sim_state_at(run->sim, run->next_frame, &run->between);
		JN_TRY(write_record(run, &run->between, NULL, true));
	}
	const bool is_due = t >= run->next_frame - slack;
	if (is_due && interval > 0) run->next_frame = interval * ++run->frames_due;
	if (run->scene->def.record.exact_times && interval > 0) jn_sim_stop_at(run->sim, run->next_frame);
	run->frame_is_written = false; // of the present state
	JN_TRY(jn_run_measure(run));
	return write_record(run, state, run->values, is_due || jn_sim_is_done(run->sim));
}

static bool wants_more(JnRun* run) {
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

// A step, timed where the run keeps pace with the clock.
static JnStatus step(JnRun* run) {
	const bool is_paced = run->pace.speed > 0;
	if (is_paced) jn_pace_step_begins(&run->pace);
	JN_TRY(jn_sim_step(run->sim));
	if (is_paced) jn_pace_step_ends(&run->pace, jn_sim_state(run->sim)->t);
	return JN_OK;
}

// The start is recorded, too.
static JnStatus begin(JnRun* run) {
	JN_TRY(write_step(run));
	return jn_run_checkpoints_begin(run);
}

static JnStatus step_to_end(JnRun* run, JnRunResult* result) {
	run->began = jn_seconds() - run->end.wall_seconds;
	if (run->options->speed > 0) jn_pace_begin(&run->pace, run->options->speed, jn_sim_state(run->sim)->t);
	while (!jn_sim_is_done(run->sim) && !result->was_stopped) {
		const JnStatus status = step(run);
		run->end.wall_seconds = jn_seconds() - run->began;
		if (status != JN_OK) return status;
		count_step(run);
		JN_TRY(write_step(run));
		JN_TRY(jn_run_save_if_due(run));
		result->was_stopped = !wants_more(run) && !jn_sim_is_done(run->sim);
		if (run->pace.speed > 0 && !result->was_stopped) jn_pace_wait(&run->pace, jn_sim_state(run->sim)->t);
	}
	return JN_OK;
}

static JnStatus open_recorders(JnRun* run) {
	JN_TRY(jn_recorders_open(&run->recorders, &run->arena, &run->info, NULL));
	run->recorders_are_open = true;
	return JN_OK;
}

static JnStatus prepare(JnRun* run, JnArchive* resumed) {
	const double began = jn_seconds();
	JN_TRY(jn_scene_build(run->scene, run->options->threads, &run->sim));
	JN_TRY(jn_run_describe(run));
	JN_TRY(jn_folder_make(run->options->directory));
	run->end.t_end = run->scene->def.sim.duration;
	JN_TRY(resumed != NULL ? jn_run_restore(run, resumed) : open_recorders(run));
	JN_TRY(jn_state_create(jn_sim_system(run->sim)->space, &run->between));
	run->end.setup_seconds += jn_seconds() - began;
	run->has_state = true;
	if (resumed == NULL) return begin(run);
	jn_run_checkpoints_go_on(run);
	run->resumed_at = jn_sim_steps(run->sim);
	return JN_OK;
}

// The last state is on disk also when the run ended between two frames.
static JnStatus finish(JnRun* run, JnStatus status, bool was_stopped) {
	if (!run->recorders_are_open) return status;
	JnStatus written = JN_OK;
	if (run->has_state && status != JN_IO_FAILED && !run->frame_is_written)
		written = write_record(run, jn_sim_state(run->sim), NULL, true);
	if (run->has_state && status != JN_IO_FAILED && written == JN_OK && (status != JN_OK || was_stopped))
		written = jn_run_save_at_end(run);
	if (run->pace.speed > 0) {
		run->pace_report = jn_pace_report(&run->pace, jn_sim_state(run->sim)->t);
		run->end.pace = &run->pace_report;
	}
	run->end.outcome = status != JN_OK ? "failed" : was_stopped ? "interrupted" : "done";
	run->end.message = status == JN_OK ? "" : run->message[0] != '\0' ? run->message : jn_status_name(status);
	const JnStatus closed = jn_recorders_close(&run->recorders, &run->end);
	if (status == JN_OK) status = written;
	return status == JN_OK ? closed : status;
}

static int element_count(const JnRecordInfo* info) {
	int count = 0;
	for (int b = 0; b < info->body_count; ++b) count += info->bodies[b].cell_count;
	return count;
}

static void fill_result(JnRun* run, JnRunResult* result) {
	result->steps = run->end.steps;
	result->frames = run->end.frames;
	result->rejected = run->end.rejected;
	result->newton = run->end.newton;
	result->factorizations = run->end.factorizations;
	result->solves = run->end.solves;
	result->iterations = run->end.iterations;
	result->changes = run->end.changes;
	memcpy(result->served, run->end.served, sizeof result->served);
	result->t = run->end.t;
	result->t_end = run->end.t_end;
	result->has_plots = run->info.wants_plots;
	result->resumed_at = run->resumed_at;
	result->wall_seconds = run->end.wall_seconds;
	result->specific_error = run->end.specific_error;
	result->pace = run->pace_report;
	if (run->sim == NULL) return;
	result->nodes = run->info.node_count;
	result->elements = element_count(&run->info);
}

// The summary says why a run failed in the words of the last error.
static void keep_error(void* user, JnLogLevel level, const char* message) {
	JnRun* run = user;
	if (level == JN_LOG_ERROR) snprintf(run->message, sizeof run->message, "%s", message);
	run->outer.sink(run->outer.user, level, message);
}

static void release(JnRun* run) {
	if (run->between.x != NULL) jn_state_destroy(jn_sim_system(run->sim)->space, &run->between);
	jn_sim_destroy(run->sim);
	jn_archive_free(&run->saving.kept);
	jn_arena_free(&run->arena);
}

JnStatus jn_run_execute(JnRun* run, JnArchive* resumed, JnRunResult* result) {
	*result = (JnRunResult){0};
	run->outer = jn_log_swap((JnLog){keep_error, run});
	JnStatus status = prepare(run, resumed);
	if (status == JN_OK) status = step_to_end(run, result);
	status = finish(run, status, result->was_stopped);
	jn_log_swap(run->outer);
	fill_result(run, result);
	release(run);
	return status;
}

JnStatus jn_scene_run(const JnScene* scene, const JnRunOptions* options, JnRunResult* result) {
	JnRun run = {.scene = scene, .options = options};
	return jn_run_execute(&run, NULL, result);
}
