#include "blocks.h"

#include "model/model.h"
#include "model/stiffness.h"

JnStatus peer_blocks(const Peer* peer, bool is_full, PeerBlocks* out) {
	const JnModel* model = jn_sim_model(peer->sim);
	const JnModelSystem* sys = (const JnModelSystem*)peer->sys;
	if (model == NULL || model->is_matrix_free || model->has_beta || model->alpha_mass != NULL ||
		sys->unsymmetric != NULL)
		return fputs("only the matrix of an undamped model without wind can be had in blocks\n", stderr), JN_BAD_INPUT;
	const JnPattern* pattern = &model->pattern;
	*out = (PeerBlocks){is_full, pattern->nodes, is_full ? pattern->full_start : pattern->column_start,
						is_full ? pattern->full_column : pattern->row};
	return JN_OK;
}

typedef struct Fill {
	const JnModel* model;
	const double* K;
	double mass, stiffness;
} Fill;

// The stored block of (row, column), by rows, to the place of (row, column), by columns.
static void fill_block(const Fill* fill, int row, int column, int block, bool is_transposed, double* out) {
	for (int e = 0; e < 9; ++e) {
		const int i = e % 3, j = e / 3, a = 3 * row + i, b = 3 * column + j;
		const double inertia = i == j ? fill->mass * fill->model->mass[block] : 0;
		const double k = fill->K[9 * (size_t)block + (size_t)(is_transposed ? 3 * j + i : 3 * i + j)];
		const bool is_held = fill->model->held[a] || fill->model->held[b];
		out[e] = !is_held ? inertia + fill->stiffness * k : (a == b ? inertia : 0);
	}
}

// Column c of the stored lower triangle is row c of the upper one, its blocks transposed.
void peer_fill_blocks(const Peer* peer, const PeerBlocks* blocks, double mass, double stiffness, double* numbers) {
	const JnModel* model = jn_sim_model(peer->sim);
	const JnPattern* pattern = &model->pattern;
	const Fill fill = {model, jn_stiffness_blocks((JnModelSystem*)peer->sys, JN_EXACT), mass, stiffness};
	for (int row = 0; row < blocks->nodes; ++row)
		for (int k = blocks->row_start[row]; k < blocks->row_start[row + 1]; ++k) {
			const int stored = blocks->is_full ? pattern->full_block[k] : ~k;
			const int block = stored >= 0 ? stored : ~stored;
			fill_block(&fill, row, blocks->column[k], block, stored < 0, numbers + 9 * (size_t)k);
		}
}
