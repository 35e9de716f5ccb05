// `jounce report`: one file without references to others, which holds the runs' numbers.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "support/support.h"

static const char scene_text[] =
	"# <script>alert(1)</script>\nname: block\nduration: 0.2 s\nbodies:\n"
	"  - name: block\n"
	"    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
	"    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
	"    fix: [{where: {face: z-}}]\n"
	"integrator: {method: sdirk2}\nstep: {controller: fixed, dt: 10 ms}\nprobes: [{name: top, at: [0.5, 0.5, 1]}]\n"
	"record: {interval: 20 ms, plots: no}\n";

static char folder[256];

static Outcome run(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce %s' ends with %d, expected %d\n%s\n%s", arguments[0], outcome.status, expected, outcome.out,
				 outcome.err);
	return outcome;
}

#define RUN(status, ...)                                                                                               \
	do {                                                                                                               \
		Outcome outcome = run(status, (const char* const[]){__VA_ARGS__, NULL});                                       \
		outcome_free(&outcome);                                                                                        \
	} while (0)

static int set_up(void** state) {
	(void)state;
	if (folder_create(folder) != 0) return -1;
	setenv("JOUNCE_BROWSER", "/nowhere/chromium", 1); // render_test draws
	file_write(path_join(folder, "block.yaml"), scene_text);
	RUN(0, "run", "block.yaml", "-o", "a", "--quiet");
	RUN(0, "run", "block.yaml", "-o", "b", "--quiet", "--set", "integrator.method=backward_euler", "--set",
		"step.dt=5ms");
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static void expect_part(const char* page, const char* part) {
	if (strstr(page, part) == NULL) fail_msg("'%s' is not in the page", part);
}

// Every attribute that would make a browser fetch something holds its data itself.
static void expect_alone(const char* page) {
	static const char* const marks[] = {"src=\"", "href=\""};
	for (size_t i = 0; i < sizeof marks / sizeof *marks; ++i)
		for (const char* at = page; (at = strstr(at, marks[i])) != NULL; at += strlen(marks[i]))
			if (strncmp(at + strlen(marks[i]), "data:", 5) != 0) fail_msg("the page refers to %.60s", at);
	assert_null(strstr(page, "<script"));
	assert_null(strstr(page, "@import"));
	assert_null(strstr(page, "url("));
}

static void a_run_is_told_with_its_numbers(void** state) {
	(void)state;
	char part[96];
	RUN(0, "report", "a", "-o", "a.html");
	char* page = file_read(path_join(folder, "a.html"));
	char* summary = file_read(path_join(folder, "a/summary.json"));
	const char* newton = strstr(summary, "\"newton\": ");
	assert_non_null(newton);
	snprintf(part, sizeof part, "Newton iterations</th><td>%d</td>", atoi(newton + 10));
	expect_alone(page);
	expect_part(page, part);
	expect_part(page, "Steps</th><td>20</td>"); // 0.2 s of 10 ms
	expect_part(page, "Mass</th><td>1000 kg</td>");
	expect_part(page, "<b>Energy [J]</b>");
	expect_part(page, "<b>Probe top [m]</b>");
	expect_part(page, "Where the time went");
	expect_part(page, "&#60;script&#62;alert(1)"); // of the scene's text
	expect_part(page, "No pictures: JOUNCE_BROWSER");
	free(summary);
	free(page);
}

static void of_two_runs_the_differences_are_told(void** state) {
	(void)state;
	RUN(0, "report", "a", "b", "-o", "two.html", "--pictures", "0", "--title", "a & b");
	char* page = file_read(path_join(folder, "two.html"));
	expect_alone(page);
	expect_part(page, "<h1>a &#38; b</h1>");
	expect_part(page, "<code>step.dt</code></th><td>10 ms</td><td>5ms</td>");
	expect_part(page, "backward_euler</td>");
	expect_part(page, "Steps</th><td>20</td><td>40</td>");
	expect_part(page, "Distance of the end from the first run's");
	assert_null(strstr(page, "<code>duration")); // the same in both
	assert_null(strstr(page, "No pictures"));    // none were asked for
	free(page);
}

static void an_unfinished_run_is_warned_of(void** state) {
	(void)state;
	RUN(1, "run", "block.yaml", "-o", "c", "--quiet", "--set", "integrator.method=explicit_euler", "--set",
		"bodies[0].mass=lumped", "--set", "step.dt=50ms", "--set", "duration=50s");
	RUN(0, "report", "c", "-o", "c.html");
	char* page = file_read(path_join(folder, "c.html"));
	expect_part(page, "<div class=\"warnings\"");
	expect_part(page, "c: failed: ");
	free(page);
}

static void wrong_folders_and_options_are_refused(void** state) {
	(void)state;
	RUN(2, "report");
	RUN(2, "report", "nowhere");
	RUN(2, "report", "a", "--pictures", "many");
	RUN(2, "report", "a", "--color", "sped");
	RUN(3, "report", "a", "-o", "no/such/folder/a.html");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_run_is_told_with_its_numbers),
		cmocka_unit_test(of_two_runs_the_differences_are_told),
		cmocka_unit_test(an_unfinished_run_is_warned_of),
		cmocka_unit_test(wrong_folders_and_options_are_refused),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
