#include "plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "control/combined.h"
#include "control/controller.h"
#include "control/embedded.h"
#include "control/force_error.h"
#include "control/stable.h"
#include "control/step_doubling.h"
#include "control/zienkiewicz_xie.h"
#include "draw.h"
#include "force/kernel.h"
#include "force/peridynamic.h"
#include "force/solid.h"
#include "integrate/integrator.h"
#include "integrate/properties.h"
#include "integrate/tableau.h"
#include "mesh/shape/shape.h"
#include "model/system_list.h"

#define MESHES JN_SOURCE_DIR "/test/random/meshes/"

// What runs on what. Shapes and laws that are not named here are solids.
typedef struct Family {
	const char *shapes, *laws; // divided by '|'
	const char* sets;          // of the shapes that have no row of their own below
} Family;

static const Family families[] = {
	{"cloth|file", "mass_spring|membrane", NULL},
	{"thread", "rod|constraints", NULL},
	{"points_box|points_file", "peridynamic", NULL},
	{"rigid_sphere|rigid_plate", "rigid", NULL},
};

enum { FAMILY_COUNT = sizeof families / sizeof *families };

static const Family shape_sets[] = {
	{"sheet|cloth", NULL, "left|right|lower|upper|corners"},
	{"ball", NULL, "surface"},
	{"cylinder", NULL, "bottom|top"},
	{"jello", NULL, "plate|bottom|top"},
	{"rope|thread", NULL, "start|end"},
};

enum { SETS_COUNT = sizeof shape_sets / sizeof *shape_sets };

static bool has(const char* words, const char* word) {
	for (int i = 0; words != NULL && word_at(words, i) != NULL; ++i)
		if (strcmp(word_at(words, i), word) == 0) return true;
	return false;
}

static bool fits(const JnRow* shape, const JnRow* law) {
	bool shape_is_named = false, law_is_named = false;
	for (int i = 0; i < FAMILY_COUNT; ++i) {
		const bool has_shape = has(families[i].shapes, shape->name), has_law = has(families[i].laws, law->name);
		if (has_shape && has_law) return true;
		shape_is_named |= has_shape && strcmp(shape->name, "file") != 0;
		law_is_named |= has_law && strcmp(law->name, "constraints") != 0;
	}
	return !shape_is_named && !law_is_named;
}

bool plan_is_thread(const PlanBody* body) {
	return body->shape != NULL && strcmp(body->shape->name, "thread") == 0;
}

bool plan_is_cloth(const PlanBody* body) {
	return has(families[0].laws, body->law->name);
}

static const JnRow* any_row(JnRandom* random, const JnRowList* list) {
	return list->rows[draw_integer(random, 0, list->count - 1)];
}

static void choose_file(JnRandom* random, PlanBody* body) {
	const bool is_filled = strcmp(body->shape->name, "file") == 0;
	body->file = draw_chance(random, 0.5) ? MESHES "octahedron.obj" : MESHES "cube.off";
	body->filling = draw_chance(random, 0.7) || body->element != NULL ? "tetrahedra" : "voxels";
	if (is_filled && plan_is_cloth(body)) {
		body->file = draw_chance(random, 0.5) ? MESHES "cloth.obj" : MESHES "octahedron.obj";
		body->filling = "triangles";
	} else if (is_filled && draw_chance(random, 0.3)) {
		body->file = MESHES "two.vtk";
		body->filling = "";
	}
}

static PlanBody body_of(JnRandom* random, const JnRow* law) {
	PlanBody body = {.law = law, .shape = any_row(random, &jn_shape_list)};
	while (!fits(body.shape, law)) body.shape = any_row(random, &jn_shape_list);
	if (strcmp(law->name, "constraints") == 0) body.element = "tet4";
	choose_file(random, &body);
	body.has_horizon = draw_chance(random, 0.2);
	return body;
}

static bool is_points(const PlanBody* body) {
	return strcmp(body->law->name, "peridynamic") == 0 || strcmp(body->law->name, "rigid") == 0;
}

const char* plan_sets(const PlanBody* body) {
	for (int i = 0; body->shape != NULL && i < SETS_COUNT; ++i)
		if (has(shape_sets[i].shapes, body->shape->name)) return shape_sets[i].sets;
	return NULL;
}

// Can this rule judge steps of the method?
static bool serves(const JnRow* controller, const JnIntegratorType* method) {
	JnIntegratorProperties properties;
	JnTableauProperties tableau = {0};
	if (controller == &jn_controller_embedded.row) {
		if (method->properties != NULL) method->properties(method->table, &tableau);
		return tableau.error_order > 0;
	}
	if (controller == &jn_controller_zienkiewicz_xie.row) return method->newmark_beta != NULL;
	if (controller == &jn_controller_force_error.row) return (method->needs & JN_NEEDS_TANGENT) != 0;
	if (controller == &jn_controller_step_doubling.row) return method->commit == NULL;
	if (controller != &jn_controller_stable.row) return true;
	return jn_integrator_properties(method, &properties) == JN_OK && properties.stability_limit > 0 &&
		   isfinite(properties.stability_limit);
}

const JnRow* plan_controller(const Plan* plan, JnRandom* random, bool may_combine) {
	const JnRow* row = NULL;
	const bool may_be_refused = draw_chance(random, 0.01);
	do row = any_row(random, &jn_controller_list);
	while ((row == &jn_controller_combined.row && !may_combine) ||
		   (!may_be_refused && !serves(row, (const JnIntegratorType*)plan->method)));
	return row;
}

static void add_part(Plan* plan, const char* part) {
	const size_t length = strlen(plan->list);
	snprintf(plan->list + length, sizeof plan->list - length, "|%s", part);
}

static void maybe_add(Plan* plan, JnRandom* random, double chance, const char* part) {
	if (draw_chance(random, chance)) add_part(plan, part);
}

// Bodies of the law's kind, or any others where they can stand together: points know points and rigid things alone.
static void choose_bodies(Plan* plan, JnRandom* random, const JnRow* law) {
	plan->body_count = draw_chance(random, 0.5) ? 1 : draw_integer(random, 2, PLAN_BODIES);
	plan->bodies[0] = body_of(random, law);
	for (int b = 1; b < plan->body_count; ++b) {
		do plan->bodies[b] = body_of(random, any_row(random, &jn_law_list));
		while (is_points(&plan->bodies[b]) != is_points(&plan->bodies[0]));
	}
}

// What meets whom.
static void choose_meetings(Plan* plan, JnRandom* random) {
	bool has_thread = false, has_rigid = false, has_constraints = false, has_cloth = false;
	for (int b = 0; b < plan->body_count; ++b) {
		has_thread |= plan_is_thread(&plan->bodies[b]);
		has_cloth |= plan_is_cloth(&plan->bodies[b]);
		has_rigid |= strcmp(plan->bodies[b].law->name, "rigid") == 0;
		has_constraints |= has("constraints|rod", plan->bodies[b].law->name);
	}
	if (has_thread && draw_chance(random, 0.7)) {
		add_part(plan, "collision");
		if (plan_is_thread(&plan->bodies[0]) && plan->body_count > 1 && !plan_is_thread(&plan->bodies[1]))
			maybe_add(plan, random, 0.6, "suture");
	} else if (!is_points(&plan->bodies[0]) && (!has_cloth || plan->body_count == 1)) {
		maybe_add(plan, random, 0.5, "contact");
	}
	if (is_points(&plan->bodies[0])) maybe_add(plan, random, has_rigid ? 1 : 0.5, "repulsion");
	if (has_constraints) maybe_add(plan, random, 0.3, "relax");
	if (!is_points(&plan->bodies[0])) maybe_add(plan, random, 0.25, "wind");
	maybe_add(plan, random, 0.4, "obstacles");
}

static void choose_system(Plan* plan) {
	plan->body_count = 0;
	add_part(plan, "system");
}

void plan_make(Plan* plan, long index, JnRandom* random) {
	const long methods = jn_integrator_list.count, laws = jn_law_list.count, rules = jn_controller_list.count;
	const long column = index % methods, row = index / methods, law = (row + column) % laws;
	static const double wildness[] = {1e-9, 1e-9, 1e-9, 1e-9, 1e-9, 0.02, 0.02, 0.06, 0.06, 0.3};
	*plan = (Plan){.method = jn_integrator_list.rows[column],
				   .controller = jn_controller_list.rows[(row / laws + row % laws + column) % rules],
				   .damping_stiffness = draw_integer(random, 0, 2),
				   .wildness = wildness[draw_integer(random, 0, 9)]};
	const JnIntegratorType* method = (const JnIntegratorType*)plan->method;
	plan->needs_lumped = (method->needs & JN_NEEDS_DIAGONAL_MASS) != 0;
	if (!serves(plan->controller, method)) plan->controller = plan_controller(plan, random, true);
	if (draw_chance(random, 0.1)) plan->damping_start = 0.01 * jn_random_uniform(random);
	if (draw_chance(random, 0.02)) {
		choose_system(plan);
	} else {
		choose_bodies(plan, random, jn_law_list.rows[law]);
		choose_meetings(plan, random);
		add_part(plan, "bodies");
	}
	plan->parts = plan->list;
}

PlanWord plan_says(const Plan* plan, const char* path) {
	static const char planned[] = "bodies|system|obstacles|wind|repulsion|contact|collision|suture|relax";
	if (has(planned, path)) return has(plan->parts, path) ? PLAN_SAYS_YES : PLAN_SAYS_NO;
	if (has("integrator|step", path) || strcmp(path, "bodies.damping.stiffness") == 0) return PLAN_SAYS_YES;
	if (strcmp(path, "bodies.damping.start") == 0) return PLAN_SAYS_YES;
	if (strcmp(path, "bodies.damping") == 0) return PLAN_SAYS_YES;
	if (strcmp(path, "bodies.mass") == 0 && plan->needs_lumped) return PLAN_SAYS_YES;
	if (has("newton|contact.solver", path)) return PLAN_SAYS_YES; // they bound what a failing step takes
	if (has("probes|fracture", path) && plan->body_count == 0) return PLAN_SAYS_NO;
	return PLAN_SAYS_NOTHING;
}
