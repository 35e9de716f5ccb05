// Pictures at evenly spaced times, put into the page as base64.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "interrupt.h"
#include "render_shoot.h"
#include "report_page.h"
#include "view_code.h"

enum { WIDTH = 720, HEIGHT = 450, NARROW = 400, MOST_DRAWN = 6, MOST_PICTURES = 60 };

typedef struct Album {
	FILE* out;
	const double* times;
} Album;

static JnStatus take(void* user, int number, const void* data, size_t size) {
	const Album* album = user;
	fprintf(album->out, "<figure><img alt=\"The bodies at %.6g s\" src=\"data:image/webp;base64,",
			album->times[number]);
	view_code_print(album->out, &(ViewBytes){.data = (char*)data, .size = size});
	fprintf(album->out, "\"></figure>\n");
	return ferror(album->out) ? JN_OUT_OF_MEMORY : JN_OK;
}

static void keep_reason(void* user, JnLogLevel level, const char* message) {
	Report* report = user;
	if (level == JN_LOG_ERROR) snprintf(report->no_pictures, sizeof report->no_pictures, "%s", message);
}

static int choose_times(const ViewSources* sources, int wanted, double times[MOST_PICTURES]) {
	double last = 0;
	const double first = sources->list[0].run.times[0];
	for (int i = 0; i < sources->count; ++i) {
		const ViewRun* run = &sources->list[i].run;
		if (run->times[run->frame_count - 1] > last) last = run->times[run->frame_count - 1];
	}
	const int count = wanted > MOST_PICTURES ? MOST_PICTURES : last > first ? wanted : 1;
	for (int i = 0; i < count; ++i) times[i] = count > 1 ? first + (last - first) * i / (count - 1) : last;
	return count;
}

void report_pictures_make(Report* report) {
	double times[MOST_PICTURES];
	int taken = 0;
	if (report->options->pictures == 0) return;
	ViewSources drawn = *report->sources; // the first of them; a crowd cannot be seen
	if (drawn.count > MOST_DRAWN) drawn.count = MOST_DRAWN;
	Album album = {.out = open_memstream(&report->pictures, &report->pictures_size), .times = times};
	if (album.out == NULL) return;
	const bool is_alone = drawn.count == 1;
	RenderJob job = {.sources = &drawn, .width = is_alone ? WIDTH : NARROW * (drawn.count < 3 ? drawn.count : 3)};
	job.height = is_alone ? HEIGHT : 300 * ((drawn.count + 2) / 3);
	job.samples = 2;
	job.kind = RENDER_WEBP;
	job.field = report->options->field;
	job.has_legend = job.has_time = job.has_names = true;
	job.count = choose_times(&drawn, report->options->pictures, times);
	job.times = times;
	job.take = take;
	job.user = &album;
	const JnLog log = jn_log_swap((JnLog){keep_reason, report});
	const JnStatus status = render_shoot(&job, &taken);
	jn_log_swap(log);
	const bool is_whole = fclose(album.out) == 0 && status == JN_OK && taken == job.count;
	if (is_whole || app_interrupted) return;
	free(report->pictures);
	report->pictures = NULL;
}

void report_pictures(Report* report) {
	if (report->pictures == NULL) return;
	const bool is_alone = report->count == 1;
	jn_text_print(&report->file, "<section><h2>Pictures</h2><div class=\"%s\">\n", is_alone ? "pictures" : "strips");
	jn_text_write(&report->file, report->pictures, report->pictures_size);
	jn_text_print(&report->file, "</div>");
	if (report->count > MOST_DRAWN)
		jn_text_print(&report->file, "<p class=\"faint\">Of the first %d of %d runs.</p>", MOST_DRAWN, report->count);
	jn_text_print(&report->file, "</section>\n");
}
