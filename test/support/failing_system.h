/// @file failing_system.h
/// A system that answers as another one does, until the call of a chosen number: that one fails with a chosen status, and
/// leaves what it should have written as it was. What asks a system for forces, tangents, matrices and solves must hand such a
/// failure on, or know what to do without.
#ifndef JN_TEST_SUPPORT_FAILING_SYSTEM_H
#define JN_TEST_SUPPORT_FAILING_SYSTEM_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "jounce/extend.h"

enum { FAILING_MATRICES = 8 };

typedef struct FailingMatrix {
	JnMatrix base;
	JnMatrix* inner;
} FailingMatrix;

typedef struct FailingSystem {
	JnSystem base;
	JnSystem* inner;
	JnSystemOps ops; ///< without `advance` where the other has none
	FailingMatrix matrices[FAILING_MATRICES];
	long calls, refused; ///< calls so far; the number of the one that fails, from 1; 0: none
	JnStatus status;     ///< of that one
	const char* culprit; ///< its verb; NULL: none has failed
} FailingSystem;

static inline FailingSystem* failing_of(JnSystem* sys) {
	return (FailingSystem*)sys;
}

static inline JnStatus failing_count(FailingSystem* sys, const char* verb) {
	sys->inner->report = sys->base.report;
	if (++sys->calls != sys->refused) return JN_OK;
	sys->culprit = verb;
	return sys->status;
}

static inline JnStatus failing_begin(JnSystem* base, const JnState* start) {
	FailingSystem* sys = failing_of(base);
	JN_TRY(failing_count(sys, "begin"));
	const JnStatus status = sys->inner->ops->begin(sys->inner, start);
	base->force_scale = sys->inner->force_scale;
	base->force_floor = sys->inner->force_floor;
	return status;
}

static inline void failing_prescribe(JnSystem* base, JnState* s, JnVec a) {
	failing_of(base)->inner->ops->prescribe(failing_of(base)->inner, s, a);
}

static inline void failing_hold(JnSystem* base, JnVec r) {
	failing_of(base)->inner->ops->hold(failing_of(base)->inner, r);
}

static inline JnStatus failing_force(JnSystem* base, const JnState* s, JnVec f) {
	JN_TRY(failing_count(failing_of(base), "force"));
	return failing_of(base)->inner->ops->force(failing_of(base)->inner, s, f);
}

static inline double failing_energy(JnSystem* base, const JnState* s) {
	return failing_of(base)->inner->ops->energy(failing_of(base)->inner, s);
}

static inline JnStatus failing_linearize(JnSystem* base, const JnState* s) {
	FailingSystem* sys = failing_of(base);
	JN_TRY(failing_count(sys, "linearize"));
	const JnStatus status = sys->inner->ops->linearize(sys->inner, s);
	for (int i = 0; i < FAILING_MATRICES; ++i)
		if (sys->matrices[i].inner != NULL) sys->matrices[i].base.is_factored = sys->matrices[i].inner->is_factored;
	return status;
}

static inline void failing_apply(JnMatrix* base, const double* in, JnVec out) {
	JnMatrix* inner = ((FailingMatrix*)base)->inner;
	inner->ops->apply(inner, in, out);
}

static inline JnStatus failing_solve(JnMatrix* base, const double* rhs, JnVec out) {
	JnMatrix* inner = ((FailingMatrix*)base)->inner;
	JN_TRY(failing_count(failing_of(base->sys), "solve"));
	const JnStatus status = inner->ops->solve(inner, rhs, out);
	base->is_factored = inner->is_factored;
	return status;
}

static inline JnStatus failing_approximate(JnMatrix* base, double tolerance, const double* rhs, JnVec out) {
	JnMatrix* inner = ((FailingMatrix*)base)->inner;
	JN_TRY(failing_count(failing_of(base->sys), "approximate"));
	const JnStatus status = inner->ops->approximate(inner, tolerance, rhs, out);
	base->is_factored = inner->is_factored;
	return status;
}

static inline JnStatus failing_matrix(JnSystem* base, JnShift shift, JnMatrix** out) {
	static const JnMatrixOps exact = {.apply = failing_apply, .solve = failing_solve},
							 all = {.apply = failing_apply, .solve = failing_solve, .approximate = failing_approximate};
	FailingSystem* sys = failing_of(base);
	JnMatrix* inner = NULL;
	JN_TRY(failing_count(sys, "matrix"));
	JN_TRY(sys->inner->ops->matrix(sys->inner, shift, &inner));
	int i = 0;
	while (sys->matrices[i].inner != NULL && sys->matrices[i].inner != inner)
		if (++i == FAILING_MATRICES) fail_msg("more than %d matrices", FAILING_MATRICES);
	sys->matrices[i] = (FailingMatrix){.base = *inner, .inner = inner};
	sys->matrices[i].base.ops = inner->ops->approximate != NULL ? &all : &exact;
	sys->matrices[i].base.sys = base;
	*out = &sys->matrices[i].base;
	return JN_OK;
}

static inline double failing_stretch(JnSystem* base, const JnState* from, const JnState* to) {
	return failing_of(base)->inner->ops->stretch(failing_of(base)->inner, from, to);
}

static inline JnStatus failing_advance(JnSystem* base, const JnState* from, double kick, double drift, JnState* to) {
	JN_TRY(failing_count(failing_of(base), "advance"));
	return failing_of(base)->inner->ops->advance(failing_of(base)->inner, from, kick, drift, to);
}

/// Stand before `inner`, which must outlive this. `sys` must stay where it is; there is nothing to free.
static inline void failing_create(FailingSystem* sys, JnSystem* inner) {
	*sys = (FailingSystem){.base = *inner, .inner = inner};
	sys->ops = (JnSystemOps){.begin = failing_begin,
							 .prescribe = failing_prescribe,
							 .hold = failing_hold,
							 .force = failing_force,
							 .energy = failing_energy,
							 .linearize = failing_linearize,
							 .matrix = failing_matrix,
							 .stretch = failing_stretch,
							 .advance = inner->ops->advance != NULL ? failing_advance : NULL};
	sys->base.ops = &sys->ops;
}

/// From now on the call of that number fails, from 1, and none before or after it; 0: none.
static inline void failing_at(FailingSystem* sys, long number, JnStatus status) {
	sys->calls = 0;
	sys->refused = number;
	sys->status = status;
	sys->culprit = NULL;
}

#endif
