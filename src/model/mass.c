#include "model/mass.h"

enum { MOST_NODES = 10 };

static void lump(JnShape shape, int nodes, double* matrix) {
	double total = 0, trace = 0, rows[MOST_NODES] = {0};
	for (int i = 0; i < nodes; ++i) {
		trace += matrix[i * nodes + i];
		for (int j = 0; j < nodes; ++j) rows[i] += matrix[i * nodes + j];
		total += rows[i];
	}
	for (int i = 0; i < nodes; ++i) {
		const double share = shape == JN_TET10 ? matrix[i * nodes + i] * total / trace : rows[i];
		for (int j = 0; j < nodes; ++j) matrix[i * nodes + j] = i == j ? share : 0;
	}
}

static void add_body(JnModel* model, const JnBody* body) {
	const int nodes = jn_shape_info[body->mesh.shape].nodes;
	double matrix[MOST_NODES * MOST_NODES];
	for (int cell = 0; cell < body->mesh.cell_count; ++cell) {
		jn_group_cell_mass(&body->mesh, cell, body->density, matrix);
		if (body->mass_form == 1) lump(body->mesh.shape, nodes, matrix);
		const int* node = body->cells + (size_t)cell * (size_t)nodes;
		for (int i = 0; i < nodes; ++i)
			for (int j = 0; j < nodes; ++j) {
				if (node[i] < node[j]) continue;
				const int block = jn_pattern_find(&model->pattern, node[i], node[j]);
				model->mass[block] += matrix[i * nodes + j];
				if (model->alpha_mass != NULL) model->alpha_mass[block] += body->damping.alpha * matrix[i * nodes + j];
			}
	}
}

static void sum_rows(JnModel* model) {
	const JnPattern* pattern = &model->pattern;
	for (int i = 0; i < pattern->nodes; ++i) {
		double sum = 0;
		for (int k = pattern->full_start[i]; k < pattern->full_start[i + 1]; ++k) {
			const int block = pattern->full_block[k];
			sum += model->mass[block >= 0 ? block : ~block];
		}
		model->nodal_mass[i] = sum;
		model->total_mass += sum;
	}
}

JnStatus jn_mass_build(JnModel* model) {
	bool has_alpha = false;
	model->mass_is_diagonal = true;
	for (int b = 0; b < model->body_count; ++b) {
		has_alpha |= model->bodies[b].damping.alpha > 0;
		model->has_beta |= jn_body_has_beta(model, &model->bodies[b]);
		model->mass_is_diagonal &= model->bodies[b].mass_form == 1 || model->bodies[b].mesh.shape == JN_POINT1;
	}
	JN_NEW(&model->arena, model->mass, model->pattern.blocks);
	JN_NEW(&model->arena, model->nodal_mass, model->node_count);
	if (has_alpha) JN_NEW(&model->arena, model->alpha_mass, model->pattern.blocks);
	for (int b = 0; b < model->body_count; ++b) add_body(model, &model->bodies[b]);
	sum_rows(model);
	return JN_OK;
}
