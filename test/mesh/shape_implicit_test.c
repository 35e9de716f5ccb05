// The duck and the beach ball: where they stand, how large they are, what they are made of.
#include "mesh/embed.h"
#include "shape_case.h"

typedef struct Box {
	double low[3], high[3];
} Box;

static Box box_of(int count, const double* nodes) {
	Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
	for (int i = 0; i < 3 * count; i++) {
		box.low[i % 3] = fmin(box.low[i % 3], nodes[i]);
		box.high[i % 3] = fmax(box.high[i % 3], nodes[i]);
	}
	return box;
}

static void expect(const char* what, double value, double expected, double tolerance) {
	print_message("%s: value %g, expected %g, tolerance %g\n", what, value, expected, tolerance);
	assert_true(fabs(value - expected) <= tolerance);
}

/// Make a toy of tetrahedra, unless there is no Gmsh.
static void make(ShapeCase* c, const char* text) {
	log_capture();
	const JnStatus status = shape_try(c, text);
	const bool is_without_gmsh = status != JN_OK && strstr(log_text(), "this needs Gmsh") != NULL;
	log_release();
	if (is_without_gmsh) {
		shape_free(c);
		skip();
	}
	assert_int_equal(status, JN_OK);
}

static void a_duck_stands_at_its_origin_and_has_its_size(void** unused) {
	(void)unused;
	ShapeCase c;
	make(&c, "{type: duck, size: 12 cm, origin: [1, 2, 3]}");
	const Box box = box_of(c.mesh.node_count, c.mesh.nodes);
	const double round = 0.004; // a third of a cell: how much of the bill's and tail's tips chords may cut off
	expect("length", box.high[0] - box.low[0], 0.12, round);
	expect("middle along x", 0.5 * (box.low[0] + box.high[0]), 1, round);
	expect("middle along z", 0.5 * (box.low[2] + box.high[2]), 3, round);
	expect("foot", box.low[1], 2, 1e-4);
	shape_free(&c);
}

static void a_duck_looks_along_x(void** unused) {
	(void)unused;
	ShapeCase c;
	make(&c, "{type: duck, size: 1}");
	const Box box = box_of(c.mesh.node_count, c.mesh.nodes);
	double head = 0;
	int count = 0;
	for (int i = 0; i < c.mesh.node_count; i++) {
		if (c.mesh.nodes[3 * i + 1] < 0.75 * box.high[1]) continue;
		head += c.mesh.nodes[3 * i];
		count++;
	}
	assert_true(count > 20);
	assert_true(head / count > 0.1); // the head is in front of the middle
	shape_free(&c);
}

static void a_duck_has_sound_cells(void** unused) {
	(void)unused;
	ShapeCase c;
	JnQuality quality;
	make(&c, "{type: duck, size: 1}");
	for (int cell = 0; cell < c.mesh.cell_count; cell++) assert_true(jn_mesh_cell_volume(&c.mesh, cell) > 0);
	assert_int_equal(jn_mesh_quality(&c.mesh, &quality), JN_OK);
	print_message("%d nodes, %d cells, %s min %.3f median %.3f\n", c.mesh.node_count, c.mesh.cell_count,
				  quality.measure, quality.min, quality.median);
	assert_true(c.mesh.cell_count > 2000 && c.mesh.cell_count < 10000);
	assert_true(quality.min > 0.1 && quality.median > 0.7);
	shape_free(&c);
}

static void smaller_cells_give_more_of_them(void** unused) {
	(void)unused;
	ShapeCase coarse, fine;
	make(&coarse, "{type: duck, size: 1, cell: 10 cm}");
	make(&fine, "{type: duck, size: 1, cell: 5 cm}");
	const double ratio = (double)fine.mesh.cell_count / coarse.mesh.cell_count;
	assert_true(ratio > 5 && ratio < 12); // 8 for the same shape
	// the beak and the wings become rounder
	expect("volume", mesh_volume(&coarse.mesh) / mesh_volume(&fine.mesh), 1, 0.05);
	shape_free(&coarse);
	shape_free(&fine);
}

static void a_beach_ball_is_a_sphere_with_grooves(void** unused) {
	(void)unused;
	ShapeCase c;
	make(&c, "{type: beach_ball, size: 50 cm, cell: 25 mm}");
	const Box box = box_of(c.mesh.node_count, c.mesh.nodes);
	expect("height", box.high[1] - box.low[1], 0.5, 0.005); // chords of 25 mm lie 0.3 mm inside, at each end
	expect("foot", box.low[1], 0, 0.0025);
	const double sphere = M_PI / 6 * 0.125, volume = mesh_volume(&c.mesh);
	assert_true(volume < 0.985 * sphere && volume > 0.93 * sphere); // the grooves take some 2 %, chords 1 %
	double shallow = INFINITY;                                      // of outer nodes: the bottom of a groove
	int count, *faces;
	assert_int_equal(jn_mesh_boundary(&c.mesh, &c.arena, &count, &faces), JN_OK);
	for (int i = 0; i < 3 * count; i++) {
		const double* x = c.mesh.nodes + 3 * faces[i];
		shallow = fmin(shallow, hypot(hypot(x[0], x[2]), x[1] - 0.25));
	}
	expect("radius in a groove", shallow, 0.25 - 0.011, 0.002); // depth 0.022 of the diameter
	shape_free(&c);
}

static void toys_of_voxels_carry_a_finer_surface(void** unused) {
	(void)unused;
	ShapeCase c;
	shape_make(&c, "{type: duck, size: 1, cell: 10 cm, mesh: voxels}");
	assert_int_equal(c.mesh.shape, JN_HEX8);
	assert_non_null(c.mesh.embedding);
	assert_true(c.mesh.embedding->surface.triangle_count > c.mesh.cell_count);
	assert_true(mesh_volume(&c.mesh) > jn_surface_volume(&c.mesh.embedding->surface)); // cubes hold all of it
	shape_free(&c);
}

// Half a turn about y leaves the middle of the box where it is, and the beak at the other end.
static void a_turned_duck_looks_elsewhere(void** unused) {
	(void)unused;
	ShapeCase c, turned;
	shape_make(&c, "{type: duck, size: 1, cell: 10 cm, mesh: voxels, origin: [1, 2, 3]}");
	shape_make(&turned, "{type: duck, size: 1, cell: 10 cm, mesh: voxels, origin: [1, 2, 3], rotate: [0, 180 deg, 0]}");
	for (int i = 0; i < 3 * c.mesh.node_count; i++) {
		const double x = c.mesh.nodes[i], expected = i % 3 == 0 ? 2 - x : i % 3 == 2 ? 6 - x : x;
		assert_true(fabs(turned.mesh.nodes[i] - expected) < 1e-12);
	}
	const JnSurface *straight = &c.mesh.embedding->surface, *other = &turned.mesh.embedding->surface;
	for (int i = 0; i < straight->node_count; i++)
		assert_true(fabs(straight->nodes[3 * i] + other->nodes[3 * i] - 2) < 1e-12);
	shape_free(&c);
	shape_free(&turned);
}

static void cells_of_senseless_size_are_refused(void** unused) {
	(void)unused;
	shape_expect_refusal("{type: duck, size: 1, cell: 0.1 mm}", "ask for larger ones");
	shape_expect_refusal("{type: beach_ball, size: 1, cell: 5 m}", "shape.cell: 5 m is too large for a toy of 1 m");
	shape_expect_refusal("{type: duck}", "size");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_duck_stands_at_its_origin_and_has_its_size),
		cmocka_unit_test(a_duck_looks_along_x),
		cmocka_unit_test(a_duck_has_sound_cells),
		cmocka_unit_test(smaller_cells_give_more_of_them),
		cmocka_unit_test(a_beach_ball_is_a_sphere_with_grooves),
		cmocka_unit_test(toys_of_voxels_carry_a_finer_surface),
		cmocka_unit_test(a_turned_duck_looks_elsewhere),
		cmocka_unit_test(cells_of_senseless_size_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
