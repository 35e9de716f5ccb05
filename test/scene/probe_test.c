// Probes: what they follow, and the messages of those that follow nothing.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/support.h"

static char folder[256];

static int set_up(void** state) {
	(void)state;
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static const char* const bodies = "duration: 0.05 s\n"
								  "gravity: [0, -9.81, 0]\n"
								  "integrator: sdirk2\n"
								  "step: {controller: fixed, dt: 10 ms}\n"
								  "record: {plots: false}\n"
								  "bodies:\n"
								  "  - name: left\n"
								  "    shape: {type: box, size: [1, 1, 1], cells: [1, 1, 2]}\n"
								  "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n"
								  "    sets: [{name: foot, where: {face: y-}}]\n"
								  "    fix: [{where: {set: foot}}]\n"
								  "  - name: right\n"
								  "    shape: {type: box, origin: [2, 0, 0], size: [1, 1, 1], cells: [1, 1, 2]}\n"
								  "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n"
								  "probes:\n";

static JnStatus run(const char* probes) {
	char text[2048];
	JnScene* scene = NULL;
	const char* path = path_join(folder, "scene.yaml");
	snprintf(text, sizeof text, "%s%s", bodies, probes);
	file_write(path, text);
	JN_TRY(jn_scene_load(path, 0, NULL, &scene));
	JnRunResult result;
	const JnRunOptions options = {.directory = path_join(folder, "out"), .threads = 1};
	const JnStatus status = jn_scene_run(scene, &options, &result);
	jn_scene_destroy(scene);
	return status;
}

static void expect_number(const Table* table, int row, const char* column, double expected, double tolerance) {
	const double value = table_number(table, row, column);
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("row %d, %s: %.17g, expected %.17g, tolerance %g", row, column, value, expected, tolerance);
}

static void a_probe_follows_the_mean_position_of_its_nodes(void** state) {
	(void)state;
	assert_int_equal(run("  - {name: foot, body: left, where: {set: foot}}\n"
						 "  - {name: side, body: right, where: {face: x+}}\n"
						 "  - {name: one, body: right, where: {corner: x+y-z-}}\n"
						 "  - {name: two, body: right, where: {corner: x+y+z+}}\n"
						 "  - {name: all, body: right, where: {face: all}}\n"),
					 JN_OK);
	Table table = table_read(path_join(folder, "out/series.csv"));
	const double drop = 9.81 / 2 * 0.05 * 0.05; // falls freely; sdirk2 is exact for constant acceleration
	const double rounding = 1e-12;
	for (int row = 1; row < table.rows; row += table.rows - 2) {
		const double fallen = row == 1 ? 0 : drop;
		expect_number(&table, row, "probe.foot.x", 0.5, 0);
		expect_number(&table, row, "probe.foot.y", 0, 0);
		expect_number(&table, row, "probe.foot.z", 0.5, 0);
		expect_number(&table, row, "probe.side.x", 3, rounding);
		expect_number(&table, row, "probe.side.y", 0.5 - fallen, rounding);
		expect_number(&table, row, "probe.one.y", -fallen, rounding);
		expect_number(&table, row, "probe.two.z", 1, rounding);
		expect_number(&table, row, "probe.all.x", 2.5, rounding);
	}
	table_free(&table);
}

static void a_point_is_looked_for_in_the_named_body_alone(void** state) {
	(void)state;
	assert_int_equal(run("  - {name: any, at: [1.1, 0, 0]}\n"
						 "  - {name: right, body: right, at: [1.1, 0, 0]}\n"),
					 JN_OK);
	Table table = table_read(path_join(folder, "out/series.csv"));
	expect_number(&table, 1, "probe.any.x", 1, 0);
	expect_number(&table, 1, "probe.right.x", 2, 0);
	table_free(&table);
}

static void expect_refusal(const char* probes, const char* part) {
	log_capture();
	const JnStatus status = run(probes);
	if (status != JN_BAD_INPUT || strstr(log_text(), part) == NULL || strstr(log_text(), "scene.yaml:16:") == NULL)
		fail_msg("%s: expected '%s', got '%s'", probes, part, log_text());
	log_release();
}

static void a_probe_that_follows_nothing_is_refused(void** state) {
	(void)state;
	expect_refusal("  - {name: a}\n", "probes[0]: nothing says what to follow; give exactly one of at, where");
	expect_refusal("  - {name: a, at: [0, 0, 0], where: {face: all}}\n", "probes[0]: both");
	expect_refusal("  - {name: a, where: {face: all}}\n", "there are 2; name one with 'body'");
	expect_refusal("  - {name: a, body: rihgt, where: {face: all}}\n", "did you mean 'right'?");
	expect_refusal("  - {name: a, body: something_else, where: {face: all}}\n",
				   "probes[0].body: there is no body 'something_else'; use the name of one of the bodies");
	expect_refusal("  - {name: a, body: right, where: {set: foot}}\n", "no set 'foot'. Sets here: none");
	expect_refusal("  - {name: a, body: left, where: {set: food}}\n", "did you mean 'foot'? Sets here: foot");
	expect_refusal("  - {name: a, body: left, where: {box: {min: [5, 5, 5], max: [6, 6, 6]}}}\n", "no node lies there");
	expect_refusal("  - {name: a, body: left, where: {}}\n", "probes[0].where: nothing says which nodes");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_probe_follows_the_mean_position_of_its_nodes, set_up, tear_down),
		cmocka_unit_test_setup_teardown(a_point_is_looked_for_in_the_named_body_alone, set_up, tear_down),
		cmocka_unit_test_setup_teardown(a_probe_that_follows_nothing_is_refused, set_up, tear_down),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
