/// @file point_system.h
/// The smallest system M a = f(x): three independent coordinates of mass 1 kg with a force f(x) given as a function.
/// Counts its calls, so that a test knows what a solver asked for.
#ifndef JN_TEST_SUPPORT_POINT_SYSTEM_H
#define JN_TEST_SUPPORT_POINT_SYSTEM_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include "base/space.h"
#include "jounce/extend.h"

enum { POINT_LENGTH = 3, POINT_SLOTS = 8 };

typedef struct PointMatrix {
	JnMatrix base;
	JnShift shift;
	bool is_used;
} PointMatrix;

typedef struct PointSystem {
	JnSystem base;
	double (*force)(double x);
	double (*stiffness)(double x); ///< -df/dx
	double K[POINT_LENGTH];
	PointMatrix matrices[POINT_SLOTS];
	JnReport report;
} PointSystem;

static inline JnStatus point_begin(JnSystem* sys, const JnState* start) {
	(void)sys, (void)start;
	return JN_OK;
}

static inline void point_prescribe(JnSystem* sys, JnState* s, JnVec a) {
	(void)sys, (void)s, (void)a;
}

static inline void point_hold(JnSystem* sys, JnVec r) {
	(void)sys, (void)r;
}

static inline JnStatus point_force(JnSystem* sys, const JnState* s, JnVec f) {
	for (int k = 0; k < POINT_LENGTH; ++k) f[k] = ((PointSystem*)sys)->force(s->x[k]);
	++sys->report->forces;
	return JN_OK;
}

static inline double point_energy(JnSystem* sys, const JnState* s) {
	(void)sys, (void)s;
	return NAN;
}

static inline JnStatus point_linearize(JnSystem* sys, const JnState* s) {
	PointSystem* point = (PointSystem*)sys;
	for (int k = 0; k < POINT_LENGTH; ++k) point->K[k] = point->stiffness(s->x[k]);
	for (int i = 0; i < POINT_SLOTS; ++i) point->matrices[i].base.is_factored = false;
	++sys->report->tangents;
	return JN_OK;
}

static inline void point_apply(JnMatrix* matrix, const double* in, JnVec out) {
	const JnShift shift = ((PointMatrix*)matrix)->shift;
	const PointSystem* point = (PointSystem*)matrix->sys;
	for (int k = 0; k < POINT_LENGTH; ++k) out[k] = (shift.mass + shift.stiffness * point->K[k]) * in[k];
}

static inline JnStatus point_solve(JnMatrix* matrix, const double* rhs, JnVec out) {
	const JnShift shift = ((PointMatrix*)matrix)->shift;
	const PointSystem* point = (PointSystem*)matrix->sys;
	++point->base.report->solves;
	matrix->is_factored = true;
	for (int k = 0; k < POINT_LENGTH; ++k) out[k] = rhs[k] / (shift.mass + shift.stiffness * point->K[k]);
	return JN_OK;
}

static inline JnStatus point_matrix(JnSystem* sys, JnShift shift, JnMatrix** out) {
	static const JnMatrixOps ops = {.apply = point_apply, .solve = point_solve};
	PointSystem* point = (PointSystem*)sys;
	for (int i = 0; i < POINT_SLOTS; ++i) {
		PointMatrix* matrix = &point->matrices[i];
		const bool is_it = matrix->is_used && matrix->shift.mass == shift.mass &&
						   matrix->shift.damping == shift.damping && matrix->shift.stiffness == shift.stiffness;
		if (matrix->is_used && !is_it) continue;
		if (!matrix->is_used)
			*matrix =
				(PointMatrix){.base = {.ops = &ops, .sys = sys, .refresh_cost = 16}, .shift = shift, .is_used = true};
		*out = &matrix->base;
		return JN_OK;
	}
	fail_msg("more than %d shifts", POINT_SLOTS);
	return JN_BAD_INPUT;
}

static inline double point_stretch(JnSystem* sys, const JnState* from, const JnState* to) {
	(void)sys, (void)from, (void)to;
	return 0;
}

/// `point` must stay where it is. Free with point_destroy.
static inline void point_create(PointSystem* point, double (*force)(double), double (*stiffness)(double)) {
	static const JnSystemOps ops = {.begin = point_begin,
									.prescribe = point_prescribe,
									.hold = point_hold,
									.force = point_force,
									.energy = point_energy,
									.linearize = point_linearize,
									.matrix = point_matrix,
									.stretch = point_stretch};
	*point = (PointSystem){.base = {.ops = &ops, .space = jn_host_space_create(POINT_LENGTH, 1), .force_scale = 1},
						   .force = force,
						   .stiffness = stiffness};
	assert_non_null(point->base.space);
	point->base.report = &point->report;
}

static inline void point_destroy(PointSystem* point) {
	jn_host_space_destroy(point->base.space);
}

#endif
