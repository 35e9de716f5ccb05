#include "scene/checkpoint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/space.h"
#include "base/timer.h"
#include "model/model.h"
#include "record/checkpoint.h"

// Steps between saved states, times nodes, where the scene says nothing. Saving costs what one to four steps do, and with
// direct solvers a new analysis of the matrix, which is worth some twenty steps of a large model.
static const double node_steps = 3e6;
enum { LEAST_STEPS = 50, MOST_STEPS = 10000 };

static const double pause = 10; // between files, where the scene says nothing [s]

// ---- what is in a checkpoint

static void write_origin(const JnScene* scene, JnArchive* archive) {
	jn_archive_text(archive, "path", scene->document.path);
	jn_archive_text(archive, "text", scene->document.text);
	jn_archive_count(archive, "sets", scene->set_count, 1);
	for (int i = 0; i < scene->set_count; ++i) jn_archive_text(archive, "set", scene->sets[i]);
}

JnStatus jn_run_origin_read(JnArchive* archive, JnRunOrigin* origin) {
	*origin = (JnRunOrigin){0};
	origin->path = jn_archive_text(archive, "path", NULL);
	origin->text = jn_archive_text(archive, "text", NULL);
	origin->set_count = jn_archive_count(archive, "sets", 0, 1);
	origin->sets = calloc((size_t)origin->set_count + 1, sizeof *origin->sets);
	if (origin->sets == NULL) archive->status = jn_error(JN_OUT_OF_MEMORY, "out of memory: overrides");
	for (int i = 0; i < origin->set_count && origin->sets != NULL; ++i)
		origin->sets[i] = jn_archive_text(archive, "set", NULL);
	if (archive->status != JN_OK) jn_run_origin_free(origin);
	return archive->status;
}

void jn_run_origin_free(JnRunOrigin* origin) {
	free(origin->sets);
	*origin = (JnRunOrigin){0};
}

// Sums over the run. The words of its end are not known yet, and addresses mean nothing elsewhere.
static void archive_sums(JnRun* run, JnArchive* archive) {
	JnRecordEnd end = run->end;
	end.outcome = end.message = NULL;
	end.pace = NULL;
	jn_archive_bytes(archive, "sums", &end, sizeof end);
	if (!archive->is_reading || archive->status != JN_OK) return;
	end.outcome = end.message = NULL;
	end.pace = NULL;
	end.t_end = run->end.t_end;
	run->end = end;
}

static void archive_numbers(JnRun* run, JnArchive* archive) {
	archive_sums(run, archive);
	jn_archive_real(archive, "total_at_start", &run->total_at_start);
	jn_archive_real(archive, "next_frame", &run->next_frame);
	jn_archive_long(archive, "frames_due", &run->frames_due);
	jn_archive_switch(archive, "frame_is_written", &run->frame_is_written);
	jn_archive_real(archive, "next_save", &run->saving.next_time);
	jn_archive_long(archive, "saves_due", &run->saving.due);
}

// The state comes before what touches files: one that is refused leaves them as they are.
static JnStatus write_run(JnRun* run, JnStatus (*save_state)(JnSim*, JnArchive*), JnArchive* archive) {
	write_origin(run->scene, archive);
	archive_numbers(run, archive);
	JN_TRY(save_state(run->sim, archive));
	jn_recorders_archive(&run->recorders, archive);
	return archive->status;
}

JnStatus jn_run_restore(JnRun* run, JnArchive* archive) {
	archive_numbers(run, archive);
	JN_TRY(archive->status);
	JN_TRY(jn_sim_restore(run->sim, archive));
	if (run->changes_step) jn_sim_restart_step(run->sim);
	JN_TRY(jn_recorders_open(&run->recorders, &run->arena, &run->info, archive));
	run->recorders_are_open = true;
	return jn_archive_end(archive);
}

// ---- when

static long steps_between(const JnRun* run) {
	const double steps = node_steps / fmax(run->info.node_count, 1);
	return (long)fmin(fmax(steps, LEAST_STEPS), MOST_STEPS);
}

// A run that waits for the clock has no time for what nobody asked for.
static bool is_saving(const JnRun* run) {
	return run->scene->def.checkpoint.every > 0 || run->options->speed == 0;
}

static void plan_next(JnRun* run) {
	JnRunSaving* saving = &run->saving;
	const double every = run->scene->def.checkpoint.every, t = jn_sim_state(run->sim)->t;
	saving->next_step = every > 0 ? 0 : jn_sim_steps(run->sim) + steps_between(run);
	if (every == 0 || saving->next_time > t * (1 + 1e-9)) return;
	saving->due = (long)fmin(floor(t * (1 + 1e-9) / every) + 1, 1e15);
	saving->next_time = every * (double)saving->due;
}

static bool is_due(const JnRun* run) {
	const JnRunSaving* saving = &run->saving;
	if (!is_saving(run) || jn_sim_is_done(run->sim)) return false;
	if (saving->next_step > 0) return jn_sim_steps(run->sim) >= saving->next_step;
	return jn_sim_state(run->sim)->t >= saving->next_time * (1 - 1e-9);
}

// ---- saving

static JnStatus write_file(JnRun* run, JnCheckpointKind kind, long step, const JnArchive* archive) {
	const int keep = kind == JN_CHECKPOINT_STEP ? run->scene->def.checkpoint.keep : 1;
	JN_TRY(jn_recorders_sync(&run->recorders)); // a checkpoint never knows of what is not there
	return jn_checkpoint_write(run->options->directory, kind, step, archive->bytes, archive->size, keep);
}

static JnStatus write_kept(JnRun* run) {
	if (run->saving.is_written || run->saving.kept.size == 0) return JN_OK;
	JN_TRY(write_file(run, JN_CHECKPOINT_STEP, run->saving.step, &run->saving.kept));
	run->saving.is_written = true;
	run->saving.written = jn_seconds();
	return JN_OK;
}

JnStatus jn_run_checkpoints_begin(JnRun* run) {
	jn_checkpoints_remove(run->options->directory);
	plan_next(run);
	run->saving.written = jn_seconds();
	JN_TRY(write_run(run, jn_sim_snapshot, &run->saving.kept));
	return run->scene->def.checkpoint.every > 0 ? write_kept(run) : JN_OK;
}

void jn_run_checkpoints_go_on(JnRun* run) {
	plan_next(run);
	run->saving.step = jn_sim_steps(run->sim);
	run->saving.is_written = true;
	run->saving.written = jn_seconds();
}

// The simulation gets a new space: vectors of the old one go before.
static JnStatus save(JnRun* run) {
	JnRunSaving* saving = &run->saving;
	const double began = jn_seconds();
	saving->kept.size = 0;
	saving->is_written = false;
	plan_next(run);
	run->has_state = false; // until it is there again
	jn_state_destroy(jn_sim_system(run->sim)->space, &run->between);
	JN_TRY(write_run(run, jn_sim_save, &saving->kept));
	run->has_state = true;
	saving->step = jn_sim_steps(run->sim);
	JN_TRY(jn_state_create(jn_sim_system(run->sim)->space, &run->between));
	run->end.seconds_save += jn_seconds() - began;
	return JN_OK;
}

JnStatus jn_run_save_if_due(JnRun* run) {
	if (!is_due(run)) return JN_OK;
	JN_TRY(save(run));
	const bool is_asked = run->scene->def.checkpoint.every > 0;
	return is_asked || jn_seconds() - run->saving.written >= pause ? write_kept(run) : JN_OK;
}

JnStatus jn_run_save_at_end(JnRun* run) {
	JnArchive present = {0};
	JnStatus status = write_kept(run);
	if (status != JN_OK || jn_sim_steps(run->sim) == run->saving.step) return status;
	status = write_run(run, jn_sim_snapshot, &present);
	if (status == JN_OK) status = write_file(run, JN_CHECKPOINT_END, jn_sim_steps(run->sim), &present);
	jn_archive_free(&present);
	return status;
}
