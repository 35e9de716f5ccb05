// The command `jounce reproduce`: names, pages, failures, resumption; and the measures of likeness against known motions.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "reproduce/measure.c" // the command's own parts are in no library
#include "support/support.h"

// The overrides of ho-fig3 fit this; a linear law makes its 18 runs cheap.
static const char scene_text[] = "name: beam\n"
								 "duration: 1 s\n"
								 "bodies:\n"
								 "  - name: beam\n"
								 "    shape: {type: box, size: [0.25, 0.25, 2], cells: [1, 1, 4]}\n"
								 "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.4}\n"
								 "    fix: [{where: {face: z-}}]\n"
								 "integrator: {method: sdirk2}\n"
								 "step: {controller: fixed, dt: 10 ms}\n";

static char folder[256];

static int set_up(void** state) {
	(void)state;
	return folder_create(folder) == 0 ? 0 : -1;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

#define REPRODUCE(expected, ...) reproduce(expected, (const char* const[]){"reproduce", __VA_ARGS__, NULL})

static Outcome reproduce(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce reproduce' ends with %d, expected %d\nstdout: %s\nstderr: %s", outcome.status, expected,
				 outcome.out, outcome.err);
	return outcome;
}

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

static void expect_near(double value, double expected, double tolerance) {
	if (!(fabs(value - expected) <= tolerance)) fail_msg("%g, expected %g within %g", value, expected, tolerance);
}

static void list_names_every_study(void** state) {
	(void)state;
	static const char* const names[] = {"ho-fig1 ",  "ho-fig3 ",       "ho-fig4 ",   "ho-fig5 ",  "ho-fig6 ",
										"ho-fig7 ",  "ho-fig8 ",       "ho-table1 ", "ad-fig1 ",  "ad-fig2 ",
										"ad-cloth ", "adaptive-beam ", "notch ",     "ex-phase ", "ex-table "};
	Outcome outcome = REPRODUCE(0, "list");
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i) expect_part(outcome.out, names[i]);
	outcome_free(&outcome);
}

static void misspelt_name_is_refused_with_the_right_one(void** state) {
	(void)state;
	Outcome outcome = REPRODUCE(2, "ho-fig3", "ho-tabel1");
	expect_part(outcome.err, "there is nothing called 'ho-tabel1'; did you mean 'ho-table1'?");
	assert_string_equal(outcome.out, "");
	outcome_free(&outcome);
	assert_false(path_exists(path_join(folder, "out")));
}

// No scene is there, so that every run fails; all are tried, and the page names them.
static void failed_runs_are_on_the_page(void** state) {
	(void)state;
	Outcome outcome = REPRODUCE(1, "ho-fig5", "--quick", "--scenes", "nowhere", "-o", "r", "--jobs", "2");
	expect_part(outcome.err, "SDIRK2 5 ms: ");
	expect_part(outcome.err, "nowhere/jello.yaml");
	outcome_free(&outcome);
	char* page = file_read(path_join(folder, "r/ho-fig5/page.md"));
	expect_part(page, "BE 0.05 ms failed: ");
	expect_part(page, "TR-BDF2(B) 5 ms failed: ");
	expect_part(page, "jounce run nowhere/jello.yaml --set 'record.plots=no'");
	free(page);
	assert_true(path_exists(path_join(folder, "r/ho-fig5/index.html")));
}

// The two errors of a method, at 33 ms and 5 ms.
static void find_errors(const char* table, const char* method, double errors[2]) {
	const char* row = strstr(table, method);
	if (row == NULL) fail_msg("'%s' is not in: %s", method, table);
	assert_int_equal(sscanf(row + strlen(method), "%lf,%lf", &errors[0], &errors[1]), 2);
}

// Backward Euler loses more than SDIRK2 at both steps, and its series ends at 20 s with the error of the table.
static void expect_energies(void) {
	double euler[2] = {0}, sdirk2[2] = {0};
	char* table = file_read(path_join(folder, "r/ho-fig3/table.csv"));
	Table curve = table_read(path_join(folder, "r/ho-fig3/runs/backward_euler_dt=5ms/thinned.csv"));
	find_errors(table, "\nBE,", euler);
	find_errors(table, "\nSDIRK2,", sdirk2);
	assert_true(euler[0] > sdirk2[0]);
	assert_true(euler[1] > sdirk2[1]);
	expect_near(table_number(&curve, curve.rows - 1, "t"), 20, 1e-9); // 4000 sums of 5 ms
	const double last = table_number(&curve, curve.rows - 1, "specific_error");
	expect_near(euler[1], last, 1e-3 * last); // the table has four digits
	assert_in_range(curve.rows, 400, 402);
	table_free(&curve);
	free(table);
}

static void page_and_tables_are_those_of_runs_which_a_second_call_keeps(void** state) {
	(void)state;
	static const char* const files[] = {"index.html", "page.md", "energy_over_time.csv", "energy_over_time.gnuplot"};
	char path[128];
	file_write(path_join(folder, "beam.yaml"), scene_text);
	Outcome outcome = REPRODUCE(0, "ho-fig3", "--quick", "--scenes", ".", "-o", "r", "-q");
	assert_string_equal(outcome.out, "");
	outcome_free(&outcome);
	for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
		snprintf(path, sizeof path, "r/ho-fig3/%s", files[i]);
		if (!path_exists(path_join(folder, path))) fail_msg("%s is missing", path);
	}
	assert_false(path_exists(path_join(folder, "r/ho-fig3/runs/sdirk2_dt=5ms/series.csv"))); // only the thinned one
	expect_energies();
	char* first = file_read(path_join(folder, "r/ho-fig3/energy_over_time.csv"));
	outcome = REPRODUCE(0, "ho-fig3", "--quick", "--scenes", ".", "-o", "r");
	expect_part(outcome.out, "18 runs, 18 of them done already, in r/ho-fig3\n");
	outcome_free(&outcome);
	char* second = file_read(path_join(folder, "r/ho-fig3/energy_over_time.csv"));
	assert_string_equal(first, second);
	free(first);
	free(second);
}

// The curve through (1.6, 0) has the energy of that start everywhere, and the half step leaves it outwards.
static void portraits_of_a_pendulum_lie_over_curves_of_equal_energy(void** state) {
	(void)state;
	double theta, omega;
	int points = 0;
	Outcome outcome = REPRODUCE(0, "ex-phase", "--quick", "--scenes", JN_SOURCE_DIR "/scenes", "-o", "r", "-q");
	outcome_free(&outcome);
	char* curves = file_read(path_join(folder, "r/ex-phase/curves.csv"));
	const char* at = strstr(curves, "\n\n\n"); // behind the first block
	assert_non_null(at);
	for (at += 3; sscanf(at, "%lf,%lf", &theta, &omega) == 2 && *at != '\n'; at = strchr(at, '\n') + 1, ++points)
		expect_near(0.5 * omega * omega - 9.81 * cos(theta), -9.81 * cos(1.6), 1e-4); // six digits of numbers up to 5
	assert_in_range(points, 300, 500);
	free(curves);
	char* claims = file_read(path_join(folder, "r/ex-phase/claims.csv"));
	expect_part(claims, "(midpoint) against");
	expect_part(claims, "(explicit_euler),confirmed");
	expect_part(claims, "not known"); // of pictures that the quick form leaves out
	free(claims);
	Table series = table_read(path_join(folder, "r/ex-phase/runs/half_steps_half_step_1.6/series.csv"));
	assert_true(table_number(&series, series.rows - 1, "total") > 1.1 * table_number(&series, 1, "total"));
	table_free(&series);
	assert_true(path_exists(path_join(folder, "r/ex-phase/half_steps.gnuplot")));
}

// The order of Forest and Ruth is four, whatever the paper says; the limits are those of the board's own CSV.
static void scoreboard_of_a_thread_judges_what_the_paper_says(void** state) {
	(void)state;
	Outcome outcome = REPRODUCE(0, "ex-table", "--quick", "--scenes", JN_SOURCE_DIR "/scenes", "-o", "r", "-q");
	assert_string_equal(outcome.out, "");
	outcome_free(&outcome);
	char* claims = file_read(path_join(folder, "r/ex-table/claims_plain.csv"));
	expect_part(claims, "Forest-Ruth is accurate up to the third order,measured order 4.0");
	expect_part(claims, "it is a method of fourth order,refuted");
	assert_null(strstr(claims, "not known"));
	free(claims);
	Table board = table_read(path_join(folder, "r/ex-table/relaxed.csv"));
	assert_int_equal(board.rows, 10);
	assert_true(table_number(&board, 1, "score") == 1); // explicit Euler
	table_free(&board);
	char* page = file_read(path_join(folder, "r/ex-table/page.md"));
	expect_part(page, "--time 0.1s --set 'bodies[0].shape.links=6' --set 'relax={}'");
	free(page);
	assert_true(path_exists(path_join(folder, "r/ex-table/undamped/score.md")));
}

// ---- measures ----

static void span_is_highest_minus_lowest_within_the_window(void** state) {
	(void)state;
	const double times[] = {0, 1, 2, 3, 4}, values[] = {9, 1, -2, 3, -9};
	expect_near(measure_span(5, times, values, 1, 3), 5, 0);
	assert_true(isnan(measure_span(5, times, values, 5, 6)));
}

enum { CELLS = 96, SIDE = CELLS + 1, NODES = 2 * SIDE * SIDE };
typedef double (*Height)(double u, double v);

// Height of the wrinkles of a sheet of 1 m with two layers of nodes, bent into z = height(x, y).
static double wrinkles_of(Height height) {
	JnArena arena = {0};
	SheetGrid grid;
	double* rest = jn_arena_take(&arena, 3 * NODES, sizeof *rest);
	double* points = jn_arena_take(&arena, 3 * NODES, sizeof *points);
	assert_non_null(rest);
	assert_non_null(points);
	for (int i = 0; i < NODES; ++i) {
		const double at[3] = {(double)(i / 2 % SIDE) / CELLS, (double)(i / 2 / SIDE) / CELLS, (i % 2) / 96.0};
		memcpy(rest + 3 * i, at, sizeof at);
		memcpy(points + 3 * i, at, sizeof at);
		points[3 * i + 2] += height(at[0], at[1]);
	}
	assert_int_equal(sheet_grid_create(NODES, rest, &arena, &grid), JN_OK);
	assert_int_equal(grid.cells[0], CELLS);
	const double wrinkles = measure_wrinkles(&grid, NODES, points);
	jn_arena_free(&arena);
	return wrinkles;
}

static double cubic(double u, double v) {
	return 1 + u - 2 * v + u * u - 3 * u * v + 0.5 * v * v * v - u * u * u + u * u * v;
}

// As long as the window of 13 points, so that its mean over a window is 0 everywhere.
static double ripple(double u, double v) {
	(void)v;
	return 0.01 * sin(2 * acos(-1.0) * u * CELLS / 13);
}

static double swell(double u, double v) {
	(void)v;
	return 0.01 * sin(2 * acos(-1.0) * u * CELLS / 52);
}

static void cubic_surface_has_no_wrinkles(void** state) {
	(void)state;
	expect_near(wrinkles_of(cubic), 0, 1e-13); // sums of 169 numbers of size 1
}

// The mean square of a sine over 72 lines is 1/2 but for the part of a wave that is left over.
static void wave_as_long_as_the_window_is_all_wrinkle(void** state) {
	(void)state;
	expect_near(wrinkles_of(ripple), 0.01 / sqrt(2), 0.03 * 0.01);
}

// S multiplies a wave of 52 points by sin(13 pi / 52) / (13 sin(pi / 52)) = 0.9008, and (1 - 0.9008)^2 = 0.0098 is left.
static void wave_four_times_as_long_is_hardly_seen(void** state) {
	(void)state;
	const double pi = acos(-1.0), mean = sin(pi / 4) / (13 * sin(pi / 52)), left = pow(1 - mean, 2);
	const double wrinkles = wrinkles_of(swell);
	assert_true(left < 0.011);
	expect_near(wrinkles, 0.01 * left / sqrt(2), 0.2 * 0.01 * left); // 1.4 waves fit inside
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(list_names_every_study, set_up, tear_down),
		cmocka_unit_test_setup_teardown(misspelt_name_is_refused_with_the_right_one, set_up, tear_down),
		cmocka_unit_test_setup_teardown(failed_runs_are_on_the_page, set_up, tear_down),
		cmocka_unit_test_setup_teardown(page_and_tables_are_those_of_runs_which_a_second_call_keeps, set_up, tear_down),
		cmocka_unit_test_setup_teardown(portraits_of_a_pendulum_lie_over_curves_of_equal_energy, set_up, tear_down),
		cmocka_unit_test_setup_teardown(scoreboard_of_a_thread_judges_what_the_paper_says, set_up, tear_down),
		cmocka_unit_test(span_is_highest_minus_lowest_within_the_window),
		cmocka_unit_test(cubic_surface_has_no_wrinkles),
		cmocka_unit_test(wave_as_long_as_the_window_is_all_wrinkle),
		cmocka_unit_test(wave_four_times_as_long_is_hardly_seen),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
