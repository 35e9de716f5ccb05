// The command `jounce compare` as a user meets it: combinations, resumption, failures, errors against a reference.
#define _GNU_SOURCE // environ
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "jounce/base.h"
#include "support/support.h"

// A block that is held at z- and swings.
static const char scene_text[] = "name: block\n"
								 "duration: 0.1 s\n"
								 "bodies:\n"
								 "  - name: block\n"
								 "    shape: {type: box, size: [1, 1, 2], cells: [2, 2, 4]}\n"
								 "    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
								 "    fix: [{where: {face: z-}}]\n"
								 "integrator: {method: sdirk2}\n"
								 "step: {controller: fixed, dt: 10 ms}\n"
								 "probes:\n"
								 "  - {name: top, at: [0.5, 0.5, 2]}\n";

// From 50 to 60 ms the end is pushed through the foot, which Neo-Hookean elements do not survive and cannot cut around.
static const char crush[] =
	"bodies[0].drive=[{where: {face: z+}, z: {type: keyframes, points: [[50 ms, 0], [60 ms, -4]]}}]";
static const char no_cuts[] = "step.cuts=0";

static char folder[256];

static int set_up(void** state) {
	(void)state;
	if (folder_create(folder) != 0) return -1;
	file_write(path_join(folder, "block.yaml"), scene_text);
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

// Run with the given words and compare the exit status; the caller frees.
#define COMPARE(expected, ...)                                                                                         \
	compare(expected, (const char* const[]){"compare", "block.yaml", "-o", "c", __VA_ARGS__, NULL})

static Outcome compare(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce compare' ends with %d, expected %d\nstdout: %s\nstderr: %s", outcome.status, expected,
				 outcome.out, outcome.err);
	return outcome;
}

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

static bool in_folder(const char* name) {
	return path_exists(path_join(folder, name));
}

// These words on stderr, nothing on stdout, nothing on disk.
#define REFUSED(part, ...)                                                                                             \
	do {                                                                                                               \
		Outcome refused = COMPARE(2, __VA_ARGS__);                                                                     \
		assert_string_equal(refused.out, "");                                                                          \
		expect_part(refused.err, part);                                                                                \
		outcome_free(&refused);                                                                                        \
		assert_false(in_folder("c"));                                                                                  \
	} while (0)

static void expect_text(const Table* table, int row, const char* column, const char* expected) {
	assert_string_equal(table->cells[row][table_column(table, column)], expected);
}

static void expect_between(double value, double low, double high) {
	if (!(value >= low && value <= high)) fail_msg("%g is not in [%g, %g]", value, low, high);
}

static struct timespec changed(const char* name) {
	struct stat about;
	assert_int_equal(stat(path_join(folder, name), &about), 0);
	return about.st_mtim;
}

static bool same_time(struct timespec a, struct timespec b) {
	return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

// Python's word for it, so that the CSV is judged by another's reader. `rows` are dictionaries.
static void expect_csv(const char* condition) {
	char program[1024];
	snprintf(program, sizeof program,
			 "import csv,sys; rows=list(csv.DictReader(open(sys.argv[1],newline=''),strict=True)); "
			 "sys.exit(0 if all(None not in r and None not in r.values() for r in rows) and (%s) else 9)",
			 condition);
	char* arguments[] = {"python3", "-c", program, (char*)path_join(folder, "c/comparison.csv"), NULL};
	pid_t child;
	if (posix_spawnp(&child, JN_PYTHON, NULL, NULL, arguments, environ) != 0) skip();
	int status = 0;
	assert_int_equal(waitpid(child, &status, 0), child);
	if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_msg("comparison.csv is no CSV, or not: %s", condition);
}

static void every_combination_is_a_row_and_a_folder(void** state) {
	(void)state;
	static const char* const names[] = {"sdirk2_dt=20ms", "sdirk2_dt=10ms", "backward_euler_dt=20ms",
										"backward_euler_dt=10ms"};
	Outcome outcome =
		COMPARE(0, "--vary", "integrator.method=sdirk2,backward_euler", "--vary", "step.dt=20ms, 10ms", "--jobs", "2");
	expect_part(outcome.out, "block.yaml: 4 runs, 2 at a time, in c\n");
	expect_part(outcome.out, "4/4 done");
	assert_string_equal(outcome.err, "");
	outcome_free(&outcome);
	Table table = table_read(path_join(folder, "c/comparison.csv"));
	assert_int_equal(table.rows, 1 + 4);
	for (int i = 0; i < 4; ++i) {
		char path[128];
		expect_text(&table, 1 + i, "name", names[i]);
		expect_text(&table, 1 + i, "integrator.method", i < 2 ? "sdirk2" : "backward_euler");
		expect_text(&table, 1 + i, "step.dt", i % 2 == 0 ? "20ms" : "10ms");
		expect_text(&table, 1 + i, "outcome", "done");
		expect_text(&table, 1 + i, "position_error_rms", ""); // there is no reference
		assert_int_equal((int)table_number(&table, 1 + i, "steps"), i % 2 == 0 ? 5 : 10);
		snprintf(path, sizeof path, "c/runs/%s/run.h5", names[i]);
		assert_true(in_folder(path));
	}
	table_free(&table);
}

static void tables_and_pictures_are_written(void** state) {
	(void)state;
	static const char* const files[] = {"comparison.md",
										"report.html",
										"comparison.txt",
										"plots/comparison.dat",
										"plots/convergence.gnuplot",
										"plots/work_precision.gnuplot",
										"plots/energy.gnuplot"};
	static const char* const pictures[] = {"convergence.png", "convergence.svg", "work_precision.png", "energy.png"};
	Outcome outcome = COMPARE(0, "--vary", "step.dt=20ms,10ms", "--reference", "step.dt=2ms");
	char* text = file_read(path_join(folder, "c/comparison.txt"));
	expect_part(outcome.out, text);
	free(text);
	const bool was_drawn = strstr(outcome.err, "gnuplot") == NULL; // else it is not installed, which is said
	outcome_free(&outcome);
	for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
		char path[128];
		snprintf(path, sizeof path, "c/%s", files[i]);
		if (!in_folder(path)) fail_msg("%s is missing", path);
	}
	for (size_t i = 0; was_drawn && i < sizeof pictures / sizeof *pictures; ++i) {
		char path[300];
		struct stat about;
		snprintf(path, sizeof path, "%s/c/plots/%s", folder, pictures[i]);
		if (stat(path, &about) != 0 || about.st_size == 0) fail_msg("%s is missing or empty", path);
	}
}

// At these steps the next term of the error is some percent of the first, and so is that of the order.
static void sdirk2_has_order_two_against_a_reference(void** state) {
	(void)state;
	Outcome outcome = COMPARE(0, "--vary", "step.dt=10ms,5ms,2.5ms", "--reference", "step.dt=0.2ms", "-q");
	assert_string_equal(outcome.out, "");
	outcome_free(&outcome);
	Table table = table_read(path_join(folder, "c/comparison.csv"));
	assert_int_equal(table.rows, 1 + 4);
	expect_text(&table, 1, "order", ""); // nothing is coarser
	expect_between(table_number(&table, 2, "order"), 1.9, 2.1);
	expect_between(table_number(&table, 3, "order"), 1.9, 2.1);
	expect_text(&table, 4, "name", "reference");
	expect_text(&table, 4, "position_error_rms", "");
	table_free(&table);
	char* script = file_read(path_join(folder, "c/plots/convergence.gnuplot"));
	expect_part(script, "slope ");
	expect_between(strtod(strstr(script, "slope ") + 6, NULL), 1.9, 2.1);
	free(script);
}

// The errors, once more from the series of both runs: the last position of a probe is that of a node at the end.
static void probe_errors_are_those_of_the_series(void** state) {
	(void)state;
	Outcome outcome = COMPARE(0, "-q", "--vary", "step.dt=20ms", "--reference", "step.dt=5ms");
	outcome_free(&outcome);
	Table coarse = table_read(path_join(folder, "c/runs/dt=20ms/series.csv"));
	Table fine = table_read(path_join(folder, "c/runs/reference/series.csv"));
	double sum = 0, largest = 0, last = 0;
	for (int i = 1; i <= 5; ++i) { // steps of the coarse run; the fine one takes four for each
		const double x = table_number(&coarse, 1 + i, "probe.top.x") - table_number(&fine, 1 + 4 * i, "probe.top.x");
		const double y = table_number(&coarse, 1 + i, "probe.top.y") - table_number(&fine, 1 + 4 * i, "probe.top.y");
		const double z = table_number(&coarse, 1 + i, "probe.top.z") - table_number(&fine, 1 + 4 * i, "probe.top.z");
		last = sqrt(x * x + y * y + z * z);
		sum += last * last;
		largest = fmax(largest, last);
	}
	Table table = table_read(path_join(folder, "c/comparison.csv"));
	const double rms = sqrt(sum / 5), rounding = 1e-12; // both sides add up the same few doubles
	expect_between(table_number(&table, 1, "probe.top.error_rms") / rms, 1 - rounding, 1 + rounding);
	expect_between(table_number(&table, 1, "probe.top.error_max") / largest, 1 - rounding, 1 + rounding);
	expect_between(table_number(&table, 1, "position_error_max"), last, INFINITY);
	expect_between(table_number(&table, 1, "position_error_rms"), 0, table_number(&table, 1, "position_error_max"));
	table_free(&coarse);
	table_free(&fine);
	table_free(&table);
}

static void second_call_runs_nothing(void** state) {
	(void)state;
	static const char summary[] = "c/runs/dt=10ms/summary.json";
	Outcome outcome = COMPARE(0, "--vary", "step.dt=20ms,10ms");
	outcome_free(&outcome);
	const struct timespec before = changed(summary);
	outcome = COMPARE(0, "--vary", "step.dt=20ms,10ms,5ms");
	expect_part(outcome.out, "3 runs, 2 of them done already");
	expect_part(outcome.out, "3/3 done");
	outcome_free(&outcome);
	outcome = COMPARE(0, "--vary", "step.dt=20ms,10ms,5ms");
	expect_part(outcome.out, "3 runs, 3 of them done already, in c\n");
	assert_null(strstr(outcome.out, "3/3 done"));
	outcome_free(&outcome);
	assert_true(same_time(before, changed(summary)));
}

static void changed_settings_or_scene_run_again(void** state) {
	(void)state;
	static const char summary[] = "c/runs/dt=10ms/summary.json";
	Outcome outcome = COMPARE(0, "--vary", "step.dt=10ms");
	outcome_free(&outcome);
	struct timespec before = changed(summary);
	outcome = COMPARE(0, "--vary", "step.dt=10ms", "--set", "gravity=[0,-5,0]");
	assert_null(strstr(outcome.out, "done already"));
	outcome_free(&outcome);
	assert_false(same_time(before, changed(summary)));
	before = changed(summary);
	char text[sizeof scene_text + 32];
	snprintf(text, sizeof text, "%s# a remark\n", scene_text);
	file_write(path_join(folder, "block.yaml"), text);
	outcome = COMPARE(0, "--vary", "step.dt=10ms", "--set", "gravity=[0,-5,0]");
	assert_null(strstr(outcome.out, "done already"));
	outcome_free(&outcome);
	assert_false(same_time(before, changed(summary)));
}

static void failing_run_does_not_stop_the_others(void** state) {
	(void)state;
	Outcome outcome = COMPARE(1, "--vary", "duration=40ms,100ms,30ms", "--set", crush, "--set", no_cuts, "--jobs", "1");
	expect_part(outcome.out, "failed: duration=100ms: step 6 at t = 0.05 s failed");
	outcome_free(&outcome);
	expect_csv("[r['outcome'] for r in rows]==['done','failed','done'] and 'smaller step.dt' in rows[1]['message'] "
			   "and rows[0]['message']=='' and rows[1]['steps']=='5'");
}

static void failed_reference_leaves_the_errors_out(void** state) {
	(void)state;
	Outcome outcome = COMPARE(1, "--vary", "step.dt=10ms", "--reference", crush, "--reference", no_cuts);
	expect_part(outcome.out, "no errors: the reference is not done");
	expect_part(outcome.out, "failed: reference: ");
	outcome_free(&outcome);
	expect_csv("rows[0]['outcome']=='done' and rows[0]['position_error_rms']==''");
}

static void bracketed_values_stay_whole(void** state) {
	(void)state;
	Outcome outcome = COMPARE(0, "--vary", "gravity=[0,-1,0],[0,-2,0]", "--vary",
							  "step={controller: fixed, dt: 10 ms}, {controller: fixed, dt: 20 ms}");
	outcome_free(&outcome);
	expect_csv("len(rows)==4 and [r['gravity'] for r in rows]==['[0,-1,0]']*2+['[0,-2,0]']*2 and "
			   "rows[1]['step']=='{controller: fixed, dt: 20 ms}' and [r['steps'] for r in rows]==['10','5']*2");
}

static void bad_variations_are_refused_before_any_run(void** state) {
	(void)state;
	REFUSED("nothing is varied", "--set", "step.dt=1ms");
	REFUSED("write key=value", "--vary", "step.dt");
	REFUSED("value 2 is empty", "--vary", "step.dt=1ms,,2ms");
	REFUSED("'1ms' comes twice", "--vary", "step.dt=1ms,2ms,1ms");
	REFUSED("a bracket or quote has no counterpart", "--vary", "gravity=[0,-1,0");
	REFUSED("varied already", "--vary", "step.dt=1ms", "--vary", "step.dt=2ms");
	REFUSED("more than 10000 combinations", "--vary", "step.dt=1,2,3,4,5,6,7,8,9,10,11", "--vary",
			"duration=1,2,3,4,5,6,7,8,9,10", "--vary", "newton.max_iterations=1,2,3,4,5,6,7,8,9,10", "--vary",
			"newton.tolerance=1,2,3,4,5,6,7,8,9,10");
}

static void bad_combination_is_named(void** state) {
	(void)state;
	REFUSED("dt=2mm: ", "--vary", "step.dt=1ms,2mm");
	REFUSED("sdirk2 dtt=1ms: ", "--vary", "integrator.method=sdirk2", "--vary", "step.dtt=1ms");
	REFUSED("did you mean 'dt'", "--vary", "step.dtt=1ms");
	REFUSED("the reference: ", "--vary", "step.dt=1ms", "--reference", "step.dt=2mm");
	REFUSED("write key=value", "--vary", "step.dt=1ms", "--reference", "step.dt");
}

static void reference_of_another_duration_or_mesh_is_refused(void** state) {
	(void)state;
	REFUSED("the run ends at 0.2 s and the reference at 0.1 s", "--vary", "duration=0.1,0.2", "--reference",
			"step.dt=1ms");
	REFUSED("the run has 12 nodes and the reference 45", "--vary", "bodies[0].shape.cells=[1,1,2]", "--reference",
			"step.dt=1ms");
	REFUSED("lie elsewhere", "--vary", "bodies[0].shape.size=[1,1,3]", "--reference", "step.dt=1ms");
}

static void unknown_options_get_a_suggestion(void** state) {
	(void)state;
	REFUSED("there is no option '--refrence'; did you mean '--reference'?", "--vary", "step.dt=1ms", "--refrence",
			"x=1");
	REFUSED("--jobs: '0' is no whole number from 1 to 1024", "--vary", "step.dt=1ms", "--jobs", "0");
}

static void missing_scene_or_folder_is_a_file_failure(void** state) {
	(void)state;
	Outcome outcome = compare(3, (const char* const[]){"compare", "none.yaml", "--vary", "step.dt=1ms", NULL});
	expect_part(outcome.err, "none.yaml: cannot be opened");
	outcome_free(&outcome);
	outcome = COMPARE(3, "--vary", "step.dt=10ms", "-o", "block.yaml/c");
	expect_part(outcome.err, "block.yaml/c: cannot make this folder");
	outcome_free(&outcome);
}

static void wait_until(Process process, bool (*is_reached)(void)) {
	for (int i = 0; i < 3000 && !is_reached(); ++i) {
		assert_int_equal(waitpid(process.id, NULL, WNOHANG), 0); // it still runs
		usleep(10000);
	}
	assert_true(is_reached());
}

static bool long_run_steps(void) {
	return in_folder("c/runs/duration=0.1/summary.json") && in_folder("c/runs/duration=1e5/series.csv") &&
		   !in_folder("c/runs/duration=1e5/summary.json");
}

static void interrupt_ends_cleanly_and_the_same_command_goes_on(void** state) {
	(void)state;
	const char* const words[] = {"compare", "block.yaml", "-o", "c", "--vary", "duration=0.1,1e5", "--jobs", "2", NULL};
	Process process = command_start(folder, words);
	wait_until(process, long_run_steps);
	usleep(500000); // until the short run's process has ended, too
	assert_int_equal(kill(process.id, SIGINT), 0);
	Outcome outcome = command_wait(process);
	assert_int_equal(outcome.status, 0);
	expect_part(outcome.out, "stopped as asked, with 1 of 2 runs done; the same command goes on from there");
	outcome_free(&outcome);
	expect_csv("[r['outcome'] for r in rows]==['done','interrupted']");
	process = command_start(folder, words);
	wait_until(process, long_run_steps); // again: its summary went when it started
	assert_int_equal(kill(process.id, SIGINT), 0);
	outcome = command_wait(process);
	assert_int_equal(outcome.status, 0);
	expect_part(outcome.out, "2 runs, 1 of them done already");
	outcome_free(&outcome);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(every_combination_is_a_row_and_a_folder),
		TEST(tables_and_pictures_are_written),
		TEST(sdirk2_has_order_two_against_a_reference),
		TEST(probe_errors_are_those_of_the_series),
		TEST(second_call_runs_nothing),
		TEST(changed_settings_or_scene_run_again),
		TEST(failing_run_does_not_stop_the_others),
		TEST(failed_reference_leaves_the_errors_out),
		TEST(bracketed_values_stay_whole),
		TEST(bad_variations_are_refused_before_any_run),
		TEST(bad_combination_is_named),
		TEST(reference_of_another_duration_or_mesh_is_refused),
		TEST(unknown_options_get_a_suggestion),
		TEST(missing_scene_or_folder_is_a_file_failure),
		TEST(interrupt_ends_cleanly_and_the_same_command_goes_on),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
