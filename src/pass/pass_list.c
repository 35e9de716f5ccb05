// The passes that simulations may run, and running them.
#include "pass/pass.h"

#include "base/log.h"
#include "mesh/thread.h"
#include "model/model.h"

const JnPassType* const jn_pass_list[] = {&jn_pass_relax_before,
										  &jn_pass_contact,
										  &jn_pass_collision,
										  &jn_pass_suture,
										  &jn_pass_relax_after,
										  &jn_pass_fracture,
										  NULL};

// Both would move a thread's nodes, each without regard for the other.
static JnStatus check(const JnSimDef* def, const JnModel* model) {
	for (int b = 0; def->contact != NULL && def->collision != NULL && b < model->body_count; ++b)
		if (model->bodies[b].mesh.thread != NULL && model->bodies[b].contact.active)
			return jn_error(
				JN_BAD_INPUT,
				"collision: stands beside `contact:`, and both would move the thread '%s'; take one of them "
				"out",
				model->bodies[b].name);
	return JN_OK;
}

static JnStatus join(const JnPasses* passes) {
	for (int i = 0; i < passes->count; ++i)
		if (passes->list[i]->type->join != NULL)
			JN_TRY(passes->list[i]->type->join(passes->list[i], passes->list, passes->count));
	return JN_OK;
}

JnStatus jn_passes_create(const JnSimDef* def, JnModel* model, JnPasses* passes) {
	*passes = (JnPasses){0};
	JN_TRY(check(def, model));
	for (int i = 0; jn_pass_list[i] != NULL; ++i) {
		const JnPassType* type = jn_pass_list[i];
		const void* place = (const char*)def + type->definition;
		const void* options = type->is_always ? place : *(const void* const*)place;
		JnPass* pass = NULL;
		const JnStatus status = type->is_always || options != NULL ? type->create(options, model, &pass) : JN_OK;
		if (pass != NULL) passes->list[passes->count++] = pass;
		if (status == JN_OK) continue;
		jn_passes_destroy(passes);
		return status;
	}
	const JnStatus status = join(passes);
	if (status != JN_OK) jn_passes_destroy(passes);
	return status;
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

void jn_passes_react(const JnPasses* passes, double* force) {
	for (int i = 0; i < passes->count; ++i)
		if (passes->list[i]->type->react != NULL) passes->list[i]->type->react(passes->list[i], force);
}

void jn_passes_archive(JnPasses* passes, JnArchive* archive) {
	for (int i = 0; i < passes->count; ++i)
		if (passes->list[i]->type->archive != NULL) passes->list[i]->type->archive(passes->list[i], archive);
}

void jn_passes_explain(const JnPasses* passes, JnPassComplaint* out) {
	*out = (JnPassComplaint){.node = -1};
	for (int i = 0; i < passes->count && out->cause[0] == '\0'; ++i)
		if (passes->list[i]->type->explain != NULL) passes->list[i]->type->explain(passes->list[i], out);
}
