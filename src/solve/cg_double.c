// The iteration of cg_single.c in double precision. Every sum has the order of base/space.c, so that a solution is the same,
// bit for bit, for any number of threads.
#include "solve/cg_double.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"

JnStatus jn_cg_double_create(JnCgDouble* cg, const JnPattern* pattern, const bool* held, int threads) {
	const size_t entries = 3 * (size_t)pattern->nodes;
	*cg = (JnCgDouble){.algebra = jn_single_algebra(), .held = held, .nodes = pattern->nodes};
	cg->space = jn_host_space_create(entries, threads);
	cg->held_list = malloc((entries + 1) * sizeof *cg->held_list);
	cg->single_r = jn_single_vector(jn_single_length(pattern->nodes));
	cg->single_z = jn_single_vector(jn_single_length(pattern->nodes));
	JnVec* const vectors[] = {&cg->x, &cg->r, &cg->z, &cg->p, &cg->q};
	bool is_complete = cg->space != NULL && cg->held_list != NULL && cg->single_r != NULL && cg->single_z != NULL;
	for (int i = 0; is_complete && i < 5; ++i) is_complete = (*vectors[i] = cg->space->ops->create(cg->space)) != NULL;
	if (!is_complete) return jn_error(JN_OUT_OF_MEMORY, "out of memory: vectors of %zu numbers", entries);
	for (size_t k = 0; k < entries; ++k)
		if (held[k]) cg->held_list[cg->held_count++] = k;
	return JN_OK;
}

void jn_cg_double_destroy(JnCgDouble* cg) {
	const JnVec vectors[] = {cg->x, cg->r, cg->z, cg->p, cg->q};
	for (int i = 0; cg->space != NULL && i < 5; ++i) cg->space->ops->destroy(cg->space, vectors[i]);
	jn_host_space_destroy(cg->space);
	free(cg->held_list);
	jn_aligned_free(cg->single_r);
	jn_aligned_free(cg->single_z);
	*cg = (JnCgDouble){0};
}

void jn_cg_double_multiply(const JnCgDouble* cg, const JnOperator* matrices, int slot, const double* in, JnVec out) {
	matrices->apply(matrices->user, slot, in, out);
	for (int i = 0; i < cg->held_count; ++i) out[cg->held_list[i]] = 0;
}

// z = B r, in the range of single precision.
static void apply_precondition(const JnCgDouble* cg, int slot, JnPrecondition* precondition, double norm) {
	if (precondition == NULL) {
		cg->space->ops->combine(cg->space, cg->z, 1, &(JnTerm){1, cg->r});
		return;
	}
	memset(cg->z, 0, cg->space->length * sizeof *cg->z);
	cg->algebra->pack((size_t)cg->nodes, 1 / norm, cg->r, cg->held, cg->single_r);
	precondition->type->apply(precondition, slot, cg->single_r, cg->single_z);
	cg->algebra->unpack((size_t)cg->nodes, norm, cg->single_z, cg->z);
}

JnStatus jn_cg_double_solve(JnCgDouble* cg, const JnOperator* matrices, int slot, JnPrecondition* precondition,
							double goal, int most, int* iterations) {
	JnSpace* space = cg->space;
	double norm = sqrt(space->ops->dot(space, cg->r, cg->r)), alpha = 0, before = 1;
	memset(cg->p, 0, space->length * sizeof *cg->p);
	memset(cg->q, 0, space->length * sizeof *cg->q);
	while (*iterations < most) {
		apply_precondition(cg, slot, precondition, norm);
		const double rz = space->ops->dot(space, cg->r, cg->z),
					 beta = -alpha * space->ops->dot(space, cg->z, cg->q) / before;
		space->ops->combine(space, cg->p, 2, (JnTerm[]){{1, cg->z}, {beta, cg->p}});
		++*iterations;
		jn_cg_double_multiply(cg, matrices, slot, cg->p, cg->q);
		const double curvature = space->ops->dot(space, cg->p, cg->q);
		if (!isfinite(curvature) || !isfinite(rz)) return JN_NOT_FINITE;
		if (curvature <= 0 || rz <= 0) return JN_INDEFINITE;
		alpha = rz / curvature;
		before = rz;
		space->ops->combine(space, cg->x, 2, (JnTerm[]){{1, cg->x}, {alpha, cg->p}});
		space->ops->combine(space, cg->r, 2, (JnTerm[]){{1, cg->r}, {-alpha, cg->q}});
		norm = sqrt(space->ops->dot(space, cg->r, cg->r));
		if (norm <= goal) return JN_OK;
	}
	return JN_NOT_CONVERGED;
}
