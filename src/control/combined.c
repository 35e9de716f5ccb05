// Several controllers judge each attempt: it is accepted only if all accept it, and the smallest of the sizes that they want
// comes next.
#include "control/combined.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/log.h"
#include "control/controller.h"

typedef struct CombinedDef {
	JnItems rules; // JnVariant
} CombinedDef;

typedef struct CombinedMemory {
	JnController** rules; // one a rule
	int failed;           // rule that ended the run
} CombinedMemory;

static int count_of(const JnController* self) {
	return ((const CombinedDef*)self->options)->rules.count;
}

static JnStatus check(const JnController* self) {
	if (count_of(self) > 0) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.rules: is empty; list the controllers that must agree, such as [force_error, embedded]",
					self->path);
}

static JnStatus create(JnController* self) {
	const JnVariant* rules = ((const CombinedDef*)self->options)->rules.data;
	CombinedMemory* memory = self->memory;
	memory->rules = calloc((size_t)count_of(self), sizeof(JnController*));
	if (memory->rules == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: controllers");
	for (int i = 0; i < count_of(self); ++i) {
		char path[sizeof self->path + 24];
		snprintf(path, sizeof path, "%s.rules[%d]", self->path, i);
		JN_TRY(jn_controller_create(&rules[i], path, self->integrator, self->sys, &memory->rules[i]));
	}
	return JN_OK;
}

static void destroy(JnController* self) {
	CombinedMemory* memory = self->memory;
	for (int i = 0; memory->rules != NULL && i < count_of(self); ++i) jn_controller_destroy(memory->rules[i]);
	free(memory->rules);
}

static double first(JnController* self) {
	CombinedMemory* memory = self->memory;
	double dt = INFINITY;
	for (int i = 0; i < count_of(self); ++i) dt = fmin(dt, memory->rules[i]->type->first(memory->rules[i]));
	return dt;
}

static JnStatus prepare(JnController* self, const JnStep* step) {
	CombinedMemory* memory = self->memory;
	for (int i = 0; i < count_of(self); ++i) JN_TRY(jn_controller_prepare(memory->rules[i], step));
	return JN_OK;
}

static JnStatus judge(JnController* self, JnStep* step, JnStatus outcome, JnVerdict* verdict) {
	CombinedMemory* memory = self->memory;
	*verdict = (JnVerdict){.accepted = true, .dt = INFINITY};
	for (int i = 0; i < count_of(self); ++i) {
		JnController* rule = memory->rules[i];
		JnVerdict one = {0};
		memory->failed = i;
		JN_TRY(rule->type->judge(rule, step, outcome, &one));
		verdict->accepted &= one.accepted;
		verdict->dt = fmin(verdict->dt, one.dt);
	}
	return JN_OK;
}

static void explain(const JnController* self, JnComplaint* complaint) {
	const CombinedMemory* memory = self->memory;
	jn_controller_explain(memory->rules[memory->failed], complaint);
}

static const JnKey keys[] = {
	{.name = "rules",
	 .kind = JN_LIST,
	 .field = offsetof(CombinedDef, rules),
	 .required = true,
	 .rows = &jn_controller_list,
	 .tag = "controller",
	 .size = sizeof(JnVariant),
	 .meaning = "the controllers, by their names or with their keys"},
	{0},
};

static void archive_rules(JnController* self, JnArchive* archive) {
	CombinedMemory* memory = self->memory;
	for (int i = 0; i < count_of(self); ++i) jn_controller_archive(memory->rules[i], archive);
}

const JnControllerType jn_controller_combined = {
	.row = {.name = "combined",
			.doc = "several controllers: a step is accepted if all accept it, and the smallest size wanted comes next",
			.keys = keys,
			.options_size = sizeof(CombinedDef)},
	.memory_size = sizeof(CombinedMemory),
	.check = check,
	.create = create,
	.destroy = destroy,
	.first = first,
	.prepare = prepare,
	.judge = judge,
	.explain = explain,
	.archive = archive_rules,
};
