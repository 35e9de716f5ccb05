// What holds for every shape that is generated from mapped blocks, with each element: cells are positive and well
// shaped, match across faces, use every node, and fill the volume that the shape has.
#include "mesh/shape_case.h"

static const double pi = 3.14159265358979323846;

static const char* const shapes[] = {
	"type: sheet, size: [1, 0.5], thickness: 0.1, cells: [6, 4], layers: 2",
	"type: sheet, plane: xz, size: [1, 0.5], thickness: 0.1, cells: [6, 4]",
	"type: sheet, plane: yz, size: [1, 0.5], thickness: 0.1, cells: [6, 4]",
	"type: ball, radius: 1",
	"type: ball, radius: 1, cells: 1, rings: 1",
	"type: cylinder, radius: 1, length: 2",
	"type: cylinder, radius: 1, length: 2, axis: x, cells: [4, 1, 1]",
	"type: torus, major: 1, minor: 0.4",
	"type: torus, major: 1, minor: 0.2, axis: z, cells: [8, 1, 24]",
	"type: rope, radius: 0.06, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 1, 0]}, {at: [0, 1, 1]}]",
	"type: jello",
	"type: jello, flutes: 12, flute_depth: 0.05, cells: [60, 5, 10], rounding: 0.5",
};
enum { SHAPES = sizeof shapes / sizeof *shapes };
static const char* const elements[JN_SOLID_SHAPE_COUNT] = {
	[JN_TET4] = "tet4", [JN_TET10] = "tet10", [JN_HEX8] = "hex8"};

static void make(ShapeCase* c, int shape, int element) {
	char text[512];
	snprintf(text, sizeof text, "{%s, element: %s}", shapes[shape], elements[element]);
	shape_make(c, text);
	assert_int_equal(c->mesh.shape, element);
}

/// Do `check` for every shape and element.
static void for_all(void (*check)(const ShapeCase*, const char* name)) {
	for (int k = 0; k < SHAPES * JN_SOLID_SHAPE_COUNT; ++k) {
		ShapeCase c;
		make(&c, k / JN_SOLID_SHAPE_COUNT, k % JN_SOLID_SHAPE_COUNT);
		check(&c, shapes[k / JN_SOLID_SHAPE_COUNT]);
		shape_free(&c);
	}
}

static void check_cells(const ShapeCase* c, const char* name) {
	JnQuality quality;
	for (int cell = 0; cell < c->mesh.cell_count; ++cell)
		if (!(jn_mesh_cell_volume(&c->mesh, cell) > 0)) fail_msg("%s: cell %d is inside out", name, cell);
	assert_int_equal(jn_mesh_quality(&c->mesh, &quality), JN_OK);
	// a scaled Jacobian above 0.2 and a mean ratio above 0.15 serve all laws here; a thin cell has a small ratio by its
	// proportions alone, six to one among these
	const double least = c->mesh.shape == JN_HEX8 ? 0.2 : 0.15;
	if (!(quality.min > least)) fail_msg("%s: %s is %g, expected > %g", name, quality.measure, quality.min, least);
}

static void cells_are_positive_and_well_shaped(void** state) {
	(void)state;
	for_all(check_cells);
}

static void check_nodes(const ShapeCase* c, const char* name) {
	const JnMesh* mesh = &c->mesh;
	bool* used = calloc((size_t)mesh->node_count, sizeof *used);
	for (int k = 0; k < mesh->cell_count * jn_shape_info[mesh->shape].nodes; ++k) {
		assert_in_range(mesh->cells[k], 0, mesh->node_count - 1);
		used[mesh->cells[k]] = true;
	}
	for (int i = 0; i < mesh->node_count; ++i)
		if (!used[i]) fail_msg("%s: node %d is in no cell", name, i);
	free(used);
}

static void every_node_is_used(void** state) {
	(void)state;
	for_all(check_nodes);
}

typedef struct Edge {
	int from, to;
} Edge;

static int by_nodes(const void* left, const void* right) {
	return memcmp(left, right, sizeof(Edge));
}

// Had two neighbours cut a face differently, or not shared its nodes, it would be part of the boundary, and edges would
// be met more than once or by one side alone.
static void check_boundary(const ShapeCase* c, const char* name) {
	JnArena arena = {0};
	int count, *triangles;
	assert_int_equal(jn_mesh_boundary(&c->mesh, &arena, &count, &triangles), JN_OK);
	Edge* edges = jn_arena_take(&arena, 3 * (size_t)count, sizeof *edges);
	for (int k = 0; k < 3 * count; ++k) edges[k] = (Edge){triangles[k], triangles[k / 3 * 3 + (k + 1) % 3]};
	qsort(edges, 3 * (size_t)count, sizeof *edges, by_nodes);
	for (int k = 0; k < 3 * count; ++k) {
		const Edge back = {edges[k].to, edges[k].from};
		if (k > 0 && by_nodes(&edges[k], &edges[k - 1]) == 0) fail_msg("%s: an edge is met twice", name);
		if (bsearch(&back, edges, 3 * (size_t)count, sizeof back, by_nodes) == NULL)
			fail_msg("%s: the boundary is open at nodes %d, %d", name, back.from, back.to);
	}
	jn_arena_free(&arena);
}

static void the_boundary_is_closed_and_looks_one_way(void** state) {
	(void)state;
	for_all(check_boundary);
}

static double volume_of(const char* text) {
	ShapeCase c;
	shape_make(&c, text);
	const double volume = mesh_volume(&c.mesh);
	shape_free(&c);
	return volume;
}

static void expect_volume(const char* text, double expected, double tolerance) {
	const double volume = volume_of(text);
	if (!(fabs(volume - expected) <= tolerance * expected))
		fail_msg("%s: volume %.17g, expected %.17g", text, volume, expected);
}

static void flat_sided_shapes_have_their_exact_volume(void** state) {
	(void)state;
	const double rounding = 1e-13; // of hundreds of sums
	for (int element = 0; element < JN_SOLID_SHAPE_COUNT; ++element) {
		char text[256];
		snprintf(text, sizeof text, "{type: sheet, size: [1, 2], thickness: 1/96, cells: [5, 7], element: %s}",
				 elements[element]);
		expect_volume(text, 2.0 / 96, rounding);
		snprintf(text, sizeof text, "{type: cylinder, radius: 2, length: 3, cells: [24, 2, 2], element: %s}",
				 elements[element]);
		expect_volume(text, 3 * 24 / 2.0 * 4 * sin(2 * pi / 24), rounding); // a prism over a polygon of 24 corners
	}
}

static void volumes_of_round_shapes_converge_with_order_two(void** state) {
	(void)state;
	static const char* const texts[][2] = {
		{"{type: ball, radius: 1, cells: 4, rings: 2}", "{type: ball, radius: 1, cells: 8, rings: 4}"},
		{"{type: torus, major: 2, minor: 1, cells: [16, 2, 24]}",
		 "{type: torus, major: 2, minor: 1, cells: [32, 4, 48]}"},
	};
	const double exact[] = {4 * pi / 3, 2 * pi * pi * 2};
	for (int i = 0; i < 2; ++i) {
		const double coarse = exact[i] - volume_of(texts[i][0]), fine = exact[i] - volume_of(texts[i][1]);
		assert_true(coarse > 0); // chords lie inside
		const double order = log2(coarse / fine);
		print_message("%s: missing %g, then %g: order %.2f\n", texts[i][0], coarse, fine, order);
		assert_true(fabs(order - 2) < 0.1); // the next term of the error is h^2 smaller: 4 % at 24 chords a turn
	}
}

static void expect_set(const JnMesh* mesh, const char* name, int axis, double value) {
	const JnNodeSet* set = mesh_set(mesh, name);
	int count = 0;
	for (int i = 0; i < mesh->node_count; ++i) {
		const bool is_there = fabs(mesh->nodes[3 * i + axis] - value) < 1e-12; // rounding of coordinates near 1
		count += is_there;
		if (is_there != set_has(set, i)) fail_msg("set %s and node %d disagree", name, i);
	}
	assert_int_equal(set->count, count);
	assert_true(count > 0);
}

static void edges_of_a_sheet_have_names(void** state) {
	(void)state;
	static const int axes[3][2] = {{0, 1}, {0, 2}, {1, 2}};
	static const char* const planes[] = {"xy", "xz", "yz"};
	for (int k = 0; k < 9; ++k) {
		ShapeCase c;
		char text[256];
		snprintf(
			text, sizeof text,
			"{type: sheet, plane: %s, origin: [1, 1, 1], size: [1, 0.5], thickness: 0.1, cells: [3, 2], element: %s}",
			planes[k / 3], elements[k % 3]);
		shape_make(&c, text);
		expect_set(&c.mesh, "left", axes[k / 3][0], 1);
		expect_set(&c.mesh, "right", axes[k / 3][0], 2);
		expect_set(&c.mesh, "lower", axes[k / 3][1], 1);
		expect_set(&c.mesh, "upper", axes[k / 3][1], 1.5);
		shape_free(&c);
	}
}

static void a_turned_sheet_has_its_middle_and_corners(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: sheet, plane: xz, size: [4, 3], thickness: 1e-6, cells: [4, 3], rotate: [0, 0, 30 deg]}");
	const JnNodeSet* corners = mesh_set(&c.mesh, "corners");
	assert_int_equal(corners->count, 8);
	for (int i = 0; i < 8; ++i) { // 2 m from the middle line, turned about z: up on the right
		const double* x = c.mesh.nodes + 3 * corners->nodes[i];
		const double side = x[0] > 2 ? 1 : -1;
		assert_true(fabs(x[0] - (2 + side * 2 * cos(M_PI / 6))) < 2e-6); // the thickness
		assert_true(fabs(x[1] - side * 2 * sin(M_PI / 6)) < 2e-6);
		assert_true(fabs(x[2] * (3 - x[2])) < 1e-12);
	}
	shape_free(&c);
}

static void ends_of_a_cylinder_have_names(void** state) {
	(void)state;
	for (int axis = 0; axis < 3; ++axis) {
		ShapeCase c;
		char text[256];
		snprintf(text, sizeof text, "{type: cylinder, origin: [0.5, 0.5, 0.5], radius: 0.1, length: 2, axis: %c}",
				 'x' + axis);
		shape_make(&c, text);
		expect_set(&c.mesh, "bottom", axis, 0.5);
		expect_set(&c.mesh, "top", axis, 2.5);
		shape_free(&c);
	}
}

static void the_surface_of_a_ball_is_its_sphere(void** state) {
	(void)state;
	ShapeCase c;
	shape_make(&c, "{type: ball, center: [1, 2, 3], radius: 0.5}");
	const JnNodeSet* surface = mesh_set(&c.mesh, "surface");
	for (int i = 0; i < c.mesh.node_count; ++i) {
		const double* X = c.mesh.nodes + 3 * i;
		const double distance = hypot(hypot(X[0] - 1, X[1] - 2), X[2] - 3);
		if ((fabs(distance - 0.5) < 1e-12) != set_has(surface, i)) fail_msg("node %d at %g m", i, distance);
	}
	assert_int_equal(surface->count, 6 * 16 + 2); // quadrilaterals of a closed surface, and Euler's 2
	shape_free(&c);
}

static void numbers_that_make_no_shape_are_refused(void** state) {
	(void)state;
	shape_expect_refusal("{type: cylinder, radius: 1, length: 1, cells: [15, 1, 1]}", "use 12 or 16");
	shape_expect_refusal("{type: torus, major: 1, minor: 1}", "smaller than major");
	shape_expect_refusal("{type: torus, major: 2, minor: 1, cells: [8, 1, 2]}", "use 3 or more");
	shape_expect_refusal("{type: ball, radius: 1, cells: 512, rings: 512}", "use fewer");
	shape_expect_refusal("{type: sheet, size: [1, 1, 1], thickness: 0.1, cells: [2, 2]}", "two numbers are expected");
	shape_expect_refusal("{type: sheet, size: [1, 0], thickness: 0.1, cells: [2, 2]}", "size[1]");
	// its rounded edge is pushed through its narrow waves
	shape_expect_refusal("{type: jello, taper: 0.4, flute_depth: 0.2, rounding: 1, element: tet4}", "inside out");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(cells_are_positive_and_well_shaped),
		cmocka_unit_test(every_node_is_used),
		cmocka_unit_test(the_boundary_is_closed_and_looks_one_way),
		cmocka_unit_test(flat_sided_shapes_have_their_exact_volume),
		cmocka_unit_test(volumes_of_round_shapes_converge_with_order_two),
		cmocka_unit_test(edges_of_a_sheet_have_names),
		cmocka_unit_test(a_turned_sheet_has_its_middle_and_corners),
		cmocka_unit_test(ends_of_a_cylinder_have_names),
		cmocka_unit_test(the_surface_of_a_ball_is_its_sphere),
		cmocka_unit_test(numbers_that_make_no_shape_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
