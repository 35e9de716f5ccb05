// The Van der Pol oscillator, x'' = mu (1 - x^2) x' - x, stiff for large mu: velocity-dependent forces with a tangent of
// your own, stepped by several methods at the same step.
//
//   cc van_der_pol.c $(pkg-config --cflags --libs jounce) -o van_der_pol
#include <stdio.h>

#include "jounce/extend.h"
#include "jounce/jounce.h"

static int force(void* user, double t, const double* x, const double* v, double* f) {
	const double mu = *(const double*)user;
	(void)t;
	f[0] = mu * (1 - x[0] * x[0]) * v[0] - x[0];
	return 0;
}

// K = -df/dx, D = -df/dv
static int tangent(void* user, double t, const double* x, const double* v, double* stiffness, double* damping) {
	const double mu = *(const double*)user;
	(void)t;
	stiffness[0] = 2 * mu * x[0] * v[0] + 1;
	damping[0] = -mu * (1 - x[0] * x[0]);
	return 0;
}

static JnStatus run(JnSystem* sys, const char* method) {
	char settings[160];
	const double x[1] = {2}, v[1] = {0};
	JnSim* sim = NULL;
	snprintf(settings, sizeof settings, "{duration: 100 s, step: {dt: 20 ms}, integrator: {method: %s}}", method);
	JnStatus status = jn_sim_create_for(sys, settings, x, v, &sim);
	while (status == JN_OK && !jn_sim_is_done(sim)) status = jn_sim_step(sim);
	if (status == JN_OK)
		printf("%-16s x(%g) = %.6f after %ld steps\n", method, jn_sim_state(sim)->t, jn_sim_state(sim)->x[0],
			   jn_sim_steps(sim));
	jn_sim_destroy(sim);
	return status;
}

int main(void) {
	static const char* const methods[] = {"backward_euler", "sdirk2", "tr_bdf2", "esdirk436"};
	double mu = 100;
	const JnUserSystemDef def = {.count = 1, .user = &mu, .force = force, .tangent = tangent};
	JnSystem* sys = NULL;
	JnStatus status = jn_user_system_create(&def, &sys);
	for (int i = 0; i < 4 && status == JN_OK; ++i) status = run(sys, methods[i]);
	jn_user_system_destroy(sys);
	return status == JN_OK ? 0 : 1;
}
