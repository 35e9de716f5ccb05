// Obstacles from scene files: their signed distances against formulas, and those that are refused, with the words.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <hdf5.h>
#include <cmocka.h>

#include "jounce/scene.h"
#include "math/vec3.h"
#include "model/model.h"
#include "support/support.h"

static char folder[256];

// A tetrahedron: corners 0, x, y, z of a unit of the file.
static const char corner_off[] = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
static const char open_off[] = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";

static int set_up(void** state) {
	(void)state;
	log_capture();
	const int outcome = folder_create(folder);
	file_write(path_join(folder, "corner.off"), corner_off);
	file_write(path_join(folder, "open.off"), open_off);
	return outcome;
}

static int tear_down(void** state) {
	(void)state;
	log_release();
	folder_remove(folder);
	return 0;
}

/// A scene with these lines below `obstacles:`, which begins at line 3.
static JnStatus build(const char* obstacles, JnScene** scene, JnSim** sim) {
	char text[4096];
	snprintf(text, sizeof text,
			 "duration: 0.1 s\nintegrator: sdirk2\nobstacles:\n%s\nbodies:\n"
			 "  - name: block\n    shape: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}\n"
			 "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n"
			 "    contact: {self: yes, surface: rubber}\n",
			 obstacles);
	const char* path = path_join(folder, "scene.yaml");
	file_write(path, text);
	*scene = NULL;
	*sim = NULL;
	JnStatus status = jn_scene_load(path, 0, NULL, scene);
	if (status == JN_OK) status = jn_scene_build(*scene, 1, sim);
	return status;
}

static void expect_distance(const char* shape, const double point[3], double expected, const double direction[3]) {
	JnScene* scene;
	JnSim* sim;
	char text[1024];
	snprintf(text, sizeof text, "  - {name: it, surface: ice, shape: {%s}}", shape);
	if (build(text, &scene, &sim) != JN_OK) fail_msg("%s: %s", shape, log_text());
	const JnModel* model = jn_sim_model(sim);
	assert_int_equal(model->obstacle_count, 1);
	assert_string_equal(model->obstacles[0].name, "it");
	assert_string_equal(model->obstacles[0].surface, "ice");
	double normal[3];
	const double distance = jn_obstacle_distance(&model->obstacles[0].shape, point, normal);
	print_message("%s: distance %.17g, expected %.17g\n", shape, distance, expected);
	assert_true(fabs(distance - expected) < 1e-14); // a few roundings of numbers up to 5
	if (direction != NULL) assert_true(vec3_distance(normal, direction) < 1e-14);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static const double up[3] = {0, 1, 0};

static void a_plane_is_a_floor_by_default(void** state) {
	(void)state;
	expect_distance("type: plane", (double[]){5, -2, 7}, -2, up);
	expect_distance("type: plane, point: [0, 10 cm, 0]", (double[]){5, 1, 7}, 0.9, up);
	expect_distance("type: plane, point: [1, 0, 0], normal: [3, 4, 0]", (double[]){2, 1, 0}, 1.4,
					(double[]){0.6, 0.8, 0});
	expect_distance("type: plane, normal: [0, 1e30, 0]", (double[]){5, -2, 7}, -2, up);
	expect_distance("type: plane, normal: [0, 1e-200, 0]", (double[]){5, -2, 7}, -2, up);
}

static void a_sphere_is_a_ball_or_a_cave(void** state) {
	(void)state;
	expect_distance("type: sphere, center: [1, 0, 0], radius: 50 cm", (double[]){1, 2, 0}, 1.5, up);
	expect_distance("type: sphere, center: [1, 0, 0], radius: 50 cm", (double[]){1, 0.1, 0}, -0.4, up);
	expect_distance("type: sphere, center: [1, 0, 0], radius: 0.5, inside: yes", (double[]){1, -0.1, 0}, 0.4, up);
}

static void a_box_has_full_edges(void** state) {
	(void)state;
	expect_distance("type: box, center: [0, 1, 0], size: [2, 4, 6]", (double[]){0.5, 3.5, 2}, 0.5, up);
	expect_distance("type: box, center: [0, 1, 0], size: [2, 4, 6]", (double[]){0.5, 1, 2}, -0.5, (double[]){1, 0, 0});
	expect_distance("type: box, size: [2, 2, 2]", (double[]){2, 2, 1}, sqrt(2), NULL);
}

// Turned by 30 degrees about z, the first edge points to (cos 30, sin 30, 0); about x first by a quarter, the second edge
// goes to z and stays there in the turn about z.
static void a_box_turns_about_x_then_y_then_z(void** state) {
	(void)state;
	const double c = sqrt(0.75), s = 0.5;
	expect_distance("type: box, center: [1, 1, 1], size: [2, 4, 6], rotate: [0, 0, 30 deg]",
					(double[]){1 + 3 * c, 1 + 3 * s, 1}, 2, (double[]){c, s, 0});
	expect_distance("type: box, size: [2, 4, 6], rotate: [90 deg, 0, 30 deg]", (double[]){0, 0, 2.5}, 0.5,
					(double[]){0, 0, 1});
	expect_distance("type: box, size: [2, 4, 6], rotate: [90 deg, 0, 30 deg]", (double[]){1.5 * c, 1.5 * s, 0}, 0.5,
					(double[]){c, s, 0});
}

static void a_capsule_goes_from_end_to_end(void** state) {
	(void)state;
	expect_distance("type: capsule, from: [-1, 0, 0], to: [1, 0, 0], radius: 0.25", (double[]){0.3, 1, 0}, 0.75, up);
	expect_distance("type: capsule, from: [-1, 0, 0], to: [1, 0, 0], radius: 0.25", (double[]){2, 0, 0}, 0.75,
					(double[]){1, 0, 0});
}

// From a point on the axis all ways out are as long: whichever is taken, it is across and has length 1.
static void from_the_axis_of_a_capsule_the_way_out_is_across(void** state) {
	(void)state;
	static const struct {
		double end[3], direction[3]; // the axis times the direction of which it has least
	} samples[] = {{{2, 0, 0}, {0, 0, 1}},
				   {{0, 2, 0}, {0, 0, -1}},
				   {{0, 0, 2}, {0, 1, 0}},
				   {{1.2, 1.6, 0}, {0.8, -0.6, 0}},
				   {{1.6, 1.2, 0}, {0.6, -0.8, 0}}};
	for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i) {
		const double* end = samples[i].end;
		char shape[160];
		snprintf(shape, sizeof shape, "type: capsule, from: [0, 0, 0], to: [%g, %g, %g], radius: 0.25", end[0], end[1],
				 end[2]);
		expect_distance(shape, (double[]){end[0] / 2, end[1] / 2, end[2] / 2}, -0.25, samples[i].direction);
	}
}

static void a_mesh_is_placed_like_a_body(void** state) {
	(void)state;
	expect_distance("type: mesh, path: corner.off", (double[]){0.2, -0.5, 0.2}, 0.5, (double[]){0, -1, 0});
	expect_distance("type: mesh, path: corner.off", (double[]){0.2, 0.1, 0.2}, -0.1, (double[]){0, -1, 0});
	expect_distance("type: mesh, path: corner.off, scale: 10 cm, translate: [0, 1, 0]", (double[]){0.02, 0.5, 0.02},
					0.5, (double[]){0, -1, 0});
	// the file's z is up: its base z = 0 becomes y = 0, its corner (0, 0, 1) the top
	expect_distance("type: mesh, path: corner.off, up: z, fit: 2 m", (double[]){0, 3, 0}, 1, up);
}

static void bodies_say_how_they_take_part(void** state) {
	(void)state;
	JnScene* scene;
	JnSim* sim;
	assert_int_equal(build("  - {shape: plane}", &scene, &sim), JN_OK);
	const JnModel* model = jn_sim_model(sim);
	const JnBodyContactDef* contact = &model->bodies[0].contact;
	assert_true(contact->active);
	assert_true(contact->self);
	assert_string_equal(contact->surface, "rubber");
	assert_string_equal(model->obstacles[0].surface, "default");
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static void a_run_records_its_obstacles(void** state) {
	(void)state;
	JnScene* scene;
	JnSim* sim;
	JnRunResult result;
	assert_int_equal(build("  - {name: floor, shape: plane}", &scene, &sim), JN_OK);
	const JnRunOptions options = {.directory = path_join(folder, "out"), .threads = 1};
	assert_int_equal(jn_scene_run(scene, &options, &result), JN_OK);
	const hid_t file = H5Fopen(path_join(folder, "out/run.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
	assert_true(file >= 0);
	double points[12];
	const hid_t dataset = H5Dopen2(file, "/obstacles/floor/points", H5P_DEFAULT);
	assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, points) >= 0);
	for (int i = 0; i < 4; i++) assert_true(points[3 * i + 1] == 0);
	H5Dclose(dataset);
	H5Fclose(file);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static void expect_refusal(const char* obstacles, const char* first, const char* second) {
	JnScene* scene;
	JnSim* sim;
	log_capture();
	assert_int_equal(build(obstacles, &scene, &sim), JN_BAD_INPUT);
	assert_null(sim);
	jn_scene_destroy(scene);
	const bool is_placed = strstr(log_text(), "scene.yaml:4:") != NULL || strstr(log_text(), "scene.yaml:5:") != NULL;
	if (!is_placed || strstr(log_text(), first) == NULL || strstr(log_text(), second) == NULL)
		fail_msg("message: %s\nexpected to contain: %s\nand: %s", log_text(), first, second);
}

static void obstacles_that_cannot_be_are_refused(void** state) {
	(void)state;
	expect_refusal("  - {shape: {type: plane, normal: [0, 0, 0]}}", "obstacles[0].shape.normal: ", "use [0, 1, 0]");
	expect_refusal("  - {shape: {type: sphere, radius: 0}}", "obstacles[0].shape.radius: ", "use a length above 0");
	expect_refusal("  - {name: a, shape: plane}\n  - {name: b, shape: {type: sphere, radius: -1 cm}}",
				   "obstacles[1].shape.radius: ", "use a length above 0");
	expect_refusal("  - {shape: {type: box, size: [1, 0, 1]}}", "obstacles[0].shape.size", "use lengths above 0");
	expect_refusal("  - {shape: {type: box, half: [1, 0, 1]}}", "obstacles[0].shape", "of the obstacle 'box'");
	expect_refusal("  - {shape: {type: capsule, from: [0, 0, 0], radius: 1}}", "obstacles[0].shape", "'to' is missing");
	expect_refusal("  - {shape: cube}", "there is no obstacle 'cube'", "jounce list obstacles");
}

static void obstacle_meshes_must_be_closed_surfaces(void** state) {
	(void)state;
	expect_refusal("  - {shape: {type: mesh, path: open.off}}", "obstacles[0].shape.path: ", "close the holes");
	expect_refusal("  - {shape: {type: mesh, path: none.off}}", "obstacles[0].shape.path: ", "cannot be read");
	expect_refusal("  - {shape: {type: mesh, path: " JN_SOURCE_DIR "/test/allocation/volume.vtk}}",
				   "obstacles[0].shape.path: ", "holds a volume; give a closed surface, such as an .obj file");
	expect_refusal("  - {shape: {type: mesh, path: corner.off, scale: 0}}", "obstacles[0].shape.scale: ", "write 1 mm");
}

static void names_of_obstacles_are_plain_and_differ(void** state) {
	(void)state;
	expect_refusal("  - {name: a/b, shape: plane}", "obstacles[0].name: ", "use only letters");
	expect_refusal("  - {name: a, shape: plane}\n  - {name: a, shape: plane}", "obstacles[1].name: ", "use another");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_plane_is_a_floor_by_default),
		cmocka_unit_test(a_sphere_is_a_ball_or_a_cave),
		cmocka_unit_test(a_box_has_full_edges),
		cmocka_unit_test(a_box_turns_about_x_then_y_then_z),
		cmocka_unit_test(a_capsule_goes_from_end_to_end),
		cmocka_unit_test(from_the_axis_of_a_capsule_the_way_out_is_across),
		cmocka_unit_test(a_mesh_is_placed_like_a_body),
		cmocka_unit_test(bodies_say_how_they_take_part),
		cmocka_unit_test(a_run_records_its_obstacles),
		cmocka_unit_test(obstacles_that_cannot_be_are_refused),
		cmocka_unit_test(obstacle_meshes_must_be_closed_surfaces),
		cmocka_unit_test(names_of_obstacles_are_plain_and_differ),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
