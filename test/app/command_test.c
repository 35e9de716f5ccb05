// The command `jounce` as a user meets it: exit statuses, words, files.
#define _GNU_SOURCE // environ
#include <fcntl.h>
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
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "jounce/base.h"
#include "support/support.h"

static const char scene_text[] = "name: block\n"
								 "duration: 0.1 s\n"
								 "bodies:\n"
								 "  - name: block\n"
								 "    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
								 "    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
								 "    fix: [{where: {face: z-}}]\n"
								 "integrator: sdirk2\n"
								 "step: {controller: fixed, dt: 10 ms}\n"
								 "probes:\n"
								 "  - {name: top, at: [0.5, 0.5, 1]}\n"
								 "  - {name: edge, at: [0, 0, 0.5]}\n"
								 "record: {plots: no}\n";

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
#define RUN(expected, ...) run_command(expected, (const char* const[]){__VA_ARGS__, NULL})

static Outcome run_command(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce %s %s' ends with %d, expected %d\nstdout: %s\nstderr: %s", arguments[0],
				 arguments[1] != NULL ? arguments[1] : "", outcome.status, expected, outcome.out, outcome.err);
	return outcome;
}

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

// A command that is refused: its status, nothing on stdout, these words on stderr.
static void expect_refusal(int status, const char* part, const char* const arguments[]) {
	Outcome outcome = run_command(status, arguments);
	assert_string_equal(outcome.out, "");
	expect_part(outcome.err, part);
	outcome_free(&outcome);
}

#define REFUSED(status, part, ...) expect_refusal(status, part, (const char* const[]){__VA_ARGS__, NULL})

static bool in_folder(const char* name) {
	return path_exists(path_join(folder, name));
}

static void expect_in_file(const char* name, const char* part) {
	char* text = file_read(path_join(folder, name));
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in %s: %s", part, name, text);
	free(text);
}

// Python's word for it, so that the JSON is judged by another's reader.
static void expect_json(const char* name, const char* condition) {
	char program[512];
	snprintf(program, sizeof program, "import json,sys; d=json.load(open(sys.argv[1])); sys.exit(0 if %s else 9)",
			 condition);
	char* arguments[] = {"python3", "-c", program, (char*)path_join(folder, name), NULL};
	pid_t child;
	if (posix_spawnp(&child, JN_PYTHON, NULL, NULL, arguments, environ) != 0) skip();
	int status = 0;
	assert_int_equal(waitpid(child, &status, 0), child);
	if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_msg("%s is no JSON, or not: %s", name, condition);
}

static void version_names_version_vectors_and_blas(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "--version");
	expect_part(outcome.out, "jounce " JN_VERSION "\n");
	expect_part(outcome.out, "elements at once");
	assert_string_equal(outcome.err, "");
	outcome_free(&outcome);
}

static void help_lists_the_commands_and_exit_statuses(void** state) {
	(void)state;
	static const char* const parts[] = {"run ", "check ", "list ", "describe ", "exit status"};
	Outcome outcome = RUN(0, "--help");
	for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) expect_part(outcome.out, parts[i]);
	assert_string_equal(outcome.err, "");
	outcome_free(&outcome);
}

static void every_command_has_help(void** state) {
	(void)state;
	static const char* const commands[] = {"run", "check", "list", "describe"};
	for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
		char usage[64];
		snprintf(usage, sizeof usage, "usage: jounce %s ", commands[i]);
		Outcome outcome = RUN(0, commands[i], "--help");
		assert_int_equal(strncmp(outcome.out, usage, strlen(usage)), 0);
		outcome_free(&outcome);
	}
}

static void no_command_is_bad_usage(void** state) {
	(void)state;
	expect_refusal(2, "usage: jounce COMMAND", (const char* const[]){NULL, NULL});
}

static void unknown_command_gets_a_suggestion(void** state) {
	(void)state;
	REFUSED(2, "there is no command 'chekc'; did you mean 'check'?", "chekc");
}

static void each_list_is_text_and_json(void** state) {
	(void)state;
	static const char* const lists[][2] = {
		{"integrators", "sdirk2"}, {"obstacles", "capsule"}, {"materials", "stable_neo_hookean"},
		{"shapes", "box"},         {"elements", "tet10"},    {"motions", "keyframes"},
		{"curves", "helix"},       {"solvers", "direct"},    {"controllers", "fixed"}};
	for (size_t i = 0; i < sizeof lists / sizeof *lists; ++i) {
		char condition[128];
		Outcome text = RUN(0, "list", lists[i][0]), json = RUN(0, "list", lists[i][0], "--json");
		assert_int_equal(strncmp(text.out, lists[i][0], strlen(lists[i][0])), 0);
		expect_part(text.out, lists[i][1]);
		file_write(path_join(folder, "list.json"), json.out);
		snprintf(condition, sizeof condition, "list(d)==['%s'] and '%s' in [r['name'] for r in d['%s']]", lists[i][0],
				 lists[i][1], lists[i][0]);
		expect_json("list.json", condition);
		outcome_free(&text);
		outcome_free(&json);
	}
}

static void all_lists_are_one_json_object(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "list", "--json");
	file_write(path_join(folder, "list.json"), outcome.out);
	expect_json("list.json", "len(d)==11 and all(len(rows)>0 for rows in d.values())");
	outcome_free(&outcome);
}

static void no_limit_is_minus_zero(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "list", "integrators");
	assert_null(strstr(outcome.out, " -0 "));
	outcome_free(&outcome);
	outcome = RUN(0, "list", "integrators", "--json");
	assert_null(strstr(outcome.out, ": -0,"));
	outcome_free(&outcome);
}

static void unknown_list_gets_a_suggestion(void** state) {
	(void)state;
	REFUSED(2, "there is no list 'material'; did you mean 'materials'?", "list", "material");
}

static void describe_explains_a_key(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "describe", "bodies.material.poisson");
	expect_part(outcome.out, "[0, 0.5)");
	outcome_free(&outcome);
}

static void describe_unknown_key_gets_a_suggestion(void** state) {
	(void)state;
	REFUSED(2, "did you mean 'duration'?", "describe", "durations");
}

static void check_reports_elements_and_steps_and_writes_nothing(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "check", "block.yaml");
	expect_part(outcome.out, "block.yaml: ok\n");
	expect_part(outcome.out, "block: 8 hex8 elements, 27 nodes, neo_hookean\n");
	expect_part(outcome.out, "27 nodes, 1000 kg, 27 of 81 coordinates fixed or driven\n");
	expect_part(outcome.out, "10 of 0.01 s, to t = 0.1 s\n");
	assert_string_equal(outcome.err, "");
	outcome_free(&outcome);
	assert_false(in_folder("out"));
}

static void check_refuses_a_bad_scene(void** state) {
	(void)state;
	REFUSED(2, "bodies[0].material.poisson: 0.6 is outside [0, 0.5)", "check", "block.yaml", "--set",
			"bodies[0].material.poisson=0.6");
	assert_false(in_folder("out"));
}

static void check_takes_no_output_folder(void** state) {
	(void)state;
	REFUSED(2, "check writes nothing", "check", "block.yaml", "-o", "here");
}

static void run_without_scene_is_bad_usage(void** state) {
	(void)state;
	REFUSED(2, "no scene file is given", "run");
}

static void missing_scene_is_a_file_failure(void** state) {
	(void)state;
	REFUSED(3, "none.yaml: cannot be opened: No such file or directory", "run", "none.yaml");
	assert_false(in_folder("out"));
}

static void unknown_options_are_refused_by_name(void** state) {
	(void)state;
	REFUSED(2, "there is no option '--quite'; did you mean '--quiet'?", "run", "block.yaml", "--quite");
	REFUSED(2, "there is no option '-x'", "run", "block.yaml", "-x");
	REFUSED(2, "--set needs a value behind it", "run", "block.yaml", "--set");
	REFUSED(2, "there is no option '--jsn'", "list", "--jsn");
	REFUSED(2, "there is no option '--bad'", "describe", "--bad");
}

static void thread_counts_are_whole_numbers_from_1(void** state) {
	(void)state;
	static const char* const bad[] = {"0", "-1", "1.5", "many", "99999999999999999999", ""};
	for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
		REFUSED(2, "is no whole number from 1 to 1024", "run", "block.yaml", "--threads", bad[i]);
	assert_false(in_folder("out"));
}

static void bad_override_creates_nothing(void** state) {
	(void)state;
	Outcome outcome = RUN(2, "run", "block.yaml", "--set", "step.dtt=1ms");
	expect_part(outcome.err, "step.dtt: unknown key");
	outcome_free(&outcome);
	assert_false(in_folder("out"));
}

static void selection_without_nodes_creates_nothing(void** state) {
	(void)state;
	Outcome outcome =
		RUN(2, "run", "block.yaml", "--quiet", "--set", "bodies[0].fix[0].where={nearest: [0,0,0], face: x+}");
	expect_part(outcome.err, "bodies[0].fix[0].where: several ways");
	outcome_free(&outcome);
	assert_false(in_folder("out"));
}

static void run_writes_all_its_files(void** state) {
	(void)state;
	static const char* const files[] = {"run.h5",       "run.xdmf",         "surface.xdmf",     "series.csv",
										"summary.json", "plots/energy.svg", "plots/energy.png", "plots/energy.gnuplot"};
	Outcome outcome = RUN(0, "run", "block.yaml", "--set", "record.plots=yes", "--threads", "1");
	assert_string_equal(outcome.err, "");
	expect_part(outcome.out, "block.yaml: 'block' with sdirk2 over 0.1 s\n");
	expect_part(outcome.out, "10 steps to t = 0.1 s in ");
	expect_part(outcome.out, "wrote out/block: ");
	outcome_free(&outcome);
	for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
		struct stat about;
		char path[600];
		snprintf(path, sizeof path, "%s/out/block/%s", folder, files[i]);
		if (stat(path, &about) != 0 || about.st_size == 0) fail_msg("%s is missing or empty", path);
	}
	expect_json("out/block/summary.json", "d['outcome']=='done' and d['steps']==10 and d['message']==''");
}

static void series_has_its_columns_and_a_row_a_step(void** state) {
	(void)state;
	static const char start[] =
		"step,t,dt,kinetic,elastic,gravity,total,specific_error,newton,factorizations,solves,iterations,rejected";
	static const char end[] = ",probe.top.x,probe.top.y,probe.top.z,probe.edge.x,probe.edge.y,probe.edge.z\n";
	Outcome outcome = RUN(0, "run", "block.yaml", "-o", "r", "--quiet");
	outcome_free(&outcome);
	char* text = file_read(path_join(folder, "r/series.csv"));
	assert_int_equal(strncmp(text, start, strlen(start)), 0);
	const size_t header = (size_t)(strchr(text, '\n') - text) + 1;
	assert_int_equal(strncmp(text + header - strlen(end), end, strlen(end)), 0);
	free(text);
	Table table = table_read(path_join(folder, "r/series.csv"));
	assert_int_equal(table.rows, 1 + 11);
	for (int row = 1; row < table.rows; ++row) {
		assert_int_equal((int)table_number(&table, row, "step"), row - 1);
		const double energy = table_number(&table, row, "kinetic") + table_number(&table, row, "elastic") +
							  table_number(&table, row, "gravity");
		const double total = table_number(&table, row, "total"); // the sum of the three, so only rounding differs
		assert_true(fabs(energy - total) <= 1e-12 * fabs(table_number(&table, row, "gravity")));
	}
	assert_true(fabs(table_number(&table, 11, "t") - 0.1) < 1e-15); // ten additions of 0.01 round by less
	assert_true(table_number(&table, 11, "probe.edge.y") < 0);      // it hangs down from z-
	table_free(&table);
}

static void quiet_prints_nothing(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "run", "block.yaml", "--quiet");
	assert_string_equal(outcome.out, "");
	assert_string_equal(outcome.err, "");
	outcome_free(&outcome);
	assert_true(in_folder("out/block/summary.json"));
}

static void overrides_are_kept_with_the_recorded_scene(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "run", "block.yaml", "-q", "--set", "integrator=backward_euler", "--set", "step.dt=20ms");
	outcome_free(&outcome);
	expect_json("out/block/summary.json", "d['method']=='backward_euler' and d['steps']==5");
}

static void scene_path_may_have_spaces_and_lie_elsewhere(void** state) {
	(void)state;
	mkdir(path_join(folder, "my scenes"), 0777);
	file_write(path_join(folder, "my scenes/a block.yaml"), strchr(scene_text, '\n') + 1); // without its name
	Outcome outcome = RUN(0, "run", "my scenes/a block.yaml", "-q");
	outcome_free(&outcome);
	assert_true(in_folder("out/a_block/run.h5"));
}

// Neither needs permissions, which root has always.
static void output_below_a_file_is_a_file_failure(void** state) {
	(void)state;
	REFUSED(3, "block.yaml/r: cannot make this folder: Not a directory", "run", "block.yaml", "-q", "-o",
			"block.yaml/r");
	REFUSED(3, "block.yaml: is no folder; choose another output with -o", "run", "block.yaml", "-q", "-o",
			"block.yaml");
	expect_in_file("block.yaml", scene_text);
}

static void output_that_cannot_be_created_leaves_no_half_file(void** state) {
	(void)state;
	mkdir(path_join(folder, "r"), 0777);
	mkdir(path_join(folder, "r/run.h5"), 0777);
	Outcome outcome = RUN(3, "run", "block.yaml", "-q", "-o", "r");
	expect_part(outcome.err, "r/run.h5");
	outcome_free(&outcome);
	assert_false(in_folder("r/series.csv"));
	assert_false(in_folder("r/run.xdmf"));
}

// From 50 to 60 ms the top is pushed through the foot. Neo-Hookean elements have no inverted states, so that the sixth
// step of 10 ms cannot work, and halving it is forbidden.
static void failing_run_keeps_its_last_good_state(void** state) {
	(void)state;
	Outcome outcome = RUN(1, "run", "block.yaml", "--set", "step={controller: fixed, dt: 10 ms, cuts: 0}", "--set",
						  "bodies[0].drive=[{where: {face: z+}, z: {type: keyframes, points: [[50 ms, 0], [60 ms, "
						  "-2]]}}]");
	expect_part(outcome.err, "jounce: error: step 6 at t = 0.05 s failed: ");
	expect_part(outcome.err, "moves a node by 2 m within the step, and the shortest edge there is 0.5 m");
	expect_part(outcome.err, "Try a slower motion");
	expect_part(outcome.out, "5 steps to t = 0.05 s");
	expect_part(outcome.out, "wrote out/block: ");
	outcome_free(&outcome);
	expect_json("out/block/summary.json",
				"d['outcome']=='failed' and d['steps']==5 and 'smaller step.dt' in d['message']");
	Table table = table_read(path_join(folder, "out/block/series.csv"));
	assert_int_equal(table.rows, 1 + 6);
	table_free(&table);
	expect_in_file("out/block/run.xdmf", "Value=\"0.05");
}

static void output_to_a_full_disk_is_a_file_failure(void** state) {
	(void)state;
	const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
	if (full < 0) skip();
	Outcome outcome = command_wait(command_start_into(full, folder, (const char* const[]){"list", NULL}));
	assert_int_equal(outcome.status, 3);
	expect_part(outcome.err, "the output cannot be written");
	outcome_free(&outcome);
}

static void wait_for(const char* name, Process process) {
	for (int i = 0; i < 3000 && !in_folder(name); ++i) {
		assert_int_equal(waitpid(process.id, NULL, WNOHANG), 0); // it still runs
		usleep(10000);
	}
	assert_true(in_folder(name));
}

static void interrupt_finishes_the_step_and_the_files(void** state) {
	(void)state;
	const char* const words[] = {"run", "block.yaml", "--set", "duration=1e6", NULL};
	Process process = command_start(folder, words);
	wait_for("out/block/series.csv", process);
	usleep(200000);
	assert_int_equal(kill(process.id, SIGINT), 0);
	Outcome outcome = command_wait(process);
	assert_int_equal(outcome.status, 0);
	expect_part(outcome.out, "stopped as asked, at t = ");
	expect_part(outcome.out, " of 1e+06 s\n");
	outcome_free(&outcome);
	expect_json("out/block/summary.json", "d['outcome']=='interrupted' and 0<d['t']<d['t_end']==1e6");
	char* summary = file_read(path_join(folder, "out/block/summary.json"));
	Table table = table_read(path_join(folder, "out/block/series.csv"));
	char steps[64];
	snprintf(steps, sizeof steps, "\"steps\": %d,", table.rows - 2); // header and start are no steps
	expect_part(summary, steps);
	free(summary);
	table_free(&table);
}

static double number_after(const char* text, const char* name) {
	const char* at = strstr(text, name);
	if (at == NULL) fail_msg("'%s' is not in: %s", name, text);
	return strtod(at + strlen(name), NULL);
}

// A step of 10 ms lasts 100 s at this speed: who is asked to stop then does not wait for the clock.
static void interrupt_ends_a_wait_for_the_clock(void** state) {
	(void)state;
	const char* const words[] = {"run", "block.yaml", "--realtime=1e-4", NULL};
	Process process = command_start(folder, words);
	wait_for("out/block/series.csv", process);
	usleep(200000);
	const time_t began = time(NULL);
	assert_int_equal(kill(process.id, SIGINT), 0);
	Outcome outcome = command_wait(process);
	assert_int_equal(outcome.status, 0);
	outcome_free(&outcome);
	assert_true(time(NULL) - began < 20);
	expect_json("out/block/summary.json", "d['outcome']=='interrupted'");
}

// 10 steps of 10 ms at twice the speed of the clock: the run waits for it, and says how it kept up.
static void a_run_in_real_time_waits_for_the_clock_and_reports_deadlines(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "run", "block.yaml", "-o", "paced", "--realtime=2");
	expect_part(outcome.out, "of 10 deadlines missed");
	expect_part(outcome.out, "a step took: median");
	expect_part(outcome.out, "it was late by: median");
	expect_part(outcome.out, "woke it late by: median");
	outcome_free(&outcome);
	expect_json("paced/summary.json", "d['realtime']['steps']==10 and d['realtime']['speed']==2");
	char* summary = file_read(path_join(folder, "paced/summary.json"));
	const double stepping = number_after(summary, "\"stepping_seconds\": ");
	const double waiting = number_after(summary, "\"waiting_seconds\": ");
	assert_true(stepping > 0 && stepping + waiting > 0.0499); // 0.1 s at twice the speed, however fast the steps are
	assert_true(number_after(summary, "\"reached\": ") < 2.01);
	assert_true(number_after(summary, "\"wall_seconds\": ") > 0.044); // the last step begins after 0.09 s
	const double missed = number_after(summary, "\"missed\": ");
	assert_true(missed >= 0 && missed <= 10);
	assert_true(fabs(number_after(summary, "\"missed_share\": ") - missed / 10) < 1e-12);
	const double median = number_after(summary, "\"step_seconds\": {\"p50\": ");
	assert_true(median > 0 && median < stepping);
	free(summary);
}

static void speeds_that_are_none_are_refused(void** state) {
	(void)state;
	REFUSED(2, "--realtime: 'fast' is no speed", "run", "block.yaml", "--realtime=fast");
	REFUSED(2, "--realtime: '0' is no speed", "run", "block.yaml", "--realtime=0");
	REFUSED(2, "--realtime is an option of 'jounce run'", "check", "block.yaml", "--realtime");
}

// 3 of 10 steps; the run can be resumed, as after Ctrl-C.
static void a_run_stops_after_the_steps_that_were_asked_for(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "run", "block.yaml", "-o", "some", "--steps", "3");
	expect_part(outcome.out, "stopped as asked");
	outcome_free(&outcome);
	expect_json("some/summary.json", "d['steps']==3 and d['outcome']=='interrupted'");
	REFUSED(2, "--steps: '0' is no whole number from 1", "run", "block.yaml", "--steps", "0");
	REFUSED(2, "--steps: '2x' is no whole number from 1", "run", "block.yaml", "--steps", "2x");
	REFUSED(2, "--steps is an option of 'jounce run'", "check", "block.yaml", "--steps", "2");
}

static void a_run_without_a_pace_says_nothing_of_deadlines(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "run", "block.yaml", "-o", "free");
	assert_null(strstr(outcome.out, "deadline"));
	outcome_free(&outcome);
	expect_json("free/summary.json", "'realtime' not in d");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(version_names_version_vectors_and_blas),
		TEST(help_lists_the_commands_and_exit_statuses),
		TEST(every_command_has_help),
		TEST(no_command_is_bad_usage),
		TEST(unknown_command_gets_a_suggestion),
		TEST(each_list_is_text_and_json),
		TEST(all_lists_are_one_json_object),
		TEST(no_limit_is_minus_zero),
		TEST(unknown_list_gets_a_suggestion),
		TEST(describe_explains_a_key),
		TEST(describe_unknown_key_gets_a_suggestion),
		TEST(check_reports_elements_and_steps_and_writes_nothing),
		TEST(check_refuses_a_bad_scene),
		TEST(check_takes_no_output_folder),
		TEST(run_without_scene_is_bad_usage),
		TEST(missing_scene_is_a_file_failure),
		TEST(unknown_options_are_refused_by_name),
		TEST(thread_counts_are_whole_numbers_from_1),
		TEST(a_run_stops_after_the_steps_that_were_asked_for),
		TEST(bad_override_creates_nothing),
		TEST(selection_without_nodes_creates_nothing),
		TEST(run_writes_all_its_files),
		TEST(series_has_its_columns_and_a_row_a_step),
		TEST(quiet_prints_nothing),
		TEST(overrides_are_kept_with_the_recorded_scene),
		TEST(scene_path_may_have_spaces_and_lie_elsewhere),
		TEST(output_below_a_file_is_a_file_failure),
		TEST(output_that_cannot_be_created_leaves_no_half_file),
		TEST(failing_run_keeps_its_last_good_state),
		TEST(output_to_a_full_disk_is_a_file_failure),
		TEST(interrupt_finishes_the_step_and_the_files),
		TEST(interrupt_ends_a_wait_for_the_clock),
		TEST(a_run_in_real_time_waits_for_the_clock_and_reports_deadlines),
		TEST(speeds_that_are_none_are_refused),
		TEST(a_run_without_a_pace_says_nothing_of_deadlines),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
