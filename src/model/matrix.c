// Shifted matrices of a model. Products use M, D and K as they are; a solve factors their sum on first use. When the
// Cholesky factorisation meets an indefinite matrix, K is replaced by its definite form for this factor alone. With the
// exact tangent of a wind the matrix is not symmetric, and LU takes the place of Cholesky.
#include <string.h>

#include "model/damping.h"
#include "model/repulsion.h"
#include "model/system.h"
#include "model/wind.h"

// What a new tangent and factor cost, in iterations that use an old one (a solve, a force, a product with M). Larger
// factors run at higher speed, so that the ratio hardly depends on size: measured 18 for the beam of 825 nodes.
static const double refresh_cost = 16;

// Where the solver iterates, a new tangent is one product among many.
static const double refresh_cost_iterative = 0.5;

static bool depends_on_state(JnShift shift) {
	return shift.damping != 0 || shift.stiffness != 0;
}

static void add_scalars(const JnPattern* pattern, double scale, const double* scalars, double* blocks) {
	for (int k = 0; k < pattern->blocks; ++k)
		for (int axis = 0; axis < 3; ++axis) blocks[9 * (size_t)k + 4 * (size_t)axis] += scale * scalars[k];
}

// scratch = m M + d D + k K, where K stands in `stiffness` (which may be scratch itself).
static void combine(JnModelSystem* sys, JnShift shift, const double* stiffness) {
	const JnPattern* pattern = &sys->model->pattern;
	const size_t entries = 9 * (size_t)pattern->blocks;
	for (size_t k = 0; k < entries; ++k) sys->scratch[k] = shift.stiffness * stiffness[k];
	const double* damping = shift.damping != 0 ? jn_damping_blocks(sys) : NULL;
	for (size_t k = 0; k < entries && damping != NULL; ++k) sys->scratch[k] += shift.damping * damping[k];
	add_scalars(pattern, shift.mass, sys->model->mass, sys->scratch);
	if (sys->alpha_mass != NULL) add_scalars(pattern, shift.damping, sys->alpha_mass, sys->scratch);
}

static JnSolver* solver_of(const JnModelMatrix* matrix) {
	const JnModelSystem* sys = (const JnModelSystem*)matrix->base.sys;
	return sys->unsymmetric != NULL && depends_on_state(matrix->shift) ? sys->unsymmetric : sys->solver;
}

// full = scratch in full rows, and the derivatives of the wind.
static void add_wind(const JnModelSystem* sys, JnShift shift) {
	const JnPattern* pattern = &sys->model->pattern;
	for (int k = 0; k < pattern->full_start[pattern->nodes]; ++k) {
		const int block = pattern->full_block[k];
		const double* from = sys->scratch + 9 * (size_t)(block >= 0 ? block : ~block);
		double* to = sys->full + 9 * (size_t)k;
		for (int e = 0; e < 9; ++e) to[e] = from[block >= 0 ? e : 3 * (e % 3) + e / 3];
	}
	jn_wind_add_blocks(sys->model->wind, shift, sys->full);
}

static JnStatus factor_scratch(const JnModelMatrix* matrix) {
	const JnModelSystem* sys = (const JnModelSystem*)matrix->base.sys;
	JnSolver* solver = solver_of(matrix);
	++sys->base.report->factorizations;
	if (solver == sys->solver) return solver->type->factor(solver, matrix->slot, sys->scratch);
	add_wind(sys, matrix->shift);
	return solver->type->factor(solver, matrix->slot, sys->full);
}

static JnStatus factor_definite(JnModelMatrix* matrix) {
	JnModelSystem* sys = (JnModelSystem*)matrix->base.sys;
	++sys->base.report->indefinite;
	jn_assembly_tangent(sys->assembly, sys->linear_x, JN_DEFINITE, NULL, sys->scratch);
	if (sys->model->repulsion != NULL) jn_repulsion_add_diagonal(sys->model->repulsion, JN_DEFINITE, sys->scratch);
	combine(sys, matrix->shift, sys->scratch);
	matrix->is_definite = true;
	return factor_scratch(matrix);
}

static JnStatus factor(JnModelMatrix* matrix) {
	JnModelSystem* sys = (JnModelSystem*)matrix->base.sys;
	combine(sys, matrix->shift, sys->stiffness);
	matrix->is_definite = false;
	JnStatus status = factor_scratch(matrix);
	if (status == JN_INDEFINITE && matrix->shift.stiffness != 0) status = factor_definite(matrix);
	matrix->base.is_factored = status == JN_OK;
	return status;
}

static void divide_by_mass(const JnModelSystem* sys, double mass, const double* rhs, double* out) {
	const JnModel* model = sys->model;
	if (mass == 1) {
		sys->algebra->multiply(sys->base.space->length, rhs, sys->inverse_mass, out);
		for (int i = 0; i < model->held_count; ++i) out[model->held_list[i].entry] = 0;
		return;
	}
	for (int k = 0; k < 3 * model->node_count; ++k)
		out[k] = model->held[k] ? 0 : rhs[k] / (mass * model->nodal_mass[k / 3]);
}

typedef JnStatus Solve(JnSolver*, int slot, const double* rhs, double* out);

static JnStatus solve_with(const JnModelMatrix* matrix, Solve* solve, const double* rhs, JnVec out) {
	JnSolver* solver = solver_of(matrix);
	const JnStatus status = solve(solver, matrix->slot, rhs, out);
	matrix->base.sys->report->iterations += solver->iterations;
	return status;
}

// A solver that iterates may find out only now that the matrix is indefinite; `out`, which may be rhs, is then untouched.
static JnStatus solve_by(JnMatrix* base, Solve* solve, const double* rhs, JnVec out) {
	JnModelMatrix* matrix = (JnModelMatrix*)base;
	JnModelSystem* sys = (JnModelSystem*)base->sys;
	if (!depends_on_state(matrix->shift) && sys->model->mass_is_diagonal) {
		divide_by_mass(sys, matrix->shift.mass, rhs, out);
		return JN_OK;
	}
	++sys->base.report->solves;
	if (!matrix->base.is_factored) JN_TRY(factor(matrix));
	JnStatus status = solve_with(matrix, solve, rhs, out);
	if (status == JN_INDEFINITE && matrix->shift.stiffness != 0 && !matrix->is_definite) {
		JN_TRY(factor_definite(matrix));
		status = solve_with(matrix, solve, rhs, out);
	}
	return status;
}

static JnStatus solve(JnMatrix* base, const double* rhs, JnVec out) {
	return solve_by(base, solver_of((JnModelMatrix*)base)->type->solve, rhs, out);
}

static JnStatus approximate(JnMatrix* base, const double* rhs, JnVec out) {
	return solve_by(base, solver_of((JnModelMatrix*)base)->type->approximate, rhs, out);
}

// out += scale * K in, K at linear_x.
static void apply_stiffness(const JnModelSystem* sys, JnDefinite definite, double scale, const double* in,
							double* out) {
	const JnTangentAt at = {.x = sys->linear_x, .definite = definite};
	if (sys->model->is_matrix_free)
		jn_assembly_product(sys->assembly, at, scale, in, out);
	else
		jn_blocks_apply(&sys->model->pattern, sys->stiffness, scale, in, out, sys->model->threads);
	if (sys->model->repulsion != NULL) jn_repulsion_product(sys->model->repulsion, definite, scale, in, out);
}

static void apply_shifted(const JnModelSystem* sys, JnShift shift, JnDefinite definite, const double* in, JnVec out) {
	const JnModel* model = sys->model;
	memset(out, 0, 3 * (size_t)model->node_count * sizeof *out);
	if (model->mass_is_diagonal)
		for (int k = 0; k < 3 * model->node_count; ++k) out[k] = shift.mass * model->nodal_mass[k / 3] * in[k];
	else if (shift.mass != 0)
		jn_scalars_apply(&model->pattern, model->mass, shift.mass, in, out, model->threads);
	if (shift.damping != 0) jn_damping_apply_mass(sys, shift.damping, in, out);
	if (shift.damping != 0) jn_damping_apply(sys, shift.damping, in, out);
	if (shift.stiffness != 0) apply_stiffness(sys, definite, shift.stiffness, in, out);
	if (sys->unsymmetric != NULL) jn_wind_apply(model->wind, shift, in, out);
}

static void apply(JnMatrix* base, const double* in, JnVec out) {
	apply_shifted((const JnModelSystem*)base->sys, ((const JnModelMatrix*)base)->shift, JN_EXACT, in, out);
}

void jn_model_matrix_product(void* user, int slot, const double* in, double* out) {
	const JnModelSystem* sys = user;
	const JnModelMatrix* matrix = &sys->matrices[slot];
	apply_shifted(sys, matrix->shift, matrix->is_definite ? JN_DEFINITE : JN_EXACT, in, out);
}

static const JnMatrixOps matrix_ops = {.apply = apply, .solve = solve, .approximate = approximate};

static bool same_shift(JnShift a, JnShift b) {
	return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

JnStatus jn_model_matrix(JnModelSystem* sys, JnShift shift, JnMatrix** out) {
	JnModelMatrix* chosen = &sys->matrices[0];
	const double cost = sys->solver->type->attach != NULL ? refresh_cost_iterative : refresh_cost;
	for (int i = 0; i < JN_SOLVER_SLOTS; ++i) {
		JnModelMatrix* matrix = &sys->matrices[i];
		if (matrix->is_used && same_shift(matrix->shift, shift)) {
			chosen = matrix;
			break;
		}
		if (matrix->last_use < chosen->last_use) chosen = matrix;
	}
	if (!chosen->is_used || !same_shift(chosen->shift, shift))
		*chosen = (JnModelMatrix){.base = {.ops = &matrix_ops, .sys = &sys->base, .refresh_cost = cost},
								  .shift = shift,
								  .slot = (int)(chosen - sys->matrices),
								  .is_used = true};
	chosen->last_use = ++sys->uses;
	*out = &chosen->base;
	return JN_OK;
}

void jn_model_matrix_expire(JnModelSystem* sys) {
	for (int i = 0; i < JN_SOLVER_SLOTS; ++i)
		if (depends_on_state(sys->matrices[i].shift)) sys->matrices[i].base.is_factored = false;
}
