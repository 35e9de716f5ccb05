#include "render_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "app.h"
#include "options.h"
#include "recording_file.h"

enum { MOST_PIXELS = 8192, MOST_SAMPLES = 4, MOST_NUMBERS = 6 }; // what SwiftShader draws into at once

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},         {"camera", required_argument, NULL, 'c'},
	{"color", required_argument, NULL, 'f'},  {"colour", required_argument, NULL, 'f'},
	{"film", required_argument, NULL, 'F'},   {"fps", required_argument, NULL, 'p'},
	{"frames", required_argument, NULL, 'n'}, {"map", required_argument, NULL, 'm'},
	{"output", required_argument, NULL, 'o'}, {"quiet", no_argument, NULL, 'q'},
	{"range", required_argument, NULL, 'r'},  {"samples", required_argument, NULL, 'a'},
	{"size", required_argument, NULL, 's'},   {"speed", required_argument, NULL, 'v'},
	{"text", required_argument, NULL, 'x'},   {"theme", required_argument, NULL, 'T'},
	{"times", required_argument, NULL, 't'},  {0},
};

#define REFUSE(...) app_usage_error("render", __VA_ARGS__)

// Up to `most` numbers with `separator` between them; 0 when the text is anything else. `*end` is what follows.
static int read_numbers(const char* text, char separator, int most, double* out, const char** end) {
	int count = 0;
	while (count < most) {
		char* next = NULL;
		out[count] = strtod(text, &next);
		if (next == text || !isfinite(out[count])) return 0;
		text = next;
		++count;
		if (*text != separator) break;
		++text;
	}
	*end = text;
	return count;
}

static int read_size(RenderJob* job) {
	double size[2];
	const char* end = "";
	const bool is_read = read_numbers(optarg, 'x', 2, size, &end) == 2 && *end == '\0';
	if (!is_read || size[0] != floor(size[0]) || size[1] != floor(size[1]) || fmin(size[0], size[1]) < 16 ||
		fmax(size[0], size[1]) > MOST_PIXELS)
		return REFUSE("--size: '%s' is no size such as 1920x1080, from 16 to %d pixels", optarg, MOST_PIXELS);
	job->width = (int)size[0];
	job->height = (int)size[1];
	return EXIT_DONE;
}

// -0 and 0 are one place.
static bool is_same_point(const double a[3], const double b[3]) {
	return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// "azimuth,elevation[,zoom]", or "x,y,z/x,y,z".
static int read_camera(RenderCamera* camera) {
	double numbers[MOST_NUMBERS];
	const char* end = "";
	*camera = (RenderCamera){.zoom = 1};
	const int count = read_numbers(optarg, ',', 3, numbers, &end);
	if (count == 3 && *end == '/') {
		const char* behind = "";
		camera->has_points = read_numbers(end + 1, ',', 3, numbers + 3, &behind) == 3 && *behind == '\0' &&
							 !is_same_point(numbers, numbers + 3);
		memcpy(camera->eye, numbers, sizeof camera->eye);
		memcpy(camera->target, numbers + 3, sizeof camera->target);
	} else if (count >= 2 && *end == '\0') {
		camera->azimuth = numbers[0];
		camera->elevation = numbers[1];
		if (count == 3) camera->zoom = numbers[2];
		camera->has_angles = fabs(camera->elevation) < 90 && camera->zoom > 0;
	}
	if (camera->has_angles || camera->has_points) return EXIT_DONE;
	return REFUSE(
		"--camera: '%s' is neither azimuth,elevation[,zoom], such as 30,20,1.2 in degrees, nor eye/target, such "
		"as 2,1,3/0,0,0 in m",
		optarg);
}

static int read_range(RenderJob* job) {
	const char* end = "";
	job->has_range =
		read_numbers(optarg, ',', 2, job->range, &end) == 2 && *end == '\0' && job->range[0] < job->range[1];
	if (job->has_range) return EXIT_DONE;
	return REFUSE("--range: '%s' are no two numbers such as 0,1500, the lower one first", optarg);
}

static int read_text(RenderJob* job) {
	job->has_legend = job->has_time = job->has_names = false;
	if (strcmp(optarg, "none") == 0) return EXIT_DONE;
	const struct {
		const char* word;
		bool* choice;
	} words[] = {{"legend", &job->has_legend}, {"time", &job->has_time}, {"names", &job->has_names}};
	for (const char* at = optarg; *at != '\0';) {
		const size_t length = strcspn(at, ",");
		bool is_known = false;
		for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
			if (strlen(words[i].word) == length && strncmp(at, words[i].word, length) == 0)
				*words[i].choice = is_known = true;
		if (!is_known) return REFUSE("--text: '%s': write none, or some of legend,time,names", optarg);
		at += length + (at[length] == ',');
	}
	return EXIT_DONE;
}

static int read_above_zero(const char* name, double most, double* value) {
	char* end = NULL;
	*value = strtod(optarg, &end);
	if (end != optarg && *end == '\0' && *value > 0 && *value <= most) return EXIT_DONE;
	return REFUSE("--%s: '%s' is no number above 0 and up to %g", name, optarg, most);
}

static int read_samples(RenderJob* job) {
	char* end = NULL;
	const long number = strtol(optarg, &end, 10);
	if (end == optarg || *end != '\0' || number < 1 || number > MOST_SAMPLES)
		return REFUSE("--samples: '%s' is no whole number from 1 to %d", optarg, MOST_SAMPLES);
	job->samples = (int)number;
	return EXIT_DONE;
}

static int read_theme(RenderJob* job) {
	job->theme = optarg;
	if (strcmp(optarg, "light") == 0 || strcmp(optarg, "dark") == 0) return EXIT_DONE;
	return REFUSE("--theme: '%s' is neither light nor dark", optarg);
}

// What a name ends with, without the dot.
static const char* extension_of(const char* path) {
	const char *slash = strrchr(path, '/'), *dot = strrchr(slash != NULL ? slash : path, '.');
	return dot != NULL ? dot + 1 : "";
}

static int read_output(RenderOptions* options) {
	static const struct {
		const char* extension;
		RenderKind kind;
	} kinds[] = {{"png", RENDER_PNG}, {"jpg", RENDER_JPEG}, {"jpeg", RENDER_JPEG}, {"webp", RENDER_WEBP}};
	options->output = optarg;
	for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
		if (strcasecmp(extension_of(optarg), kinds[i].extension) != 0) continue;
		options->job.kind = kinds[i].kind;
		return EXIT_DONE;
	}
	return REFUSE("-o: '%s' does not end with .png, .jpg or .webp; a film is asked for by --film", optarg);
}

static int read_film(RenderOptions* options) {
	options->film = optarg;
	options->film_kind = strcasecmp(extension_of(optarg), "gif") == 0 ? FILM_GIF : FILM_MP4;
	if (options->film_kind == FILM_GIF || strcasecmp(extension_of(optarg), "mp4") == 0) return EXIT_DONE;
	return REFUSE("--film: '%s' does not end with .mp4 or .gif", optarg);
}

static int read_option(int option, char** arguments, RenderOptions* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'q':
		options->is_quiet = true;
		return EXIT_DONE;
	case 'o':
		return read_output(options);
	case 'F':
		return read_film(options);
	case 'n':
		options->frames = optarg;
		return EXIT_DONE;
	case 't':
		options->times = optarg;
		return EXIT_DONE;
	case 'f':
		options->job.field = optarg;
		return EXIT_DONE;
	case 'm':
		options->job.map = optarg;
		return EXIT_DONE;
	case 's':
		return read_size(&options->job);
	case 'c':
		return read_camera(&options->job.camera);
	case 'r':
		return read_range(&options->job);
	case 'x':
		return read_text(&options->job);
	case 'a':
		return read_samples(&options->job);
	case 'T':
		return read_theme(&options->job);
	case 'p':
		return read_above_zero("fps", 240, &options->fps);
	case 'v':
		return read_above_zero("speed", 1e9, &options->speed);
	case ':':
		return REFUSE("%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("render", known, arguments);
	}
}

// What does not go together.
static int check(const RenderOptions* options) {
	if (options->folder_count == 0) return REFUSE("nothing to draw is given: a folder of results");
	if (options->output != NULL && options->film != NULL) return REFUSE("-o and --film: one of them at a time");
	if (options->frames != NULL && options->times != NULL) return REFUSE("--frames and --times: one of them at a time");
	if (options->film == NULL && (options->fps > 0 || options->speed > 0))
		return REFUSE("--fps and --speed are for a --film");
	if (options->speed > 0 && (options->frames != NULL || options->times != NULL))
		return REFUSE("--speed chooses the times of a film; leave it out, or --frames and --times");
	if (options->film != NULL && options->film_kind == FILM_MP4 && (options->job.width | options->job.height) & 1)
		return REFUSE("--size: the pictures of an mp4 have even widths and heights");
	if (options->job.samples * (long)fmax(options->job.width, options->job.height) > MOST_PIXELS)
		return REFUSE("--samples: %d x %d pixels with %d samples along each side are too many; at most %d along a side",
					  options->job.width, options->job.height, options->job.samples, MOST_PIXELS);
	return EXIT_DONE;
}

int render_options_read(int count, char** arguments, RenderOptions* options) {
	opterr = 0; // the words are ours
	*options = (RenderOptions){.job = {.width = 1280, .height = 720, .samples = 2, .kind = RENDER_PNG}};
	options->job.has_legend = options->job.has_time = options->job.has_names = true;
	for (int option; (option = getopt_long(count, arguments, ":ho:q", known, NULL)) != -1;) {
		const int status = read_option(option, arguments, options);
		if (status != EXIT_DONE) return status;
	}
	options->folder_count = count - optind;
	options->folders = arguments + optind;
	for (int i = optind; i < count; ++i) recording_file_fold(&arguments[i]);
	if (options->film != NULL) options->job.kind = RENDER_RAW;
	return options->wants_help ? EXIT_DONE : check(options);
}
