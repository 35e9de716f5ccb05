// jounce mesh: what it says, writes and refuses.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "support/support.h"

static char folder[256];

// A cube of 20 cm, in centimetres, with outward triangles.
static const char cube[] = "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nv 0 0 20\nv 20 0 20\nv 20 20 20\nv 0 20 20\n"
						   "f 1 4 3\nf 1 3 2\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\n"
						   "f 3 4 8\nf 3 8 7\nf 2 3 7\nf 2 7 6\nf 1 5 8\nf 1 8 4\n";

static int set_up(void** state) {
	(void)state;
	if (folder_create(folder) != 0) return -1;
	setenv("JOUNCE_CACHE", path_join(folder, "cache"), 1);
	file_write(path_join(folder, "cube.obj"), cube);
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static Outcome run(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("status %d, expected %d\nstdout: %s\nstderr: %s", outcome.status, expected, outcome.out, outcome.err);
	return outcome;
}

#define RUN(expected, ...) run(expected, (const char* const[]){"mesh", __VA_ARGS__, NULL})

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

static double number_after(const char* text, const char* words) {
	const char* place = strstr(text, words);
	if (place == NULL) fail_msg("'%s' is not in: %s", words, text);
	return atof(place + strlen(words));
}

static void a_surface_is_described(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "cube.obj", "--set", "scale=0.01");
	expect_part(outcome.out, "12 triangles, 8 nodes");
	expect_part(outcome.out, "[0, 0.2] x [0, 0.2] x [0, 0.2] m");
	assert_float_equal(number_after(outcome.out, "inside"), 8e-3, 1e-8); // printed with six digits
	outcome_free(&outcome);
}

static void voxels_fill_the_cube(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "cube.obj", "--set", "fit=0.2m", "--voxels", "5cm", "-o", "cube.vtu");
	expect_part(outcome.out, "hex8");
	expect_part(outcome.out, "scaled Jacobian: min 1 ");
	assert_true(path_exists(path_join(folder, "cube.vtu")));
	outcome_free(&outcome);
	outcome = RUN(0, "cube.vtu");
	expect_part(outcome.out, "hex8");
	outcome_free(&outcome);
}

// The corners of the cube are kept, so that its volume is.
static void tetrahedra_are_made_once_and_kept(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "cube.obj", "--set", "scale=0.01", "--tets", "5cm", "-o", "cube.msh");
	expect_part(outcome.out, "tet4");
	assert_null(strstr(outcome.out, "kept in the cache"));
	assert_float_equal(number_after(outcome.out, "filled"), 8e-3, 1e-6);
	outcome_free(&outcome);
	outcome = RUN(0, "cube.obj", "--set", "scale=0.01", "--tets", "5cm");
	expect_part(outcome.out, "kept in the cache");
	outcome_free(&outcome);
	outcome = RUN(0, "cube.msh");
	expect_part(outcome.out, "tet4");
	assert_float_equal(number_after(outcome.out, "filled"), 8e-3, 1e-6);
	outcome_free(&outcome);
}

static void ten_node_tetrahedra_are_a_key(void** state) {
	(void)state;
	Outcome outcome = RUN(0, "cube.obj", "--set", "scale=0.01", "--tets", "8cm", "--set", "tetrahedra.element=tet10");
	expect_part(outcome.out, "tet10");
	outcome_free(&outcome);
}

static void bad_input_is_refused_with_status_2(void** state) {
	(void)state;
	static const struct {
		const char* words[6];
		const char* says;
	} cases[] = {
		{{"mesh", "absent.obj"}, "absent.obj cannot be read"},
		{{"mesh", "cube.obj", "--tets", "0"}, "tetrahedra.size"},
		{{"mesh", "cube.obj", "--tets", "5 kg"}, "a length is expected"},
		{{"mesh", "cube.obj", "--set", "upp=z"}, "did you mean 'up'"},
		{{"mesh", "cube.obj", "--tetrahedra=1"}, "there is no option"},
		{{"mesh"}, "no file is given"},
		{{"mesh", "cube.obj", "-o", "cube.xyz"}, "xyz"},
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
		Outcome outcome = run(2, cases[i].words);
		expect_part(outcome.err, cases[i].says);
		outcome_free(&outcome);
	}
	assert_false(path_exists(path_join(folder, "cube.xyz")));
}

static void a_scene_takes_a_surface_from_beside_it(void** state) {
	(void)state;
	file_write(path_join(folder, "scene.yaml"),
			   "duration: 10 ms\nbodies:\n  - name: cube\n"
			   "    shape: {type: file, path: cube.obj, scale: 0.01, voxels: {size: 10 cm}}\n"
			   "    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
			   "    fix: [{where: {face: y-}}]\n"
			   "step: {dt: 5 ms}\nrecord: {plots: no}\n");
	Outcome outcome = run(0, (const char* const[]){"run", "scene.yaml", "-o", "out", NULL});
	outcome_free(&outcome);
	outcome = run(2, (const char* const[]){"check", "scene.yaml", "--set", "bodies[0].shape.voxels=null", NULL});
	expect_part(outcome.err, "holds a surface; fill it");
	outcome_free(&outcome);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_surface_is_described),
		cmocka_unit_test(voxels_fill_the_cube),
		cmocka_unit_test(tetrahedra_are_made_once_and_kept),
		cmocka_unit_test(ten_node_tetrahedra_are_a_key),
		cmocka_unit_test(bad_input_is_refused_with_status_2),
		cmocka_unit_test(a_scene_takes_a_surface_from_beside_it),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
