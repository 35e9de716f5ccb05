// Contacts of bodies that hardly move: gaps and normals against looking at everything, counts of candidates, threads,
// exchange of bodies, deep overlaps, corners, triangles without area.
#include "detect/detector.h"

#include "detect_case.h"
#include "mesh/triangle_tree.h"

static const JnDetectorOptions plain = {.threads = 1};

static void move_to(Case* c, int body, double x, double y, double z) {
	const double by[3] = {x, y, z};
	for (int i = 3 * c->first_node[body]; i < 3 * c->first_node[body + 1]; i++) c->end[i] = c->start[i] += by[i % 3];
}

static JnTriangleTree static_tree(Case* c, int body, JnSurface* s) {
	JnTriangleTree tree;
	*s = (JnSurface){c->skins[body].vertex_count, c->start + 3 * c->first_node[body], c->skins[body].triangle_count,
					 NULL};
	s->triangles = jn_arena_take(&c->arena, 3 * (size_t)s->triangle_count, sizeof(int));
	memcpy(s->triangles, c->skins[body].triangles, 3 * (size_t)s->triangle_count * sizeof(int));
	assert_int_equal(jn_triangle_tree_create(s, &c->arena, &tree), JN_OK);
	return tree;
}

/// The smallest gap of the contacts of a vertex with a skin; INFINITY when there is none.
static double least_gap(const JnContactList* list, int skin, int vertex, int other) {
	double least = INFINITY;
	for (int i = 0; i < list->count; i++) {
		const JnContact* contact = &list->contacts[i];
		if (contact->vertex_skin == skin && contact->vertex == vertex && contact->other_skin == other)
			least = fmin(least, contact->gap);
	}
	return least;
}

/// Each vertex inside, or within the margin, has the signed distance as its gap; the others have no contact.
static void check_gaps(Case* c, const JnContactList* list, int skin, int other, double margin) {
	JnSurface surface;
	const JnTriangleTree tree = static_tree(c, other, &surface);
	int contacts = 0;
	for (int v = 0; v < c->skins[skin].vertex_count; v++) {
		const double* p = c->start + 3 * (c->first_node[skin] + v);
		const bool inside = jn_triangle_tree_is_inside(&tree, p);
		const double distance = jn_triangle_tree_nearest(&tree, p).distance, gap = least_gap(list, skin, v, other);
		if (!inside && distance > margin) assert_true(gap == INFINITY);
		if (!inside && distance > margin) continue;
		contacts++;
		assert_true(fabs(gap - (inside ? -distance : distance)) < 1e-14); // roundings of numbers near 1
	}
	print_message("%d vertices of skin %d touch\n", contacts, skin);
	assert_true(contacts > 0);
}

static void check_shape(const JnContactList* list) {
	for (int i = 0; i < list->count; i++) {
		const JnContact* contact = &list->contacts[i];
		assert_true(fabs(vec3_length(contact->normal) - 1) < 1e-14); // roundings of a unit vector
		assert_true(contact->weights[0] >= 0 && contact->weights[1] >= 0 && contact->weights[2] >= 0);
		// three roundings
		assert_true(fabs(contact->weights[0] + contact->weights[1] + contact->weights[2] - 1) < 1e-15);
		if (i == 0) continue;
		const JnContact* before = contact - 1;
		assert_true(before->vertex_skin <= contact->vertex_skin);
		if (before->vertex_skin == contact->vertex_skin) assert_true(before->vertex <= contact->vertex);
	}
}

static void gaps_of_overlapping_spheres_are_those_of_a_search_over_everything(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface sphere = surface_sphere(&c.arena, 1, 12);
	case_add(&c, &sphere, (double[]){0, 0, 0});
	case_add(&c, &sphere, (double[]){1.31, 0.83, 0.77});
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.02);
	check_shape(&list);
	check_gaps(&c, &list, 0, 1, 0.02);
	check_gaps(&c, &list, 1, 0, 0.02);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// Turned blocks overlapping by much: vertices far deeper than the margin are found, with the nearest surface.
static void gaps_of_deep_overlaps_are_those_of_the_nearest_surface(void** unused) {
	(void)unused;
	Case c = {0};
	JnSurface cube = surface_cube(&c.arena, -1, 2);
	case_add(&c, &cube, (double[]){0, 0, 0});
	for (int i = 0; i < cube.node_count; i++) {
		double* x = cube.nodes + 3 * i;
		const double turned[2] = {0.8 * x[0] - 0.6 * x[1], 0.6 * x[0] + 0.8 * x[1]};
		memcpy(x, turned, sizeof turned);
	}
	case_add(&c, &cube, (double[]){1.21, 0.3, 0.9});
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.001);
	check_shape(&list);
	check_gaps(&c, &list, 0, 1, 0.001);
	check_gaps(&c, &list, 1, 0, 0.001);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// The normal is the slope of the signed distance: moving along it by h changes the distance by h.
static void normals_are_slopes_of_the_signed_distance(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface sphere = surface_sphere(&c.arena, 1, 10);
	case_add(&c, &sphere, (double[]){0, 0, 0});
	case_add(&c, &sphere, (double[]){1.2, 0.93, 0.91});
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.05);
	JnSurface surfaces[2];
	const JnTriangleTree trees[2] = {static_tree(&c, 0, &surfaces[0]), static_tree(&c, 1, &surfaces[1])};
	for (int i = 0; i < list.count; i++) {
		const JnContact* contact = &list.contacts[i];
		const JnTriangleTree* tree = &trees[contact->other_skin];
		const double* p = c.start + 3 * (c.first_node[contact->vertex_skin] + contact->vertex);
		double ahead[3];
		if (fabs(contact->gap) < 1e-4) continue; // the point ahead may be on the other side
		for (int a = 0; a < 3; a++) ahead[a] = p[a] + (contact->gap > 0 ? -1e-5 : 1e-5) * contact->normal[a];
		const double change = fabs(contact->gap) - jn_triangle_tree_nearest(tree, ahead).distance;
		assert_true(fabs(change - 1e-5) <
					1e-13); // towards the nearest point it stays the nearest; roundings of numbers near 1
	}
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void candidates_are_all_pairs_whose_boxes_touch(void** unused) {
	(void)unused;
	Case c = {0};
	const double margin = 0.03;
	const JnSurface sphere = surface_sphere(&c.arena, 1, 9);
	case_add(&c, &sphere, (double[]){0, 0, 0});
	case_add(&c, &sphere, (double[]){1.2, 0.83, 0.71});
	case_move(&c, 1, -0.1, 0.05, 0.02);
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, margin);
	int64_t touching = 0;
	for (int s = 0; s < 2; s++) {
		const JnSkin *mine = &c.skins[s], *other = &c.skins[1 - s];
		const JnSkinMotion own = {c.start + 3 * c.first_node[s], c.end + 3 * c.first_node[s], margin};
		const JnSkinMotion its = {c.start + 3 * c.first_node[1 - s], c.end + 3 * c.first_node[1 - s], margin};
		for (int v = 0; v < mine->vertex_count; v++)
			for (int t = 0; t < other->triangle_count; t++) {
				const JnTreeBox a = jn_motion_vertex_box(&own, v), b = jn_motion_triangle_box(other, &its, t);
				touching += jn_boxes_touch(&a, &b);
			}
	}
	print_message("%lld of %lld pairs\n", (long long)touching, (long long)list.counts.pairs);
	assert_int_equal(list.counts.candidates, touching);
	assert_int_equal(list.counts.pairs, 2 * (int64_t)sphere.node_count * sphere.triangle_count);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void contacts_are_the_same_for_any_number_of_threads(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface sphere = surface_sphere(&c.arena, 1, 40);
	case_add(&c, &sphere, (double[]){0, 0, 0});
	case_add(&c, &sphere, (double[]){1.5, 0.83, 0.71});
	case_add(&c, &sphere, (double[]){-1.5, 0.9, 0.7});
	case_move(&c, 1, -0.1, 0, 0);
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList one = case_find(&c, detector, 0.02);
	assert_true(one.count > 100);
	for (int threads = 2; threads <= 4; threads += 2) {
		JnDetector* other = case_detector(&c, &(JnDetectorOptions){.threads = threads});
		for (int repeat = 0; repeat < 3; repeat++) {
			const JnContactList many = case_find(&c, other, 0.02);
			assert_int_equal(many.count, one.count);
			assert_int_equal(many.counts.candidates, one.counts.candidates);
			assert_same_contacts(many.contacts, one.contacts, one.count);
		}
		jn_detector_destroy(other);
	}
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void the_age_of_a_tree_does_not_show_in_the_contacts(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface sphere = surface_sphere(&c.arena, 1, 15);
	case_add(&c, &sphere, (double[]){0, 0, 0});
	case_add(&c, &sphere, (double[]){1.5, 0.83, 0.71});
	JnDetector* old = case_detector(&c, &plain);
	case_find(&c, old, 0.02);
	for (int i = 0; i < c.node_count; i++) { // wring the first one
		double* x = c.start + 3 * i;
		if (i < c.first_node[1]) x[0] += 0.3 * x[2] * x[2];
		for (int a = 0; a < 3; a++) c.end[3 * i + a] = x[a];
	}
	JnDetector* new = case_detector(&c, &plain);
	const JnContactList refitted = case_find(&c, old, 0.02), built = case_find(&c, new, 0.02);
	assert_int_equal(refitted.counts.rebuilt, 0);
	assert_int_equal(built.counts.rebuilt, 2);
	assert_int_equal(refitted.count, built.count);
	assert_true(built.count > 20);
	assert_same_contacts(refitted.contacts, built.contacts, built.count);
	jn_detector_destroy(old);
	jn_detector_destroy(new);
	jn_arena_free(&c.arena);
}

static void exchanging_two_bodies_exchanges_their_contacts(void** unused) {
	(void)unused;
	Case a = {0}, b = {0};
	const JnSurface sphere = surface_sphere(&a.arena, 1, 11), cube = surface_cube(&a.arena, -1, 2);
	const double here[3] = {0, 0, 0}, there[3] = {1.6, 0.9, 0.8};
	case_add(&a, &sphere, here);
	case_add(&a, &cube, there);
	case_add(&b, &cube, there);
	case_add(&b, &sphere, here);
	JnDetector *one = case_detector(&a, &plain), *other = case_detector(&b, &plain);
	const JnContactList first = case_find(&a, one, 0.05), second = case_find(&b, other, 0.05);
	assert_int_equal(first.count, second.count);
	int split = 0; // contacts of the first body's vertices come first
	while (split < first.count && first.contacts[split].vertex_skin == 0) split++;
	assert_true(split > 0 && split < first.count);
	for (int i = 0; i < first.count; i++) {
		JnContact expected = second.contacts[(i + first.count - split) % first.count];
		expected.vertex_skin = 1 - expected.vertex_skin;
		expected.other_skin = 1 - expected.other_skin;
		assert_memory_equal(&first.contacts[i], &expected, sizeof expected);
	}
	jn_detector_destroy(one);
	jn_detector_destroy(other);
	jn_arena_free(&a.arena);
	jn_arena_free(&b.arena);
}

/// A small cube in the corner of three slabs that are one body.
static void a_corner_gives_a_contact_for_each_of_its_walls(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface x = case_block(&c.arena, (double[]){-1, 0, 0}, (double[]){1, 5, 5});
	const JnSurface y = case_block(&c.arena, (double[]){-1, -1, 0}, (double[]){6, 1, 5});
	const JnSurface z = case_block(&c.arena, (double[]){-1, -1, -1}, (double[]){6, 6, 1});
	const JnSurface two = surface_join(&c.arena, &x, &y, 0), walls = surface_join(&c.arena, &two, &z, 0);
	const JnSurface cube = surface_cube(&c.arena, 0.01, 1);
	case_add(&c, &cube, (double[]){0, 0, 0});
	case_add(&c, &walls, (double[]){0, 0, 0});
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.02);
	int walls_met[3] = {0}, count = 0;
	for (int i = 0; i < list.count; i++) {
		const JnContact* contact = &list.contacts[i];
		if (contact->vertex_skin != 0 || contact->vertex != 0) continue;
		count++;
		for (int a = 0; a < 3; a++) walls_met[a] += contact->normal[a] == 1;
		assert_true(fabs(contact->gap - 0.01) < 1e-15); // one rounding of numbers near 1
	}
	assert_int_equal(count, 3);
	for (int a = 0; a < 3; a++) assert_int_equal(walls_met[a], 1);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// Above a face but near an edge of a block, the other face at that edge is no further contact.
static void near_a_convex_edge_there_is_one_contact(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface block = case_block(&c.arena, (double[]){0, 0, -1}, (double[]){1, 1, 1});
	JnSurface pin = surface_cube(&c.arena, 0, 0.5); // one corner comes near
	case_add(&c, &block, (double[]){0, 0, 0});
	case_add(&c, &pin, (double[]){0.999, 0.4, 0.001});
	JnDetector* detector = case_detector(&c, &plain);
	const JnContactList list = case_find(&c, detector, 0.01);
	int count = 0;
	for (int i = 0; i < list.count; i++) count += list.contacts[i].vertex_skin == 1 && list.contacts[i].vertex == 0;
	assert_int_equal(count, 1);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

/// Needles and points among the triangles of both bodies, which also touch exactly.
static void triangles_without_area_give_no_nan_and_change_no_gap(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface cube = surface_cube(&c.arena, 0, 1);
	JnSurface odd = surface_new(&c.arena, 9, 15); // a cube, a point, a needle, and one triangle twice
	memcpy(odd.nodes, cube.nodes, 24 * sizeof(double));
	memcpy(odd.nodes + 24, (double[]){0.5, 0, 0}, 3 * sizeof(double));
	memcpy(odd.triangles, cube.triangles, 36 * sizeof(int));
	put_triangle(&odd, 12, 0, 0, 0);
	put_triangle(&odd, 13, 0, 8, 1);
	put_triangle(&odd, 14, 2, 2, 3);
	case_add(&c, &odd, (double[]){0, 0, 0});
	case_add(&c, &odd, (double[]){0.25, 0.25, 1});
	for (int round = 0; round < 3; round++) {
		JnDetector* detector = case_detector(&c, &plain);
		const JnContactList list = case_find(&c, detector, 0.01);
		check_shape(&list);
		int found = 0;
		for (int i = 0; i < list.count; i++) {
			assert_true(isfinite(list.contacts[i].gap) && isfinite(list.contacts[i].gap_end));
			found += list.contacts[i].vertex_skin == 1 && list.contacts[i].vertex == 0;
		}
		assert_true(found >= 1);
		jn_detector_destroy(detector);
		move_to(&c, 1, 0, 0, round == 0 ? -1 : 0); // then one in the other, with surfaces that cross
		if (round == 1) case_move(&c, 1, 0.3, -0.2, 0.1);
		if (round == 0) move_to(&c, 1, 0, 0, 1.005);
	}
	jn_arena_free(&c.arena);
}

static void positions_that_are_not_finite_are_an_outcome(void** unused) {
	(void)unused;
	Case c = {0};
	JnContactList list;
	const JnSurface cube = surface_cube(&c.arena, 0, 1);
	case_add(&c, &cube, (double[]){0, 0, 0});
	JnDetector* detector = case_detector(&c, &plain);
	c.end[4] = INFINITY;
	assert_int_equal(jn_detector_find(detector, c.start, c.end, 0.1, &list), JN_NOT_FINITE);
	c.end[4] = NAN;
	assert_int_equal(jn_detector_find(detector, c.start, c.end, 0.1, &list), JN_NOT_FINITE);
	assert_int_equal(list.count, 0);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

static void a_second_search_needs_no_memory(void** unused) {
	(void)unused;
	Case c = {0};
	const JnSurface sphere = surface_sphere(&c.arena, 1, 20);
	case_add(&c, &sphere, (double[]){0, 0, 0});
	case_add(&c, &sphere, (double[]){1.9, 0, 0});
	JnDetector* detector = case_detector(&c, &plain);
	assert_true(case_find(&c, detector, 0.02).counts.allocations > 0);
	assert_int_equal(case_find(&c, detector, 0.02).counts.allocations, 0);
	jn_detector_destroy(detector);
	jn_arena_free(&c.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(gaps_of_overlapping_spheres_are_those_of_a_search_over_everything),
		cmocka_unit_test(gaps_of_deep_overlaps_are_those_of_the_nearest_surface),
		cmocka_unit_test(normals_are_slopes_of_the_signed_distance),
		cmocka_unit_test(candidates_are_all_pairs_whose_boxes_touch),
		cmocka_unit_test(contacts_are_the_same_for_any_number_of_threads),
		cmocka_unit_test(the_age_of_a_tree_does_not_show_in_the_contacts),
		cmocka_unit_test(exchanging_two_bodies_exchanges_their_contacts),
		cmocka_unit_test(a_corner_gives_a_contact_for_each_of_its_walls),
		cmocka_unit_test(near_a_convex_edge_there_is_one_contact),
		cmocka_unit_test(triangles_without_area_give_no_nan_and_change_no_gap),
		cmocka_unit_test(positions_that_are_not_finite_are_an_outcome),
		cmocka_unit_test(a_second_search_needs_no_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
