/// @file model_case.h
/// Small models for tests, built from definition structs: a box of cells, clamped or free, with one law.
#ifndef JN_TEST_SUPPORT_MODEL_CASE_H
#define JN_TEST_SUPPORT_MODEL_CASE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/key.h"
#include "base/space.h"
#include "control/controller.h"
#include "force/kernel.h"
#include "integrate/integrator.h"
#include "jounce/sim.h"
#include "mesh/shape/shape.h"
#include "model/motion.h"
#include "solve/solver.h"

enum { FACE_NONE, FACE_X_LOW, FACE_X_HIGH, FACE_Y_LOW, FACE_Y_HIGH, FACE_Z_LOW, FACE_Z_HIGH, FACE_ALL };

/// A simulation of one body and everything that its definition points to. Fill with case_box, then change at will; it
/// must stay where it is.
typedef struct ModelCase {
	JnBoxDef box;
	JnMaterialDef material;
	JnDirectDef direct;
	JnFixDef fix[2];
	JnDriveDef drive;
	double motion[8], control[16]; ///< options of the motion and of the controller, by their keys
	double method[32];             ///< options of the integrator
	JnBodyDef body;
	JnSimDef sim;
} ModelCase;

static inline const JnRow* row_named(const JnRowList* list, const char* name) {
	const JnRow* row = jn_row_find(list, name);
	if (row == NULL) fail_msg("no %s '%s'", list->noun, name);
	return row;
}

/// The field of a row's options that a key fills.
static inline void* option(const JnRow* row, void* options, const char* name) {
	for (const JnKey* key = row->keys; key->name != NULL; ++key)
		if (strcmp(key->name, name) == 0) return (char*)options + key->field;
	fail_msg("%s has no key '%s'", row->name, name);
	return NULL;
}

/// Choose a method, with the defaults of its own keys.
static inline void case_method(ModelCase* c, const JnRow* row) {
	JnArena texts = {0};
	if (row->options_size > sizeof c->method) fail_msg("%s: options of %zu bytes", row->name, row->options_size);
	if (row->keys != NULL) assert_int_equal(jn_keys_read(row->keys, NULL, "", &texts, c->method), JN_OK);
	jn_arena_free(&texts); // numbers and choices only
	c->sim.integrator = (JnVariant){row, row->options_size > 0 ? c->method : NULL};
}

/// Whether a method is a diagonally implicit Runge-Kutta method: those share one step function.
static inline bool is_dirk(const JnRow* row) {
	const JnIntegratorType* euler = (const JnIntegratorType*)row_named(&jn_integrator_list, "backward_euler");
	return ((const JnIntegratorType*)row)->step == euler->step;
}

static inline JnSelectDef face_select(int face) {
	return (JnSelectDef){.face = face, .nearest = {NAN, NAN, NAN}};
}

/// 2 x 2 x 4 cells of 0.1 m, clamped at z-, soft (E = 10 kPa), consistent mass, no gravity and no damping; sdirk2 with
/// dt = 1/128 s.
static inline void case_box(ModelCase* c, int element, const char* law) {
	*c = (ModelCase){
		.box = {.size = {0.2, 0.2, 0.4}, .cells = {2, 2, 4}, .element = element},
		.material = {.density = 1000, .young = 1e4, .poisson = 0.3},
		.fix = {{.where = face_select(FACE_Z_LOW), .axes = "xyz"}},
	};
	c->body = (JnBodyDef){
		.name = "box",
		.shape = {row_named(&jn_shape_list, "box"), &c->box},
		.material = {row_named(&jn_law_list, law), &c->material},
		.fix = {1, c->fix},
	};
	c->sim = (JnSimDef){
		.model = {.bodies = {1, &c->body}, .solver = {row_named(&jn_solver_list, "direct"), &c->direct}},
		.integrator = {.row = row_named(&jn_integrator_list, "sdirk2")},
		.newton = {.tolerance = 1e-10, .max_iterations = 60},
		.step = {row_named(&jn_controller_list, "fixed"), c->control},
		.duration = 1,
	};
	*(double*)option(c->sim.step.row, c->control, "dt") = 1.0 / 128;
	*(int*)option(c->sim.step.row, c->control, "cuts") = 10;
	*(int*)option(c->sim.step.row, c->control, "recovery") = 4;
}

static inline void case_gravity(ModelCase* c, double x, double y, double z) {
	c->sim.model.gravity[0] = x;
	c->sim.model.gravity[1] = y;
	c->sim.model.gravity[2] = z;
}

/// Move a face along x by a sine; its other axes stay.
static inline void case_drive(ModelCase* c, int face, double amplitude, double frequency) {
	const JnRow* sine = row_named(&jn_motion_list, "sine");
	*(double*)option(sine, c->motion, "amplitude") = amplitude;
	*(double*)option(sine, c->motion, "frequency") = frequency;
	c->drive = (JnDriveDef){.where = face_select(face), .motion = {{sine, c->motion}}};
	c->body.drive = (JnItems){1, &c->drive};
}

/// A bar of tetrahedra whose upper end is moved.
static inline void case_driven_bar(ModelCase* c) {
	case_box(c, JN_TET4, "corotated");
	case_gravity(c, 0, -9.81, 0);
	case_drive(c, FACE_Z_HIGH, 0.05, 2);
}

/// A body with both parts of Rayleigh damping, moving at the start.
static inline void case_damped_body(ModelCase* c) {
	case_box(c, JN_HEX8, "st_venant_kirchhoff");
	case_gravity(c, 0, -9.81, 1);
	c->body.damping = (JnDampingDef){.alpha = 0.3, .beta = 0.01};
	c->body.velocity[1] = 0.5;
}

/// A model with an integrator, stepped by hand.
typedef struct Rig {
	JnModel* model;
	JnSystem* sys;
	JnSpace* space;
	JnIntegrator* integrator;
	JnState start, end;
	JnReport report;
	int nodes, length; ///< length = 3 * nodes
} Rig;

static inline void rig_create(Rig* rig, const ModelCase* c, int threads) {
	*rig = (Rig){0};
	assert_int_equal(jn_model_create(&c->sim.model, threads, &rig->model), JN_OK);
	rig->sys = jn_model_system(rig->model);
	rig->sys->report = &rig->report;
	rig->space = rig->sys->space;
	rig->nodes = jn_model_node_count(rig->model);
	rig->length = 3 * rig->nodes;
	assert_int_equal(jn_state_create(rig->space, &rig->start), JN_OK);
	assert_int_equal(jn_state_create(rig->space, &rig->end), JN_OK);
	rig->integrator = jn_integrator_create(&c->sim.integrator, &c->sim.newton, rig->space);
	assert_non_null(rig->integrator);
	jn_model_start(rig->model, 0, &rig->start);
	assert_int_equal(rig->sys->ops->begin(rig->sys, &rig->start), JN_OK);
}

static inline void rig_destroy(Rig* rig) {
	jn_integrator_destroy(rig->integrator);
	jn_state_destroy(rig->space, &rig->start);
	jn_state_destroy(rig->space, &rig->end);
	jn_model_destroy(rig->model);
}

/// Tell the system that the start was edited, and begin a step from it.
static inline void rig_begin(Rig* rig) {
	rig->sys->ops->prescribe(rig->sys, &rig->start, NULL);
	jn_state_touch(rig->space, &rig->start);
	assert_int_equal(rig->sys->ops->begin(rig->sys, &rig->start), JN_OK);
}

/// From start to end; start stays.
static inline JnStatus rig_attempt(Rig* rig, double dt) {
	JnStep step = {.sys = rig->sys, .start = &rig->start, .end = &rig->end, .dt = dt};
	const JnStatus status = rig->integrator->type->step(rig->integrator, &step);
	rig->report = step.report;
	rig->sys->report = &rig->report;
	return status;
}

/// Take the end of an attempt that worked as the start of the next step.
static inline void rig_accept(Rig* rig, double dt) {
	const JnStep step = {.sys = rig->sys, .start = &rig->start, .end = &rig->end, .dt = dt, .report = rig->report};
	if (rig->integrator->type->commit != NULL) rig->integrator->type->commit(rig->integrator, &step);
	const JnState swap = rig->start;
	rig->start = rig->end;
	rig->end = swap;
	assert_int_equal(rig->sys->ops->begin(rig->sys, &rig->start), JN_OK);
}

/// A step that must work; the end becomes the start of the next.
static inline void rig_step(Rig* rig, double dt) {
	const JnStatus status = rig_attempt(rig, dt);
	if (status != JN_OK) fail_msg("%s: %s", rig->integrator->type->row.name, jn_status_name(status));
	rig_accept(rig, dt);
}

/// Uniform in [-1, 1].
static inline double random_number(uint64_t* seed) {
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(*seed >> 11) / (double)((uint64_t)1 << 52) - 1;
}

static inline void fill_random(uint64_t* seed, double scale, int length, double* out) {
	for (int k = 0; k < length; ++k) out[k] = scale * random_number(seed);
}

/// Move the start: rest plus random displacements and velocities up to the given sizes; held entries stay.
static inline void rig_shake(Rig* rig, uint64_t seed, double displacement, double speed) {
	const double* rest = jn_model_rest(rig->model);
	for (int k = 0; k < rig->length; ++k) {
		rig->start.x[k] = rest[k] + displacement * random_number(&seed);
		rig->start.v[k] = speed * random_number(&seed);
	}
	rig_begin(rig);
}

static inline double largest_difference(const double* a, const double* b, int length) {
	double most = 0;
	for (int k = 0; k < length; ++k) {
		const double difference = fabs(a[k] - b[k]);
		if (!(difference <= most)) most = difference;
	}
	return most;
}

static inline double largest_size(const double* a, int length) {
	double most = 0;
	for (int k = 0; k < length; ++k)
		if (!(fabs(a[k]) <= most)) most = fabs(a[k]);
	return most;
}

/// Fail, with value, expected and tolerance, unless |value - expected| <= tolerance.
#define expect_near(value, expected, tolerance, ...)                                                                   \
	do {                                                                                                               \
		const double near_value = (value), near_expected = (expected), near_tolerance = (tolerance);                   \
		if (!(fabs(near_value - near_expected) <= near_tolerance)) {                                                   \
			print_error(__VA_ARGS__);                                                                                  \
			fail_msg(": %.17g, expected %.17g, tolerance %.3g", near_value, near_expected, near_tolerance);            \
		}                                                                                                              \
	} while (0)

#endif
