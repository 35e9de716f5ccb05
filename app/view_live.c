#include "view_live.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/folder.h"
#include "base/log.h"
#include "compare_process.h"
#include "interrupt.h"
#include "jounce/scene.h"

// The scene is read here first, so that its errors come before a browser opens.
static JnStatus choose_folder(ViewLive* live, const ViewOptions* options) {
	JnScene* scene;
	JN_TRY(jn_scene_load(options->names[0], options->set_count, options->sets, &scene));
	snprintf(live->folder, sizeof live->folder, "out/%s", jn_scene_def(scene)->name);
	if (options->directory != NULL) snprintf(live->folder, sizeof live->folder, "%s", options->directory);
	jn_scene_destroy(scene);
	return jn_folder_make(live->folder);
}

// What an earlier run has left would be taken for this one's.
static JnStatus remove_earlier(const ViewLive* live) {
	static const char* const names[] = {"run.h5", "summary.json"};
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
		char path[JN_PATH_SIZE];
		JN_TRY(jn_path_join(live->folder, names[i], path));
		if (unlink(path) != 0 && errno != ENOENT)
			return jn_error(JN_IO_FAILED, "%s: cannot be removed: %s", path, strerror(errno));
	}
	return JN_OK;
}

static JnStatus start(ViewLive* live, const ViewOptions* options) {
	char threads[16];
	int count = 0;
	const char** arguments = calloc(2 * (size_t)options->set_count + 10, sizeof *arguments);
	if (arguments == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the arguments of a run");
	snprintf(threads, sizeof threads, "%d", options->threads);
	const char* const first[] = {"jounce", "run", options->names[0], "-o", live->folder, "--quiet"};
	for (size_t i = 0; i < sizeof first / sizeof *first; ++i) arguments[count++] = first[i];
	for (int i = 0; i < options->set_count; ++i) {
		arguments[count++] = "--set";
		arguments[count++] = options->sets[i];
	}
	if (options->threads > 0) {
		arguments[count++] = "--threads";
		arguments[count++] = threads;
	}
	live->process = compare_process_start("/proc/self/exe", arguments, NULL, live->log);
	const int reason = errno;
	free(arguments);
	if (live->process > 0) return JN_OK;
	live->process = 0;
	return jn_error(JN_RUN_FAILED, "the run of %s cannot be started: %s", options->names[0], strerror(reason));
}

JnStatus view_live_start(ViewLive* live, const ViewOptions* options) {
	*live = (ViewLive){0};
	JN_TRY(choose_folder(live, options));
	JN_TRY(jn_path_join(live->folder, "run.log", live->log));
	JN_TRY(remove_earlier(live));
	return start(live, options);
}

// The last line of what the run said.
static void read_last_line(const char* path, char line[VIEW_MESSAGE_BYTES]) {
	FILE* file = fopen(path, "r");
	char next[VIEW_MESSAGE_BYTES];
	snprintf(line, VIEW_MESSAGE_BYTES, "the run has ended without a recording; see %.200s", path);
	while (file != NULL && fgets(next, sizeof next, file) != NULL)
		if (next[0] != '\n') memcpy(line, next, sizeof next);
	line[strcspn(line, "\n")] = '\0';
	if (file != NULL) fclose(file);
}

void view_live_look(ViewLive* live, ViewSource* source) {
	int wait_status;
	if (live->process == 0 || waitpid(live->process, &wait_status, WNOHANG) != live->process) return;
	live->process = 0;
	view_source_open(source);
	source->is_awaited = false;
	if (compare_process_status(wait_status) == 0) {
		printf("the run has ended; its results are in %s\n", live->folder);
	} else {
		char line[VIEW_MESSAGE_BYTES];
		live->has_failed = true;
		read_last_line(live->log, line);
		fprintf(stderr, "%s\n", line);
		if (!source->is_open) snprintf(source->error, sizeof source->error, "%s", line);
	}
	fflush(stdout);
}

void view_live_wait(ViewLive* live, ViewSource* source) {
	const struct timespec pause = {.tv_nsec = 50 * 1000 * 1000};
	while (live->process != 0 && !app_interrupted) {
		nanosleep(&pause, NULL);
		view_live_look(live, source);
	}
	view_live_stop(live);
	source->is_awaited = false;
	view_source_open(source);
}

void view_live_stop(ViewLive* live) {
	if (live->process == 0) return;
	fputs("stopping the run; its files are completed\n", stderr);
	kill(live->process, SIGINT);
	compare_process_wait(live->process);
	live->process = 0;
}
