// Whole sheets: forces and energies of the laws of cloth against what is computed by hand, and what they refuse.
#include "base/key.h"
#include "constraint_sample.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

/// A sheet of 0.6 m x 0.4 m in the plane of x and y, and its groups by a law with these keys.
typedef struct Sheet {
	JnArena arena;
	JnMesh mesh;
	JnGroups groups;
	double* x;
} Sheet;

static const JnRow* row_of(const JnRowList* list, const char* name) {
	const JnRow* row = jn_row_find(list, name);
	assert_non_null(row);
	return row;
}

static void* field_of(const JnRow* row, void* options, const char* name) {
	for (const JnKey* key = row->keys; key->name != NULL; ++key)
		if (strcmp(key->name, name) == 0) return (char*)options + key->field;
	fail_msg("%s has no key '%s'", row->name, name);
	return NULL;
}

static void set_pair(const JnRow* row, void* options, const char* name, double u, double v) {
	double* pair = field_of(row, options, name);
	pair[0] = u;
	pair[1] = v;
}

static void make_mesh(Sheet* s, int cells_u, int cells_v) {
	double options[32] = {0};
	const JnRow* row = row_of(&jn_shape_list, "cloth");
	assert_true(row->options_size <= sizeof options);
	set_pair(row, options, "size", 0.6, 0.4);
	int* cells = field_of(row, options, "cells");
	cells[0] = cells_u;
	cells[1] = cells_v;
	assert_int_equal(((const JnShapeType*)row)->generate(options, "shape", &s->arena, &s->mesh), JN_OK);
	s->x = jn_arena_take(&s->arena, 3 * (size_t)s->mesh.node_count, sizeof(double));
	memcpy(s->x, s->mesh.nodes, 3 * (size_t)s->mesh.node_count * sizeof(double));
}

static const double STRETCH[2] = {300, 200}, SHEAR = 40, BEND[2] = {3e-3, 2e-3};

static JnStatus build(Sheet* s, const char* law, double bend_u, double bend_v, const double grain[3]) {
	double options[32] = {0};
	const JnRow* row = row_of(&jn_law_list, law);
	assert_true(row->options_size <= sizeof options);
	*(double*)field_of(row, options, "density") = 0.2;
	memcpy(field_of(row, options, "grain"), grain, 3 * sizeof(double));
	set_pair(row, options, "stretch", STRETCH[0], STRETCH[1]);
	*(double*)field_of(row, options, "shear") = SHEAR;
	set_pair(row, options, "bend", bend_u, bend_v);
	const JnLaw* chosen = (const JnLaw*)row;
	return chosen->build(chosen, options, &s->mesh, 0, "bodies[0]", &s->arena, &s->groups);
}

static const double NO_GRAIN[3] = {NAN, NAN, NAN}, GRAIN_Y[3] = {0, 1, 0};

static Sheet sheet(const char* law, int cells_u, int cells_v) {
	Sheet s = {0};
	make_mesh(&s, cells_u, cells_v);
	assert_int_equal(build(&s, law, BEND[0], BEND[1], NO_GRAIN), JN_OK);
	return s;
}

static double energy_of(const Sheet* s, int group) {
	const JnGroup* g = &s->groups.list[group];
	double* lanes = malloc((size_t)g->batches * (size_t)g->kernel->width * sizeof *lanes);
	double sum = 0;
	g->kernel->energy(g, 0, g->batches, s->x, lanes);
	for (int e = 0; e < g->count; ++e) sum += lanes[e];
	free(lanes);
	return sum;
}

static double energy(const Sheet* s) {
	double sum = 0;
	for (int g = 0; g < s->groups.count; ++g) sum += energy_of(s, g);
	return sum;
}

/// f += forces of all groups at x.
static void add_forces(const Sheet* s, double* f) {
	for (int g = 0; g < s->groups.count; ++g) {
		const JnGroup* group = &s->groups.list[g];
		const int width = group->kernel->width, nodes = group->kernel->nodes;
		double* lanes = malloc((size_t)group->batches * 3 * (size_t)nodes * (size_t)width * sizeof *lanes);
		group->kernel->force(group, 0, group->batches, s->x, lanes);
		for (int k = 0; k < group->count * nodes; ++k) {
			const int batch = k / nodes / width, lane = k / nodes % width, i = k % nodes;
			const int node = group->nodes[(batch * nodes + i) * width + lane];
			for (int a = 0; a < 3; ++a) f[3 * node + a] += lanes[((batch * nodes + i) * 3 + a) * width + lane];
		}
		free(lanes);
	}
}

static void expect(double value, double expected, double tolerance, const char* what) {
	print_message("%s: %.10g, expected %.10g, tolerance %.2g\n", what, value, expected, tolerance);
	assert_true(fabs(value - expected) <= tolerance);
}

static double force_at(const Sheet* s, int axis, double X) {
	double sum = 0, *f = calloc(3 * (size_t)s->mesh.node_count, sizeof *f);
	add_forces(s, f);
	for (int i = 0; i < s->mesh.node_count; ++i)
		if (fabs(s->mesh.nodes[3 * i + axis] - X) < 1e-9) sum += f[3 * i + axis];
	free(f);
	return sum;
}

static double largest_inside(const Sheet* s) {
	double most = 0, *f = calloc(3 * (size_t)s->mesh.node_count, sizeof *f);
	add_forces(s, f);
	for (int i = 0; i < s->mesh.node_count; ++i) {
		const double* X = s->mesh.nodes + 3 * i;
		if (X[0] > 1e-9 && X[0] < 0.6 - 1e-9 && X[1] > 1e-9 && X[1] < 0.4 - 1e-9)
			most = fmax(most, largest(f + 3 * i, 3));
	}
	free(f);
	return most;
}

static void stretch_along(Sheet* s, int axis, double factor) {
	for (int i = 0; i < s->mesh.node_count; ++i) s->x[3 * i + axis] *= factor;
}

// 10 % along an axis pull k width 0.1 at either end, by hand; nothing inside.
static void a_stretched_membrane_pulls_stiffness_times_width_times_strain(void** unused) {
	(void)unused;
	for (int axis = 0; axis < 2; ++axis) {
		Sheet s = sheet("membrane", 6, 4);
		stretch_along(&s, axis, 1.1);
		const double width = axis == 0 ? 0.4 : 0.6, end = axis == 0 ? 0.6 : 0.4;
		expect(force_at(&s, axis, end), -STRETCH[axis] * width * 0.1, 1e-12, "force at the end [N]");
		expect(largest_inside(&s), 0, 1e-12, "force inside [N]");
		expect(energy(&s), 0.5 * STRETCH[axis] * 0.01 * 0.24, 1e-12, "energy [J]");
		jn_arena_free(&s.arena);
	}
}

// x += g y: w_u . w_v = g, and |w_v| = sqrt(1 + g^2).
static void a_sheared_membrane_has_the_energy_of_its_shear(void** unused) {
	(void)unused;
	Sheet s = sheet("membrane", 6, 4);
	const double g = 0.2, longer = sqrt(1 + g * g) - 1;
	for (int i = 0; i < s.mesh.node_count; ++i) s.x[3 * i] += g * s.mesh.nodes[3 * i + 1];
	expect(energy(&s), 0.24 * (0.5 * SHEAR * g * g + 0.5 * STRETCH[1] * longer * longer), 1e-12, "energy [J]");
	expect(largest_inside(&s), 0, 1e-12, "force inside [N]");
	jn_arena_free(&s.arena);
}

static void grain_turns_the_threads(void** unused) {
	(void)unused;
	Sheet s = {0};
	make_mesh(&s, 6, 4);
	assert_int_equal(build(&s, "membrane", BEND[0], BEND[1], GRAIN_Y), JN_OK);
	stretch_along(&s, 0, 1.1);
	expect(force_at(&s, 0, 0.6), -STRETCH[1] * 0.4 * 0.1, 1e-12, "force along v [N]");
	jn_arena_free(&s.arena);
}

static void a_sheet_at_rest_has_no_energy_and_no_force(void** unused) {
	(void)unused;
	static const char* const laws[] = {"membrane", "mass_spring"};
	for (int law = 0; law < 2; ++law) {
		Sheet s = sheet(laws[law], 5, 7);
		assert_int_equal(s.groups.count, 3);
		expect(energy(&s), 0, 1e-25, "energy [J]"); // squares of rounding
		expect(fmax(largest_inside(&s), fabs(force_at(&s, 0, 0.6))), 0, 1e-12, "force [N]");
		jn_arena_free(&s.arena);
	}
}

/// Roll the sheet up along a direction of its plane, without stretch: X . d = R phi.
static void roll(Sheet* s, double angle, double radius) {
	const double d[2] = {cos(angle), sin(angle)};
	for (int i = 0; i < s->mesh.node_count; ++i) {
		const double* X = s->mesh.nodes + 3 * i;
		const double along = X[0] * d[0] + X[1] * d[1], across = -X[0] * d[1] + X[1] * d[0];
		const double u = radius * sin(along / radius);
		s->x[3 * i] = u * d[0] - across * d[1];
		s->x[3 * i + 1] = u * d[1] + across * d[0];
		s->x[3 * i + 2] = radius * (1 - cos(along / radius));
	}
}

// A roll of curvature 1/R has B/2 /R^2 an area. Hinges see it but for those of the rim, a share of h/size.
static void a_rolled_membrane_has_the_energy_of_a_thin_plate(void** unused) {
	(void)unused;
	static const double degrees[] = {0, 90, 45, 30};
	for (int k = 0; k < 4; ++k) {
		const double angle = degrees[k] * 3.14159265358979 / 180;
		double value[2];
		for (int finer = 0; finer < 2; ++finer) {
			Sheet s = {0};
			make_mesh(&s, 60 << finer, 40 << finer);
			assert_int_equal(build(&s, "membrane", 2e-3, 2e-3, NO_GRAIN), JN_OK);
			roll(&s, angle, 1);
			value[finer] = energy_of(&s, 2);
			jn_arena_free(&s.arena);
		}
		// the rim's share halves from mesh to mesh; what is left is of second order in h/R = 0.01
		expect(2 * value[1] - value[0], 0.5 * 2e-3 * 0.24, 1e-3 * 0.5 * 2e-3 * 0.24, "energy of the roll [J]");
	}
}

static void threads_have_bending_stiffnesses_of_their_own(void** unused) {
	(void)unused;
	for (int axis = 0; axis < 2; ++axis) {
		Sheet s = sheet("membrane", 60, 40);
		roll(&s, axis * 3.14159265358979 / 2, 1);
		const double inside = axis == 0 ? 59.0 / 60 : 39.0 / 40; // hinges between the rims
		const double expected = 0.5 * BEND[axis] * 0.24 * inside;
		expect(energy_of(&s, 2), expected, 1e-3 * expected, "energy of the roll [J]"); // (h/R)^2 and chords
		jn_arena_free(&s.arena);
	}
}

// A small strain e along u: structural springs k_u e^2/2, two diagonals of half the strain and of 2 k_s each, together k_s e^2/2,
// and bend springs k_b e^2/2 on their own area, 5 of 6 cells in each row.
static void a_stretched_sheet_of_springs_has_the_energy_of_each_kind(void** unused) {
	(void)unused;
	Sheet s = sheet("mass_spring", 6, 4);
	const double e = 1e-6;
	stretch_along(&s, 0, 1 + e);
	const double expected = 0.5 * e * e * ((STRETCH[0] + SHEAR) * 0.24 + BEND[0] * 0.24 * 5 / 6);
	expect(energy(&s), expected, 1e-5 * expected, "energy [J]"); // the diagonals' next term is of the order of e
	jn_arena_free(&s.arena);
}

static void springs_are_those_of_provot(void** unused) {
	(void)unused;
	Sheet s = sheet("mass_spring", 6, 4); // 7 x 5 nodes
	assert_int_equal(s.groups.list[0].count, 6 * 5 + 7 * 4);
	assert_int_equal(s.groups.list[1].count, 2 * 6 * 4);
	assert_int_equal(s.groups.list[2].count, 5 * 5 + 7 * 3);
	jn_arena_free(&s.arena);
}

static void expect_refusal(Sheet* s, const char* const words[]) {
	static const char* const laws[] = {"membrane", "mass_spring"};
	for (int law = 0; law < 2; ++law) {
		log_capture();
		assert_int_equal(build(s, laws[law], 0, 0, NO_GRAIN), JN_BAD_INPUT);
		for (int i = 0; words[i] != NULL; ++i)
			if (strstr(log_text(), words[i]) == NULL) fail_msg("no '%s' in: %s", words[i], log_text());
		log_release();
	}
}

#define EXPECT_REFUSAL(sheet, ...) expect_refusal(sheet, (const char* const[]){__VA_ARGS__, NULL})

static void cloth_laws_refuse_solids(void** unused) {
	(void)unused;
	Sheet s = {0};
	const JnBoxDef box = {.size = {1, 1, 1}, .cells = {1, 1, 1}, .element = JN_HEX8};
	assert_int_equal(jn_generate_box(&box, &s.arena, &s.mesh), JN_OK);
	EXPECT_REFUSAL(&s, "bodies[0].material.law", "hex8", "type: cloth");
	jn_arena_free(&s.arena);
}

static void flat_triangles_and_edges_of_three_are_refused(void** unused) {
	(void)unused;
	Sheet s = {0};
	make_mesh(&s, 2, 1);
	memcpy(s.mesh.nodes + 3, s.mesh.nodes, 3 * sizeof(double));
	EXPECT_REFUSAL(&s, "bodies[0]", "area 0", "must be > 0");
	jn_arena_free(&s.arena);
	s = (Sheet){0};
	make_mesh(&s, 1, 1);
	s.mesh.cells[3] = s.mesh.cells[0]; // the second triangle becomes the first
	s.mesh.cells[4] = s.mesh.cells[1];
	s.mesh.cells[5] = s.mesh.cells[2];
	EXPECT_REFUSAL(&s, "two triangles on one side of the edge between its nodes 0 and 1");
	jn_arena_free(&s.arena);
}

static void a_grain_across_the_sheet_is_refused(void** unused) {
	(void)unused;
	Sheet s = {0};
	make_mesh(&s, 2, 2);
	log_capture();
	assert_int_equal(build(&s, "membrane", 0, 0, (const double[]){0, 0, 1}), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "material.grain"));
	log_release();
	jn_arena_free(&s.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_stretched_membrane_pulls_stiffness_times_width_times_strain),
		cmocka_unit_test(a_sheared_membrane_has_the_energy_of_its_shear),
		cmocka_unit_test(grain_turns_the_threads),
		cmocka_unit_test(a_sheet_at_rest_has_no_energy_and_no_force),
		cmocka_unit_test(a_rolled_membrane_has_the_energy_of_a_thin_plate),
		cmocka_unit_test(threads_have_bending_stiffnesses_of_their_own),
		cmocka_unit_test(a_stretched_sheet_of_springs_has_the_energy_of_each_kind),
		cmocka_unit_test(springs_are_those_of_provot),
		cmocka_unit_test(cloth_laws_refuse_solids),
		cmocka_unit_test(flat_triangles_and_edges_of_three_are_refused),
		cmocka_unit_test(a_grain_across_the_sheet_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
