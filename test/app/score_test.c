// The command `jounce score`: limits of stability that are known, and what it refuses.
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "support/support.h"

// omega = 10/s: so small an amplitude that the cubic part is 1e-6 of the force, and 1e-4 of it at the bound of energies.
static const char oscillator[] = "name: oscillator\n"
								 "system: {type: spring_1d, k_x: 100, k_v: 0, mass: 1, x: 1e-3, v: 0}\n"
								 "duration: 100 s\n"
								 "integrator: {method: rk4}\n"
								 "step: {dt: 20 ms}\n";

static const char block[] = "name: block\n"
							"duration: 0.2 s\n"
							"gravity: [0, -9.81, 0]\n"
							"bodies:\n"
							"  - name: block\n"
							"    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], element: tet4}\n"
							"    material: {law: constraints, density: 1000, stiffness: 1e7 Pa}\n"
							"    mass: %s\n"
							"    fix: [{where: {face: %s}}]\n"
							"step: {dt: 1 ms}\n";

static char folder[256];

static int set_up(void** state) {
	(void)state;
	if (folder_create(folder) != 0) return -1;
	file_write(path_join(folder, "oscillator.yaml"), oscillator);
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static Outcome score(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce score' ends with %d, expected %d\nstdout: %s\nstderr: %s", outcome.status, expected,
				 outcome.out, outcome.err);
	return outcome;
}

#define SCORE(expected, scene, ...) score(expected, (const char* const[]){"score", scene, "-o", "s", __VA_ARGS__, NULL})

#define REFUSED(text, ...)                                                                                             \
	do {                                                                                                               \
		Outcome refused = score(2, (const char* const[]){"score", __VA_ARGS__, NULL});                                 \
		if (strstr(refused.err, text) == NULL) fail_msg("'%s' is not in: %s", text, refused.err);                      \
		outcome_free(&refused);                                                                                        \
	} while (0)

/// What is expected of a method.
typedef struct Limit {
	const char* method;
	double h; // omega times the step
} Limit;

// A column of the row of a method; NAN where the cell is empty.
static double cell(const char* csv, const char* method, int column) {
	char start[64];
	snprintf(start, sizeof start, "\n%s,", method);
	const char* at = strstr(csv, start);
	if (at == NULL) fail_msg("'%s' is not in: %s", method, csv);
	for (++at; column > 0; --column) at = strchr(at, ',') + 1;
	return *at == ',' || *at == '\n' ? NAN : strtod(at, NULL);
}
enum { LIMIT = 2, IS_CAPPED, STEP, FORCES, VALUE, BY_FORCES };

static void expect_limits(const Limit* limits, int count) {
	char* csv = file_read(path_join(folder, "s/score.csv"));
	for (int i = 0; i < count; ++i) {
		const double h = 10 * cell(csv, limits[i].method, LIMIT);
		print_message("%s: %.4f, expected %.4f\n", limits[i].method, h, limits[i].h);
		if (!(fabs(h - limits[i].h) <= 0.02 * limits[i].h)) // what the search promises
			fail_msg("%s: %.4f, expected %.4f within 2 %%", limits[i].method, h, limits[i].h);
	}
	free(csv);
}

static void limits_of_an_undamped_oscillator_are_those_of_theory(void** state) {
	(void)state;
	static const Limit limits[] = {{"symplectic_euler", 2}, {"modified_midpoint", 2}, {"modified_half_step", 2},
								   {"verlet", 2},           {"forest_ruth", 1.5734},  {"rk4", 2.8284}};
	Outcome outcome = SCORE(0, "oscillator.yaml", "--methods",
							"symplectic_euler,modified_midpoint,modified_half_step,verlet,forest_ruth,rk4");
	outcome_free(&outcome);
	expect_limits(limits, 6);
}

// xi = 0.1. Explicit Euler grows so slowly just above its limit that the time must be long.
static void limits_of_a_damped_oscillator_are_those_of_theory(void** state) {
	(void)state;
	static const Limit limits[] = {{"explicit_euler", 0.2},       {"midpoint", 0.4},           {"half_step", 1.049},
								   {"modified_half_step", 1.843}, {"symplectic_euler", 1.809}, {"rk4", 2.95}};
	Outcome outcome = SCORE(0, "oscillator.yaml", "--set", "system.k_v=2", "--time", "500s", "--methods",
							"explicit_euler,midpoint,half_step,modified_half_step,symplectic_euler,rk4");
	outcome_free(&outcome);
	expect_limits(limits, 6);
}

// |z|^2 = 1 + h^2 grows to the bound in the time: (1 + h^2)^(T/h) = 1 + 200, which is some T h / 10 = ln(201) / 10.
static void limit_of_explicit_euler_without_damping_follows_from_the_time(void** state) {
	(void)state;
	static const double times[] = {10, 40};
	static const char* const texts[] = {"10s", "40s"};
	for (int i = 0; i < 2; ++i) {
		const Limit limit = {"explicit_euler", log(201) / (10 * times[i])};
		Outcome outcome = SCORE(0, "oscillator.yaml", "--time", texts[i], "--methods", "explicit_euler");
		outcome_free(&outcome);
		expect_limits(&limit, 1);
	}
}

static void score_is_step_over_time_relative_to_explicit_euler(void** state) {
	(void)state;
	Outcome outcome = SCORE(0, "oscillator.yaml", "--time", "5s", "--methods", "rk4,explicit_euler");
	char* csv = file_read(path_join(folder, "s/score.csv"));
	const double euler = cell(csv, "explicit_euler", LIMIT), rk4 = cell(csv, "rk4", LIMIT);
	const double by_time = rk4 / cell(csv, "rk4", STEP) / (euler / cell(csv, "explicit_euler", STEP));
	const double by_forces = rk4 / cell(csv, "rk4", FORCES) / (euler / cell(csv, "explicit_euler", FORCES));
	assert_true(fabs(cell(csv, "rk4", VALUE) / by_time - 1) < 1e-7); // nine digits in the file
	assert_true(fabs(cell(csv, "rk4", BY_FORCES) / by_forces - 1) < 1e-7);
	assert_true(cell(csv, "explicit_euler", VALUE) == 1);
	assert_non_null(strstr(outcome.out, "score"));
	free(csv);
	outcome_free(&outcome);
	assert_true(path_exists(path_join(folder, "s/score.md")));
	assert_true(path_exists(path_join(folder, "s/score.txt")));
}

static void implicit_methods_end_at_the_cap(void** state) {
	(void)state;
	Outcome outcome = SCORE(0, "oscillator.yaml", "--time", "20s", "--cap", "0.5s", "--methods", "backward_euler,rk4");
	char* csv = file_read(path_join(folder, "s/score.csv"));
	assert_true(cell(csv, "backward_euler", LIMIT) == 0.5 && cell(csv, "backward_euler", IS_CAPPED) == 1);
	assert_true(cell(csv, "rk4", LIMIT) < 0.3 && cell(csv, "rk4", IS_CAPPED) == 0);
	assert_non_null(strstr(outcome.out, ">= 500"));
	free(csv);
	outcome_free(&outcome);
}

static void methods_of_all_families_get_a_row(void** state) {
	(void)state;
	static const char names[] = "sdirk2,ros3p,newmark,bdf2,average_vector_field,exponential_rosenbrock";
	int rows = 0;
	Outcome outcome = SCORE(0, "oscillator.yaml", "--methods", names, "--time", "0.5s", "-q");
	assert_string_equal(outcome.out, "");
	outcome_free(&outcome);
	char* csv = file_read(path_join(folder, "s/score.csv"));
	for (const char* at = csv; *at != '\0'; ++at) rows += *at == '\n';
	assert_int_equal(rows, 7);
	assert_true(cell(csv, "exponential_rosenbrock", LIMIT) == 0.01); // the cap: a fiftieth of the time
	assert_true(cell(csv, "sdirk2", VALUE) == 1); // the first, where explicit Euler is not among them
	free(csv);
}

static void passes_run_as_they_are(void** state) {
	(void)state;
	char text[1024];
	snprintf(text, sizeof text, block, "lumped", "y+");
	file_write(path_join(folder, "block.yaml"), text);
	double limits[2];
	for (int i = 0; i < 2; ++i) {
		Outcome outcome =
			SCORE(0, "block.yaml", "--methods", "symplectic_euler", "--set",
				  i == 0 ? "gravity=[0, -9.81, 0]" : "relax={axis: no, springs: yes, sweeps: 1, compliance: 1e-5}");
		outcome_free(&outcome);
		char* csv = file_read(path_join(folder, "s/score.csv"));
		limits[i] = cell(csv, "symplectic_euler", LIMIT);
		free(csv);
	}
	print_message("largest stable step: %g s, relaxed %g s\n", limits[0], limits[1]);
	assert_true(limits[0] > 0 && limits[1] > 0 && fabs(limits[1] / limits[0] - 1) > 0.02);
}

// No step keeps the energy of Euler's method within rounding: the search ends at the least step of scenes, without a limit.
static void a_method_without_any_stable_step_has_no_limit(void** state) {
	(void)state;
	Outcome outcome = SCORE(0, "oscillator.yaml", "--methods", "explicit_euler,rk4", "--factor", "1e-20", "--time",
							"1ms", "--cap", "20us");
	char* csv = file_read(path_join(folder, "s/score.csv"));
	const double limit = cell(csv, "explicit_euler", LIMIT);
	free(csv);
	outcome_free(&outcome);
	assert_false(limit > 0);
}

static void what_cannot_be_scored_is_refused(void** state) {
	(void)state;
	char text[1024];
	snprintf(text, sizeof text, block, "consistent", "y+");
	file_write(path_join(folder, "consistent.yaml"), text);
	snprintf(text, sizeof text, block, "lumped", "y+");
	file_write(path_join(folder, "still.yaml"), text);
	REFUSED("there is no integrator 'rk5'; did you mean 'rk4'?", "oscillator.yaml", "--methods", "verlet,rk5");
	REFUSED("'rk4' comes twice", "oscillator.yaml", "--methods", "rk4,rk4");
	REFUSED("mass: lumped", "consistent.yaml");
	REFUSED("explicit_euler", "consistent.yaml", "--methods", "all");
	REFUSED("nothing moves within 0.2 s", "still.yaml", "--set", "gravity=[0, 0, 0]");
	REFUSED("a time is expected", "oscillator.yaml", "--time", "3 kg");
	REFUSED("--time: '0' is not above 0", "oscillator.yaml", "--time", "0");
	REFUSED("--cap: no step of 2 s fits into a run of 1 s", "oscillator.yaml", "--time", "1s", "--cap", "2s");
	REFUSED("unknown key", "oscillator.yaml", "--set", "system.k_z=2");
	REFUSED("no scene file is given", "--methods", "rk4");
	Outcome outcome = score(3, (const char* const[]){"score", "none.yaml", NULL});
	outcome_free(&outcome);
}

// Whether the process has come as far as to catch SIGINT, which ends it before.
static bool catches_interrupts(int id) {
	char path[64], line[256];
	unsigned long long caught = 0;
	snprintf(path, sizeof path, "/proc/%d/status", id);
	FILE* status = fopen(path, "r");
	while (status != NULL && fgets(line, sizeof line, status) != NULL)
		if (strncmp(line, "SigCgt:", 7) == 0) caught = strtoull(line + 7, NULL, 16);
	if (status != NULL) fclose(status);
	return (caught >> (SIGINT - 1) & 1) != 0;
}

static void interrupt_writes_what_is_known(void** state) {
	(void)state;
	const char* const words[] = {"score", "oscillator.yaml", "-o", "s", "--time", "1e6s", "--cap", "0.5s", NULL};
	Process process = command_start(folder, words);
	for (int i = 0; i < 1000 && !catches_interrupts((int)process.id); ++i) usleep(10000);
	usleep(100000);
	assert_int_equal(kill(process.id, SIGINT), 0);
	Outcome outcome = command_wait(process);
	assert_int_equal(outcome.status, 0);
	assert_non_null(strstr(outcome.out, "stopped as asked"));
	outcome_free(&outcome);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(limits_of_an_undamped_oscillator_are_those_of_theory),
		TEST(limits_of_a_damped_oscillator_are_those_of_theory),
		TEST(limit_of_explicit_euler_without_damping_follows_from_the_time),
		TEST(score_is_step_over_time_relative_to_explicit_euler),
		TEST(implicit_methods_end_at_the_cap),
		TEST(methods_of_all_families_get_a_row),
		TEST(passes_run_as_they_are),
		TEST(a_method_without_any_stable_step_has_no_limit),
		TEST(what_cannot_be_scored_is_refused),
		TEST(interrupt_writes_what_is_known),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
