// Scenes that cannot be right: each is refused with a message that says where, what and what to do.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/support.h"

// A scene that works; tests exchange one line of it.
static const char* const lines[] = {
	/*  1 */ "name: small",
	/*  2 */ "duration: 0.1 s",
	/*  3 */ "bodies:",
	/*  4 */ "  - name: block",
	/*  5 */ "    shape: {type: box, size: [1, 1, 1], cells: [1, 1, 2]}",
	/*  6 */ "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}",
	/*  7 */ "    fix:",
	/*  8 */ "      - where: {face: z-}",
	/*  9 */ "integrator: sdirk2",
	/* 10 */ "step: {controller: fixed, dt: 10 ms}",
	/* 11 */ "probes:",
	/* 12 */ "  - {name: top, at: [0.5, 0.5, 1]}",
};
enum { LINES = sizeof lines / sizeof *lines };

static char folder[256];

static int set_up(void** state) {
	(void)state;
	log_capture();
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	log_release();
	folder_remove(folder);
	return 0;
}

// Write the scene with `text` in place of line `line` (0: none); returns its path.
static const char* write_scene(int line, const char* text) {
	char all[4096] = "";
	size_t length = 0;
	for (int i = 0; i < LINES; ++i)
		length += (size_t)snprintf(all + length, sizeof all - length, "%s\n", i + 1 == line ? text : lines[i]);
	const char* path = path_join(folder, "scene.yaml");
	file_write(path, all);
	return path;
}

static JnStatus load_and_build(const char* path, int set_count, const char* const sets[]) {
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	JnStatus status = jn_scene_load(path, set_count, sets, &scene);
	if (status != JN_OK) assert_null(scene);
	if (status == JN_OK) status = jn_scene_build(scene, 1, &sim);
	if (status != JN_OK) assert_null(sim);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status;
}

// `place` is line:column of the key that is to blame, or of the list entry.
static void expect_message(const char* place, const char* part) {
	char start[512];
	snprintf(start, sizeof start, "%s/scene.yaml:%s: ", folder, place);
	const bool starts = strncmp(log_text(), start, strlen(start)) == 0;
	if (!starts || strstr(log_text(), part) == NULL)
		fail_msg("message: %s\nexpected to start with: %s\nexpected to contain: %s", log_text(), start, part);
	assert_int_equal(strchr(log_text(), '\n') - log_text() + 1, strlen(log_text())); // one message, not a chain
}

// The scene with one line exchanged is refused, with a message at "line:column" that contains `part`.
static void expect_refusal(int line, const char* text, const char* place, const char* part) {
	assert_int_equal(load_and_build(write_scene(line, text), 0, NULL), JN_BAD_INPUT);
	expect_message(place, part);
}

static void the_scene_that_the_tests_break_works(void** state) {
	(void)state;
	assert_int_equal(load_and_build(write_scene(0, NULL), 0, NULL), JN_OK);
	assert_string_equal(log_text(), "");
}

static void missing_file_is_an_io_failure(void** state) {
	(void)state;
	assert_int_equal(load_and_build(path_join(folder, "none.yaml"), 0, NULL), JN_IO_FAILED);
	assert_non_null(strstr(log_text(), "none.yaml: cannot be opened: No such file or directory"));
}

static void yaml_syntax_error_has_its_line(void** state) {
	(void)state;
	expect_refusal(2, "duration: [0.1", "3:7", "");
}

static void unknown_key_gets_a_suggestion(void** state) {
	(void)state;
	expect_refusal(2, "durations: 0.1 s", "2:1", "durations: unknown key; did you mean 'duration'?");
}

static void wrong_unit_names_the_expected_one(void** state) {
	(void)state;
	expect_refusal(2, "duration: 0.1 kg", "2:1", "duration: '0.1 kg' has the unit kg, but a time is expected");
}

static void poisson_ratio_above_one_half_gets_a_remedy(void** state) {
	(void)state;
	expect_refusal(6, "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.51}", "6:56",
				   "bodies[0].material.poisson: 0.51 is outside [0, 0.5); use 0.49 for nearly incompressible");
}

static void size_of_zero_is_refused(void** state) {
	(void)state;
	expect_refusal(5, "    shape: {type: box, size: [1, 0, 1], cells: [1, 1, 2]}", "5:34",
				   "bodies[0].shape.size[1]: 0 is outside (0, infinity)");
}

static void no_cells_are_refused(void** state) {
	(void)state;
	expect_refusal(5, "    shape: {type: box, size: [1, 1, 1], cells: [1, 1, 0]}", "5:55",
				   "bodies[0].shape.cells[2]: 0 is outside [1, 4096]");
}

static void too_many_cells_are_refused(void** state) {
	(void)state;
	expect_refusal(5, "    shape: {type: box, size: [1, 1, 1], cells: [4096, 4096, 4096]}", "5:41",
				   "bodies[0].shape.cells: 4096 x 4096 x 4096 hexahedra are 6.87e+10 cells of hex8, more than 2e+07; "
				   "use fewer");
}

static void body_without_a_free_node_is_refused(void** state) {
	(void)state;
	expect_refusal(8, "      - where: {face: all}", "3:1", "bodies: no node is free, all 12 are fixed or driven; fix");
}

static void unknown_method_gets_a_suggestion(void** state) {
	(void)state;
	expect_refusal(9, "integrator: sdrik2", "9:1",
				   "integrator: there is no integrator 'sdrik2'; did you mean 'sdirk2'");
}

static void unknown_material_points_to_the_list_of_materials(void** state) {
	(void)state;
	expect_refusal(6, "    material: {law: jelly, density: 1000, young: 1e5, poisson: 0.3}", "6:16",
				   "bodies[0].material.law: there is no material 'jelly'. 'jounce list materials' shows all");
}

static void selection_without_nodes_tells_where_the_body_is(void** state) {
	(void)state;
	expect_refusal(8, "      - where: {box: {min: [5, 5, 5], max: [6, 6, 6]}}", "8:9",
				   "bodies[0].fix[0].where: no node lies there; choose nodes of the body, which spans [0, 1] x [0, 1] "
				   "x [0, 1] m");
}

static void selection_that_says_nothing_lists_the_ways(void** state) {
	(void)state;
	expect_refusal(8, "      - {}", "8:9",
				   "bodies[0].fix[0].where: nothing says which nodes; give exactly one of face, box, sphere, nearest");
}

static void two_ways_of_selecting_are_refused(void** state) {
	(void)state;
	expect_refusal(8, "      - where: {face: z-, nearest: [0, 0, 0]}", "8:9",
				   "bodies[0].fix[0].where: several ways of choosing nodes are given; give exactly one of");
}

static void axes_other_than_x_y_z_are_refused(void** state) {
	(void)state;
	expect_refusal(8, "      - {where: {face: z-}, axes: xw}", "8:29",
				   "bodies[0].fix[0].axes: 'xw' is more than x, y and z; use only these letters");
}

static void falling_keyframe_times_are_refused(void** state) {
	(void)state;
	expect_refusal(7,
				   "    drive: [{where: {face: z+}, x: {type: keyframes, points: [[0, 0], [2, 1], [1, 0]]}}]\n"
				   "    fix:",
				   "7:79",
				   "bodies[0].drive[0].x.points[2]: its time 1 s is not after the 2 s before it; let times rise");
}

static void drive_without_motion_is_refused(void** state) {
	(void)state;
	expect_refusal(7, "    drive: [{where: {face: z+}}]\n    fix:", "7:13",
				   "bodies[0].drive[0]: no axis has a motion; give x, y or z, or along, or input, or use fix");
}

static void bodies_of_one_name_are_refused(void** state) {
	(void)state;
	char text[512];
	snprintf(text, sizeof text, "%s\n%s\n%s\n%s", lines[3], lines[4], lines[5], lines[3]);
	expect_refusal(4, text, "7:5", "bodies[1].name: 'block' is the name of bodies[0] already; use another");
}

static void probes_of_one_name_are_refused(void** state) {
	(void)state;
	expect_refusal(12, "  - {name: top, at: [0, 0, 0]}\n  - {name: top, at: [0, 0, 1]}", "13:6",
				   "probes[1].name: 'top' is the name of probes[0] already; use another");
}

static void name_with_a_slash_is_refused(void** state) {
	(void)state;
	expect_refusal(1, "name: ../small", "1:1", "name: '../small' is no plain name; use only letters, digits, _ and -");
}

static void empty_name_is_refused(void** state) {
	(void)state;
	expect_refusal(4, "  - name: ''", "4:5", "bodies[0].name: is empty; use letters, digits, _ and -");
}

static void very_long_name_is_refused(void** state) {
	(void)state;
	expect_refusal(12,
				   "  - {name: aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa, at: [0, 0, 0]}",
				   "12:6", "probes[0].name: 'aaaaaaaaaaaaaaaaaaaa...' is longer than 64 letters; shorten it");
}

static void missing_duration_is_named(void** state) {
	(void)state;
	expect_refusal(2, "", "1:1", "the required key 'duration' is missing (simulated time)");
}

static void scene_without_bodies_is_refused(void** state) {
	(void)state;
	file_write(path_join(folder, "scene.yaml"), "duration: 1 s\nbodies: []\n");
	assert_int_equal(load_and_build(path_join(folder, "scene.yaml"), 0, NULL), JN_BAD_INPUT);
	expect_message("2:1", "bodies: there are none, and no system in their place");
}

static void bodies_beside_a_system_are_refused(void** state) {
	(void)state;
	const char* const sets[] = {"system=spring_1d", "probes=[]"};
	assert_int_equal(load_and_build(write_scene(0, NULL), 2, sets), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "bodies: stand beside 'system: spring_1d'"));
}

static void a_system_needs_no_bodies(void** state) {
	(void)state;
	file_write(path_join(folder, "scene.yaml"), "duration: 1 s\nsystem: {type: spring_1d, mass: 2 kg}\n");
	assert_int_equal(load_and_build(path_join(folder, "scene.yaml"), 0, NULL), JN_OK);
}

static void what_acts_on_bodies_does_not_stand_beside_a_system(void** state) {
	(void)state;
	static const struct {
		const char *line, *message;
	} parts[] = {{"contact: {}", "contact: stands beside 'system: spring_1d'"},
				 {"collision: {}", "collision: stands beside"},
				 {"relax: {}", "relax: stands beside"},
				 {"wind: {velocity: [1, 0, 0]}", "wind: stands beside"},
				 {"obstacles: [{name: floor, shape: plane}]", "obstacles: stand beside"},
				 {"probes: [{name: tip, at: [0, 0, 0]}]",
				  "probes: follow nodes of bodies, and 'spring_1d' has columns of its own; take them out"}};
	for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
		char text[200];
		snprintf(text, sizeof text, "duration: 1 s\nsystem: spring_1d\n%s\n", parts[i].line);
		file_write(path_join(folder, "scene.yaml"), text);
		log_capture();
		assert_int_equal(load_and_build(path_join(folder, "scene.yaml"), 0, NULL), JN_BAD_INPUT);
		expect_message("3:1", parts[i].message);
	}
}

static void override_is_named_in_place_of_the_file(void** state) {
	(void)state;
	const char* const sets[] = {"bodies[0].fix[0].where={sphere: {center: [9, 9, 9], radius: 1}}"};
	assert_int_equal(load_and_build(write_scene(0, NULL), 1, sets), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "--set bodies[0].fix[0].where={sphere: {center: [9, 9, 9], radius: 1}}: "
									   "bodies[0].fix[0].where: no node lies there"));
}

static void override_without_value_is_refused(void** state) {
	(void)state;
	const char* const sets[] = {"step.dt"};
	assert_int_equal(load_and_build(write_scene(0, NULL), 1, sets), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "--set step.dt: write path=value, such as step.dt=10ms"));
}

static void scene_without_name_is_called_after_its_file(void** state) {
	(void)state;
	const char* path = path_join(folder, "my soft beam.2.yaml");
	file_write(path, "duration: 1 s\nbodies: []\n");
	JnScene* scene;
	assert_int_equal(jn_scene_load(path, 0, NULL, &scene), JN_OK);
	assert_string_equal(jn_scene_def(scene)->name, "my_soft_beam_2");
	assert_string_equal(jn_scene_path(scene), path);
	jn_scene_destroy(scene);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(the_scene_that_the_tests_break_works),
		TEST(missing_file_is_an_io_failure),
		TEST(yaml_syntax_error_has_its_line),
		TEST(unknown_key_gets_a_suggestion),
		TEST(wrong_unit_names_the_expected_one),
		TEST(poisson_ratio_above_one_half_gets_a_remedy),
		TEST(size_of_zero_is_refused),
		TEST(no_cells_are_refused),
		TEST(too_many_cells_are_refused),
		TEST(body_without_a_free_node_is_refused),
		TEST(unknown_method_gets_a_suggestion),
		TEST(unknown_material_points_to_the_list_of_materials),
		TEST(selection_without_nodes_tells_where_the_body_is),
		TEST(selection_that_says_nothing_lists_the_ways),
		TEST(two_ways_of_selecting_are_refused),
		TEST(axes_other_than_x_y_z_are_refused),
		TEST(falling_keyframe_times_are_refused),
		TEST(drive_without_motion_is_refused),
		TEST(bodies_of_one_name_are_refused),
		TEST(probes_of_one_name_are_refused),
		TEST(name_with_a_slash_is_refused),
		TEST(empty_name_is_refused),
		TEST(very_long_name_is_refused),
		TEST(missing_duration_is_named),
		TEST(scene_without_bodies_is_refused),
		TEST(bodies_beside_a_system_are_refused),
		TEST(a_system_needs_no_bodies),
		TEST(what_acts_on_bodies_does_not_stand_beside_a_system),
		TEST(override_is_named_in_place_of_the_file),
		TEST(override_without_value_is_refused),
		TEST(scene_without_name_is_called_after_its_file),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
