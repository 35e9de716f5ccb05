// The solvers that iterate: `cg`, with the preconditioner that is named or the cheapest, and `auto`, which may use a factor of
// the matrix as well. choice.h decides when a new matrix comes; here its decisions are carried out.
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/aligned.h"
#include "base/log.h"
#include "base/parallel.h"
#include "solve/cg_refine.h"
#include "solve/choice.h"
#include "solve/direct.h"
#include "solve/kept.h"

enum {
	SMALL = 100,  // nodes below which a factor costs less than thinking about it
	GRAIN = 4096, // rows that a thread should have before it is worth waking
};

// The matrix of a slot.
typedef struct Slot {
	double* blocks; // where products do not come from whoever attached
	float* single;  // the same, JN_SINGLE_INVERSE a block
	JnWay way;      // for which it is prepared
} Slot;

typedef struct Cg {
	JnSolver base;
	const JnCgDef* def;
	const JnPattern* pattern;
	const bool* held;
	int threads;
	bool may_factor;     // the solver is `auto`
	bool has_begun;      // `choice` and `matrices` are made
	JnOperator attached; // apply NULL: factor() gets blocks
	JnOperator matrices; // what iterations use
	double* diagonal;    // 9 a node, where `matrices` are slots' blocks
	Slot slots[JN_SOLVER_SLOTS];
	JnCgRefine refine;
	JnChoice choice;
	JnPrecondition* preconditions[JN_WAY_COUNT]; // as far as they were wanted
} Cg;

static const JnPreconditionType* const types[JN_WAY_COUNT] = {
	[JN_WAY_BLOCK] = &jn_precondition_block,
	[JN_WAY_KEPT] = &jn_precondition_kept,
	[JN_WAY_INCOMPLETE] = &jn_precondition_incomplete,
	[JN_WAY_MULTIGRID] = &jn_precondition_multigrid,
};

static void destroy(JnSolver* solver) {
	if (solver == NULL) return;
	Cg* cg = (Cg*)solver;
	for (int way = 0; way < JN_WAY_COUNT; ++way)
		if (cg->preconditions[way] != NULL) cg->preconditions[way]->type->destroy(cg->preconditions[way]);
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) {
		free(cg->slots[slot].blocks);
		jn_aligned_free(cg->slots[slot].single);
	}
	jn_cg_refine_destroy(&cg->refine);
	free(cg->diagonal);
	free(cg);
}

static JnStatus create(const JnSolverType* type, const JnCgDef* def, const JnPattern* pattern, const bool* held,
					   int threads, JnSolver** out) {
	*out = NULL;
	Cg* cg = calloc(1, sizeof *cg);
	if (cg == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: %s solver", type->row.name);
	*cg = (Cg){.base = {.type = type, .is_iterative = true, .way = JN_WAY_BLOCK},
			   .def = def,
			   .pattern = pattern,
			   .held = held,
			   .threads = threads,
			   .may_factor = type == &jn_solver_auto};
	const JnStatus status = jn_cg_refine_create(&cg->refine, pattern, held, threads);
	cg->refine.most = def->max_iterations;
	cg->refine.is_double = def->precision == 1;
	if (status != JN_OK)
		destroy(&cg->base);
	else
		*out = &cg->base;
	return status;
}

static JnStatus create_cg(const void* options, const JnPattern* pattern, const bool* held, int threads,
						  JnSolver** out) {
	return create(&jn_solver_cg, options, pattern, held, threads, out);
}

static JnStatus create_auto(const void* options, const JnPattern* pattern, const bool* held, int threads,
							JnSolver** out) {
	return create(&jn_solver_auto, options, pattern, held, threads, out);
}

static bool takes_products(const void* options) {
	return ((const JnCgDef*)options)->matrix == 0;
}

static void attach(JnSolver* solver, JnOperator matrices) {
	((Cg*)solver)->attached = matrices;
}

// ---- blocks of the slots as an operator

static void multiply_blocks(void* user, int slot, const double* in, double* out) {
	const Cg* cg = user;
	memset(out, 0, 3 * (size_t)cg->pattern->nodes * sizeof *out);
	jn_blocks_apply(cg->pattern, cg->slots[slot].blocks, 1, in, out, cg->threads);
}

static void multiply_single(void* user, int slot, const float* in, float* out) {
	const Cg* cg = user;
	const int nodes = cg->pattern->nodes, team = jn_threads_for((size_t)nodes, GRAIN, cg->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int part = 0; part < team; ++part)
		jn_single_algebra()->multiply(cg->pattern, cg->slots[slot].single, in, out, (int)((long)nodes * part / team),
									  (int)((long)nodes * (part + 1) / team));
}

static const double* diagonal_of_blocks(void* user, int slot) {
	const Cg* cg = user;
	for (int node = 0; node < cg->pattern->nodes; ++node)
		memcpy(cg->diagonal + 9 * (size_t)node, cg->slots[slot].blocks + 9 * (size_t)cg->pattern->column_start[node],
			   9 * sizeof(double));
	return cg->diagonal;
}

static const double* all_blocks(void* user, int slot) {
	return ((const Cg*)user)->slots[slot].blocks;
}

static bool is_mass_of_attached(void* user, int slot) {
	const Cg* cg = user;
	return cg->attached.is_mass != NULL && cg->attached.is_mass(cg->attached.user, slot);
}

static const double* positions_of_attached(void* user, int slot) {
	const Cg* cg = user;
	return cg->attached.positions(cg->attached.user, slot);
}

static bool has_products(const Cg* cg) {
	return cg->attached.apply != NULL && cg->def->matrix == 0 && !cg->attached.is_assembled;
}

static JnStatus keep_single(Cg* cg, int slot) {
	const size_t blocks = (size_t)cg->pattern->blocks;
	float** single = &cg->slots[slot].single;
	if (*single == NULL) *single = jn_single_vector(JN_SINGLE_INVERSE * blocks);
	if (*single == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: a matrix of %zu blocks", blocks);
	for (size_t k = 0; k < blocks; ++k)
		for (size_t e = 0; e < 9; ++e)
			(*single)[JN_SINGLE_INVERSE * k + 4 * (e % 3) + e / 3] = (float)cg->slots[slot].blocks[9 * k + e];
	return JN_OK;
}

static JnStatus keep_blocks(Cg* cg, int slot, const double* blocks) {
	const size_t count = 9 * (size_t)cg->pattern->blocks, nodes = (size_t)cg->pattern->nodes;
	double** kept = &cg->slots[slot].blocks;
	if (*kept == NULL) *kept = malloc((count + 1) * sizeof **kept);
	if (cg->diagonal == NULL) cg->diagonal = malloc((9 * nodes + 1) * sizeof *cg->diagonal);
	if (*kept == NULL || cg->diagonal == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: a matrix of %zu numbers", count);
	if (blocks == NULL) blocks = cg->attached.blocks(cg->attached.user, slot);
	memcpy(*kept, blocks, count * sizeof **kept);
	return cg->refine.is_double ? JN_OK : keep_single(cg, slot);
}

static JnOperator operator_of(Cg* cg) {
	if (has_products(cg)) return cg->attached;
	return (JnOperator){.user = cg,
						.apply = multiply_blocks,
						.apply_single = cg->refine.is_double ? NULL : multiply_single,
						.diagonal = diagonal_of_blocks,
						.blocks = all_blocks,
						.positions = cg->attached.positions != NULL ? positions_of_attached : NULL,
						.is_mass = is_mass_of_attached,
						.rest = cg->attached.rest,
						.floor = cg->attached.floor};
}

// ---- ways

// Bonds without a matrix have no blocks to factor.
static void begin(Cg* cg) {
	const JnPattern* pattern = cg->pattern;
	const bool has_matrix = pattern->blocks > pattern->nodes || cg->attached.apply == NULL;
	bool allowed[JN_WAY_COUNT] = {false};
	cg->matrices = operator_of(cg);
	for (int way = 0; way < JN_WAY_COUNT; ++way) allowed[way] = types[way] != NULL && has_matrix;
	allowed[JN_WAY_BLOCK] = true;
	allowed[JN_WAY_DIRECT] = cg->may_factor && has_matrix;
	if (cg->def->precondition != 0)
		for (int way = 0; way < JN_WAY_COUNT; ++way) allowed[way] = way == cg->def->precondition;
	const bool has_single = cg->matrices.apply_single != NULL && !cg->refine.is_double;
	jn_choice_begin(&cg->choice, pattern->nodes, pattern->blocks, has_single, allowed);
	if (allowed[JN_WAY_DIRECT] && pattern->nodes < SMALL) cg->choice.way = JN_WAY_DIRECT;
	cg->has_begun = true;
}

static double memory_limit(const Cg* cg) {
	if (cg->def->memory > 0) return cg->def->memory;
	return 0.5 * (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

// The factor that `kept` carries along, and that of the matrix itself, are by one solver. JN_OUT_OF_MEMORY: it is too large.
static JnStatus analyse(Cg* cg) {
	const double limit = memory_limit(cg);
	JnPrecondition** kept = &cg->preconditions[JN_WAY_KEPT];
	if (*kept != NULL) return JN_OK;
	JN_TRY(jn_precondition_kept.create(cg->pattern, cg->held, cg->threads, &cg->matrices, kept));
	const JnSolverCost cost = jn_solver_direct.cost(jn_kept_direct(*kept));
	const double bytes = 1.5 * (double)cost.bytes; // in double and in single precision
	jn_choice_learn_factor(&cg->choice, cost.factor_flops, cost.factor_entries);
	if (bytes <= limit) return JN_OK;
	jn_warn("solver.method %s: a factor of %.3g GB is above the limit of %.3g GB (solver.memory); none is made",
			cg->base.type->row.name, 1e-9 * bytes, 1e-9 * limit);
	jn_precondition_kept.destroy(*kept);
	*kept = NULL;
	return JN_OUT_OF_MEMORY;
}

static JnStatus acquire(Cg* cg, JnWay way) {
	if (way == JN_WAY_DIRECT || way == JN_WAY_KEPT) return analyse(cg);
	JnPrecondition** precondition = &cg->preconditions[way];
	if (types[way] == NULL || *precondition != NULL) return JN_OK;
	JN_TRY(types[way]->create(cg->pattern, cg->held, cg->threads, &cg->matrices, precondition));
	jn_choice_learn(&cg->choice, way, (*precondition)->setup_products, (*precondition)->apply_products);
	return JN_OK;
}

// What there is no room for; both factors are of one size. False: nothing else is left.
static bool do_without(Cg* cg, JnWay way) {
	if (way == JN_WAY_DIRECT) jn_choice_forbid(&cg->choice, JN_WAY_KEPT);
	if (way == JN_WAY_KEPT) jn_choice_forbid(&cg->choice, JN_WAY_DIRECT);
	return jn_choice_forbid(&cg->choice, way);
}

// Learn what other ways cost where that is little beside what has been spent.
static void look_around(Cg* cg) {
	static const JnWay unknown[] = {JN_WAY_KEPT, JN_WAY_DIRECT, JN_WAY_INCOMPLETE, JN_WAY_MULTIGRID};
	for (size_t i = 0; i < sizeof unknown / sizeof *unknown; ++i) {
		if (jn_choice_wants_to_know(&cg->choice, unknown[i]) && acquire(cg, unknown[i]) != JN_OK)
			do_without(cg, unknown[i]);
	}
}

static JnStatus prepare_as(Cg* cg, int slot, JnWay way, bool is_chosen) {
	JN_TRY(acquire(cg, way));
	cg->slots[slot].way = way;
	const bool renews = is_chosen && jn_choice_renews(&cg->choice);
	if (is_chosen) jn_choice_count_matrix(&cg->choice, renews);
	if (way == JN_WAY_DIRECT) {
		JnSolver* direct = jn_kept_direct(cg->preconditions[JN_WAY_KEPT]);
		return direct->type->factor(direct, slot, cg->matrices.blocks(cg->matrices.user, slot));
	}
	JnPrecondition* precondition = cg->preconditions[way];
	if (precondition == NULL) return JN_OK;
	JN_TRY(precondition->type->update(precondition, slot, renews));
	if (way != JN_WAY_KEPT) // whose cost is known from the analysis; others may have counted anew
		jn_choice_learn(&cg->choice, way, precondition->setup_products, precondition->apply_products);
	return JN_OK;
}

// Masses are well conditioned: their diagonal blocks will do, unless factors are made anyway.
static JnStatus prepare(Cg* cg, int slot) {
	const bool is_mass = cg->matrices.is_mass != NULL && cg->matrices.is_mass(cg->matrices.user, slot);
	if (is_mass && cg->choice.way != JN_WAY_DIRECT && cg->choice.way != JN_WAY_PLAIN)
		return prepare_as(cg, slot, JN_WAY_BLOCK, false);
	JnStatus status = prepare_as(cg, slot, cg->choice.way, true);
	while (status == JN_OUT_OF_MEMORY && do_without(cg, cg->choice.way))
		status = prepare_as(cg, slot, cg->choice.way, true);
	return status;
}

static void tell(Cg* cg) {
	cg->base.is_iterative = cg->choice.way != JN_WAY_DIRECT;
	cg->base.changes += cg->choice.changes;
	cg->choice.changes = 0;
}

static JnStatus factor(JnSolver* solver, int slot, const double* blocks) {
	Cg* cg = (Cg*)solver;
	if (!cg->has_begun) begin(cg);
	if (!has_products(cg)) JN_TRY(keep_blocks(cg, slot, blocks));
	look_around(cg);
	jn_choice_next(&cg->choice);
	const JnStatus status = prepare(cg, slot);
	tell(cg);
	return status;
}

static JnStatus solve_as(Cg* cg, int slot, double tolerance, bool is_rough, const double* rhs, double* out) {
	const JnWay way = cg->slots[slot].way;
	double digits = 0;
	cg->base.way = way;
	cg->base.iterations = 0;
	if (way == JN_WAY_DIRECT) {
		JnSolver* direct = jn_kept_direct(cg->preconditions[JN_WAY_KEPT]);
		jn_choice_count_solve(&cg->choice, 0, 0);
		return is_rough ? direct->type->approximate(direct, slot, tolerance, rhs, out)
						: direct->type->solve(direct, slot, rhs, out);
	}
	const JnCgTask task = {.matrices = &cg->matrices,
						   .slot = slot,
						   .precondition = cg->preconditions[way],
						   .tolerance = tolerance,
						   .is_rough = is_rough};
	const JnStatus status = jn_cg_refine_solve(&cg->refine, &task, rhs, out, &cg->base.iterations, &digits);
	if (status == JN_OK && way == cg->choice.way) jn_choice_count_solve(&cg->choice, cg->base.iterations, digits);
	return status;
}

// What does not converge may do so in another way.
static JnStatus solve_to(JnSolver* solver, int slot, double tolerance, bool is_rough, const double* rhs, double* out) {
	Cg* cg = (Cg*)solver;
	JnStatus status = solve_as(cg, slot, tolerance, is_rough, rhs, out);
	while (status == JN_NOT_CONVERGED && cg->slots[slot].way == cg->choice.way &&
		   jn_choice_forbid(&cg->choice, cg->choice.way)) {
		JN_TRY(prepare(cg, slot));
		tell(cg);
		status = solve_as(cg, slot, tolerance, is_rough, rhs, out);
	}
	return status;
}

static JnStatus solve(JnSolver* solver, int slot, const double* rhs, double* out) {
	return solve_to(solver, slot, ((Cg*)solver)->def->tolerance, false, rhs, out);
}

static JnStatus approximate(JnSolver* solver, int slot, double tolerance, const double* rhs, double* out) {
	const JnCgDef* def = ((Cg*)solver)->def;
	return solve_to(solver, slot, fmax(def->tolerance, tolerance), true, rhs, out);
}

static const char* const preconditions[] = {"auto", "none", "block", "kept", "incomplete", "multigrid", NULL};
static const char* const matrix_forms[] = {"auto", "assembled", NULL};
static const char* const precisions[] = {"mixed", "double", NULL};

#define TOLERANCE                                                                                                      \
	{                                                                                                                  \
		.name = "tolerance", .kind = JN_REAL, .field = offsetof(JnCgDef, tolerance), .value = {1e-8}, .low = 1e-14,    \
		.high = 0.1,                                                                                                   \
		.meaning = "norm of the residual at which a system counts as solved, relative to its right-hand side"          \
	}
#define MAX_ITERATIONS                                                                                                 \
	{                                                                                                                  \
		.name = "max_iterations", .kind = JN_INTEGER, .field = offsetof(JnCgDef, max_iterations), .value = {2000},     \
		.low = 1, .high = 1000000,                                                                                     \
		.meaning = "iterations after which another preconditioner is tried, or the step counts as failed"              \
	}
#define PRECISION                                                                                                      \
	{                                                                                                                  \
		.name = "precision", .kind = JN_CHOICE, .field = offsetof(JnCgDef, precision), .names = precisions,            \
		.meaning =                                                                                                     \
			"mixed: iterations in single precision where laws give such products, residuals in double; double: all "   \
			"but the preconditioner in double"                                                                         \
	}
#define MEMORY                                                                                                         \
	{                                                                                                                  \
		.name = "memory", .kind = JN_REAL, .field = offsetof(JnCgDef, memory), .low = 0, .high = 1e15,                 \
		.meaning = "bytes that a factor may take; larger ones are not made; 0: half of what the machine has"           \
	}
#define MATRIX                                                                                                         \
	{                                                                                                                  \
		.name = "matrix", .kind = JN_CHOICE, .field = offsetof(JnCgDef, matrix), .names = matrix_forms,                \
		.meaning = "auto: products without a matrix where every law gives them; assembled: always a matrix"            \
	}

static const JnKey auto_keys[] = {TOLERANCE, MAX_ITERATIONS, MATRIX, PRECISION, MEMORY, {0}};

static const JnKey cg_keys[] = {
	TOLERANCE,
	MAX_ITERATIONS,
	{.name = "precondition",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnCgDef, precondition),
	 .names = preconditions,
	 .meaning =
		 "auto: whichever is cheapest; none; block: the 3x3 diagonal block of each node; kept: a sparse Cholesky "
		 "factor of an earlier state, carried along by the rotations of the nodes; incomplete: an incomplete "
		 "Cholesky factor; multigrid: smoothed aggregates"},
	MATRIX,
	PRECISION,
	MEMORY,
	{0},
};

#define VERBS                                                                                                          \
	.destroy = destroy, .takes_products = takes_products, .attach = attach, .factor = factor, .solve = solve,          \
	.approximate = approximate

const JnSolverType jn_solver_cg = {
	.row = {.name = "cg",
			.doc = "conjugate gradients: little memory, for large models; where laws allow, without a matrix",
			.keys = cg_keys,
			.options_size = sizeof(JnCgDef)},
	.create = create_cg,
	VERBS,
};

const JnSolverType jn_solver_auto = {
	.row = {.name = "auto",
			.doc = "direct or conjugate gradients, whichever takes less work, judged anew as the run goes on",
			.keys = auto_keys,
			.options_size = sizeof(JnCgDef)},
	.create = create_auto,
	VERBS,
};
