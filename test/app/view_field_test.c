// What the viewer computes: stress and energy density against the law's formulas, and the coding of saved numbers.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include <cmocka.h>

#include "math/mat3.h"
#include "model/model.h"
#include "support/support.h"
#include "view_code.c" // the command's own parts are in no library
#include "view_elastic.c"

static const double mu = 1e5 / (2 * 1.3), lambda = 1e5 * 0.3 / (1.3 * 0.4); // of E = 1e5 Pa, nu = 0.3

static void write_scene(char text[1024], const char* element, const char* end) {
	snprintf(text, 1024,
			 "name: block\nduration: 0.1 s\nbodies:\n"
			 "  - name: block\n"
			 "    shape: {type: box, size: [1, 2, 1], cells: [2, 3, 2], element: %s}\n"
			 "    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
			 "integrator: sdirk2\nstep: {controller: fixed, dt: 10 ms}\n%s",
			 element, end);
}

// The model of a scene, which knows its own rest positions.
static void open_scene(ViewElastic* elastic, const char* text) {
	JnScene* scene;
	JnSim* sim;
	assert_int_equal(jn_scene_parse("block.yaml", text, 0, NULL, &scene), JN_OK);
	assert_int_equal(jn_scene_build(scene, 1, &sim), JN_OK);
	const JnModel* model = jn_sim_model(sim);
	assert_int_equal(view_elastic_open(elastic, "block.yaml", text, model->node_count, model->rest), JN_OK);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
}

static const double F[3][3] = {{1.2, 0.1, 0}, {0, 0.9, 0.05}, {0.02, 0, 1.1}};

static double* deform(const JnModel* model) {
	double* x = calloc(3 * (size_t)model->node_count, sizeof *x);
	for (int i = 0; i < model->node_count; ++i)
		for (int a = 0; a < 3; ++a)
			for (int b = 0; b < 3; ++b) x[3 * i + a] += F[a][b] * model->rest[3 * i + b] + (b == a ? 7 : 0);
	return x;
}

// sigma = mu/J (F F^T - 1) + lambda ln J / J, of which von Mises' measure sees only the deviator of F F^T.
static double stress_by_formula(double J) {
	double square = 0, B[3][3] = {0};
	for (int i = 0; i < 27; ++i) B[i / 9][i / 3 % 3] += F[i / 9][i % 3] * F[i / 3 % 3][i % 3];
	const double mean = (B[0][0] + B[1][1] + B[2][2]) / 3;
	for (int i = 0; i < 9; ++i) square += pow(B[i / 3][i % 3] - (i % 4 == 0 ? mean : 0), 2);
	return mu / J * sqrt(1.5 * square);
}

static double energy_by_formula(double J) {
	double square = 0;
	for (int i = 0; i < 9; ++i) square += F[i / 3][i % 3] * F[i / 3][i % 3];
	return mu / 2 * (square - 3) - mu * log(J) + lambda / 2 * log(J) * log(J);
}

// Sums of a few hundred terms, each rounded to 1e-16: 1e-10 leaves room.
static void expect_all(const double* values, int count, double expected, const char* what) {
	for (int i = 0; i < count; ++i)
		if (!(fabs(values[i] - expected) <= 1e-10 * expected))
			fail_msg("%s at node %d is %.17g, expected %.17g within 1e-10 of it", what, i, values[i], expected);
}

static void a_uniform_deformation_has_the_stress_and_energy_of_its_law(void** state) {
	static const char* const shapes[] = {"hex8", "tet4", "tet10"};
	double inverse[3][3], J[3][3];
	memcpy(J, F, sizeof J);
	const double determinant = mat3_invert(J, inverse);
	(void)state;
	for (int i = 0; i < 3; ++i) {
		char text[1024];
		ViewElastic elastic;
		write_scene(text, shapes[i], "");
		open_scene(&elastic, text);
		const int count = elastic.model->node_count;
		double *x = deform(elastic.model), *values = malloc((size_t)count * sizeof *values);
		view_elastic_stress(&elastic, x, values);
		expect_all(values, count, stress_by_formula(determinant), "the stress");
		view_elastic_energy(&elastic, x, values);
		expect_all(values, count, energy_by_formula(determinant), "the energy density");
		free(values);
		free(x);
		view_elastic_close(&elastic);
	}
}

// Tetrahedra of five sizes, apart from each other, listed so that their lowest nodes jump: the model sorts them.
static void write_jumping_cells(const char* path) {
	static const int order[5] = {3, 0, 4, 1, 2};
	FILE* file = fopen(path, "w");
	assert_non_null(file);
	fputs("# vtk DataFile Version 3.0\ncells\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 20 double\n", file);
	for (int i = 0; i < 20; ++i) {
		const int cell = i / 4, corner = i % 4;
		const double size = 0.1 * (cell + 1);
		fprintf(file, "%.17g %.17g %.17g\n", cell + size * (corner == 1), size * (corner == 2), size * (corner == 3));
	}
	fputs("CELLS 5 25\n", file);
	for (int i = 0; i < 5; ++i) {
		const int first = 4 * order[i];
		fprintf(file, "4 %d %d %d %d\n", first, first + 1, first + 2, first + 3);
	}
	fputs("CELL_TYPES 5\n10 10 10 10 10\n", file);
	assert_int_equal(fclose(file), 0);
}

static void elements_in_another_order_than_the_cells_have_their_own_stress(void** state) {
	char folder[256], text[1024];
	double inverse[3][3], J[3][3], values[20];
	ViewElastic elastic;
	(void)state;
	memcpy(J, F, sizeof J);
	assert_int_equal(folder_create(folder), 0);
	const char* path = path_join(folder, "cells.vtk");
	write_jumping_cells(path);
	snprintf(text, sizeof text,
			 "name: cells\nduration: 0.1 s\nbodies:\n  - name: cells\n    shape: {type: file, path: %s}\n"
			 "    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
			 "integrator: sdirk2\nstep: {controller: fixed, dt: 10 ms}\n",
			 path);
	open_scene(&elastic, text);
	const JnModel* model = elastic.model;
	assert_int_equal(model->node_count, 20);
	assert_int_not_equal(jn_group_node(&model->groups[0], 0, 0), model->bodies[0].cells[0]); // they are sorted
	double* x = deform(model);
	view_elastic_stress(&elastic, x, values);
	expect_all(values, 20, stress_by_formula(mat3_invert(J, inverse)), "the stress");
	free(x);
	view_elastic_close(&elastic);
	folder_remove(folder);
}

static void overrides_at_the_end_of_a_recorded_scene_count(void** state) {
	char text[1024];
	ViewElastic soft, stiff;
	(void)state;
	write_scene(text, "hex8", "");
	open_scene(&soft, text);
	write_scene(text, "hex8", "# --set step.dt=1ms\n# a comment\n# --set bodies[0].material.young=2e5\n");
	const int count = soft.model->node_count;
	assert_int_equal(view_elastic_open(&stiff, "block.yaml", text, count, soft.model->rest), JN_OK);
	double *x = deform(soft.model), *one = malloc((size_t)count * sizeof *one),
		   *two = malloc((size_t)count * sizeof *two);
	view_elastic_stress(&soft, x, one);
	view_elastic_stress(&stiff, x, two);
	expect_all(two, count, 2 * one[0], "the stress with twice the modulus");
	free(x), free(one), free(two);
	view_elastic_close(&soft);
	view_elastic_close(&stiff);
}

static void another_mesh_than_the_recorded_one_is_refused(void** state) {
	char text[1024];
	ViewElastic elastic;
	double rest[3] = {0};
	(void)state;
	write_scene(text, "hex8", "");
	assert_int_equal(view_elastic_open(&elastic, "block.yaml", text, 1, rest), JN_BAD_INPUT);
	view_elastic_close(&elastic);
	log_expect("another mesh now");
}

// The reader of web/src/data/saved.ts, once more.
static void decode(const ViewBytes* bytes, int count, int parts, float* out) {
	uLongf size = (uLongf)parts * (8 + 2 * (uLongf)count);
	unsigned char* chunk = malloc(size + 1);
	assert_int_equal(uncompress(chunk, &size, (const Bytef*)bytes->data, (uLong)bytes->size), Z_OK);
	const unsigned char *low = chunk + 8 * parts, *high = low + count * parts;
	for (int part = 0; part < parts; ++part) {
		float head[2];
		unsigned code = 0;
		memcpy(head, chunk + 8 * part, sizeof head);
		for (int i = 0; i < count; ++i) {
			code = (code + low[part * count + i] + 256u * high[part * count + i]) & 0xFFFF;
			out[i * parts + part] = code == 0 ? (float)VIEW_ABSENT : head[0] + head[1] * (float)(code - 1);
		}
	}
	free(chunk);
}

static void saved_numbers_come_back_to_half_a_step(void** state) {
	enum { COUNT = 1000, PARTS = 3 };
	static float numbers[COUNT * PARTS], back[COUNT * PARTS];
	ViewBytes bytes;
	(void)state;
	for (int i = 0; i < COUNT * PARTS; ++i) numbers[i] = (float)(100 * sin(0.37 * i) * (i % PARTS) - 40);
	numbers[5] = (float)VIEW_ABSENT;
	assert_int_equal(view_code_numbers(numbers, COUNT, PARTS, &bytes), JN_OK);
	decode(&bytes, COUNT, PARTS, back);
	for (int i = 0; i < COUNT * PARTS; ++i) {
		const double step = 200.0 * (i % PARTS) / 65534; // the range over the number of codes; and rounding of floats
		if (!(fabs((double)back[i] - numbers[i]) <= 0.51 * step + 2e-5))
			fail_msg("number %d is %.9g after coding, was %.9g; half a step is %g", i, back[i], numbers[i], step / 2);
	}
	assert_true(back[5] == numbers[5]);
	free(bytes.data);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_uniform_deformation_has_the_stress_and_energy_of_its_law),
		cmocka_unit_test(elements_in_another_order_than_the_cells_have_their_own_stress),
		cmocka_unit_test(overrides_at_the_end_of_a_recorded_scene_count),
		cmocka_unit_test_setup_teardown(another_mesh_than_the_recorded_one_is_refused, log_set_up, log_tear_down),
		cmocka_unit_test(saved_numbers_come_back_to_half_a_step),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
