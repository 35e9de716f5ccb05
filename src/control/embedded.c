// The estimate is JnReport.error: the largest entry of the difference between the method's positions and those of the embedded
// method, by the weights of the table.
#include "control/embedded.h"

#include "base/log.h"
#include "control/pi.h"
#include "integrate/tableau.h"

typedef struct EmbeddedMemory {
	JnPiMemory pi; // first: jn_pi_explain reads it
	double order;
} EmbeddedMemory;

static int error_order(const JnIntegratorType* method) {
	JnTableauProperties properties = {0};
	if (method->properties != NULL) method->properties(method->table, &properties);
	return properties.error_order;
}

static JnStatus check(const JnController* self) {
	JN_TRY(jn_pi_check(self));
	if (error_order(self->integrator->type) > 0) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s.controller: embedded cannot serve %s, which has no embedded error estimate; choose force_error, "
		"zienkiewicz_xie (for Newmark's family) or step_doubling, or a method that has one, such as sdirk2",
		self->path, self->integrator->type->row.name);
}

static JnStatus create(JnController* self) {
	((EmbeddedMemory*)self->memory)->order = error_order(self->integrator->type);
	return JN_OK;
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	EmbeddedMemory* memory = self->memory;
	return jn_pi_judge(self->options, &memory->pi, step, outcome, step->report.error, memory->order, self->vectors[0],
					   verdict);
}

const JnControllerType jn_controller_embedded = {
	.row = {.name = "embedded",
			.doc = "steps by the error estimate of methods that have one (SDIRK, ESDIRK, Rosenbrock), with PI control",
			.keys = jn_pi_keys,
			.options_size = sizeof(JnPiDef)},
	.memory_size = sizeof(EmbeddedMemory),
	.vectors = 1,
	.check = check,
	.create = create,
	.first = jn_pi_first,
	.judge = judge,
	.explain = jn_pi_explain,
};
