// Conjugate gradients (Hestenes, Stiefel 1952) with the coefficient of Polak and Ribiere,
//   alpha = r.z / p.Ap,   x += alpha p,   r' = r - alpha Ap,   z' = B r',   p = z' + beta p,
//   beta = z'.(r' - r) / z.r = -alpha z'.Ap / z.r,
// which is that of Fletcher and Reeves as long as B is the same in every iteration, and bears rounding and a B that is not
// (Notay 2000). Vectors are cut into chunks; a chunk's sum does not depend on threads, and chunks are summed in order.
#include "solve/cg_single.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"
#include "base/parallel.h"

enum { GRAIN = 65536 }; // entries a thread should have before it is worth waking

JnStatus jn_cg_single_create(JnCgSingle* cg, const JnPattern* pattern, const bool* held, int threads) {
	const size_t length = jn_single_length(pattern->nodes), chunks = length / JN_SINGLE_CHUNK + 1;
	*cg = (JnCgSingle){.algebra = jn_single_algebra(), .nodes = pattern->nodes, .threads = threads, .length = length};
	float** const vectors[] = {&cg->x, &cg->r, &cg->z, &cg->p, &cg->q};
	bool is_complete = true;
	for (int i = 0; i < 5; ++i) is_complete &= (*vectors[i] = jn_single_vector(length)) != NULL;
	cg->partial = malloc(2 * chunks * sizeof *cg->partial);
	cg->held_list = malloc((3 * (size_t)pattern->nodes + 1) * sizeof *cg->held_list);
	if (!is_complete || cg->partial == NULL || cg->held_list == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: vectors of %zu numbers", length);
	for (size_t k = 0; k < 3 * (size_t)pattern->nodes; ++k)
		if (held[k]) cg->held_list[cg->held_count++] = 4 * (k / 3) + k % 3;
	return JN_OK;
}

void jn_cg_single_destroy(JnCgSingle* cg) {
	float* const vectors[] = {cg->x, cg->r, cg->z, cg->p, cg->q};
	for (int i = 0; i < 5; ++i) jn_aligned_free(vectors[i]);
	free(cg->partial);
	free(cg->held_list);
	*cg = (JnCgSingle){0};
}

static long chunks_of(const JnCgSingle* cg) {
	return (long)((cg->length + JN_SINGLE_CHUNK - 1) / JN_SINGLE_CHUNK);
}

static size_t size_of(const JnCgSingle* cg, size_t first) {
	return cg->length - first < JN_SINGLE_CHUNK ? cg->length - first : JN_SINGLE_CHUNK;
}

static double sum(const JnCgSingle* cg, int which) {
	double total = 0;
	for (long c = 0; c < chunks_of(cg); ++c) total += cg->partial[2 * c + which];
	return total;
}

// What happens to the entries first .. first + n; sums, if any, go to partial.
typedef void Loop(const JnCgSingle* cg, double scale, size_t first, size_t n, double partial[2]);

static void over_chunks(const JnCgSingle* cg, Loop* loop, double scale) {
	const int team = jn_threads_for(cg->length, GRAIN, cg->threads);
	const long chunks = chunks_of(cg);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (long c = 0; c < chunks; ++c) {
		const size_t first = (size_t)c * JN_SINGLE_CHUNK;
		loop(cg, scale, first, size_of(cg, first), cg->partial + 2 * c);
	}
}

static void dot_p_q(const JnCgSingle* cg, double scale, size_t first, size_t n, double partial[2]) {
	(void)scale;
	partial[0] = cg->algebra->dot(n, cg->p + first, cg->q + first);
}

static void dot_z_r_and_q(const JnCgSingle* cg, double scale, size_t first, size_t n, double partial[2]) {
	(void)scale;
	cg->algebra->two_dots(n, cg->z + first, cg->r + first, cg->q + first, partial);
}

static void advance(const JnCgSingle* cg, double scale, size_t first, size_t n, double partial[2]) {
	partial[0] = cg->algebra->advance(n, (float)scale, cg->p + first, cg->q + first, cg->x + first, cg->r + first);
}

static void extend(const JnCgSingle* cg, double scale, size_t first, size_t n, double partial[2]) {
	(void)partial;
	cg->algebra->extend(n, (float)scale, cg->z + first, cg->p + first);
}

static void apply_precondition(const JnCgSingle* cg, int slot, JnPrecondition* precondition) {
	if (precondition != NULL)
		precondition->type->apply(precondition, slot, cg->r, cg->z);
	else
		memcpy(cg->z, cg->r, cg->length * sizeof *cg->z);
}

// q = A p of the free entries. Returns p.q.
static double multiply(JnCgSingle* cg, const JnOperator* matrices, int slot) {
	matrices->apply_single(matrices->user, slot, cg->p, cg->q);
	for (int i = 0; i < cg->held_count; ++i) cg->q[cg->held_list[i]] = 0;
	over_chunks(cg, dot_p_q, 1);
	return sum(cg, 0);
}

JnStatus jn_cg_single_solve(JnCgSingle* cg, const JnOperator* matrices, int slot, JnPrecondition* precondition,
							double goal, int most, int* iterations) {
	memset(cg->x, 0, cg->length * sizeof *cg->x);
	memset(cg->p, 0, cg->length * sizeof *cg->p);
	memset(cg->q, 0, cg->length * sizeof *cg->q);
	double alpha = 0, before = 1; // those of the last iteration; none yet, so that p = z
	for (int i = 0; i < most; ++i) {
		apply_precondition(cg, slot, precondition);
		over_chunks(cg, dot_z_r_and_q, 1);
		const double rz = sum(cg, 0), beta = -alpha * sum(cg, 1) / before;
		over_chunks(cg, extend, beta);
		++*iterations;
		const double curvature = multiply(cg, matrices, slot);
		if (!isfinite(curvature) || !isfinite(rz)) return JN_NOT_FINITE;
		if (curvature <= 0 || rz <= 0) return JN_INDEFINITE;
		alpha = rz / curvature;
		before = rz;
		over_chunks(cg, advance, alpha);
		if (sqrt(sum(cg, 0)) <= goal) return JN_OK;
	}
	return JN_NOT_CONVERGED;
}
