// Conjugate gradients (Hestenes, Stiefel 1952) with the diagonal blocks as preconditioner:
//   alpha = r.z / p.Ap,   x += alpha p,   r -= alpha Ap,   z = B r,   p = z + (r.z new / old) p
// until |r| <= tolerance |b|. Every sum has the order of base/space.c, so that a solution is the same, bit for bit, for any
// number of threads. Each solve starts from zero: a first guess from earlier solves would make the end of a step depend on
// what was tried before it.
//
// A direction p with p.Ap <= 0 shows that A is not positive definite. Such a direction may never come up, in which case the
// answer is still that of the linear system.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "base/space.h"
#include "solve/block_jacobi.h"
#include "solve/solver.h"

typedef struct Cg {
	JnSolver base;
	const JnCgDef* def;
	const JnPattern* pattern;
	const bool* held;
	int held_count;
	size_t* held_list;   // entries
	JnOperator products; // apply NULL: the blocks of a slot are kept
	JnSpace* space;
	JnVec x, r, z, p, q;              // q = A p
	double* blocks[JN_SOLVER_SLOTS];  // where there is no operator
	double* inverse[JN_SOLVER_SLOTS]; // of the diagonal blocks
} Cg;

static void destroy(JnSolver* solver) {
	if (solver == NULL) return;
	Cg* cg = (Cg*)solver;
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) {
		free(cg->blocks[slot]);
		free(cg->inverse[slot]);
	}
	const JnVec vectors[] = {cg->x, cg->r, cg->z, cg->p, cg->q};
	for (int i = 0; cg->space != NULL && i < 5; ++i) cg->space->ops->destroy(cg->space, vectors[i]);
	jn_host_space_destroy(cg->space);
	free(cg->held_list);
	free(cg);
}

static void list_held(Cg* cg) {
	for (size_t k = 0; k < cg->space->length; ++k)
		if (cg->held[k]) cg->held_list[cg->held_count++] = k;
}

static JnStatus create(const void* options, const JnPattern* pattern, const bool* held, int threads, JnSolver** out) {
	*out = NULL;
	const size_t entries = 3 * (size_t)pattern->nodes;
	Cg* cg = calloc(1, sizeof *cg);
	if (cg == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: cg solver");
	*cg = (Cg){.base.type = &jn_solver_cg, .def = options, .pattern = pattern, .held = held};
	cg->space = jn_host_space_create(entries, threads);
	cg->held_list = malloc((entries + 1) * sizeof *cg->held_list);
	JnVec* const vectors[] = {&cg->x, &cg->r, &cg->z, &cg->p, &cg->q};
	bool is_complete = cg->space != NULL && cg->held_list != NULL;
	for (int i = 0; is_complete && i < 5; ++i) {
		*vectors[i] = cg->space->ops->create(cg->space);
		is_complete = *vectors[i] != NULL;
	}
	if (!is_complete) {
		destroy(&cg->base);
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: cg solver");
	}
	list_held(cg);
	*out = &cg->base;
	return JN_OK;
}

static bool takes_products(const void* options) {
	return ((const JnCgDef*)options)->matrix == 0;
}

static void attach(JnSolver* solver, JnOperator products) {
	((Cg*)solver)->products = products;
}

static JnStatus factor(JnSolver* solver, int slot, const double* blocks) {
	Cg* cg = (Cg*)solver;
	const size_t count = 9 * (size_t)cg->pattern->blocks, reals = JN_BLOCK_JACOBI_REALS * (size_t)cg->pattern->nodes;
	if (cg->inverse[slot] == NULL) cg->inverse[slot] = malloc((reals + 1) * sizeof(double));
	if (cg->products.apply == NULL && cg->blocks[slot] == NULL) cg->blocks[slot] = malloc(count * sizeof(double));
	if (cg->inverse[slot] == NULL || (cg->products.apply == NULL && cg->blocks[slot] == NULL))
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: a matrix of %zu numbers", count);
	if (cg->products.apply == NULL) memcpy(cg->blocks[slot], blocks, count * sizeof(double));
	return jn_block_jacobi_factor(cg->pattern, cg->held, blocks, cg->inverse[slot]);
}

static void hold(const Cg* cg, JnVec vec) {
	for (int i = 0; i < cg->held_count; ++i) vec[cg->held_list[i]] = 0;
}

// q = A p of the free entries.
static void multiply(const Cg* cg, int slot) {
	if (cg->products.apply != NULL) {
		cg->products.apply(cg->products.user, slot, cg->p, cg->q);
	} else {
		memset(cg->q, 0, cg->space->length * sizeof *cg->q);
		jn_blocks_apply(cg->pattern, cg->blocks[slot], 1, cg->p, cg->q, cg->space->threads);
	}
	hold(cg, cg->q);
}

// z = B r. Returns r.z.
static double precondition(const Cg* cg, int slot) {
	JnSpace* space = cg->space;
	if (cg->def->precondition == 0)
		jn_block_jacobi_apply(cg->pattern->nodes, cg->inverse[slot], cg->r, cg->z, space->threads);
	else
		space->ops->combine(space, cg->z, 1, &(JnTerm){1, cg->r});
	return space->ops->dot(space, cg->r, cg->z);
}

// Roundings that a right-hand side and a product sum up: what is smaller than so many is noise, and not worth iterations.
static const double slack = 16;

// From x = 0 and r the right-hand side.
static JnStatus iterate(Cg* cg, int slot, double tolerance) {
	JnSpace* space = cg->space;
	const double norm = sqrt(space->ops->dot(space, cg->r, cg->r));
	const double floor = cg->products.floor != NULL ? slack * *cg->products.floor : 0,
				 goal = fmax(tolerance * norm, floor);
	cg->base.iterations = 0;
	if (!isfinite(norm)) return JN_NOT_FINITE;
	if (norm <= floor) return JN_OK;
	double rz = precondition(cg, slot);
	space->ops->combine(space, cg->p, 1, &(JnTerm){1, cg->z});
	while (cg->base.iterations < cg->def->max_iterations) {
		++cg->base.iterations;
		multiply(cg, slot);
		const double curvature = space->ops->dot(space, cg->p, cg->q), alpha = rz / curvature;
		if (!isfinite(curvature)) return JN_NOT_FINITE;
		if (curvature <= 0) return JN_INDEFINITE;
		space->ops->combine(space, cg->x, 2, (JnTerm[]){{1, cg->x}, {alpha, cg->p}});
		space->ops->combine(space, cg->r, 2, (JnTerm[]){{1, cg->r}, {-alpha, cg->q}});
		if (sqrt(space->ops->dot(space, cg->r, cg->r)) <= goal) return JN_OK;
		const double before = rz;
		rz = precondition(cg, slot);
		space->ops->combine(space, cg->p, 2, (JnTerm[]){{1, cg->z}, {rz / before, cg->p}});
	}
	return JN_NOT_CONVERGED;
}

static JnStatus solve_to(JnSolver* solver, int slot, double tolerance, const double* rhs, double* out) {
	Cg* cg = (Cg*)solver;
	memcpy(cg->r, rhs, cg->space->length * sizeof *cg->r);
	hold(cg, cg->r);
	memset(cg->x, 0, cg->space->length * sizeof *cg->x);
	JN_TRY(iterate(cg, slot, tolerance));
	memcpy(out, cg->x, cg->space->length * sizeof *out); // not before: it may be the right-hand side
	return JN_OK;
}

static JnStatus solve(JnSolver* solver, int slot, const double* rhs, double* out) {
	return solve_to(solver, slot, ((Cg*)solver)->def->tolerance, rhs, out);
}

static JnStatus approximate(JnSolver* solver, int slot, const double* rhs, double* out) {
	const JnCgDef* def = ((Cg*)solver)->def;
	return solve_to(solver, slot, fmax(def->tolerance, def->rough), rhs, out);
}

static JnSolverCost cost(const JnSolver* solver) {
	const Cg* cg = (const Cg*)solver;
	const size_t reals = JN_BLOCK_JACOBI_REALS * (size_t)cg->pattern->nodes;
	return (JnSolverCost){.factor_entries = (double)reals, .bytes = reals * sizeof(double)};
}

static const char* const preconditions[] = {"block", "none", NULL};
static const char* const matrices[] = {"auto", "assembled", NULL};

static const JnKey keys[] = {
	{.name = "tolerance",
	 .kind = JN_REAL,
	 .field = offsetof(JnCgDef, tolerance),
	 .value = {1e-8},
	 .low = 1e-14,
	 .high = 0.1,
	 .meaning = "norm of the residual at which a system counts as solved, relative to its right-hand side"},
	{.name = "rough",
	 .kind = JN_REAL,
	 .field = offsetof(JnCgDef, rough),
	 .value = {1e-4},
	 .low = 1e-14,
	 .high = 0.1,
	 .meaning = "the same for directions of Newton's iteration, which measures its own residual"},
	{.name = "max_iterations",
	 .kind = JN_INTEGER,
	 .field = offsetof(JnCgDef, max_iterations),
	 .value = {2000},
	 .low = 1,
	 .high = 1000000,
	 .meaning = "iterations after which the step counts as failed"},
	{.name = "precondition",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnCgDef, precondition),
	 .names = preconditions,
	 .meaning = "block: invert the 3x3 diagonal block of each node; none: plain conjugate gradients"},
	{.name = "matrix",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnCgDef, matrix),
	 .names = matrices,
	 .meaning =
		 "auto: no matrix at all where every law gives its products and all masses are lumped; assembled: always "
		 "a matrix"},
	{0},
};

const JnSolverType jn_solver_cg = {
	.row = {.name = "cg",
			.doc = "conjugate gradients: little memory, for large models; where laws allow, without a matrix",
			.keys = keys,
			.options_size = sizeof(JnCgDef)},
	.create = create,
	.destroy = destroy,
	.takes_products = takes_products,
	.attach = attach,
	.factor = factor,
	.solve = solve,
	.approximate = approximate,
	.cost = cost,
};
