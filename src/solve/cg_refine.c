// A solve to six digits or less is one iteration in single precision. For more, single precision finds corrections whose
// residuals are measured in double precision (iterative refinement), and where that stalls, because the matrix is too near
// to singular, the iteration goes on in double precision.
//
// Each solve starts from zero: a first guess from earlier solves would make the end of a step depend on what was tried
// before it. A direction p with p.Ap <= 0 shows that A is not positive definite. Such a direction may never come up, in
// which case the answer is still that of the linear system.
#include "solve/cg_refine.h"

#include <math.h>
#include <string.h>

static const double roundings = 16;     // that a right-hand side and a product sum up: what is smaller is noise
static const double single_goal = 1e-5; // of a correction in single precision, relative to its right-hand side
static const double least_fall = 0.1;   // of the residual by a correction; less is a stall

JnStatus jn_cg_refine_create(JnCgRefine* cg, const JnPattern* pattern, const bool* held, int threads) {
	*cg = (JnCgRefine){.pattern = pattern, .held = held, .threads = threads};
	return jn_cg_double_create(&cg->wide, pattern, held, threads);
}

void jn_cg_refine_destroy(JnCgRefine* cg) {
	jn_cg_double_destroy(&cg->wide);
	jn_cg_single_destroy(&cg->single);
}

static double norm_of(const JnCgRefine* cg, const double* a) {
	JnSpace* space = cg->wide.space;
	return sqrt(space->ops->dot(space, a, a));
}

static bool takes_single(const JnCgRefine* cg, const JnCgTask* task) {
	return !cg->is_double && task->matrices->apply_single != NULL;
}

// Does the direction that single precision found have no positive curvature in double precision either?
static bool is_indefinite(JnCgRefine* cg, const JnCgTask* task) {
	const JnCgDouble* wide = &cg->wide;
	memset(wide->p, 0, wide->space->length * sizeof *wide->p);
	wide->algebra->unpack((size_t)wide->nodes, 1, cg->single.p, wide->p);
	jn_cg_double_multiply(wide, task->matrices, task->slot, wide->p, wide->q);
	return wide->space->ops->dot(wide->space, wide->p, wide->q) <= 0;
}

// x += d with |r - A d| near tolerance |r|, in single precision. JN_NOT_CONVERGED: that is not precise enough.
static JnStatus correct(JnCgRefine* cg, const JnCgTask* task, double norm, double tolerance, int* iterations) {
	const JnCgDouble* wide = &cg->wide;
	if (cg->single.x == NULL) JN_TRY(jn_cg_single_create(&cg->single, cg->pattern, cg->held, cg->threads));
	wide->algebra->pack((size_t)wide->nodes, 1 / norm, wide->r, cg->held, cg->single.r);
	const JnStatus status = jn_cg_single_solve(&cg->single, task->matrices, task->slot, task->precondition, tolerance,
											   cg->most - *iterations, iterations);
	if (status == JN_INDEFINITE) return is_indefinite(cg, task) ? JN_INDEFINITE : JN_NOT_CONVERGED;
	if (status == JN_NOT_FINITE) return JN_NOT_CONVERGED; // outside the range: double precision will tell
	JN_TRY(status);
	wide->algebra->unpack((size_t)wide->nodes, norm, cg->single.x, wide->x);
	return JN_OK;
}

// r = rhs - A x. Returns its norm.
static double measure(const JnCgRefine* cg, const JnCgTask* task, const double* rhs) {
	const JnCgDouble* wide = &cg->wide;
	JnSpace* space = wide->space;
	jn_cg_double_multiply(wide, task->matrices, task->slot, wide->x, wide->q);
	space->ops->combine(space, wide->r, 2, (JnTerm[]){{1, rhs}, {-1, wide->q}});
	for (int i = 0; i < wide->held_count; ++i) wide->r[wide->held_list[i]] = 0;
	return norm_of(cg, wide->r);
}

static JnStatus refine(JnCgRefine* cg, const JnCgTask* task, const double* rhs, double goal, double* norm,
					   int* iterations) {
	while (*norm > goal) {
		const double before = *norm, wanted = goal / before;
		JN_TRY(correct(cg, task, before, fmax(0.5 * wanted, single_goal), iterations));
		*norm = measure(cg, task, rhs);
		if (!(*norm <= fmax(goal, least_fall * before))) return JN_NOT_CONVERGED;
	}
	return JN_OK;
}

static JnStatus iterate(JnCgRefine* cg, const JnCgTask* task, const double* rhs, double* norm, double goal,
						int* iterations) {
	JnStatus status = JN_NOT_CONVERGED;
	if (takes_single(cg, task)) {
		status = task->is_rough ? correct(cg, task, *norm, goal / *norm, iterations)
								: refine(cg, task, rhs, goal, norm, iterations);
		if (status != JN_NOT_CONVERGED || *iterations >= cg->most) return status;
		*norm = measure(cg, task, rhs);
		if (!isfinite(*norm)) {
			memset(cg->wide.x, 0, cg->wide.space->length * sizeof *cg->wide.x);
			*norm = measure(cg, task, rhs);
		}
	}
	return jn_cg_double_solve(&cg->wide, task->matrices, task->slot, task->precondition, goal, cg->most, iterations);
}

JnStatus jn_cg_refine_solve(JnCgRefine* cg, const JnCgTask* task, const double* rhs, double* out, int* iterations,
							double* digits) {
	const JnCgDouble* wide = &cg->wide;
	const size_t bytes = wide->space->length * sizeof *wide->x;
	*iterations = 0;
	*digits = 0;
	memset(wide->x, 0, bytes);
	memcpy(wide->r, rhs, bytes);
	for (int i = 0; i < wide->held_count; ++i) wide->r[wide->held_list[i]] = 0;
	const double first = norm_of(cg, wide->r);
	const double floor = task->matrices->floor != NULL ? roundings * *task->matrices->floor : 0,
				 goal = fmax(task->tolerance * first, floor);
	if (!isfinite(first)) return JN_NOT_FINITE;
	double norm = first;
	if (first > floor) JN_TRY(iterate(cg, task, rhs, &norm, goal, iterations));
	if (first > floor) *digits = log10(first / goal);
	memcpy(out, wide->x, bytes); // not before: it may be the right-hand side
	return JN_OK;
}
