// jounce view: recordings in a browser.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "app.h"
#include "compare_process.h"
#include "interrupt.h"
#include "view_live.h"
#include "view_options.h"
#include "view_page.h"
#include "view_routes.h"
#include "view_save.h"
#include "view_server.h"

enum { PAUSE = 250 }; // between two looks at Ctrl-C and at the run [ms]

static void open_browser(const char* url) {
	if (getenv("DISPLAY") == NULL && getenv("WAYLAND_DISPLAY") == NULL) return;
	const char* const arguments[] = {"xdg-open", url, NULL};
	compare_process_start("xdg-open", arguments, NULL, "/dev/null");
}

static int serve(const ViewOptions* options, ViewSources* sources, ViewLive* live) {
	ViewServer* server;
	char url[128];
	ViewServerOptions setting = options->server;
	setting.handler = view_answer;
	setting.user = sources;
	const JnStatus status = view_server_start(&setting, &server);
	if (status != JN_OK) return app_exit_status(status);
	const char* host = setting.host != NULL ? setting.host : "127.0.0.1";
	snprintf(url, sizeof url, "http://%s:%d/", host, view_server_port(server));
	printf("%s   (Ctrl-C ends it)\n", url);
	fflush(stdout);
	app_catch_interrupts(0);
	if (!options->opens_nothing) open_browser(url);
	while (!app_interrupted) {
		view_server_run(server, PAUSE);
		view_live_look(live, &sources->list[0]);
	}
	view_server_stop(server);
	return EXIT_DONE;
}

static int save(const ViewOptions* options, ViewSources* sources, ViewLive* live) {
	ViewSaved saved;
	app_catch_interrupts(0);
	if (live->process > 0) view_live_wait(live, &sources->list[0]);
	for (int i = 0; i < sources->count; ++i) // what is wrong has been said
		if (!sources->list[i].is_open)
			return sources->list[i].status == JN_BAD_INPUT ? EXIT_BAD_INPUT : EXIT_FILE_FAILED;
	const JnStatus status = view_save(options->save, sources, (size_t)(1e6 * options->limit), &saved);
	if (status != JN_OK) return app_exit_status(status);
	printf("wrote %s: %.1f MB", options->save, (double)saved.bytes / 1e6);
	if (saved.frames < saved.of_frames)
		printf(", with %ld of %ld frames, to stay within %g MB; --limit sets that", saved.frames, saved.of_frames,
			   options->limit);
	printf("\n");
	return live->has_failed ? EXIT_RUN_FAILED : EXIT_DONE;
}

// Folders, and what is not there, are recordings, unless a name that is not there ends as those of scenes do.
static bool is_scene(const char* path) {
	struct stat facts;
	const char* end = strrchr(path, '.');
	if (stat(path, &facts) != 0) return end != NULL && strcmp(end, ".yaml") == 0;
	return !S_ISDIR(facts.st_mode) && !recording_file_is_hdf5(path);
}

static void open_sources(ViewSources* sources, const ViewOptions* options, const ViewLive* live) {
	const bool is_live = live->folder[0] != '\0';
	for (int i = 0; i < sources->count; ++i) {
		ViewSource* source = &sources->list[i];
		*source = (ViewSource){.folder = is_live ? live->folder : options->names[i], .is_awaited = is_live};
		if (is_live) continue;
		view_source_open(source);
		if (!source->is_open) fprintf(stderr, "jounce: error: %s\n", source->error);
	}
}

static int view(const ViewOptions* options, ViewSources* sources) {
	ViewLive live = {0};
	if (is_scene(options->names[0])) {
		if (options->name_count > 1)
			return app_usage_error("view", "one scene at a time; '%s' is one too many", options->names[1]);
		const JnStatus status = view_live_start(&live, options);
		if (status != JN_OK) return app_exit_status(status);
	}
	open_sources(sources, options, &live);
	const int status = options->save != NULL ? save(options, sources, &live) : serve(options, sources, &live);
	view_live_stop(&live);
	for (int i = 0; i < sources->count; ++i) view_run_close(&sources->list[i].run);
	return status;
}

static int view_with_page(const ViewOptions* options) {
	size_t size;
	if (view_page(&size) == NULL) {
		fputs("jounce: error: this command was built without the viewer's page; install nodejs and npm, and build it "
			  "again with ./dev build\n",
			  stderr);
		return EXIT_FILE_FAILED;
	}
	const size_t count = (size_t)options->name_count;
	ViewSources sources = {.count = (int)count, .list = calloc(count, sizeof *sources.list)};
	const int status = sources.list != NULL ? view(options, &sources) : EXIT_RUN_FAILED;
	free(sources.list);
	return status;
}

int app_view(int count, char** arguments) {
	ViewOptions options;
	int status = view_options_read(count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(view_help);
	else if (status == EXIT_DONE)
		status = view_with_page(&options);
	view_options_free(&options);
	return status;
}
