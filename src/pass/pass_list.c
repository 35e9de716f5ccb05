// The passes that simulations may run, and running them.
#include "pass/pass.h"

const JnPassType* const jn_pass_list[] = {&jn_pass_contact, &jn_pass_fracture, NULL};

JnStatus jn_passes_create(const JnSimDef* def, JnModel* model, JnPasses* passes) {
	*passes = (JnPasses){0};
	for (int i = 0; jn_pass_list[i] != NULL; ++i) {
		const JnPassType* type = jn_pass_list[i];
		const void* place = (const char*)def + type->definition;
		const void* options = type->is_always ? place : *(const void* const*)place;
		JnPass* pass = NULL;
		const JnStatus status = options != NULL ? type->create(options, model, &pass) : JN_OK;
		if (pass != NULL) passes->list[passes->count++] = pass;
		if (status == JN_OK) continue;
		jn_passes_destroy(passes);
		return status;
	}
	return JN_OK;
}

void jn_passes_destroy(JnPasses* passes) {
	for (int i = 0; i < passes->count; ++i) passes->list[i]->type->destroy(passes->list[i]);
	passes->count = 0;
}

JnStatus jn_passes_prepare(JnPasses* passes, const JnStep* step, int round) {
	for (int i = 0; i < passes->count; ++i)
		if (passes->list[i]->type->prepare != NULL)
			JN_TRY(passes->list[i]->type->prepare(passes->list[i], step, round));
	return JN_OK;
}

JnStatus jn_passes_correct(JnPasses* passes, JnStep* step, int round, bool* edited, bool* again) {
	*edited = *again = false;
	for (int i = 0; i < passes->count; ++i) {
		bool did_edit = false, wants_more = false;
		if (passes->list[i]->type->correct == NULL) continue;
		JN_TRY(passes->list[i]->type->correct(passes->list[i], step, round, &did_edit, &wants_more));
		*edited |= did_edit;
		*again |= wants_more;
	}
	return JN_OK;
}

void jn_passes_commit(JnPasses* passes, const JnStep* step) {
	for (int i = 0; i < passes->count; ++i)
		if (passes->list[i]->type->commit != NULL) passes->list[i]->type->commit(passes->list[i], step);
}

void jn_passes_explain(const JnPasses* passes, size_t size, char* text) {
	text[0] = '\0';
	for (int i = 0; i < passes->count && text[0] == '\0'; ++i)
		if (passes->list[i]->type->explain != NULL) passes->list[i]->type->explain(passes->list[i], size, text);
}
