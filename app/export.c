// jounce export: a recording in the formats of other programs.
#include "export.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "frames.h"
#include "interrupt.h"
#include "options.h"

static const ExportFormat formats[] = {
	{.name = "glb",
	 .doc = "glTF 2.0 with an animation: Blender, browsers, three.js, game engines",
	 .output = "run.glb",
	 .has_time = true,
	 .write = export_glb},
	{.name = "obj", .doc = "surfaces, a text file a frame", .output = "obj", .is_folder = true, .write = export_obj},
	{.name = "ply",
	 .doc = "surfaces, a binary file a frame, with colours if asked",
	 .output = "ply",
	 .is_folder = true,
	 .has_color = true,
	 .write = export_ply},
	{.name = "vtu",
	 .doc = "cells with all fields, a file a frame, and run.pvd: ParaView, VTK, meshio",
	 .output = "vtu",
	 .is_folder = true,
	 .has_time = true,
	 .has_volume = true,
	 .thread_kind = EXPORT_CURVE,
	 .write = export_vtu},
	{.name = "pc2",
	 .doc = "an .obj and a point cache for each body: Blender's modifier Mesh Cache, Maya, Houdini",
	 .output = "pc2",
	 .is_folder = true,
	 .has_time = true,
	 .write = export_pc2},
	{.name = "usda",
	 .doc = "USD as text, with time samples: Houdini, usdview, Omniverse, Blender",
	 .output = "run.usda",
	 .has_time = true,
	 .thread_kind = EXPORT_CURVE,
	 .write = export_usda},
};
enum { FORMATS = sizeof formats / sizeof *formats };

static void print_help(void) {
	fputs("usage: jounce export DIR --as FORMAT [-o PATH] [--frames A:B:STEP] [--fps N] [--color WHAT]\n\n"
		  "Writes the recording in DIR for other programs. A format is one of:\n\n",
		  stdout);
	for (int i = 0; i < FORMATS; ++i) printf("  %-5s %s\n", formats[i].name, formats[i].doc);
	puts(
		"\n  -o, --output PATH   where to; otherwise DIR/run.glb, DIR/run.usda, or the folders DIR/obj and so on. A "
		"folder\n"
		"                      must be new or empty; a file is replaced\n"
		"      --frames A:B:STEP  from A up to B without B, as Python counts: 0:100:2, ::10, -1 (the last one)\n"
		"      --fps N         show N frames a second (glb, vtu, pc2, usda); otherwise things take the time that they\n"
		"                      took in the simulation\n"
		"      --volume        cells (vtu, where this is so unless --surface is given)\n"
		"      --surface       triangles, and threads as lines\n"
		"      --color WHAT    colours of vertices (ply): displacement, speed, or a scalar or vector field of the "
		"frames\n"
		"  -q, --quiet         say nothing\n\n"
		"What is written is whole or not there. docs/export.md tells how each program opens it, and the limits.");
}

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},         {"output", required_argument, NULL, 'o'},
	{"quiet", no_argument, NULL, 'q'},        {"as", required_argument, NULL, 'a'},
	{"frames", required_argument, NULL, 'f'}, {"fps", required_argument, NULL, 'r'},
	{"color", required_argument, NULL, 'c'},  {"surface", no_argument, NULL, 's'},
	{"volume", no_argument, NULL, 'v'},       {0},
};

typedef struct Options {
	const char *folder, *format_name, *output, *frames, *fps, *color;
	bool wants_help, is_quiet, wants_surface, wants_volume;
	const ExportFormat* format;
} Options;

static int read_option(int option, char** arguments, Options* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'o':
		options->output = optarg;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 'a':
		options->format_name = optarg;
		return EXIT_DONE;
	case 'f':
		options->frames = optarg;
		return EXIT_DONE;
	case 'r':
		options->fps = optarg;
		return EXIT_DONE;
	case 'c':
		options->color = optarg;
		return EXIT_DONE;
	case 's':
		options->wants_surface = true;
		return EXIT_DONE;
	case 'v':
		options->wants_volume = true;
		return EXIT_DONE;
	case ':':
		return app_usage_error("export", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("export", known, arguments);
	}
}

static const char* format_name(void* context, int index) {
	(void)context;
	return index < FORMATS ? formats[index].name : NULL;
}

static int find_format(Options* options) {
	if (options->format_name == NULL)
		return app_usage_error("export", "no format is given; add --as glb, obj, ply, vtu, pc2 or usda");
	for (int i = 0; i < FORMATS; ++i)
		if (strcmp(formats[i].name, options->format_name) == 0) options->format = &formats[i];
	if (options->format != NULL) return EXIT_DONE;
	const char* near = jn_suggest(options->format_name, format_name, NULL);
	if (near != NULL)
		return app_usage_error("export", "there is no format '%s'; did you mean '%s'?", options->format_name, near);
	return app_usage_error("export", "there is no format '%s', only glb, obj, ply, vtu, pc2 and usda",
						   options->format_name);
}

/// What a format cannot do is refused, and not ignored.
static int check_options(const Options* options, Export* export) {
	const ExportFormat* format = options->format;
	if (options->wants_surface && options->wants_volume)
		return app_usage_error("export", "give one of --surface and --volume");
	if (options->wants_volume && !format->has_volume)
		return app_usage_error("export", "--volume: %s holds surfaces; cells go into vtu", format->name);
	if (options->color != NULL && !format->has_color)
		return app_usage_error("export", "--color: %s holds no colours of vertices; ply does, and vtu holds all fields",
							   format->name);
	if (options->fps != NULL && !format->has_time)
		return app_usage_error("export", "--fps: %s files have no times; leave it out", format->name);
	export->wants_volume = format->has_volume && !options->wants_surface;
	export->color = options->color;
	if (options->fps == NULL) return EXIT_DONE;
	char* end = NULL;
	export->fps = strtod(options->fps, &end);
	if (end != options->fps && *end == '\0' && export->fps >= 1e-3 && export->fps <= 1e6) return EXIT_DONE;
	return app_usage_error("export", "--fps: '%s' is no number from 0.001 to 1e6", options->fps);
}

static int read_options(int count, char** arguments, Options* options, Export* export) {
	opterr = 0;
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	if (options->wants_help) return EXIT_DONE;
	if (optind == count) return app_usage_error("export", "no folder of a recording is given");
	if (optind + 1 < count)
		return app_usage_error("export", "one recording at a time; '%s' is one too many", arguments[optind + 1]);
	options->folder = arguments[optind];
	const int status = find_format(options);
	return status == EXIT_DONE ? check_options(options, export) : status;
}

// ---- frames ----

static JnStatus choose_frames(Export* export, const FrameRange* range) {
	int* frames;
	double* times;
	JN_NEW(&export->arena, frames, range->count);
	JN_NEW(&export->arena, times, range->count);
	for (int i = 0; i < range->count; ++i) {
		frames[i] = range->first + i * range->step;
		times[i] = export->fps > 0 ? i / export->fps : export->recording.times[frames[i]];
	}
	export->frame_count = range->count;
	export->frames = frames;
	export->times = times;
	return JN_OK;
}

static int export_with(const Options* options, Export* export) {
	FrameRange range;
	JnStatus status = recording_open(options->folder, &export->recording);
	if (status != JN_OK) return app_exit_status(status);
	const int usage = app_read_frames("export", options->frames, export->recording.frame_count, &range);
	if (usage != EXIT_DONE) return usage;
	status = choose_frames(export, &range);
	if (status == JN_OK) status = export_find_parts(export, options->format->thread_kind);
	if (status == JN_OK) status = export_write(export, options->format, options->output);
	if (status == JN_OK && !options->is_quiet)
		printf("%s: %d frames, %ld file%s\n", export->path, export->frame_count, export->written,
			   export->written == 1 ? "" : "s");
	return app_exit_status(status);
}

int app_export(int count, char** arguments) {
	Options options = {0};
	Export export = {0};
	int status = read_options(count, arguments, &options, &export);
	if (status != EXIT_DONE) return status;
	if (options.wants_help) return print_help(), EXIT_DONE;
	app_catch_interrupts(SA_RESTART);
	status = export_with(&options, &export);
	recording_close(&export.recording);
	jn_arena_free(&export.arena);
	return status;
}
