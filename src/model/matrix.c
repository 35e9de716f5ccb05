// Shifted matrices of a model. Products use M, D and K as they are; a solve factors their sum on first use. When the
// Cholesky factorisation meets an indefinite matrix, K is replaced by its definite form for this factor alone. With the
// exact tangent of a wind the matrix is not symmetric, and LU takes the place of Cholesky.
#include <stdlib.h>
#include <string.h>

#include "model/damping.h"
#include "model/stiffness.h"
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

static JnDefinite form_of(const JnModelMatrix* matrix) {
	return matrix->is_definite ? JN_DEFINITE : JN_EXACT;
}

// scratch = m M + d D + k K.
static void combine(JnModelSystem* sys, const JnModelMatrix* matrix) {
	const JnPattern* pattern = &sys->model->pattern;
	const JnShift shift = matrix->shift;
	const size_t entries = 9 * (size_t)pattern->blocks;
	const double* damping = shift.damping != 0 ? jn_damping_blocks(sys) : NULL;
	const double* stiffness = shift.stiffness != 0 ? jn_stiffness_blocks(sys, form_of(matrix)) : NULL;
	for (size_t k = 0; k < entries; ++k) sys->scratch[k] = stiffness != NULL ? shift.stiffness * stiffness[k] : 0;
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

static JnStatus factor_as(JnModelMatrix* matrix, bool is_definite) {
	JnModelSystem* sys = (JnModelSystem*)matrix->base.sys;
	JnSolver* solver = solver_of(matrix);
	++sys->base.report->factorizations;
	if (is_definite) ++sys->base.report->indefinite;
	matrix->is_definite = is_definite;
	if (solver->type->attach != NULL) return solver->type->factor(solver, matrix->slot, NULL);
	combine(sys, matrix);
	if (solver == sys->solver) return solver->type->factor(solver, matrix->slot, sys->scratch);
	add_wind(sys, matrix->shift);
	return solver->type->factor(solver, matrix->slot, sys->full);
}

static JnStatus factor(JnModelMatrix* matrix) {
	JnStatus status = factor_as(matrix, false);
	if (status == JN_INDEFINITE && matrix->shift.stiffness != 0) status = factor_as(matrix, true);
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

// To a tolerance; 0: exactly. The solver may change its way at any matrix or solve.
static JnStatus solve_with(JnModelMatrix* matrix, double tolerance, const double* rhs, JnVec out) {
	JnSolver* solver = solver_of(matrix);
	JnReport* report = matrix->base.sys->report;
	const JnStatus status = tolerance > 0 ? solver->type->approximate(solver, matrix->slot, tolerance, rhs, out)
										  : solver->type->solve(solver, matrix->slot, rhs, out);
	report->iterations += solver->iterations;
	++report->served[solver->way];
	report->changes += solver->changes;
	solver->changes = 0;
	matrix->base.is_iterative = solver->is_iterative;
	return status;
}

// A solver that iterates may find out only now that the matrix is indefinite; `out`, which may be rhs, is then untouched.
static JnStatus solve_to(JnMatrix* base, double tolerance, const double* rhs, JnVec out) {
	JnModelMatrix* matrix = (JnModelMatrix*)base;
	JnModelSystem* sys = (JnModelSystem*)base->sys;
	if (!depends_on_state(matrix->shift) && sys->model->mass_is_diagonal) {
		divide_by_mass(sys, matrix->shift.mass, rhs, out);
		return JN_OK;
	}
	++sys->base.report->solves;
	if (!matrix->base.is_factored) JN_TRY(factor(matrix));
	JnStatus status = solve_with(matrix, tolerance, rhs, out);
	if (status == JN_INDEFINITE && matrix->shift.stiffness != 0 && !matrix->is_definite) {
		status = factor_as(matrix, true);
		if (status == JN_OK) status = solve_with(matrix, tolerance, rhs, out);
	}
	matrix->base.is_factored = status == JN_OK; // a solver that changed its way in vain may have nothing left
	return status;
}

static JnStatus solve(JnMatrix* base, const double* rhs, JnVec out) {
	return solve_to(base, 0, rhs, out);
}

static JnStatus approximate(JnMatrix* base, double tolerance, const double* rhs, JnVec out) {
	return solve_to(base, tolerance, rhs, out);
}

static void apply_shifted(JnModelSystem* sys, JnShift shift, JnDefinite definite, const double* in, JnVec out) {
	const JnModel* model = sys->model;
	memset(out, 0, 3 * (size_t)model->node_count * sizeof *out);
	if (model->mass_is_diagonal)
		for (int k = 0; k < 3 * model->node_count; ++k) out[k] = shift.mass * model->nodal_mass[k / 3] * in[k];
	else if (shift.mass != 0)
		jn_scalars_apply(&model->pattern, model->mass, shift.mass, in, out, model->threads);
	if (shift.damping != 0) jn_damping_apply_mass(sys, shift.damping, in, out);
	if (shift.damping != 0) jn_damping_apply(sys, shift.damping, in, out);
	if (shift.stiffness != 0) jn_stiffness_apply(sys, definite, shift.stiffness, in, out);
	if (sys->unsymmetric != NULL) jn_wind_apply(model->wind, shift, in, out);
}

static void apply(JnMatrix* base, const double* in, JnVec out) {
	apply_shifted((JnModelSystem*)base->sys, ((const JnModelMatrix*)base)->shift, JN_EXACT, in, out);
}

static void operator_apply(void* user, int slot, const double* in, double* out) {
	JnModelSystem* sys = user;
	const JnModelMatrix* matrix = &sys->matrices[slot];
	apply_shifted(sys, matrix->shift, form_of(matrix), in, out);
}

// One number a block as floats, in the order of full rows.
static float* full_rows(const JnPattern* pattern, const double* blocks) {
	const int count = pattern->full_start[pattern->nodes];
	float* full = malloc(((size_t)count + 1) * sizeof *full);
	for (int k = 0; k < count && full != NULL; ++k) {
		const int block = pattern->full_block[k];
		full[k] = (float)blocks[block >= 0 ? block : ~block];
	}
	return full;
}

// False where memory is short.
static bool scalar_term(JnModelSystem* sys, double scale, const double* blocks, float** full, JnScalarTerm* term) {
	const JnModel* model = sys->model;
	if (scale == 0 || blocks == NULL) return true;
	if (!model->mass_is_diagonal && *full == NULL) *full = full_rows(&model->pattern, blocks);
	*term = (JnScalarTerm){.scale = scale, .blocks = blocks, .full = *full};
	return model->mass_is_diagonal || *full != NULL;
}

// M and the alpha part of D, as factors of the elements' mass or else as matrices. False where memory is short.
static bool mass_terms(JnModelSystem* sys, JnShift shift, JnSingleSum* sum) {
	const JnModel* model = sys->model;
	if (sys->group_mass == NULL || shift.stiffness == 0)
		return scalar_term(sys, shift.mass, model->mass, &sys->full_mass, &sum->scalars[0]) &&
			   scalar_term(sys, shift.damping, sys->alpha_mass, &sys->full_alpha, &sum->scalars[1]);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		const double alpha = sys->alpha_mass != NULL ? body->damping.alpha : 0;
		for (int g = 0; g < body->group_count; ++g)
			sys->group_mass[body->first_group + g] = body->density * (shift.mass + shift.damping * alpha);
	}
	sum->mass = sys->group_mass;
	return true;
}

// The terms of a matrix in single precision. False where one of them is not to be had.
static bool single_sum(JnModelSystem* sys, const JnModelMatrix* matrix, JnSingleSum* sum) {
	const JnShift shift = matrix->shift;
	*sum = (JnSingleSum){0};
	if (!mass_terms(sys, shift, sum)) return false;
	const bool has_damping = shift.damping != 0 && sys->damping != NULL && sys->damping_acts;
	if (shift.stiffness != 0)
		sum->stored[0] = (JnStoredTerm){shift.stiffness, jn_stiffness_single(sys, form_of(matrix))};
	if (has_damping) sum->stored[1] = (JnStoredTerm){shift.damping, jn_damping_single(sys)};
	return (shift.stiffness == 0 || sum->stored[0].stored != NULL) && (!has_damping || sum->stored[1].stored != NULL);
}

// Where single precision is not to be had, double serves.
static void apply_widened(JnModelSystem* sys, int slot, const float* in, float* out) {
	const int nodes = sys->model->node_count;
	for (int k = 0; k < 3 * nodes; ++k) sys->wide_in[k] = (double)in[4 * (k / 3) + k % 3];
	operator_apply(sys, slot, sys->wide_in, sys->wide_out);
	for (int k = 0; k < 4 * nodes; ++k) out[k] = k % 4 < 3 ? (float)sys->wide_out[3 * (k / 4) + k % 4] : 0;
}

static void operator_apply_single(void* user, int slot, const float* in, float* out) {
	JnModelSystem* sys = user;
	JnSingleSum sum;
	if (single_sum(sys, &sys->matrices[slot], &sum))
		jn_assembly_apply_single(sys->assembly, &sum, in, out);
	else
		apply_widened(sys, slot, in, out);
}

static bool has_single(const JnModelSystem* sys) {
	return jn_assembly_has_single(sys->assembly, NULL) && sys->model->repulsion == NULL &&
		   (sys->model->wind == NULL || sys->model->wind->tangent == NULL);
}

static const double* operator_blocks(void* user, int slot) {
	JnModelSystem* sys = user;
	combine(sys, &sys->matrices[slot]);
	return sys->scratch;
}

static const double* operator_diagonal(void* user, int slot) {
	JnModelSystem* sys = user;
	const JnModelMatrix* matrix = &sys->matrices[slot];
	const JnShift shift = matrix->shift;
	const JnPattern* pattern = &sys->model->pattern;
	const double* damping = shift.damping != 0 ? jn_damping_diagonal(sys) : NULL;
	const double* stiffness = shift.stiffness != 0 ? jn_stiffness_diagonal(sys, form_of(matrix)) : NULL;
	for (int node = 0; node < pattern->nodes; ++node) {
		const size_t block = (size_t)pattern->column_start[node], k = 9 * (size_t)node;
		double scalar = shift.mass * sys->model->mass[block];
		if (sys->alpha_mass != NULL) scalar += shift.damping * sys->alpha_mass[block];
		for (size_t e = 0; e < 9; ++e) {
			double sum = e % 4 == 0 ? scalar : 0;
			if (stiffness != NULL) sum += shift.stiffness * stiffness[k + e];
			if (damping != NULL) sum += shift.damping * damping[k + e];
			sys->shifted_diagonal[k + e] = sum;
		}
	}
	return sys->shifted_diagonal;
}

static bool operator_is_mass(void* user, int slot) {
	return !depends_on_state(((const JnModelSystem*)user)->matrices[slot].shift);
}

static const double* operator_positions(void* user, int slot) {
	(void)slot;
	return ((const JnModelSystem*)user)->linear_x;
}

JnOperator jn_model_matrix_operator(JnModelSystem* sys) {
	return (JnOperator){.user = sys,
						.apply = operator_apply,
						.is_assembled = !sys->has_products && !sys->model->is_matrix_free,
						.apply_single = has_single(sys) ? operator_apply_single : NULL,
						.diagonal = operator_diagonal,
						.blocks = operator_blocks,
						.positions = operator_positions,
						.rest = sys->model->rest,
						.is_mass = operator_is_mass,
						.floor = &sys->base.force_floor};
}

static const JnMatrixOps matrix_ops = {.apply = apply, .solve = solve, .approximate = approximate};

static bool same_shift(JnShift a, JnShift b) {
	return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

JnStatus jn_model_matrix(JnModelSystem* sys, JnShift shift, JnMatrix** out) {
	JnModelMatrix* chosen = &sys->matrices[0];
	const bool is_iterative = sys->solver->is_iterative;
	const double cost = is_iterative ? refresh_cost_iterative : refresh_cost;
	for (int i = 0; i < JN_SOLVER_SLOTS; ++i) {
		JnModelMatrix* matrix = &sys->matrices[i];
		if (matrix->is_used && same_shift(matrix->shift, shift)) {
			chosen = matrix;
			break;
		}
		if (matrix->last_use < chosen->last_use) chosen = matrix;
	}
	if (!chosen->is_used || !same_shift(chosen->shift, shift))
		*chosen = (JnModelMatrix){.base = {.ops = &matrix_ops, .sys = &sys->base},
								  .shift = shift,
								  .slot = (int)(chosen - sys->matrices),
								  .is_used = true};
	chosen->base.refresh_cost = cost;
	chosen->base.is_iterative = is_iterative;
	chosen->last_use = ++sys->uses;
	*out = &chosen->base;
	return JN_OK;
}

void jn_model_matrix_expire(JnModelSystem* sys) {
	for (int i = 0; i < JN_SOLVER_SLOTS; ++i)
		if (depends_on_state(sys->matrices[i].shift)) sys->matrices[i].base.is_factored = false;
}
