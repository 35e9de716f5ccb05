#include "render_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/key.h"

enum { MOST_PICTURES = 100000, WORD_BYTES = 64 };
enum { SHORTEST = 3, LONGEST = 30 }; // of a film whose speed is ours to choose [s]

#define REFUSE(...) app_usage_error("render", __VA_ARGS__)

static int add(RenderPlan* plan, double time) {
	if (plan->count == MOST_PICTURES) return REFUSE("these are more than %d pictures", MOST_PICTURES);
	plan->times[plan->count++] = time;
	return EXIT_DONE;
}

// Parts of a text between separators; their number, or 0 when one is too long or there are more than `most`.
static int split(const char* text, char separator, int most, char parts[][WORD_BYTES]) {
	const char separators[] = {separator, '\0'};
	int count = 0;
	for (;; ++text) {
		const size_t length = strcspn(text, separators);
		if (count == most || length == 0 || length >= WORD_BYTES) return 0;
		memcpy(parts[count], text, length);
		parts[count++][length] = '\0';
		text += length;
		if (*text == '\0') return count;
	}
}

// ---- frames ----

static bool read_frame(const char* text, long frames, long* number) {
	char* end = NULL;
	*number = strtol(text, &end, 10);
	if (end == text || *end != '\0') return false;
	if (*number < 0) *number += frames;
	return *number >= 0 && *number < frames;
}

static int plan_frames(const char* text, const ViewRun* run, RenderPlan* plan) {
	char parts[3][WORD_BYTES];
	long first, last, step = 1;
	const int count = split(text, ':', 3, parts);
	bool is_read = count > 0 && read_frame(parts[0], run->frame_count, &first);
	if (is_read) last = first;
	if (is_read && count > 1) is_read = read_frame(parts[1], run->frame_count, &last) && last >= first;
	if (is_read && count > 2) {
		char* end = NULL;
		step = strtol(parts[2], &end, 10);
		is_read = *end == '\0' && step > 0;
	}
	if (!is_read)
		return REFUSE("--frames: '%s' is not A, A:B or A:B:STEP with frames from 0 to %ld, or from -1, the last, back",
					  text, run->frame_count - 1);
	for (long frame = first; frame <= last; frame += step) {
		const int status = add(plan, run->times[frame]);
		if (status != EXIT_DONE) return status;
	}
	return EXIT_DONE;
}

// ---- times ----

static int refuse_time(const char* text, const char* reason) {
	return REFUSE("--times: '%s' %s; write 0.5,1,1.5 or 0:2:100ms", text, reason);
}

static int plan_range(const char* text, RenderPlan* plan) {
	char parts[3][WORD_BYTES];
	double numbers[3];
	if (split(text, ':', 3, parts) != 3) return refuse_time(text, "is not A:B:STEP");
	for (int i = 0; i < 3; ++i) {
		const char* reason = jn_quantity_parse(parts[i], "s", &numbers[i]);
		if (reason != NULL) return refuse_time(parts[i], reason);
	}
	if (!(numbers[2] > 0) || numbers[1] < numbers[0]) return refuse_time(text, "does not go on");
	for (int i = 0; numbers[0] + i * numbers[2] <= numbers[1] + 1e-9 * numbers[2]; ++i) {
		const int status = add(plan, numbers[0] + i * numbers[2]);
		if (status != EXIT_DONE) return status;
	}
	return EXIT_DONE;
}

static int plan_list(const char* text, RenderPlan* plan) {
	while (*text != '\0') {
		char word[WORD_BYTES];
		double time;
		const size_t length = strcspn(text, ",");
		snprintf(word, sizeof word, "%.*s", (int)length, text);
		const char* reason = jn_quantity_parse(word, "s", &time);
		if (reason != NULL) return refuse_time(word, reason);
		const int status = add(plan, time);
		if (status != EXIT_DONE) return status;
		text += length + (text[length] == ',');
	}
	return EXIT_DONE;
}

// ---- films ----

// Real time when the film has a length that one likes to watch; otherwise the nearest of 1, 2, 5, 10, ... times slower or
// faster that gives it one.
static double choose_speed(double span) {
	static const double steps[] = {1, 2, 5};
	if (!(span > 0)) return 1;
	for (int i = 0; span < SHORTEST && i < 60; ++i) {
		const double slower = steps[i % 3] * pow(10, (int)(i / 3));
		if (span * slower >= SHORTEST) return 1 / slower;
	}
	for (int i = 0; span > LONGEST && i < 60; ++i) {
		const double faster = steps[i % 3] * pow(10, (int)(i / 3));
		if (span / faster <= LONGEST) return faster;
	}
	return 1;
}

static int plan_film(double speed, const ViewSources* sources, RenderPlan* plan) {
	double first = INFINITY, last = -INFINITY;
	for (int i = 0; i < sources->count; ++i) {
		const ViewRun* run = &sources->list[i].run;
		first = fmin(first, run->times[0]);
		last = fmax(last, run->times[run->frame_count - 1]);
	}
	plan->speed = speed > 0 ? speed : choose_speed(last - first);
	const double step = plan->speed / plan->fps;
	for (int i = 0; i == 0 || first + i * step <= last + 1e-9 * step; ++i) {
		const int status = add(plan, first + i * step);
		if (status != EXIT_DONE) return status;
	}
	return EXIT_DONE;
}

int render_plan_create(const RenderOptions* options, const ViewSources* sources, RenderPlan* plan) {
	const double usual = options->film_kind == FILM_GIF ? 25 : 30; // a GIF counts in hundredths of a second
	const ViewRun* run = &sources->list[0].run;
	*plan = (RenderPlan){.times = malloc(MOST_PICTURES * sizeof *plan->times)};
	plan->fps = options->fps > 0 ? options->fps : usual;
	if (plan->times == NULL) return EXIT_RUN_FAILED;
	if (options->frames != NULL) return plan_frames(options->frames, run, plan);
	if (options->times != NULL && strchr(options->times, ':') != NULL) return plan_range(options->times, plan);
	if (options->times != NULL) return plan_list(options->times, plan);
	if (options->film != NULL) return plan_film(options->speed, sources, plan);
	return add(plan, run->times[run->frame_count - 1]);
}

void render_plan_free(RenderPlan* plan) {
	free(plan->times);
	*plan = (RenderPlan){0};
}
