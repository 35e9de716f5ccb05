// Choosing nodes: planes, corners, named sets, and the rule that exactly one way is given.
#include "base/log.h"
#include "model/select.h"
#include "support/model_case.h"
#include "support/support.h"

enum { NODES = 5 * 4 * 3 };

// 4 x 3 x 2 cells of 0.25 m from (1, 2, 3) to (2, 2.75, 3.5).
typedef struct Choice {
	JnArena arena;
	JnMesh mesh;
	JnSelectDef where;
	bool chosen[NODES];
} Choice;

static void choice_create(Choice* c) {
	const JnBoxDef box = {.origin = {1, 2, 3}, .size = {1, 0.75, 0.5}, .cells = {4, 3, 2}, .element = JN_HEX8};
	*c = (Choice){.where = {.nearest = {NAN, NAN, NAN}}};
	assert_int_equal(jn_generate_box(&box, &c->arena, &c->mesh), JN_OK);
	assert_int_equal(c->mesh.node_count, NODES);
}

static int choose(Choice* c) {
	int count = 0;
	memset(c->chosen, true, sizeof c->chosen); // what is not chosen must be reset
	assert_int_equal(jn_select_nodes(&c->where, &c->mesh, "here", c->chosen), JN_OK);
	for (int i = 0; i < NODES; ++i) count += c->chosen[i];
	return count;
}

static void expect_refusal(Choice* c, const char* text) {
	log_capture();
	assert_int_equal(jn_select_nodes(&c->where, &c->mesh, "here", c->chosen), JN_BAD_INPUT);
	if (strstr(log_text(), text) == NULL) fail_msg("expected '%s', got '%s'", text, log_text());
	log_release();
}

static void a_plane_chooses_the_nodes_on_it(void** state) {
	(void)state;
	Choice c;
	JnRegionPlaneDef plane = {.point = {7, 7, 3.25}, .normal = {0, 0, -9}, .within = NAN};
	choice_create(&c);
	c.where.plane = &plane;
	assert_int_equal(choose(&c), 5 * 4);
	for (int i = 0; i < NODES; ++i) assert_true(c.chosen[i] == (c.mesh.nodes[3 * i + 2] == 3.25));
	jn_arena_free(&c.arena);
}

// Distances along (1, 1, 0) / sqrt 2 from the corner are multiples of 0.25 / sqrt 2 = 0.177 m.
static void within_is_a_distance_along_the_normal(void** state) {
	(void)state;
	Choice c;
	JnRegionPlaneDef plane = {.point = {1, 2, 0}, .normal = {3, 3, 0}, .within = 0.18};
	choice_create(&c);
	c.where.plane = &plane;
	assert_int_equal(choose(&c), 3 * 3); // the edge, and one node to either side of it, on three levels
	plane.within = 0.17;
	assert_int_equal(choose(&c), 3);
	jn_arena_free(&c.arena);
}

static void sides_of_a_plane_include_the_plane(void** state) {
	(void)state;
	Choice c;
	JnRegionPlaneDef plane = {.point = {1.25, 0, 0}, .normal = {1, 0, 0}, .within = NAN, .side = 1};
	choice_create(&c);
	c.where.plane = &plane;
	assert_int_equal(choose(&c), 4 * 12);
	plane.side = 2;
	assert_int_equal(choose(&c), 2 * 12);
	plane.normal[0] = -1;
	assert_int_equal(choose(&c), 4 * 12);
	jn_arena_free(&c.arena);
}

static void a_corner_chooses_its_node_alone(void** state) {
	(void)state;
	const JnKey* key = jn_select_keys;
	while (strcmp(key->name, "corner") != 0) ++key;
	Choice c;
	choice_create(&c);
	for (int corner = 1; corner <= 8; ++corner) {
		c.where.corner = corner;
		assert_int_equal(choose(&c), 1);
		const double low[3] = {1, 2, 3}, high[3] = {2, 2.75, 3.5};
		for (int i = 0; i < NODES; ++i)
			for (int axis = 0; axis < 3 && c.chosen[i]; ++axis) {
				const bool is_high = key->names[corner][2 * axis + 1] == '+'; // "x-y-z+"
				assert_true(c.mesh.nodes[3 * i + axis] == (is_high ? high : low)[axis]);
			}
	}
	jn_arena_free(&c.arena);
}

static void sets_of_the_mesh_and_of_the_body_are_found_by_name(void** state) {
	(void)state;
	Choice c;
	int own_nodes[2] = {3, 8};
	JnNodeSet own = {.name = "own", .count = 2, .nodes = own_nodes};
	JnSetDef defs[2] = {{.name = "side", .where = face_select(FACE_X_HIGH)},
						{.name = "again", .where = {.set = "side", .nearest = {NAN, NAN, NAN}}}};
	choice_create(&c);
	c.mesh.sets = &own;
	c.mesh.set_count = 1;
	assert_int_equal(jn_select_add_sets(&(JnItems){2, defs}, "sets", &c.arena, &c.mesh), JN_OK);
	c.where.set = "own";
	assert_int_equal(choose(&c), 2);
	assert_true(c.chosen[3] && c.chosen[8]);
	for (int k = 0; k < 2; ++k) {
		c.where.set = defs[k].name;
		assert_int_equal(choose(&c), 12);
		for (int i = 0; i < NODES; ++i) assert_true(c.chosen[i] == (c.mesh.nodes[3 * i] == 2));
	}
	jn_arena_free(&c.arena);
}

static void an_unknown_set_is_refused_with_those_there_are(void** state) {
	(void)state;
	Choice c;
	JnSetDef defs[2] = {{.name = "left", .where = face_select(FACE_X_LOW)},
						{.name = "right", .where = face_select(FACE_X_HIGH)}};
	choice_create(&c);
	c.where.set = "rigth";
	expect_refusal(&c, "here.set: the body has no set 'rigth'. Sets here: none");
	assert_int_equal(jn_select_add_sets(&(JnItems){2, defs}, "sets", &c.arena, &c.mesh), JN_OK);
	expect_refusal(&c, "no set 'rigth'; did you mean 'right'? Sets here: left, right");
	jn_arena_free(&c.arena);
}

static void a_set_name_that_is_taken_is_refused(void** state) {
	(void)state;
	Choice c;
	JnSetDef defs[2] = {{.name = "left", .where = face_select(FACE_X_LOW)},
						{.name = "left", .where = face_select(FACE_X_HIGH)}};
	choice_create(&c);
	log_capture();
	assert_int_equal(jn_select_add_sets(&(JnItems){2, defs}, "sets", &c.arena, &c.mesh), JN_BAD_INPUT);
	assert_non_null(strstr(log_text(), "sets[1].name: the body has a set 'left' already"));
	log_release();
	jn_arena_free(&c.arena);
}

static void not_exactly_one_way_is_refused(void** state) {
	(void)state;
	Choice c;
	JnRegionPlaneDef plane = {.normal = {0, 0, 0}, .within = NAN};
	choice_create(&c);
	expect_refusal(&c, "here: nothing says which nodes");
	c.where.corner = 1;
	c.where.set = "left";
	expect_refusal(&c, "here: several ways");
	c.where = (JnSelectDef){.plane = &plane, .nearest = {NAN, NAN, NAN}};
	expect_refusal(&c, "here.plane.normal: has no direction");
	plane.normal[1] = 1;
	expect_refusal(&c, "here: no node lies there");
	jn_arena_free(&c.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_plane_chooses_the_nodes_on_it),
		cmocka_unit_test(within_is_a_distance_along_the_normal),
		cmocka_unit_test(sides_of_a_plane_include_the_plane),
		cmocka_unit_test(a_corner_chooses_its_node_alone),
		cmocka_unit_test(sets_of_the_mesh_and_of_the_body_are_found_by_name),
		cmocka_unit_test(an_unknown_set_is_refused_with_those_there_are),
		cmocka_unit_test(a_set_name_that_is_taken_is_refused),
		cmocka_unit_test(not_exactly_one_way_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
