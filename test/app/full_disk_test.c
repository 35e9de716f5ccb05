// Full disks: every command that writes says which file cannot be written and why, ends with status 3, and leaves no file that
// looks whole and is not. A limit on the size of files stands for a full disk; where a browser, which writes files of its own,
// is at work, the file beside the picture is a link to /dev/full.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "support/support.h"

static const char scene_text[] =
	"name: block\nduration: 0.2 s\nbodies:\n"
	"  - name: block\n"
	"    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
	"    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
	"integrator: sdirk2\nstep: {controller: fixed, dt: 50 ms}\nrecord: {interval: 100 ms, plots: no}\n";

static char folder[256];

static int set_up(void** state) {
	(void)state;
	return folder_create_with_run(folder, scene_text);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

/// Run the command where no file can be larger than `blocks` of 512 bytes (of 1024 where sh is bash), and give back what it says;
/// pipes have no limit.
static char* run_limited(int blocks, int expected, const char* words) {
	char line[1024], text[4096];
	snprintf(line, sizeof line, "cd '%s' && trap '' XFSZ && ulimit -S -f %d && '%s' %s 2>&1", folder, blocks,
			 JN_COMMAND, words);
	FILE* pipe = popen(line, "r");
	assert_non_null(pipe);
	const size_t length = fread(text, 1, sizeof text - 1, pipe);
	text[length] = '\0';
	const int status = pclose(pipe);
	if (WEXITSTATUS(status) != expected)
		fail_msg("'%s' within %d blocks ends with %d, expected %d\n%s", words, blocks, WEXITSTATUS(status), expected,
				 text);
	return strdup(text);
}

static void refused(int blocks, int expected, const char* words, const char* file) {
	char* text = run_limited(blocks, expected, words);
	expect_part(text, "File too large");
	expect_part(text, file);
	free(text);
}

/// Whatever the room, the recording is gone, refused with a reason, or holds whole frames.
static void a_run_ends_with_the_file_and_the_reason(void** unused) {
	(void)unused;
	for (int room = 1; room <= 48; room += room < 8 ? 1 : 8) {
		char words[256];
		snprintf(words, sizeof words, "run block.yaml --quiet -o run%d", room);
		refused(room, 3, words, "run.h5: cannot write");
		snprintf(words, sizeof words, "run%d", room);
		Outcome outcome = command_run(folder, (const char* const[]){"export", words, "--as", "obj", "-o", "obj", NULL});
		if (outcome.status != 0 && outcome.status != 2)
			fail_msg("export ends with %d: %s", outcome.status, outcome.err);
		if (outcome.status == 2) expect_part(outcome.err, "run.h5: ");
		outcome_free(&outcome);
		folder_remove(path_join(folder, "obj"));
	}
}

static void a_saved_page_is_whole_or_not_there(void** unused) {
	(void)unused;
	refused(1, 3, "view block --save page.html", "page.html: cannot write");
	assert_false(path_exists(path_join(folder, "page.html")));
	assert_false(path_exists(path_join(folder, "page.html.tmp")));
}

static void a_report_is_whole_or_not_there(void** unused) {
	(void)unused;
	refused(1, 3, "report block --pictures 0 -o page.html", "page.html: cannot write");
	assert_false(path_exists(path_join(folder, "page.html")));
	assert_false(path_exists(path_join(folder, "page.html.tmp")));
}

static void an_export_is_whole_or_not_there(void** unused) {
	(void)unused;
	refused(1, 3, "export block --as glb -o run.glb", "run.glb");
	assert_false(path_exists(path_join(folder, "run.glb")));
}

/// Its runs fail, each for a reason that the comparison tells; a comparison that cannot write its own tables is a failure of files.
static void a_comparison_tells_why_its_runs_failed(void** unused) {
	(void)unused;
	refused(8, 1, "compare block.yaml --vary step.dt=50ms,25ms -o compared", "run.h5: cannot write");
	char* text = run_limited(0, 3, "compare block.yaml --vary step.dt=50ms,25ms -o nothing");
	expect_part(text, "File too large");
	free(text);
}

static bool has_browser(void) {
	return getenv("JOUNCE_BROWSER") != NULL ||
		   system("command -v chromium chromium-browser google-chrome >/dev/null") == 0;
}

static void a_picture_is_whole_or_not_there(void** unused) {
	(void)unused;
	if (access("/dev/full", W_OK) != 0 || !has_browser()) skip();
	assert_int_equal(symlink("/dev/full", path_join(folder, "a.png.tmp")), 0);
	Outcome outcome =
		command_run(folder, (const char* const[]){"render", "block", "-o", "a.png", "--size", "64x48", NULL});
	assert_int_equal(outcome.status, 3);
	expect_part(outcome.err, "a.png: cannot write the file: No space left on device");
	assert_false(path_exists(path_join(folder, "a.png")));
	assert_false(path_exists(path_join(folder, "a.png.tmp")));
	outcome_free(&outcome);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_run_ends_with_the_file_and_the_reason), cmocka_unit_test(a_saved_page_is_whole_or_not_there),
		cmocka_unit_test(a_report_is_whole_or_not_there),          cmocka_unit_test(an_export_is_whole_or_not_there),
		cmocka_unit_test(a_comparison_tells_why_its_runs_failed),  cmocka_unit_test(a_picture_is_whole_or_not_there),
	};
	return cmocka_run_group_tests_name("full_disk", tests, set_up, tear_down);
}
