// Making the contact pass of a model, and its memory.
#include "pass/contact.h"

#include <string.h>

void jn_contact_destroy(JnPass* base) {
	JnContactPass* pass = (JnContactPass*)base;
	jn_detector_destroy(pass->detector);
	jn_body_matrices_release(&pass->matrices);
	jn_qp_destroy(pass->qp);
	jn_contact_rows_release(&pass->now);
	jn_contact_rows_release(&pass->kept);
	jn_contact_rows_release(&pass->last);
	free(pass->found.at);
	jn_contact_rows_release(&pass->part);
	JnArena arena = pass->arena; // holds the pass itself
	jn_arena_free(&arena);
}

static JnStatus allocate(JnContactPass* pass) {
	JnArena* arena = &pass->arena;
	const size_t n = jn_contact_entries(pass);
	const int bodies = pass->model->body_count;
	JN_NEW(arena, pass->parent, bodies);
	JN_NEW(arena, pass->island_of, bodies);
	JN_NEW(arena, pass->moves, bodies);
	JN_NEW(arena, pass->is_in, bodies);
	JN_NEW(arena, pass->is_filled, bodies);
	JN_NEW(arena, pass->first_node, bodies + 1);
	JN_NEW(arena, pass->held, n);
	JN_NEW(arena, pass->free_v, n);
	JN_NEW(arena, pass->v, n);
	JN_NEW(arena, pass->solved, n);
	JN_NEW(arena, pass->work, n);
	JN_NEW(arena, pass->corrected, n);
	JN_NEW(arena, pass->load, n);
	JN_NEW(arena, pass->tried, n);
	JN_NEW(arena, pass->force, n);
	JN_NEW(arena, pass->gap, n / 3);
	for (int b = 0; b < bodies; ++b) pass->first_node[b] = pass->model->bodies[b].first_node;
	pass->first_node[bodies] = pass->model->node_count;
	for (size_t k = 0; k < n; ++k) pass->held[k] = true;
	for (size_t k = 0; k < n / 3; ++k) pass->gap[k] = pass->margin;
	return JN_OK;
}

static JnStatus build(JnContactPass* pass) {
	JN_TRY(jn_contact_surfaces_create(pass));
	JN_TRY(allocate(pass));
	for (int b = 0; b < pass->model->body_count; ++b) pass->moves[b] = pass->skin_of[b] >= 0;
	JN_TRY(jn_body_matrices_create(pass->model, pass->moves, &pass->matrices));
	const JnVariant* solver = &pass->def->solver;
	return jn_qp_create((const JnQpType*)solver->row, solver->options, &pass->qp);
}

JnStatus jn_contact_create(const void* options, JnModel* model, JnPass** out) {
	JnArena arena = {0};
	JnContactPass* pass;
	*out = NULL;
	JN_NEW(&arena, pass, 1);
	pass->arena = arena;
	pass->base.type = &jn_pass_contact;
	pass->def = options;
	pass->model = model;
	pass->sys = (JnModelSystem*)model->system;
	const JnStatus status = build(pass);
	if (status == JN_OK)
		*out = &pass->base;
	else
		jn_contact_destroy(&pass->base);
	return status;
}
