// `jounce render`: pictures with the size, the times and the bodies that were asked for; films with their frames; and what
// is said when there is no browser, or one that fails.
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>

#include <cmocka.h>

#include "support/support.h"

enum { WIDTH = 160, HEIGHT = 100, PATIENCE = 400 }; // [50 ms]

// A block that falls by 5 m, more than its own height, so that no two frames look alike.
static const char scene_text[] =
	"name: block\nduration: 1 s\nbodies:\n"
	"  - name: block\n"
	"    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
	"    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
	"integrator: sdirk2\nstep: {controller: fixed, dt: 50 ms}\nrecord: {interval: 100 ms, plots: no}\n";

static char folder[256], usual_browser[256];

static int set_up(void** state) {
	(void)state;
	const int status = folder_create_with_run(folder, scene_text);
	const char* chosen = getenv("JOUNCE_BROWSER");
	snprintf(usual_browser, sizeof usual_browser, "%s", chosen != NULL ? chosen : "");
	return status;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static int restore_browser(void** state) {
	(void)state;
	if (usual_browser[0] != '\0') return setenv("JOUNCE_BROWSER", usual_browser, 1);
	return unsetenv("JOUNCE_BROWSER");
}

static Outcome run(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce %s' ends with %d, expected %d\n%s\n%s", arguments[0], outcome.status, expected, outcome.out,
				 outcome.err);
	return outcome;
}

#define RENDER(status, ...) run(status, (const char* const[]){"render", "block", __VA_ARGS__, NULL})

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

static void refused(int status, const char* part, const char* const arguments[]) {
	Outcome outcome = run(status, arguments);
	expect_part(outcome.err, part);
	outcome_free(&outcome);
}

#define REFUSED(status, part, ...) refused(status, part, (const char* const[]){"render", "block", __VA_ARGS__, NULL})

static bool has_program(const char* name) {
	const char* at = getenv("PATH");
	while (at != NULL && *at != '\0') {
		char path[512];
		const int length = (int)strcspn(at, ":");
		snprintf(path, sizeof path, "%.*s/%s", length, at, name);
		if (access(path, X_OK) == 0) return true;
		at += length + (at[length] == ':');
	}
	return false;
}

static bool lacks_browser(void) {
	if (usual_browser[0] != '\0' || has_program("chromium") || has_program("chromium-browser") ||
		has_program("google-chrome"))
		return false;
	print_message("skipped: Chromium is not installed (apt-get install chromium)\n");
	return true;
}

static bool lacks_ffmpeg(void) {
	if (has_program("ffmpeg") && has_program("ffprobe")) return false;
	print_message("skipped: ffmpeg is not installed (apt-get install ffmpeg)\n");
	return true;
}

// A program that takes the browser's place.
static void use_script(const char* text) {
	const char* path = path_join(folder, "browser");
	file_write(path, text);
	assert_int_equal(chmod(path, 0755), 0);
	setenv("JOUNCE_BROWSER", path, 1);
}

// ---- reading PNG (8 bits, RGB or RGBA, not interlaced: what Chromium writes) ----

typedef struct Picture {
	int width, height, channels;
	unsigned char* rows; // height * (1 + width * channels), unfiltered
} Picture;

static unsigned number_at(const unsigned char* at) {
	return (unsigned)at[0] << 24 | (unsigned)at[1] << 16 | (unsigned)at[2] << 8 | at[3];
}

static unsigned char predict(int filter, int left, int above, int corner) {
	const int guess = left + above - corner;
	const int a = abs(guess - left), b = abs(guess - above), c = abs(guess - corner);
	switch (filter) {
	case 1:
		return (unsigned char)left;
	case 2:
		return (unsigned char)above;
	case 3:
		return (unsigned char)((left + above) / 2);
	case 4:
		return (unsigned char)(a <= b && a <= c ? left : b <= c ? above : corner);
	default:
		return 0;
	}
}

static void unfilter(Picture* picture) {
	const int n = picture->channels, length = picture->width * n, stride = length + 1;
	for (int y = 0; y < picture->height; ++y) {
		unsigned char* row = picture->rows + (ptrdiff_t)y * stride + 1;
		for (int i = 0; i < length; ++i) {
			const int left = i >= n ? row[i - n] : 0, above = y > 0 ? row[i - stride] : 0;
			const int corner = i >= n && y > 0 ? row[i - n - stride] : 0;
			row[i] = (unsigned char)(row[i] + predict(row[-1], left, above, corner));
		}
	}
}

static unsigned char* read_bytes(const char* path, size_t* size) {
	struct stat facts;
	FILE* file = fopen(path, "rb");
	if (file == NULL || fstat(fileno(file), &facts) != 0) fail_msg("%s is not there", path);
	*size = (size_t)facts.st_size;
	unsigned char* bytes = malloc(*size);
	assert_int_equal(fread(bytes, 1, *size, file), *size);
	fclose(file);
	return bytes;
}

static Picture read_picture(const char* name) {
	size_t size, packed = 0;
	unsigned char *bytes = read_bytes(path_join(folder, name), &size), *data = malloc(size);
	assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
	assert_int_equal(bytes[24], 8);
	Picture picture = {(int)number_at(bytes + 16), (int)number_at(bytes + 20), bytes[25] == 6 ? 4 : 3, NULL};
	for (size_t at = 8; at + 12 <= size; at += number_at(bytes + at) + 12) {
		if (memcmp(bytes + at + 4, "IDAT", 4) != 0) continue;
		memcpy(data + packed, bytes + at + 8, number_at(bytes + at));
		packed += number_at(bytes + at);
	}
	uLongf length = (uLongf)picture.height * (uLongf)(1 + picture.width * picture.channels);
	picture.rows = malloc(length);
	assert_int_equal(uncompress(picture.rows, &length, data, packed), Z_OK);
	unfilter(&picture);
	free(data);
	free(bytes);
	return picture;
}

static const unsigned char* pixel_at(const Picture* picture, int x, int y) {
	return picture->rows + (ptrdiff_t)y * (1 + picture->width * picture->channels) + 1 +
		   (ptrdiff_t)x * picture->channels;
}

// Pixels that are more blue than red, as the body is and ground and sky are not; and the mean of their rows.
static int count_blue(const Picture* picture, double* row) {
	int count = 0;
	double sum = 0;
	for (int y = 0; y < picture->height; ++y)
		for (int x = 0; x < picture->width; ++x) {
			const unsigned char* p = pixel_at(picture, x, y);
			if (p[2] < p[0] + 40) continue;
			++count;
			sum += y;
		}
	*row = count > 0 ? sum / count : 0;
	return count;
}

// ---- pictures ----

static void pictures_have_their_size_and_show_the_motion(void** state) {
	(void)state;
	double top, bottom, again;
	if (lacks_browser()) skip();
	Outcome outcome = RENDER(0, "--times", "0,1,0", "--size", "160x100", "-o", "p.png", "--text", "none");
	expect_part(outcome.out, "wrote p.png: 3 pictures of 160 x 100");
	outcome_free(&outcome);
	Picture first = read_picture("p_0000.png"), last = read_picture("p_0001.png"), same = read_picture("p_0002.png");
	const int count = count_blue(&first, &top);
	count_blue(&last, &bottom);
	count_blue(&same, &again);
	print_message("%d pixels of the body, mean row %.1f at the start, %.1f at the end\n", count, top, bottom);
	assert_int_equal(first.width, WIDTH);
	assert_int_equal(first.height, HEIGHT);
	assert_true(count > 50);
	assert_true(bottom > top + 20); // it falls through most of the picture
	assert_memory_equal(first.rows, same.rows, (size_t)HEIGHT * (size_t)(1 + WIDTH * first.channels));
	free(first.rows);
	free(last.rows);
	free(same.rows);
}

// ---- films ----

static void expect_film(const char* name, const char* expected) {
	char command[512], words[128] = "";
	snprintf(command, sizeof command,
			 "ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,pix_fmt,nb_read_frames -of "
			 "csv=p=0 %s",
			 path_join(folder, name));
	FILE* out = popen(command, "r");
	assert_non_null(out);
	if (fgets(words, sizeof words, out) == NULL) fail_msg("ffprobe finds no film in %s", name);
	pclose(out);
	words[strcspn(words, "\n")] = '\0';
	assert_string_equal(words, expected);
}

static void an_mp4_has_the_frames_asked_for(void** state) {
	(void)state;
	if (lacks_browser() || lacks_ffmpeg()) skip();
	Outcome outcome = RENDER(0, "--frames", "0:-1:2", "--film", "f.mp4", "--size", "160x100", "--color", "speed");
	expect_part(outcome.out, "wrote f.mp4: 6 pictures of 160 x 100, 0.2 s");
	outcome_free(&outcome);
	expect_film("f.mp4", "h264,160,100,yuv420p,6");
	assert_false(path_exists(path_join(folder, "f.mp4.tmp")));
	assert_false(path_exists(path_join(folder, "f.mp4.log")));
}

static void a_gif_goes_at_the_speed_asked_for(void** state) {
	(void)state;
	if (lacks_browser() || lacks_ffmpeg()) skip();
	// 1 s of motion, twice as slow, at 5 frames a second: 2 s, and the frame at the end.
	Outcome outcome = RENDER(0, "--film", "f.gif", "--size", "80x51", "--speed", "0.5", "--fps", "5");
	expect_part(outcome.out, "2 times slower than real time");
	outcome_free(&outcome);
	expect_film("f.gif", "gif,80,51,bgra,11");
}

// ---- what goes wrong ----

static void wrong_options_are_refused_in_words(void** state) {
	(void)state;
	REFUSED(2, "no size such as 1920x1080", "--size", "big");
	REFUSED(2, "neither azimuth,elevation", "--camera", "1,2,3,4");
	REFUSED(2, "neither azimuth,elevation", "--camera", "1,2,3/1,2,3");
	REFUSED(2, "neither azimuth,elevation", "--camera", "0,2,3/-0,2,3");
	REFUSED(2, "with frames from 0 to 10", "--frames", "0:11");
	REFUSED(2, "has the wrong unit", "--times", "1kg");
	REFUSED(2, "does not end with .png", "-o", "p.bmp");
	REFUSED(2, "does not end with .mp4", "--film", "f.avi");
	REFUSED(2, "even widths", "--film", "f.mp4", "--size", "161x100");
	REFUSED(2, "there is no field 'sped'; there are displacement, speed", "--color", "sped");
	REFUSED(2, "there is no such file", "nowhere");
}

static void a_missing_browser_is_told_with_its_package(void** state) {
	(void)state;
	setenv("JOUNCE_BROWSER", "/nowhere/chromium", 1);
	REFUSED(3, "there is no program '/nowhere/chromium'", "-o", "q.png");
	unsetenv("JOUNCE_BROWSER");
	char* path = strdup(getenv("PATH"));
	setenv("PATH", "/nowhere", 1);
	REFUSED(3, "apt-get install chromium", "-o", "q.png");
	REFUSED(3, "apt-get install ffmpeg", "--film", "q.mp4");
	setenv("PATH", path, 1);
	free(path);
	assert_false(path_exists(path_join(folder, "q.png")));
	assert_false(path_exists(path_join(folder, "q.mp4.tmp")));
}

static void a_browser_that_crashes_is_quoted(void** state) {
	(void)state;
	use_script("#!/bin/sh\necho the screen is on fire >&2\nexit 7\n");
	REFUSED(3, "the screen is on fire", "-o", "q.png");
	if (!lacks_ffmpeg()) REFUSED(3, "ended before the pictures were done", "--film", "q.mp4");
	assert_false(path_exists(path_join(folder, "q.mp4")));
	assert_false(path_exists(path_join(folder, "q.mp4.tmp")));
}

// The browser's place is taken by one that notes its number and never ends.
static void ctrl_c_leaves_neither_a_browser_nor_a_file(void** state) {
	(void)state;
	char script[600];
	const char* note = path_join(folder, "number");
	snprintf(script, sizeof script, "#!/bin/sh\nsleep 600 &\necho $! > %s.new\nmv %s.new %s\nwait\n", note, note, note);
	use_script(script);
	Process process = command_start(folder, (const char* const[]){"render", "block", "-o", "q.png", NULL});
	for (int i = 0; i < PATIENCE && !path_exists(note); ++i) nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
	char* number = file_read(note);
	kill(process.id, SIGINT);
	Outcome outcome = command_wait(process);
	assert_int_equal(outcome.status, 0);
	expect_part(outcome.out, "stopped as asked, with 0 of 1 pictures");
	outcome_free(&outcome);
	bool is_there = true;
	for (int i = 0; i < PATIENCE && is_there; ++i) {
		is_there = kill((pid_t)atoi(number), 0) == 0;
		if (is_there) nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
	}
	free(number);
	assert_false(is_there);
	assert_false(path_exists(path_join(folder, "q.png")));
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(pictures_have_their_size_and_show_the_motion),
		cmocka_unit_test(an_mp4_has_the_frames_asked_for),
		cmocka_unit_test(a_gif_goes_at_the_speed_asked_for),
		cmocka_unit_test(wrong_options_are_refused_in_words),
		cmocka_unit_test_teardown(a_missing_browser_is_told_with_its_package, restore_browser),
		cmocka_unit_test_teardown(a_browser_that_crashes_is_quoted, restore_browser),
		cmocka_unit_test_teardown(ctrl_c_leaves_neither_a_browser_nor_a_file, restore_browser),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
