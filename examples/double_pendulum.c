// A double pendulum, solved by an energy-conserving method: your own equations M(q) q'' = f, brought to constant mass.
//
// Two points of mass m1, m2 on stiff springs of lengths l1, l2, in Cartesian coordinates: M is constant and the rods are
// springs, so that the system fits M a = f(t, x, v) as it is.
//
//   cc double_pendulum.c $(pkg-config --cflags --libs jounce) -o double_pendulum
#include <math.h>
#include <stdio.h>

#include "jounce/extend.h"
#include "jounce/jounce.h"

typedef struct Pendulum {
	double mass[2], length[2], stiffness; // [kg], [m], [N/m]
} Pendulum;

// Spring force on the far end of a rod that stretches by d = (dx, dy).
static double pull(const Pendulum* p, int rod, double dx, double dy) {
	const double length = hypot(dx, dy);
	return -p->stiffness * (length - p->length[rod]) / length;
}

static int force(void* user, double t, const double* x, const double* v, double* f) {
	const Pendulum* p = user;
	(void)t, (void)v;
	const double dx = x[2] - x[0], dy = x[3] - x[1];
	const double first = pull(p, 0, x[0], x[1]), second = pull(p, 1, dx, dy);
	f[0] = first * x[0] - second * dx;
	f[1] = first * x[1] - second * dy - 9.81 * p->mass[0];
	f[2] = second * dx;
	f[3] = second * dy - 9.81 * p->mass[1];
	return 0;
}

static double potential(void* user, double t, const double* x) {
	const Pendulum* p = user;
	(void)t;
	const double s1 = hypot(x[0], x[1]) - p->length[0], s2 = hypot(x[2] - x[0], x[3] - x[1]) - p->length[1];
	return 0.5 * p->stiffness * (s1 * s1 + s2 * s2) + 9.81 * (p->mass[0] * x[1] + p->mass[1] * x[3]);
}

static double energy(Pendulum* p, const JnState* s) {
	const double kinetic = 0.5 * p->mass[0] * (s->v[0] * s->v[0] + s->v[1] * s->v[1]) +
						   0.5 * p->mass[1] * (s->v[2] * s->v[2] + s->v[3] * s->v[3]);
	return kinetic + potential(p, s->t, s->x);
}

int main(void) {
	Pendulum pendulum = {.mass = {1, 0.5}, .length = {1, 0.7}, .stiffness = 1e5};
	const double mass[16] = {[0] = 1, [5] = 1, [10] = 0.5, [15] = 0.5};
	const JnUserSystemDef def = {
		.count = 4, .user = &pendulum, .force = force, .energy = potential, .mass = mass}; // K by differences
	const double x[4] = {1, 0, 1.7, 0}, v[4] = {0};
	JnSystem* sys = NULL;
	JnSim* sim = NULL;
	if (jn_user_system_create(&def, &sys) != JN_OK) return 1;
	const char* settings = "{duration: 5 s, step: {dt: 2 ms}, integrator: {method: average_vector_field}}";
	JnStatus status = jn_sim_create_for(sys, settings, x, v, &sim);
	const double start = status == JN_OK ? energy(&pendulum, jn_sim_state(sim)) : 0;
	while (status == JN_OK && !jn_sim_is_done(sim)) status = jn_sim_step(sim);
	if (status == JN_OK) {
		const JnState* s = jn_sim_state(sim);
		printf("t = %g s: points at (%.4f, %.4f) and (%.4f, %.4f) m, energy %.9f J, changed by %.2e J\n", s->t, s->x[0],
			   s->x[1], s->x[2], s->x[3], energy(&pendulum, s), energy(&pendulum, s) - start);
	}
	jn_sim_destroy(sim);
	jn_user_system_destroy(sys);
	return status == JN_OK ? 0 : 1;
}
