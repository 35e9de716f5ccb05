// A factor of an earlier matrix, L L^T, complete (`kept`) or not (`incomplete`), carried along by the rotations R of the nodes
// since then:
//   z = R L^-T L^-1 R^T r.
// Stiffness is frame-indifferent: where a body has turned without new strain, R A R^T is its matrix, so that a factor serves
// as long as strains resemble those of its making, whatever the motion.
#include <stdlib.h>

#include "base/aligned.h"
#include "base/log.h"
#include "base/parallel.h"
#include "solve/direct.h"
#include "solve/incomplete.h"
#include "solve/kept.h"
#include "solve/node_rotation.h"
#include "solve/precondition.h"

enum { SLOT = JN_SOLVER_SLOTS, GRAIN = 16384 }; // of the factor; nodes a thread should have

typedef struct Carried {
	JnPrecondition base;
	const JnPattern* pattern;
	const JnOperator* matrices;
	int threads;
	JnSolver* direct; // of `kept`
	JnIncomplete incomplete;
	JnNodeRotation rotation;
	float *r, *z; // in the frame of the factor
	bool is_made;
} Carried;

static void destroy(JnPrecondition* precondition) {
	if (precondition == NULL) return;
	Carried* carried = (Carried*)precondition;
	if (carried->direct != NULL) carried->direct->type->destroy(carried->direct);
	jn_incomplete_destroy(&carried->incomplete);
	jn_node_rotation_destroy(&carried->rotation);
	jn_aligned_free(carried->r);
	jn_aligned_free(carried->z);
	free(carried);
}

static bool is_complete(const Carried* carried) {
	return carried->base.type == &jn_precondition_kept;
}

static JnStatus prepare(Carried* carried, const bool* held) {
	static const JnDirectDef options = {.precision = 0};
	const JnPattern* pattern = carried->pattern;
	carried->r = jn_single_vector(jn_single_length(pattern->nodes));
	carried->z = jn_single_vector(jn_single_length(pattern->nodes));
	if (carried->r == NULL || carried->z == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: preconditioner");
	JN_TRY(jn_node_rotation_create(&carried->rotation, pattern, held, carried->threads));
	return is_complete(carried) ? jn_solver_direct.create(&options, pattern, held, carried->threads, &carried->direct)
								: jn_incomplete_create(&carried->incomplete, pattern, held);
}

static void state_cost(Carried* carried) {
	const JnPattern* pattern = carried->pattern;
	const double product = 9 * (2.0 * pattern->blocks - pattern->nodes); // multiplications
	if (is_complete(carried)) {
		const JnSolverCost cost = jn_solver_direct.cost(carried->direct);
		carried->base.setup_products = cost.factor_flops / (2 * product);
		carried->base.apply_products = 2 * cost.factor_entries / product;
		return;
	}
	const double neighbours = (double)pattern->blocks / pattern->nodes; // of a column; each pair of them is a product
	carried->base.setup_products = 40 + 27 * pattern->nodes * 0.5 * neighbours * neighbours / product; // and assembly
	carried->base.apply_products = 1.6;
}

static JnStatus create(const JnPreconditionType* type, const JnPattern* pattern, const bool* held, int threads,
					   const JnOperator* matrices, JnPrecondition** out) {
	Carried* carried = calloc(1, sizeof *carried);
	*out = NULL;
	if (carried == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: preconditioner");
	*carried = (Carried){.base.type = type, .pattern = pattern, .matrices = matrices, .threads = threads};
	const JnStatus status = prepare(carried, held);
	if (status != JN_OK) {
		destroy(&carried->base);
		return status;
	}
	state_cost(carried);
	*out = &carried->base;
	return JN_OK;
}

static JnStatus create_kept(const JnPattern* pattern, const bool* held, int threads, const JnOperator* matrices,
							JnPrecondition** out) {
	return create(&jn_precondition_kept, pattern, held, threads, matrices, out);
}

static JnStatus create_incomplete(const JnPattern* pattern, const bool* held, int threads, const JnOperator* matrices,
								  JnPrecondition** out) {
	return create(&jn_precondition_incomplete, pattern, held, threads, matrices, out);
}

// In place of a factor in double precision stays its copy in single precision.
static JnStatus factor_blocks(Carried* carried, const double* blocks) {
	if (!is_complete(carried)) return jn_incomplete_factor(&carried->incomplete, blocks);
	JN_TRY(carried->direct->type->factor(carried->direct, SLOT, blocks));
	jn_direct_keep_single(carried->direct, SLOT);
	return JN_OK;
}

// A matrix that cannot be factored leaves the factor that there is, where that is another array.
static JnStatus renew_factor(Carried* carried, int slot) {
	const JnOperator* matrices = carried->matrices;
	const double* x = matrices->positions != NULL ? matrices->positions(matrices->user, slot) : NULL;
	const JnStatus status = factor_blocks(carried, matrices->blocks(matrices->user, slot));
	if (status == JN_INDEFINITE && carried->is_made && is_complete(carried)) return JN_OK;
	carried->is_made = status == JN_OK;
	JN_TRY(status);
	if (x != NULL) jn_node_rotation_begin(&carried->rotation, x);
	return JN_OK;
}

static JnStatus update(JnPrecondition* precondition, int slot, bool renew) {
	Carried* carried = (Carried*)precondition;
	const JnOperator* matrices = carried->matrices;
	if (renew || !carried->is_made) JN_TRY(renew_factor(carried, slot));
	if (matrices->positions != NULL)
		jn_node_rotation_follow(&carried->rotation, matrices->positions(matrices->user, slot));
	return JN_OK;
}

static void rotate(const Carried* carried, const float* rotations, const float* in, float* out) {
	const JnSingleAlgebra* algebra = jn_single_algebra();
	const int nodes = carried->pattern->nodes, team = jn_threads_for((size_t)nodes, GRAIN, carried->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int part = 0; part < team; ++part) {
		const size_t first = (size_t)((long)nodes * part / team), last = (size_t)((long)nodes * (part + 1) / team);
		algebra->apply_blocks(last - first, rotations + JN_SINGLE_INVERSE * first, in + 4 * first, out + 4 * first);
	}
}

static void solve(const Carried* carried, const float* r, float* z) {
	if (is_complete(carried))
		jn_direct_solve_nodes(carried->direct, SLOT, r, z);
	else
		jn_incomplete_solve(&carried->incomplete, r, z);
}

static void apply(JnPrecondition* precondition, int slot, const float* r, float* z) {
	(void)slot;
	const Carried* carried = (const Carried*)precondition;
	if (!carried->rotation.is_turned) {
		solve(carried, r, z);
		return;
	}
	rotate(carried, carried->rotation.back, r, carried->r);
	solve(carried, carried->r, carried->z);
	rotate(carried, carried->rotation.turn, carried->z, z);
}

static size_t bytes(const JnPrecondition* precondition) {
	const Carried* carried = (const Carried*)precondition;
	if (!is_complete(carried)) return JN_SINGLE_INVERSE * (size_t)carried->pattern->blocks * sizeof(float);
	return jn_solver_direct.cost(carried->direct).bytes * sizeof(float) / sizeof(double);
}

JnSolver* jn_kept_direct(const JnPrecondition* kept) {
	return ((const Carried*)kept)->direct;
}

const JnPreconditionType jn_precondition_kept = {
	.name = "kept", .create = create_kept, .destroy = destroy, .update = update, .apply = apply, .bytes = bytes};

const JnPreconditionType jn_precondition_incomplete = {.name = "incomplete",
													   .create = create_incomplete,
													   .destroy = destroy,
													   .update = update,
													   .apply = apply,
													   .bytes = bytes};
