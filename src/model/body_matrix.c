#include "model/body_matrix.h"

#include <string.h>

#include "base/log.h"
#include "base/timer.h"
#include "model/damping.h"

enum { SLOT = 0 }; // of each body's solver, which keeps one factor

// The columns of a body in the model's pattern, with its own node numbers. Bodies share no nodes, so that they are whole.
static JnStatus cut_pattern(const JnPattern* all, int first, int nodes, JnArena* arena, JnPattern* out) {
	const int begin = all->column_start[first], full = all->full_start[first];
	*out = (JnPattern){.nodes = nodes, .blocks = all->column_start[first + nodes] - begin};
	const int places = all->full_start[first + nodes] - full;
	JN_NEW(arena, out->column_start, nodes + 1);
	JN_NEW(arena, out->row, out->blocks + 1);
	JN_NEW(arena, out->full_start, nodes + 1);
	JN_NEW(arena, out->full_column, places + 1);
	JN_NEW(arena, out->full_block, places + 1);
	for (int i = 0; i <= nodes; ++i) {
		out->column_start[i] = all->column_start[first + i] - begin;
		out->full_start[i] = all->full_start[first + i] - full;
	}
	for (int k = 0; k < out->blocks; ++k) out->row[k] = all->row[begin + k] - first;
	for (int k = 0; k < places; ++k) {
		const int block = all->full_block[full + k];
		out->full_column[k] = all->full_column[full + k] - first;
		out->full_block[k] = block >= 0 ? block - begin : ~(~block - begin);
	}
	return JN_OK;
}

static bool has_free_entry(const bool* held, int count) {
	for (int k = 0; k < count; ++k)
		if (!held[k]) return true;
	return false;
}

static JnStatus create_body(JnModel* model, int index, JnBodyMatrices* matrices) {
	static const JnDirectDef options = {.precision = 1}; // contact asks for full solves alone
	const JnBody* body = &model->bodies[index];
	JnBodyMatrix* matrix = &matrices->bodies[index];
	const int nodes = body->mesh.node_count;
	matrix->held = model->held + 3 * (size_t)body->first_node;
	matrix->blocks = matrices->blocks + 9 * (size_t)model->pattern.column_start[body->first_node];
	JN_TRY(cut_pattern(&model->pattern, body->first_node, nodes, &model->system_arena, &matrix->pattern));
	if (!has_free_entry(matrix->held, 3 * nodes)) return JN_OK;
	return jn_solver_direct.create(&options, &matrix->pattern, matrix->held, model->threads, &matrix->solver);
}

JnStatus jn_body_matrices_create(JnModel* model, const bool* wanted, JnBodyMatrices* out) {
	*out = (JnBodyMatrices){.sys = (JnModelSystem*)model->system};
	for (int b = 0; b < model->body_count; ++b)
		if (wanted[b] && model->bodies[b].mesh.shape == JN_POINT1)
			return jn_error(
				JN_BAD_INPUT,
				"contact: '%s' is made of points, which have no surface; take contact away and give repulsion, or "
				"set contact.active: false in this body",
				model->bodies[b].name);
	if (model->is_matrix_free)
		return jn_error(JN_BAD_INPUT,
						"contact: needs assembled matrices; set solver.matrix: assembled, or take away contact");
	JN_NEW(&model->system_arena, out->blocks, 9 * (size_t)model->pattern.blocks);
	JN_NEW(&model->system_arena, out->weight, model->group_count + 1);
	JN_NEW(&model->system_arena, out->bodies, model->body_count);
	for (int b = 0; b < model->body_count; ++b)
		if (wanted[b]) JN_TRY(create_body(model, b, out));
	return JN_OK;
}

void jn_body_matrices_release(JnBodyMatrices* matrices) {
	if (matrices->bodies == NULL) return;
	for (int b = 0; b < matrices->sys->model->body_count; ++b)
		if (matrices->bodies[b].solver != NULL) jn_solver_direct.destroy(matrices->bodies[b].solver);
	matrices->bodies = NULL;
}

// blocks = m M + d D + k K of one body, K standing in them.
static void combine(JnModelSystem* sys, int index, JnShift shift, JnBodyMatrix* matrix) {
	const JnModel* model = sys->model;
	const int first = model->pattern.column_start[model->bodies[index].first_node];
	const double* all = shift.damping != 0 ? jn_damping_blocks(sys) : NULL;
	const double* damping = all != NULL ? all + 9 * (size_t)first : NULL;
	for (size_t k = 0; k < 9 * (size_t)matrix->pattern.blocks; ++k) {
		matrix->blocks[k] *= shift.stiffness;
		if (damping != NULL) matrix->blocks[k] += shift.damping * damping[k];
	}
	for (int k = 0; k < matrix->pattern.blocks; ++k) {
		double scalar = shift.mass * model->mass[first + k];
		if (sys->alpha_mass != NULL) scalar += shift.damping * sys->alpha_mass[first + k];
		for (int axis = 0; axis < 3; ++axis) matrix->blocks[9 * (size_t)k + 4 * (size_t)axis] += scalar;
	}
	matrix->is_factored = false;
}

void jn_body_matrices_fill(JnBodyMatrices* matrices, const bool* wanted, JnShift shift, const double* x) {
	JnModelSystem* sys = matrices->sys;
	const int count = sys->model->body_count;
	const double began = jn_seconds();
	for (int b = 0; b < count; ++b)
		for (int g = 0; g < sys->model->bodies[b].group_count; ++g)
			matrices->weight[sys->model->bodies[b].first_group + g] = wanted[b] ? 1 : 0;
	jn_assembly_tangent(sys->assembly, x, JN_DEFINITE, matrices->weight, matrices->blocks);
	++sys->base.report->tangents;
	for (int b = 0; b < count; ++b)
		if (wanted[b]) combine(sys, b, shift, &matrices->bodies[b]);
	sys->base.report->seconds_factor += jn_seconds() - began;
}

JnStatus jn_body_matrix_factor(JnBodyMatrices* matrices, int body) {
	JnBodyMatrix* matrix = &matrices->bodies[body];
	if (matrix->is_factored || matrix->solver == NULL) return JN_OK;
	JnReport* report = matrices->sys->base.report;
	const double began = jn_seconds();
	const JnStatus status = matrix->solver->type->factor(matrix->solver, SLOT, matrix->blocks);
	++report->factorizations;
	report->seconds_factor += jn_seconds() - began;
	matrix->is_factored = status == JN_OK;
	return status;
}
