// Zienkiewicz and Xie 1991: Newmark's position lacks dt^3 (1/6 - beta) a' of a step with a linear acceleration, so that
//   e = dt^2 (beta - 1/6) (a1 - a0)
// estimates its error, of third order. It is zero for beta = 1/6. The norm is the largest length over nodes.
#include "control/zienkiewicz_xie.h"

#include <math.h>

#include "base/log.h"
#include "control/pi.h"

enum { ORDER = 3 };

static const double blind_beta = 1.0 / 6;

static JnStatus check(const JnController* self) {
	const JnIntegratorType* method = self->integrator->type;
	const double *a0, *a1;
	JN_TRY(jn_pi_check(self));
	if (method->newmark_beta == NULL)
		return jn_error(JN_BAD_INPUT,
						"%s.controller: zienkiewicz_xie cannot serve %s, which is no Newmark method; choose newmark, "
						"linearized_newmark, hht_alpha or generalized_alpha, or the controller embedded or force_error",
						self->path, method->row.name);
	if (fabs(method->newmark_beta(self->integrator, &a0, &a1) - blind_beta) > 1e-3) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.controller: zienkiewicz_xie sees no error of %s with beta = 1/6; choose another beta, such as "
					"1/4, or the controller force_error",
					self->path, method->row.name);
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	JnSpace* space = step->sys->space;
	JnVec error = self->vectors[0];
	double length = NAN;
	if (outcome == JN_OK) {
		const double *a0, *a1;
		const double beta = step->method->newmark_beta(self->integrator, &a0, &a1);
		const double scale = step->dt * step->dt * (beta - blind_beta);
		space->ops->combine(space, error, 2, (JnTerm[]){{scale, a1}, {-scale, a0}});
		step->sys->ops->hold(step->sys, error); // held nodes are where they should be
		length = space->ops->longest(space, error);
	}
	return jn_pi_judge(self->options, self->memory, step, outcome, length, ORDER, error, verdict);
}

const JnControllerType jn_controller_zienkiewicz_xie = {
	.row = {.name = "zienkiewicz_xie",
			.doc = "Zienkiewicz and Xie 1991: the change of acceleration tells Newmark's error; with PI control",
			.keys = jn_pi_keys,
			.options_size = sizeof(JnPiDef)},
	.memory_size = sizeof(JnPiMemory),
	.vectors = 1,
	.check = check,
	.first = jn_pi_first,
	.judge = judge,
	.explain = jn_pi_explain,
};
