/// @file script_controller.h
/// A controller that takes steps of given sizes, so that a run may be taken again without the attempts that it refused.
#ifndef JN_TEST_PASS_SCRIPT_CONTROLLER_H
#define JN_TEST_PASS_SCRIPT_CONTROLLER_H

#include "control/controller.h"
#include "pass/pass_case.h"

enum { SCRIPT_MOST = 8000 };

/// Steps of given sizes.
typedef struct Script {
	int count, next;
	double sizes[SCRIPT_MOST];
} Script;

static inline double script_first(JnController* self) {
	return ((const Script*)self->options)->sizes[0];
}

static inline JnStatus script_judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	Script* script = (Script*)self->options;
	(void)step;
	assert_int_equal(outcome, JN_OK);
	++script->next;
	*verdict = (JnVerdict){.accepted = true, .dt = script->next < script->count ? script->sizes[script->next] : 1};
	return JN_OK;
}

static const JnControllerType script_type = {
	.row = {.name = "script", .doc = "steps of given sizes"}, .first = script_first, .judge = script_judge};

#endif
