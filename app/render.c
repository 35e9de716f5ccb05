// jounce render: pictures and films of recordings, without a display or a graphics card.
//
//   options -> sources (open recordings) -> plan (times) -> shoot (a browser draws them) -> files, or a film
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "app.h"
#include "base/log.h"
#include "base/timer.h"
#include "film.h"
#include "interrupt.h"
#include "render_plan.h"
#include "render_sources.h"

static const char help[] =
	"usage: jounce render DIR... [-o picture.png | --film film.mp4] [--frames A:B:STEP | --times ...]\n"
	"                     [--size 1280x720] [--camera ...] [--color FIELD] ...\n\n"
	"Draws recordings as `jounce view` does, several side by side, without a display or a graphics card: Chromium "
	"does\n"
	"it by itself. The last frame is drawn unless others are chosen; a film shows all of the motion.\n\n"
	"  -o, --output FILE    .png, .jpg or .webp; of several pictures each has its number before the dot, or where "
	"%04d\n"
	"                       stands; default picture.png in the first DIR\n"
	"      --film FILE      .mp4 (H.264) or .gif, by ffmpeg\n"
	"      --frames A:B:STEP  frames of the first DIR, from 0, or from -1, the last, back; also A and A:B\n"
	"      --times A:B:STEP   times, such as 0:2:50ms; also 0.5,1,1.5; what is shown is the last frame until then\n"
	"      --fps N          of a film; default 30, of a GIF 25\n"
	"      --speed S        of a film: 1 is real time, 0.1 ten times slower; default: 1 when the film then takes 3 to "
	"30\n"
	"                       seconds\n"
	"      --size WxH       pixels; default 1280x720\n"
	"      --camera A,E[,Z] azimuth, elevation in degrees, zoom; 1, the default: all of the motion is in the picture\n"
	"      --camera EYE/TARGET  points, such as 2,1,3/0,0.5,0 in m\n"
	"      --color FIELD    displacement, speed, or another of the recording; --map NAME: viridis, magma, cividis, "
	"turbo;\n"
	"                       --range LOW,HIGH\n"
	"      --text WORDS     what is written over the picture: some of legend,time,names, or none; default: all\n"
	"      --theme THEME    light (default) or dark\n"
	"      --samples N      samples along each side of a pixel, besides the renderer's own; default 2\n"
	"  -q, --quiet          no progress\n\n"
	"exit status: 0 done, or stopped by Ctrl-C; 2 bad input; 3 files, no browser, no ffmpeg";

typedef struct Render {
	const RenderOptions* options;
	const RenderPlan* plan;
	Film film;
	double began;
	bool is_terminal;
} Render;

static void show_progress(const Render* render, int done) {
	if (render->options->is_quiet || !render->is_terminal) return;
	printf("\r%d/%d pictures\033[K", done, render->plan->count);
	if (done == render->plan->count) printf("\r\033[K");
	fflush(stdout);
}

// "name.png" is "name_0007.png" when there are several; a name with %d, %04d, ... has the number there.
static JnStatus name_picture(const Render* render, int number, char folder[JN_PATH_SIZE], char name[256]) {
	const char* path = render->options->output;
	const char* slash = strrchr(path, '/');
	const char* last = slash != NULL ? slash + 1 : path;
	const char *dot = strrchr(last, '.'), *mark = strchr(last, '%');
	int digits = 0, end = 0;
	snprintf(folder, JN_PATH_SIZE, "%.*s", slash != NULL ? (int)(slash - path) : 1, slash != NULL ? path : ".");
	if (slash == path) snprintf(folder, JN_PATH_SIZE, "/");
	if (strlen(last) > 200) return jn_error(JN_IO_FAILED, "%s: the name is too long", path);
	if (mark != NULL && mark[1] == 'd') end = 2;
	if (mark != NULL && end == 0) sscanf(mark, "%%%2dd%n", &digits, &end);
	if (end > 0)
		snprintf(name, 256, "%.*s%0*d%s", (int)(mark - last), last, digits, number, mark + end);
	else if (render->plan->count > 1)
		snprintf(name, 256, "%.*s_%04d%s", (int)(dot - last), last, number, dot);
	else
		snprintf(name, 256, "%s", last);
	return JN_OK;
}

static JnStatus write_picture(const Render* render, int number, const void* data, size_t size) {
	char folder[JN_PATH_SIZE], name[256];
	JnTextFile file;
	JN_TRY(name_picture(render, number, folder, name));
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	jn_text_write(&file, data, size);
	return jn_text_close(&file);
}

static JnStatus take(void* user, int number, const void* data, size_t size) {
	Render* render = user;
	const JnStatus status =
		render->options->film != NULL ? film_add(&render->film, data, size) : write_picture(render, number, data, size);
	if (status == JN_OK) show_progress(render, number + 1);
	return status;
}

static void print_speed(double speed) {
	if (speed == 1) printf(", real time");
	if (speed > 0 && speed < 1) printf(", %.3g times slower than real time", 1 / speed);
	if (speed > 1) printf(", %.3g times faster than real time", speed);
}

static void print_end(const Render* render, int taken) {
	const RenderOptions* options = render->options;
	const RenderPlan* plan = render->plan;
	const double seconds = jn_seconds() - render->began;
	if (options->is_quiet) return;
	if (taken < plan->count) printf("stopped as asked, with %d of %d pictures drawn\n", taken, plan->count);
	if (taken < plan->count && (options->film != NULL || taken == 0)) return;
	printf("wrote %s: %d picture%s of %d x %d", options->film != NULL ? options->film : options->output, taken,
		   taken == 1 ? "" : "s", options->job.width, options->job.height);
	if (options->film != NULL) printf(", %.3g s", plan->count / plan->fps);
	if (options->film != NULL) print_speed(plan->speed);
	printf("; took %.1f s", seconds);
	if (taken > 1) printf(", %.2f s a picture", seconds / taken);
	putchar('\n');
}

static JnStatus draw(Render* render, ViewSources* sources) {
	int taken = 0;
	RenderJob job = render->options->job;
	job.sources = sources;
	job.count = render->plan->count;
	job.times = render->plan->times;
	job.take = take;
	job.user = render;
	const bool is_film = render->options->film != NULL;
	JnStatus status = is_film ? film_open(&render->film, render->options, render->plan->fps) : JN_OK;
	if (status == JN_OK) status = render_shoot(&job, &taken);
	if (is_film && status == JN_OK && taken == job.count) status = film_close(&render->film);
	if (is_film) film_abandon(&render->film);
	if (status == JN_OK) print_end(render, taken);
	return status;
}

static int render(const RenderOptions* options, ViewSources* sources) {
	RenderPlan plan = {0};
	int status = render_sources_check_field(sources, options->job.field);
	if (status == EXIT_DONE) status = render_plan_create(options, sources, &plan);
	Render work = {.options = options, .plan = &plan, .film.input = -1, .began = jn_seconds()};
	work.is_terminal = isatty(STDOUT_FILENO);
	app_catch_interrupts(0);
	if (status == EXIT_DONE) status = app_exit_status(draw(&work, sources));
	for (int i = 0; i < sources->count; ++i) // the browser knows only that there is no answer
		if (status == EXIT_FILE_FAILED && recording_file_has_failed(sources->list[i].run.recording.file))
			status = EXIT_BAD_INPUT;
	render_plan_free(&plan);
	return status;
}

int app_render(int count, char** arguments) {
	RenderOptions options;
	ViewSources sources = {0};
	char path[JN_PATH_SIZE];
	int status = render_options_read(count, arguments, &options);
	if (status != EXIT_DONE) return status;
	if (options.wants_help) return puts(help), EXIT_DONE;
	if (options.output == NULL && options.film == NULL) {
		if (jn_path_join(options.folders[0], "picture.png", path) != JN_OK) return EXIT_FILE_FAILED;
		options.output = path;
	}
	status = render_sources_open(options.folder_count, options.folders, &sources);
	if (status == EXIT_DONE) status = render(&options, &sources);
	render_sources_close(&sources);
	return status;
}
