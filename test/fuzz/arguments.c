// Command lines: the first byte chooses the subcommand, the rest are its arguments, one a line. What the options ask for is
// not done; plans that are made of options alone, of a comparison and of pictures, are.
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command/command.h"
#include "compare_plan.h"
#include "frames.h"
#include "options.h"
#include "render_options.h"
#include "render_plan.h"
#include "score_options.h"
#include "support/fuzz.h"
#include "view_options.h"

enum { MOST_ARGUMENTS = 24, ARGUMENT_BYTES = 200 };

static int read_scene(const char* command, int count, char** arguments) {
	SceneOptions options;
	const int status = scene_options_read(command, count, arguments, &options);
	scene_options_free(&options);
	return status;
}

static int read_run(int count, char** arguments) {
	return read_scene("run", count, arguments);
}

static int read_check(int count, char** arguments) {
	return read_scene("check", count, arguments);
}

// The scene is one that is not there: plans look into it for what is varied.
static int read_compare(int count, char** arguments) {
	CompareOptions options;
	ComparePlan plan = {0};
	int status = compare_options_read(count, arguments, &options);
	if (status == EXIT_DONE && !options.wants_help) {
		options.scene = "/nowhere/scene.yaml";
		status = compare_plan_create(&options, &plan);
		compare_plan_free(&plan);
	}
	compare_options_free(&options);
	return status;
}

static int read_score(int count, char** arguments) {
	ScoreOptions options;
	const int status = score_options_read(count, arguments, &options);
	score_options_free(&options);
	return status;
}

static int read_view(int count, char** arguments) {
	ViewOptions options;
	const int status = view_options_read(count, arguments, &options);
	view_options_free(&options);
	return status;
}

// Six frames of one recording, 0.1 s apart.
static int read_render(int count, char** arguments) {
	double times[] = {0, 0.1, 0.2, 0.3, 0.4, 0.5};
	ViewSource source = {.folder = "run", .is_open = true, .run = {.frame_count = 6, .times = times}};
	const ViewSources sources = {1, &source};
	RenderOptions options;
	RenderPlan plan = {0};
	int status = render_options_read(count, arguments, &options);
	if (status == EXIT_DONE && !options.wants_help) {
		status = render_plan_create(&options, &sources, &plan);
		render_plan_free(&plan);
	}
	return status;
}

static int (*const readers[])(int, char**) = {read_run,         read_check,         read_compare,     read_score,
											  read_view,        read_render,        fuzz_read_export, fuzz_read_mesh,
											  fuzz_read_report, fuzz_read_reproduce};

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	static char words[MOST_ARGUMENTS][ARGUMENT_BYTES];
	char* arguments[MOST_ARGUMENTS + 1] = {words[0]};
	FuzzBytes bytes = {data, size};
	const int reader = fuzz_byte(&bytes) % (int)(sizeof readers / sizeof readers[0]);
	int count = 1;
	strcpy(words[0], "jounce");
	for (; bytes.left > 0 && count < MOST_ARGUMENTS; ++count) {
		fuzz_word(&bytes, ARGUMENT_BYTES, words[count]);
		arguments[count] = words[count];
	}
	optind = 0; // getopt begins anew
	fuzz_listen();
	const int status = readers[reader](count, arguments);
	if (status != EXIT_DONE && status != EXIT_BAD_INPUT && status != EXIT_FILE_FAILED) abort();
	fuzz_judge(JN_OK);
	return 0;
}
