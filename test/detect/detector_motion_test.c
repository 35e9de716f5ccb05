// Contacts of bodies that move far within a step, of bodies with themselves, of sheets, and with obstacles.
#include "detect/detector.h"

#include "detect_case.h"

static const JnDetectorOptions plain = {.threads = 1};

/// A plate 0.01 thick in the plane z = 0 and a small ball below or above it, which passes through all of it.
static void check_fast_ball(double side) {
	Case c = {0};
	const JnSurface plate = case_block(&c.arena, (double[]){-1, -1, -0.005}, (double[]){2, 2, 0.01});
	const JnSurface ball = surface_sphere(&c.arena, 0.02, 6);
	case_add(&c, &plate, (double[]){0, 0, 0});
	case_add(&c, &ball, (double[]){0.3, 0.2, side * 0.05});
	case_move(&c, 1, 0.01, 0.02, -side * 0.1); // 10 thicknesses
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.001);
	int vertices = 0;
	for (int i = 0; i < list.count; i++) {
		const JnContact* contact = &list.contacts[i];
		if (contact->vertex_skin != 1) continue;
		vertices++;
		const double start = c.start[3 * (c.first_node[1] + contact->vertex) + 2];
		assert_near("normal", contact->normal[2], side, 1e-12); // of a flat face
		assert_near("gap", contact->gap, side * start - 0.005, 1e-12);
		assert_near("gap at the end", contact->gap_end, contact->gap - 0.1, 1e-12);
		assert_near("when", contact->when, contact->gap / 0.1, 1e-12); // roundings of numbers near 1
	}
	assert_int_equal(vertices, ball.node_count); // one each
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void a_fast_ball_meets_the_near_side_of_a_thin_plate(void** unused) {
	(void)unused;
	check_fast_ball(1);
	check_fast_ball(-1);
}

/// The plate's own corners against a ball that flies over its corner: vertices against triangles the other way round.
static void a_fast_plate_corner_meets_the_ball_in_its_way(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface ball = surface_sphere(&c.arena, 0.1, 12), pin = surface_cube(&c.arena, 0, 0.01);
	case_add(&c, &ball, (double[]){0, 0, 0});
	case_add(&c, &pin, (double[]){-0.5, -0.005, -0.005});
	case_move(&c, 1, 1, 0, 0); // through all of the ball and out
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.001);
	int met = 0;
	for (int i = 0; i < list.count; i++) {
		const JnContact* contact = &list.contacts[i];
		if (contact->vertex_skin != 1) continue;
		met += contact->when > 0;
		assert_true(contact->normal[0] < -0.9); // the side it comes from: within 0.005 / 0.1 and a facet's angle
		assert_true(contact->gap > 0.38 && contact->gap_end < 0);
	}
	assert_int_equal(met, 8);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void bodies_that_part_or_miss_have_no_contact(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface cube = surface_cube(&c.arena, 0, 1);
	case_add(&c, &cube, (double[]){0, 0, 0});
	case_add(&c, &cube, (double[]){0.2, 0.2, 1.1});
	case_move(&c, 1, 0, 0, 2);
	JnDetector* detector = case_detector(&c, &plain);
	assert_int_equal(case_find(&c, detector, 0.05).count, 0);
	case_move(&c, 1, 2.5, 0, 0);
	assert_int_equal(case_find(&c, detector, 0.05).count, 0);
	case_move(&c, 1, 0, 0, -0.08); // ends within the margin
	const JnContactList list = case_find(&c, detector, 0.05);
	assert_int_equal(list.count, 2); // a corner of each is over the other
	for (int i = 0; i < list.count; i++) {
		const double towards = list.contacts[i].vertex_skin == 1 ? 1 : -1;
		assert_near("normal", list.contacts[i].normal[2], towards, 1e-12); // flat faces
		assert_near("gap", list.contacts[i].gap, 0.1, 1e-12);
		assert_near("gap at the end", list.contacts[i].gap_end, 0.02, 1e-12);
	}
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// Pairs of random tetrahedra with random motion: every vertex that is inside at the end and was outside has a contact.
static void no_vertex_gets_in_unseen(void** unused) {
	(void)unused;
	JnRandom random = {11};
	int entered = 0;
	for (int round = 0; round < 400; round++) {
		Case c = {0};
		JnSurface s = surface_new(&c.arena, 4, 4);
		memcpy(s.nodes, (double[]){0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 12 * sizeof(double));
		const int faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
		memcpy(s.triangles, faces, sizeof faces);
		case_add(&c, &s, (double[]){0, 0, 0});
		case_add(&c, &s, (double[]){1.2 * jn_random_uniform(&random), 1.2 * jn_random_uniform(&random), 0.4});
		for (int i = 0; i < 24; i++) c.start[i] += 0.1 * jn_random_uniform(&random);
		for (int i = 0; i < 24; i++) c.end[i] = c.start[i] + 0.1 * jn_random_uniform(&random);
		for (int i = 12; i < 24; i += 3) c.end[i] -= 0.5;
		JnDetector* detector = case_detector(&c, &plain);
		const JnContactList list = case_find(&c, detector, 1e-3);
		JnTriangleTree before, after;
		const JnSurface at_start = {4, c.start, 4, s.triangles}, at_end = {4, c.end, 4, s.triangles};
		assert_int_equal(jn_triangle_tree_create(&at_start, &c.arena, &before), JN_OK);
		assert_int_equal(jn_triangle_tree_create(&at_end, &c.arena, &after), JN_OK);
		for (int v = 0; v < 4; v++) {
			if (jn_triangle_tree_is_inside(&before, c.start + 12 + 3 * v)) continue;
			if (!jn_triangle_tree_is_inside(&after, c.end + 12 + 3 * v)) continue;
			entered++;
			bool is_seen = false;
			for (int i = 0; i < list.count; i++)
				is_seen |=
					list.contacts[i].vertex_skin == 1 && list.contacts[i].vertex == v && list.contacts[i].gap_end < 0;
			assert_true(is_seen);
		}
		jn_detector_destroy(detector);
		jn_arena_free(&c.arena);
	}
	print_message("%d vertices entered\n", entered);
	assert_true(entered > 50);
}

static JnContactList find_self(Case* c, const double* rest, double neighborhood, double margin, JnDetector** detector) {
	const bool self[CASE_BODIES] = {true};
	const JnDetectorOptions options = {.threads = 1, .self = self, .rest = rest, .neighborhood = neighborhood};
	*detector = case_detector(c, &options);
	return case_find(c, *detector, margin);
}

static void a_flat_sheet_does_not_touch_itself(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface sheet = case_sheet(&c.arena, 12, 1);
	case_add(&c, &sheet, (double[]){0, 0, 0});
	assert_int_equal(find_self(&c, c.start, 0.04, 0.04, &detector).count, 0); // half an edge: neighbours by vertices do
	jn_detector_destroy(detector);
	assert_int_equal(find_self(&c, c.start, 0.3, 0.3, &detector).count, 0); // several edges: by distance at rest
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// A sheet folded along its middle: the halves are parallel, 0.02 apart, and the upper one faces down.
static void fold(const Case* c, double* x, double apart) {
	for (int i = 0; i < c->node_count; i++) {
		const double along = c->start[3 * i];
		x[3 * i] = along > 0.5 ? 1 - along : along;
		x[3 * i + 2] = along > 0.5 ? apart : along < 0.5 ? 0 : apart / 2;
	}
}

static void a_folded_sheet_touches_itself(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface sheet = case_sheet(&c.arena, 12, 1);
	case_add(&c, &sheet, (double[]){0, 0, 0});
	double* rest = case_longer(&c, c.start, c.node_count);
	double* folded = case_longer(&c, c.start, c.node_count);
	fold(&c, folded, 0.02);
	memcpy(c.start, folded, 3 * (size_t)c.node_count * sizeof(double));
	memcpy(c.end, folded, 3 * (size_t)c.node_count * sizeof(double));
	const JnContactList list = find_self(&c, rest, 0.1, 0.03, &detector);
	int top = 0, bottom = 0;
	for (int i = 0; i < list.count; i++) {
		const JnContact* contact = &list.contacts[i];
		const double z = c.start[3 * contact->vertex + 2], x = c.start[3 * contact->vertex];
		if (x > 0.3) continue; // near the fold
		top += z > 0;
		bottom += z == 0;
		assert_near("gap", contact->gap, 0.02, 1e-12); // parallel halves
		assert_near("normal", contact->normal[2], z > 0 ? 1 : -1, 1e-12);
	}
	assert_int_equal(top, 4 * 13); // columns at x = 0, 1/12, 2/12, 3/12, of 13 vertices each
	assert_int_equal(bottom, 4 * 13);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// Half of a sheet that swings through the other half in one step.
static void a_sheet_that_closes_fast_touches_itself(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface sheet = case_sheet(&c.arena, 12, 1);
	case_add(&c, &sheet, (double[]){0, 0, 0});
	double* rest = case_longer(&c, c.start, c.node_count);
	double* folded = case_longer(&c, c.start, c.node_count);
	fold(&c, c.end, -0.1);
	fold(&c, folded, 0.1);
	memcpy(c.start, folded, 3 * (size_t)c.node_count * sizeof(double));
	const JnContactList list = find_self(&c, rest, 0.1, 0.01, &detector);
	int touched = 0;
	for (int i = 0; i < list.count; i++) {
		const JnContact* contact = &list.contacts[i];
		if (c.start[3 * contact->vertex] > 0.3) continue;
		touched++;
		assert_near("when", contact->when, 0.5, 1e-12); // symmetric motion
		assert_near("gap at the end", contact->gap_end, -0.1, 1e-12);
	}
	assert_int_equal(touched, 2 * 4 * 13);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// A solid plate thinner than the margin: its sides are no contacts of each other, pressed together a little or not.
static void a_thin_solid_does_not_touch_itself(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface ball = surface_sphere(&c.arena, 1, 16);
	case_add(&c, &ball, (double[]){0, 0, 0});
	for (int i = 2; i < 3 * c.node_count; i += 3) c.start[i] *= 0.05;
	double* rest = case_longer(&c, c.start, c.node_count);
	for (int i = 2; i < 3 * c.node_count; i += 3) c.start[i] *= 0.8;
	memcpy(c.end, c.start, 3 * (size_t)c.node_count * sizeof(double));
	assert_int_equal(find_self(&c, rest, 0, 0.15, &detector).count, 0);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void a_vertex_stays_on_its_side_of_a_sheet(void** unused) {
	(void)unused;
	for (int side = -1; side <= 1; side += 2) {
		Case c = {0};
		const JnSurface sheet = case_sheet(&c.arena, 4, 1), pin = surface_cube(&c.arena, -0.01, 0.02);
		case_add(&c, &sheet, (double[]){0, 0, 0});
		case_add(&c, &pin, (double[]){0.4, 0.3, side * 0.02});
		JnDetector* detector = case_detector(&c, &plain);
		const JnContactList list = case_find(&c, detector, 0.05);
		int count = 0;
		for (int i = 0; i < list.count; i++) {
			if (list.contacts[i].vertex_skin != 1) continue;
			count++;
			assert_true(list.contacts[i].gap > 0);
			assert_near("normal", list.contacts[i].normal[2], side, 1e-15); // of a flat sheet
		}
		assert_int_equal(count, 8);
		jn_detector_destroy(detector);
		jn_arena_free(&c.arena);
	}
}

static JnContactList find_obstacle(const Case* c, const JnObstacle* obstacle, double margin, JnDetector** detector) {
	JnContactList list;
	assert_int_equal(jn_detector_create(c->body_count, c->skins, 1, obstacle, &plain, detector), JN_OK);
	assert_int_equal(jn_detector_find(*detector, c->start, c->end, margin, &list), JN_OK);
	return list;
}

static void obstacles_are_met_at_rest_and_in_flight(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface cube = surface_cube(&c.arena, 0, 1);
	const JnPlaneDef floor = {.point = {0, 0, -0.01}, .normal = {0, 0, 1}};
	const JnBlockDef slab = {.center = {0.5, 0.5, -3}, .half = {5, 5, 0.01}, .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
	case_add(&c, &cube, (double[]){0, 0, 0});
	const JnObstacle at_rest = {&jn_obstacle_plane, &floor}, in_flight = {&jn_obstacle_block, &slab};
	const JnContactList resting = find_obstacle(&c, &at_rest, 0.02, &detector);
	assert_int_equal(resting.count, 4);
	for (int i = 0; i < 4; i++) {
		assert_int_equal(resting.contacts[i].other_skin, JN_OBSTACLE_SKIN);
		assert_near("gap", resting.contacts[i].gap, 0.01, 1e-15); // one rounding
	}
	jn_detector_destroy(detector);
	case_move(&c, 0, 0, 0, -8); // all of it flies past
	const JnContactList flying = find_obstacle(&c, &in_flight, 0.02, &detector);
	assert_int_equal(flying.count, 8);
	for (int i = 0; i < 8; i++) {
		const double height = c.start[3 * flying.contacts[i].vertex + 2];
		assert_near("normal", flying.contacts[i].normal[2], 1, 1e-15);
		assert_near("gap", flying.contacts[i].gap, height + 2.99, 1e-14); // roundings of numbers up to 8
		assert_near("gap at the end", flying.contacts[i].gap_end, height + 2.99 - 8, 1e-14);
	}
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// Every vertex of a ball of many triangles against a formula, through the boxes that are left out.
static void obstacle_contacts_are_those_of_all_vertices(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface ball = surface_sphere(&c.arena, 1, 20);
	const JnCapsuleDef rod = {.ends = {{1.1, -1, 0.2}, {1.1, 1, 0.1}}, .radius = 0.25};
	const JnObstacle obstacle = {&jn_obstacle_capsule, &rod};
	case_add(&c, &ball, (double[]){0, 0, 0});
	const JnContactList list = find_obstacle(&c, &obstacle, 0.05, &detector);
	int expected = 0;
	for (int v = 0; v < c.node_count; v++) {
		double normal[3];
		const double distance = jn_obstacle_distance(&obstacle, c.start + 3 * v, normal);
		if (distance > 0.05) continue;
		assert_true(expected < list.count);
		const JnContact* contact = &list.contacts[expected++];
		assert_int_equal(contact->vertex, v);
		assert_true(fabs(contact->gap - distance) < 1e-15); // roundings of a distance below 0.3
		assert_memory_equal(contact->normal, normal, sizeof normal);
	}
	print_message("%d vertices touch\n", expected);
	assert_true(expected > 10);
	assert_int_equal(list.count, expected);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void a_hollow_sphere_keeps_a_fast_body_inside(void** unused) {
	(void)unused;
	Case c = {0};
	JnDetector* detector;
	const JnSurface cube = surface_cube(&c.arena, -0.1, 0.2);
	const JnSphereDef cave = {.radius = 1, .inside = true};
	const JnObstacle obstacle = {&jn_obstacle_sphere, &cave};
	case_add(&c, &cube, (double[]){0, 0, 0});
	case_move(&c, 0, 5, 0, 0);
	const JnContactList list = find_obstacle(&c, &obstacle, 1e-4, &detector);
	assert_int_equal(list.count, 8);
	for (int i = 0; i < 8; i++) {
		assert_true(list.contacts[i].normal[0] < -0.98); // cosine of 0.14 / 1, with the margin
		assert_true(list.contacts[i].gap > 0.5 && list.contacts[i].gap_end < -3);
	}
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_fast_ball_meets_the_near_side_of_a_thin_plate),
		cmocka_unit_test(a_fast_plate_corner_meets_the_ball_in_its_way),
		cmocka_unit_test(bodies_that_part_or_miss_have_no_contact),
		cmocka_unit_test(no_vertex_gets_in_unseen),
		cmocka_unit_test(a_flat_sheet_does_not_touch_itself),
		cmocka_unit_test(a_folded_sheet_touches_itself),
		cmocka_unit_test(a_sheet_that_closes_fast_touches_itself),
		cmocka_unit_test(a_thin_solid_does_not_touch_itself),
		cmocka_unit_test(a_vertex_stays_on_its_side_of_a_sheet),
		cmocka_unit_test(obstacles_are_met_at_rest_and_in_flight),
		cmocka_unit_test(obstacle_contacts_are_those_of_all_vertices),
		cmocka_unit_test(a_hollow_sphere_keeps_a_fast_body_inside),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
