// The inverse 3x3 diagonal blocks (block-Jacobi), one set a slot.
#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"
#include "base/parallel.h"
#include "math/mat3.h"
#include "solve/precondition.h"
#include "solve/single_algebra.h"

enum { GRAIN = 16384 }; // nodes a thread should have before it is worth waking

typedef struct Block {
	JnPrecondition base;
	const JnPattern* pattern;
	const bool* held;
	const JnOperator* matrices;
	const JnSingleAlgebra* algebra;
	int threads;
	float* inverse[JN_SOLVER_SLOTS]; // JN_SINGLE_INVERSE a node
} Block;

static void destroy(JnPrecondition* precondition) {
	if (precondition == NULL) return;
	Block* block = (Block*)precondition;
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) jn_aligned_free(block->inverse[slot]);
	free(block);
}

static JnStatus create(const JnPattern* pattern, const bool* held, int threads, const JnOperator* matrices,
					   JnPrecondition** out) {
	Block* block = calloc(1, sizeof *block);
	*out = NULL;
	if (block == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: preconditioner");
	*block = (Block){
		.pattern = pattern, .held = held, .matrices = matrices, .algebra = jn_single_algebra(), .threads = threads};
	const double product = 9 * (2.0 * pattern->blocks - pattern->nodes);
	block->base = (JnPrecondition){.type = &jn_precondition_block,
								   .setup_products = 1, // the diagonal takes a pass over the elements
								   .apply_products = 9.0 * pattern->nodes / product};
	*out = &block->base;
	return JN_OK;
}

// The minors that Cholesky's pivots are made of.
static bool is_positive(double A[3][3]) {
	return A[0][0] > 0 && A[0][0] * A[1][1] - A[1][0] * A[0][1] > 0 && mat3_determinant(A) > 0;
}

// Of the block without its held rows and columns, which become 0. False: it is not positive definite.
static bool invert(const double* diagonal, const bool* held, float* inverse) {
	double A[3][3], B[3][3];
	memcpy(A, diagonal, sizeof A);
	for (int k = 0; k < 9; ++k)
		if (held[k / 3] || held[k % 3]) A[k / 3][k % 3] = k % 4 == 0;
	if (!is_positive(A)) return false;
	mat3_invert(A, B);
	for (int row = 0; row < 3; ++row)
		for (int column = 0; column < 3; ++column)
			inverse[4 * column + row] = held[row] || held[column] ? 0 : (float)B[row][column];
	return true;
}

static JnStatus update(JnPrecondition* precondition, int slot, bool renew) {
	(void)renew; // cheap: always that of the present matrix
	Block* block = (Block*)precondition;
	const int nodes = block->pattern->nodes;
	if (block->inverse[slot] == NULL) block->inverse[slot] = jn_single_vector(JN_SINGLE_INVERSE * (size_t)nodes);
	if (block->inverse[slot] == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: diagonal blocks of %d nodes", nodes);
	const double* diagonal = block->matrices->diagonal(block->matrices->user, slot);
	for (int node = 0; node < nodes; ++node)
		if (!invert(diagonal + 9 * (size_t)node, block->held + 3 * (size_t)node,
					block->inverse[slot] + JN_SINGLE_INVERSE * (size_t)node))
			return JN_INDEFINITE;
	return JN_OK;
}

static void apply(JnPrecondition* precondition, int slot, const float* r, float* z) {
	const Block* block = (const Block*)precondition;
	const int nodes = block->pattern->nodes, team = jn_threads_for((size_t)nodes, GRAIN, block->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int part = 0; part < team; ++part) {
		const size_t first = (size_t)((long)nodes * part / team), last = (size_t)((long)nodes * (part + 1) / team);
		block->algebra->apply_blocks(last - first, block->inverse[slot] + JN_SINGLE_INVERSE * first, r + 4 * first,
									 z + 4 * first);
	}
}

static size_t bytes(const JnPrecondition* precondition) {
	return JN_SINGLE_INVERSE * (size_t)((const Block*)precondition)->pattern->nodes * sizeof(float);
}

const JnPreconditionType jn_precondition_block = {
	.name = "block", .create = create, .destroy = destroy, .update = update, .apply = apply, .bytes = bytes};
