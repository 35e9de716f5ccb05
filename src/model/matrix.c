// Shifted matrices of a model. Products use M, D and K as they are; a solve factors their sum on first use. When the
// Cholesky factorisation meets an indefinite matrix, K is replaced by its definite form for this factor alone. With the
// exact tangent of a wind the matrix is not symmetric, and LU takes the place of Cholesky.
#include <string.h>

#include "model/system.h"
#include "model/wind.h"

// What a new tangent and factor cost, in iterations that use an old one (a solve, a force, a product with M). Larger
// factors run at higher speed, so that the ratio hardly depends on size: measured 18 for the beam of 825 nodes.
static const double refresh_cost = 16;

static bool depends_on_state(JnShift shift) {
	return shift.damping != 0 || shift.stiffness != 0;
}

static void add_scalars(const JnPattern* pattern, double scale, const double* scalars, double* blocks) {
	for (int k = 0; k < pattern->blocks; ++k)
		for (int axis = 0; axis < 3; ++axis) blocks[9 * (size_t)k + 4 * (size_t)axis] += scale * scalars[k];
}

// scratch = m M + d D + k K, where K stands in `stiffness` (which may be scratch itself).
static void combine(const JnModelSystem* sys, JnShift shift, const double* stiffness) {
	const JnPattern* pattern = &sys->model->pattern;
	const size_t entries = 9 * (size_t)pattern->blocks;
	for (size_t k = 0; k < entries; ++k) sys->scratch[k] = shift.stiffness * stiffness[k];
	if (sys->damping != NULL && shift.damping != 0)
		for (size_t k = 0; k < entries; ++k) sys->scratch[k] += shift.damping * sys->damping[k];
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

static JnStatus factor(JnModelMatrix* matrix) {
	JnModelSystem* sys = (JnModelSystem*)matrix->base.sys;
	combine(sys, matrix->shift, sys->stiffness);
	JnStatus status = factor_scratch(matrix);
	if (status == JN_INDEFINITE && matrix->shift.stiffness != 0) {
		++sys->base.report->indefinite;
		jn_assembly_tangent(sys->assembly, sys->linear_x, JN_DEFINITE, NULL, sys->scratch);
		combine(sys, matrix->shift, sys->scratch);
		status = factor_scratch(matrix);
	}
	if (status != JN_OK) return status;
	matrix->base.is_factored = true;
	return JN_OK;
}

static void divide_by_mass(const JnModel* model, double mass, const double* rhs, double* out) {
	for (int k = 0; k < 3 * model->node_count; ++k)
		out[k] = model->held[k] ? 0 : rhs[k] / (mass * model->nodal_mass[k / 3]);
}

typedef JnStatus Solve(JnSolver*, int slot, const double* rhs, double* out);

static JnStatus solve_by(JnMatrix* base, Solve* solve, const double* rhs, JnVec out) {
	JnModelMatrix* matrix = (JnModelMatrix*)base;
	JnModelSystem* sys = (JnModelSystem*)base->sys;
	if (!depends_on_state(matrix->shift) && sys->model->mass_is_diagonal) {
		divide_by_mass(sys->model, matrix->shift.mass, rhs, out);
		return JN_OK;
	}
	++sys->base.report->solves;
	if (!matrix->base.is_factored) JN_TRY(factor(matrix));
	return solve(solver_of(matrix), matrix->slot, rhs, out);
}

static JnStatus solve(JnMatrix* base, const double* rhs, JnVec out) {
	return solve_by(base, solver_of((JnModelMatrix*)base)->type->solve, rhs, out);
}

static JnStatus approximate(JnMatrix* base, const double* rhs, JnVec out) {
	return solve_by(base, solver_of((JnModelMatrix*)base)->type->approximate, rhs, out);
}

static void apply(JnMatrix* base, const double* in, JnVec out) {
	const JnModelMatrix* matrix = (const JnModelMatrix*)base;
	const JnModelSystem* sys = (const JnModelSystem*)base->sys;
	const JnModel* model = sys->model;
	const JnShift shift = matrix->shift;
	memset(out, 0, 3 * (size_t)model->node_count * sizeof *out);
	if (model->mass_is_diagonal)
		for (int k = 0; k < 3 * model->node_count; ++k) out[k] = shift.mass * model->nodal_mass[k / 3] * in[k];
	else if (shift.mass != 0)
		jn_scalars_apply(&model->pattern, model->mass, shift.mass, in, out, model->threads);
	if (shift.damping != 0 && sys->alpha_mass != NULL)
		jn_scalars_apply(&model->pattern, sys->alpha_mass, shift.damping, in, out, model->threads);
	if (shift.damping != 0 && sys->damping != NULL)
		jn_blocks_apply(&model->pattern, sys->damping, shift.damping, in, out, model->threads);
	if (shift.stiffness != 0)
		jn_blocks_apply(&model->pattern, sys->stiffness, shift.stiffness, in, out, model->threads);
	if (sys->unsymmetric != NULL) jn_wind_apply(model->wind, shift, in, out);
}

static const JnMatrixOps matrix_ops = {.apply = apply, .solve = solve, .approximate = approximate};

static bool same_shift(JnShift a, JnShift b) {
	return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

JnStatus jn_model_matrix(JnModelSystem* sys, JnShift shift, JnMatrix** out) {
	JnModelMatrix* chosen = &sys->matrices[0];
	for (int i = 0; i < JN_SOLVER_SLOTS; ++i) {
		JnModelMatrix* matrix = &sys->matrices[i];
		if (matrix->is_used && same_shift(matrix->shift, shift)) {
			chosen = matrix;
			break;
		}
		if (matrix->last_use < chosen->last_use) chosen = matrix;
	}
	if (!chosen->is_used || !same_shift(chosen->shift, shift))
		*chosen = (JnModelMatrix){.base = {.ops = &matrix_ops, .sys = &sys->base, .refresh_cost = refresh_cost},
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
