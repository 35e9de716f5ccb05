/// @file spring_case.h
/// The spring of AD figure 1, x'' = -k_x (x + c x^3) - k_v (v + c v^3), from x = -1 at rest, as a system of callbacks; with
/// c = 0 it is linear.
#ifndef JN_TEST_SUPPORT_SPRING_CASE_H
#define JN_TEST_SUPPORT_SPRING_CASE_H

#include "support/model_case.h"
#include "support/support.h"

typedef struct Spring {
	double k_x, k_v, cubic;
	int fails_after; ///< calls after which the force cannot be evaluated; 0: never
	int calls;
} Spring;

static inline int spring_force(void* user, double t, const double* x, const double* v, double* f) {
	Spring* spring = user;
	(void)t;
	++spring->calls;
	f[0] = -spring->k_x * (x[0] + spring->cubic * x[0] * x[0] * x[0]) -
		   spring->k_v * (v[0] + spring->cubic * v[0] * v[0] * v[0]);
	return spring->fails_after > 0 && spring->calls > spring->fails_after;
}

static inline int spring_tangent(void* user, double t, const double* x, const double* v, double* stiffness,
								 double* damping) {
	const Spring* spring = user;
	(void)t;
	*stiffness = spring->k_x * (1 + 3 * spring->cubic * x[0] * x[0]);
	*damping = spring->k_v * (1 + 3 * spring->cubic * v[0] * v[0]);
	return 0;
}

static inline const Spring* the_spring(void) {
	static const Spring spring = {.k_x = 100, .k_v = 1, .cubic = 1};
	return &spring;
}

/// A simulation of a spring. `settings` as for jn_sim_create_for.
typedef struct SpringCase {
	Spring spring;
	JnSystem* sys;
	JnSim* sim;
} SpringCase;

static inline JnStatus spring_open(SpringCase* c, const Spring* spring, const char* settings) {
	const double x = -1, v = 0;
	*c = (SpringCase){.spring = *spring};
	const JnUserSystemDef def = {.count = 1, .user = &c->spring, .force = spring_force, .tangent = spring_tangent};
	assert_int_equal(jn_user_system_create(&def, &c->sys), JN_OK);
	return jn_sim_create_for(c->sys, settings, &x, &v, &c->sim);
}

static inline void spring_close(SpringCase* c) {
	jn_sim_destroy(c->sim);
	jn_user_system_destroy(c->sys);
}

/// What a whole run came to.
typedef struct SpringRun {
	int steps, rejected, solves, forces;
	double x, v, largest_dt;
} SpringRun;

static inline SpringRun spring_run(const Spring* spring, const char* settings) {
	SpringCase c;
	SpringRun run = {0};
	assert_int_equal(spring_open(&c, spring, settings), JN_OK);
	while (!jn_sim_is_done(c.sim)) {
		assert_int_equal(jn_sim_step(c.sim), JN_OK);
		const JnReport* report = jn_sim_last_report(c.sim);
		run.rejected += report->rejected;
		run.solves += report->solves;
		run.forces += report->forces;
		run.largest_dt = fmax(run.largest_dt, jn_sim_last_dt(c.sim));
	}
	run.steps = (int)jn_sim_steps(c.sim);
	run.x = jn_sim_state(c.sim)->x[0];
	run.v = jn_sim_state(c.sim)->v[0];
	spring_close(&c);
	return run;
}

#endif
