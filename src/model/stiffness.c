// Where K stands, and when it is made. What freezes (rotations of a step's start) or breaks is that of the present moment.
#include "model/stiffness.h"

#include <stdlib.h>
#include <string.h>

#include "model/repulsion.h"

// Whether M is the sum over solid elements whose Jacobian at rest is constant.
static bool mass_is_of_elements(const JnModel* model) {
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		if (body->mass_form != 0 || body->law->build != jn_solid_build) return false;
		for (int g = 0; g < body->group_count; ++g)
			if (model->groups[body->first_group + g].rest_points != 1) return false;
	}
	return true;
}

JnStatus jn_stiffness_create(JnModelSystem* sys) {
	JnModel* model = sys->model;
	const size_t blocks = 9 * (size_t)model->pattern.blocks, diagonal = 9 * (size_t)model->node_count;
	JN_NEW(&model->arena, sys->linear_x, 3 * (size_t)model->node_count);
	JN_NEW(&model->arena, sys->stiffness, blocks);
	JN_NEW(&model->arena, sys->scratch, blocks);
	if (!model->is_matrix_free) JN_NEW(&model->arena, sys->diagonal, diagonal);
	JN_NEW(&model->arena, sys->shifted_diagonal, diagonal);
	JN_NEW(&model->arena, sys->wide_in, 3 * (size_t)model->node_count);
	JN_NEW(&model->arena, sys->wide_out, 3 * (size_t)model->node_count);
	if (mass_is_of_elements(model)) JN_NEW(&model->arena, sys->group_mass, model->group_count + 1);
	sys->has_products = true;
	for (int g = 0; g < model->group_count; ++g) sys->has_products &= model->groups[g].kernel->product != NULL;
	return JN_OK;
}

void jn_stiffness_destroy(JnModelSystem* sys) {
	JnStored* const stored[] = {&sys->single[0], &sys->single[1], &sys->damping_single};
	for (int i = 0; i < 3; ++i) jn_stored_free(stored[i]);
	free(sys->full_mass);
	free(sys->full_alpha);
}

void jn_stiffness_set(JnModelSystem* sys, const double* x) {
	memcpy(sys->linear_x, x, 3 * (size_t)sys->model->node_count * sizeof *x);
	sys->stiffness_is_assembled = false;
	sys->single_is_current[0] = sys->single_is_current[1] = false;
}

const JnStored* jn_stiffness_single(JnModelSystem* sys, JnDefinite definite) {
	const int form = definite == JN_DEFINITE;
	const JnTangentAt at = {.x = sys->linear_x, .definite = definite};
	if (!sys->single_is_current[form])
		sys->single_is_current[form] = jn_assembly_store(sys->assembly, at, &sys->single[form]);
	return sys->single_is_current[form] ? &sys->single[form] : NULL;
}

static void assemble(JnModelSystem* sys, JnDefinite definite, double* blocks) {
	jn_assembly_tangent(sys->assembly, sys->linear_x, definite, NULL, blocks);
	if (sys->model->repulsion != NULL) jn_repulsion_add_diagonal(sys->model->repulsion, definite, blocks);
}

const double* jn_stiffness_blocks(JnModelSystem* sys, JnDefinite definite) {
	if (definite == JN_DEFINITE) {
		assemble(sys, definite, sys->scratch);
		return sys->scratch;
	}
	if (!sys->stiffness_is_assembled) assemble(sys, definite, sys->stiffness);
	sys->stiffness_is_assembled = true;
	return sys->stiffness;
}

const double* jn_stiffness_diagonal(JnModelSystem* sys, JnDefinite definite) {
	const JnTangentAt at = {.x = sys->linear_x, .definite = definite};
	if (sys->model->is_matrix_free) return jn_stiffness_blocks(sys, definite);
	jn_assembly_diagonal(sys->assembly, at, sys->diagonal);
	return sys->diagonal;
}

void jn_stiffness_apply(JnModelSystem* sys, JnDefinite definite, double scale, const double* in, double* out) {
	const JnTangentAt at = {.x = sys->linear_x, .definite = definite};
	if (sys->has_products) // even where blocks are at hand: rounding must not tell what was asked before
		jn_assembly_product(sys->assembly, at, scale, in, out);
	else
		jn_blocks_apply(&sys->model->pattern, jn_stiffness_blocks(sys, definite), scale, in, out, sys->model->threads);
	if (sys->model->repulsion != NULL) jn_repulsion_product(sys->model->repulsion, definite, scale, in, out);
}
