// Going on with a run: choose a checkpoint, read the scene that it holds, and run from there.
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "record/checkpoint.h"
#include "scene/checkpoint.h"

typedef struct Chosen {
	char path[JN_PATH_SIZE];
	void* bytes;
	size_t size;
} Chosen;

// A name without a folder is that of a file among the run's checkpoints.
static JnStatus find_named(const char* directory, const char* from, char path[JN_PATH_SIZE]) {
	char folder[JN_PATH_SIZE];
	if (strchr(from, '/') == NULL) {
		JN_TRY(jn_path_join(directory, "checkpoints", folder));
		return jn_path_join(folder, from, path);
	}
	return jn_path_join(from[0] == '/' ? "" : ".", from[0] == '/' ? from + 1 : from, path);
}

static JnStatus find(const JnResumeOptions* options, char path[JN_PATH_SIZE]) {
	const char* directory = options->run.directory;
	JnCheckpointFile step, end;
	if (options->from != NULL) return find_named(directory, options->from, path);
	const bool has_step = jn_checkpoint_find(directory, JN_CHECKPOINT_STEP, LONG_MAX, &step);
	const bool has_end = options->takes_latest && jn_checkpoint_find(directory, JN_CHECKPOINT_END, LONG_MAX, &end);
	if (!has_step && !has_end)
		return jn_error(
			JN_BAD_INPUT,
			"%s: there are no checkpoints to resume from; a run that was stopped in its first ten seconds, or whose "
			"results are of an earlier version, has none. Run the scene again",
			directory);
	memcpy(path, has_end && (!has_step || end.step >= step.step) ? end.path : step.path, JN_PATH_SIZE);
	return JN_OK;
}

// Of a file that is damaged the one before it is offered, not taken: the user should know.
static JnStatus read_chosen(const JnResumeOptions* options, Chosen* chosen) {
	const char* directory = options->run.directory;
	JnCheckpointFile other;
	JN_TRY(find(options, chosen->path));
	const JnStatus status = jn_checkpoint_read(chosen->path, &chosen->bytes, &chosen->size);
	if (status == JN_OK) return JN_OK;
	for (long before = LONG_MAX; jn_checkpoint_find(directory, JN_CHECKPOINT_STEP, before, &other);
		 before = other.step) {
		if (strcmp(other.path, chosen->path) == 0) continue;
		return jn_error(status,
						"the newest other checkpoint is of step %ld; to go on from there: jounce resume %s --from %s",
						other.step, directory, strrchr(other.path, '/') + 1);
	}
	return jn_error(status, "%s: there is no other checkpoint; run the scene again", directory);
}

// The overrides of the run, and those of whoever resumes it.
static JnStatus load(const JnRunOrigin* origin, const JnResumeOptions* options, JnScene** scene) {
	const int count = origin->set_count + options->set_count;
	const char** sets = calloc((size_t)count + 1, sizeof *sets);
	if (sets == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: overrides");
	for (int i = 0; i < count; ++i)
		sets[i] = i < origin->set_count ? origin->sets[i] : options->sets[i - origin->set_count];
	const JnStatus status = jn_scene_parse(origin->path, origin->text, count, sets, scene);
	free(sets);
	return status;
}

JnStatus jn_scene_resume(const JnResumeOptions* options, JnRunResult* result) {
	Chosen chosen = {0};
	JnRunOrigin origin = {0};
	JnScene* scene = NULL;
	*result = (JnRunResult){0};
	JN_TRY(read_chosen(options, &chosen));
	JnArchive archive = jn_archive_reader(chosen.bytes, chosen.size);
	JnStatus status = jn_run_origin_read(&archive, &origin);
	if (status == JN_OK) status = load(&origin, options, &scene);
	if (status == JN_OK) {
		JnRun run = {.scene = scene, .options = &options->run, .changes_step = options->set_count > 0};
		status = jn_run_execute(&run, &archive, result);
	}
	jn_scene_destroy(scene);
	jn_run_origin_free(&origin);
	free(chosen.bytes);
	return status;
}
