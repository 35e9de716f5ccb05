// Operator splitting as in OSQP (Stellato, Banjac, Goulart, Bemporad and Boyd 2020), the method of Higher-Order Time
// Integration for Deformable Solids, section 4.2. With w = b + G dv the relative velocities less their bounds, and z
// their copies that obey the contact law:
//
//   (C + G' R G) dv = G' (R (z - b) - y)        one factor serves until R changes
//   w~ = 1.6 w - 0.6 z,   z = projection of w~ + y / R,   y = y + R (w~ - z)
//
// and s = R (z - w) - y are multipliers for which C dv = G' s holds exactly. R = rho / (G P G'), P = 1 / diag(C): the
// paper's scaling. OSQP's sigma is 0: C is definite. Friction projects onto the dual of the friction cone, shifted by
// mu |z_t| of the iteration before (De Saxce and Feng 1998; Tasora, Mangoni, Benatti and Garziera 2021), a fixed point that
// is Coulomb's law. Polishing solves for the contacts that press as equations, by the method of multipliers.
#include <math.h>
#include <string.h>

#include "solve/qp_cone.h"
#include "solve/qp_penalty.h"

static const double relaxation = 1.6, first_rho = 1, rho_change = 5, polish_penalty = 1e4;
enum { CHECK = 20, POLISH_STEPS = 6, POLISH_TRIES = 4, RHO_CHANGES = 12 };

typedef struct Admm {
	JnQp base;
	JnPenalty penalty;
	JnNumbers numbers;
	JnIndices marks;
	double *z, *old, *y;           // one a row
	double *unit, *rho, *polished; // one a contact: 1 / (G P G'), R, and R of polishing
	int *pressing, *tried;         // one a contact: the set now, and that of the last check
	double level;                  // rho
	double goal;                   // residual at which the multipliers are tried out
	int rho_changes, tries;
} Admm;

static JnStatus reserve(Admm* a) {
	const size_t contacts = (size_t)a->base.rows.contacts, rows = (size_t)a->base.rows.count;
	JN_TRY(jn_numbers_reserve(&a->numbers, 3 * rows + 3 * contacts));
	JN_TRY(jn_indices_reserve(&a->marks, 2 * contacts));
	a->z = a->numbers.at;
	a->old = a->z + rows;
	a->y = a->old + rows;
	a->unit = a->y + rows;
	a->rho = a->unit + contacts;
	a->polished = a->rho + contacts;
	a->pressing = a->marks.at;
	a->tried = a->pressing + contacts;
	return JN_OK;
}

// unit_i = 1 / (G_i P G_i') of the normal row.
static void measure_units(Admm* a) {
	const JnContactProblem* problem = a->base.problem;
	double* diagonal = a->base.rhs;
	problem->matrix.diagonal(problem->matrix.user, diagonal);
	for (int i = 0; i < problem->count; ++i) {
		double sum = 0;
		for (int k = problem->start[i]; k < problem->start[i + 1]; ++k)
			for (int axis = 0; axis < 3; ++axis) {
				const size_t entry = 3 * (size_t)problem->node[k] + (size_t)axis;
				const double g = a->base.rows.scale[i] * problem->weight[k] * problem->frame[i][axis];
				if (problem->held == NULL || !problem->held[entry]) sum += g * g / diagonal[entry];
			}
		a->unit[i] = sum > 0 ? 1 / sum : 0;
	}
}

// Typical G P G' over typical G C^-1 G', seen by the impulses that stop each contact alone: 1 for bodies that are soft
// within the step, far below 1 for stiff ones, where all contacts share one mass. Starts rho at the right size.
static JnStatus measure_softness(Admm* a, double* softness) {
	JnQp* qp = &a->base;
	const JnContactMatrix* matrix = &qp->problem->matrix;
	double *diagonal = qp->work, jacobi = 0, exact = 0;
	for (int i = 0; i < qp->rows.contacts; ++i)
		for (int row = qp->rows.first[i]; row < qp->rows.first[i + 1]; ++row)
			a->y[row] = row == qp->rows.first[i] ? a->unit[i] * fmax(0, -qp->rows.before[row]) : 0;
	jn_qp_rows_transpose(qp, a->y, qp->rhs);
	JN_TRY(matrix->solve(matrix->user, qp->rhs, qp->change));
	++qp->report.solves;
	matrix->diagonal(matrix->user, diagonal);
	for (size_t k = 0; k < 3 * (size_t)qp->problem->nodes; ++k) {
		if (qp->problem->held != NULL && qp->problem->held[k]) continue;
		jacobi += qp->rhs[k] * qp->rhs[k] / diagonal[k];
		exact += qp->rhs[k] * qp->change[k];
	}
	*softness = exact > 0 ? jacobi / exact : 1;
	return JN_OK;
}

static JnStatus set_level(Admm* a, double level) {
	a->level = level;
	for (int i = 0; i < a->base.rows.contacts; ++i) a->rho[i] = level * a->unit[i];
	return jn_penalty_factor(&a->penalty, &a->base, a->rho);
}

static void start(Admm* a) {
	const JnQpRows* rows = &a->base.rows;
	for (int row = 0; row < rows->count; ++row) {
		a->y[row] = -rows->lambda[row];
		a->z[row] = rows->before[row];
	}
	for (int i = 0; i < rows->contacts; ++i)
		if (rows->first[i + 1] > rows->first[i]) a->z[rows->first[i]] = fmax(0, a->z[rows->first[i]]);
	memset(a->pressing, 0, 2 * (size_t)rows->contacts * sizeof *a->pressing);
	a->rho_changes = a->tries = 0;
}

// dv, then w in rows.after and s in rows.lambda, from targets z and y with penalties rho.
static JnStatus find_velocities(Admm* a, const double* rho, const double* z) {
	JnQp* qp = &a->base;
	JnQpRows* rows = &qp->rows;
	for (int i = 0; i < rows->contacts; ++i)
		for (int row = rows->first[i]; row < rows->first[i + 1]; ++row)
			rows->lambda[row] = rho[i] * ((z != NULL ? z[row] : 0) - rows->before[row]) - a->y[row];
	jn_qp_rows_transpose(qp, rows->lambda, qp->rhs);
	JN_TRY(jn_penalty_solve(&a->penalty, qp, qp->rhs, qp->change));
	jn_qp_rows_apply(qp, qp->change, rows->after);
	for (int i = 0; i < rows->contacts; ++i)
		for (int row = rows->first[i]; row < rows->first[i + 1]; ++row) {
			rows->lambda[row] -= rho[i] * rows->after[row];
			rows->after[row] += rows->before[row];
		}
	return JN_OK;
}

static void project(Admm* a, int contact) {
	const JnQpRows* rows = &a->base.rows;
	const int first = rows->first[contact], count = rows->first[contact + 1] - first;
	const double rho = a->rho[contact], mu = rows->mu[contact];
	if (rho == 0) return; // held nodes alone: nothing moves them
	double relaxed[3] = {0}, z[3] = {0};
	for (int axis = 0; axis < count; ++axis) {
		relaxed[axis] = relaxation * rows->after[first + axis] + (1 - relaxation) * a->z[first + axis];
		z[axis] = relaxed[axis] + a->y[first + axis] / rho;
	}
	const double shift = count == 3 ? mu * hypot(a->z[first + 1], a->z[first + 2]) : 0;
	z[0] += shift;
	jn_dual_cone_project(count == 3 ? mu : 0, z);
	z[0] -= shift;
	for (int axis = 0; axis < count; ++axis) {
		a->z[first + axis] = z[axis];
		a->y[first + axis] += rho * (relaxed[axis] - z[axis]);
	}
}

static JnStatus iterate(Admm* a) {
	JN_TRY(find_velocities(a, a->rho, a->z));
	memcpy(a->old, a->z, (size_t)a->base.rows.count * sizeof *a->old);
	for (int i = 0; i < a->base.rows.contacts; ++i) project(a, i);
	return JN_OK;
}

// sqrt of relative primal over relative dual residual: by how much rho should grow.
static double imbalance(const Admm* a) {
	const JnQpRows* rows = &a->base.rows;
	double primal = 0, dual = 0, velocity = 0, impulse = 0;
	for (int i = 0; i < rows->contacts; ++i)
		for (int row = rows->first[i]; row < rows->first[i + 1]; ++row) {
			primal = fmax(primal, fabs(rows->after[row] - a->z[row]));
			velocity = fmax(velocity, fmax(fabs(rows->after[row]), fabs(a->z[row])));
			dual = fmax(dual, a->rho[i] * fabs(a->z[row] - a->old[row]));
			impulse = fmax(impulse, fabs(a->y[row]));
		}
	if (!(primal > 0 && dual > 0 && velocity > 0 && impulse > 0)) return 1;
	return fmin(fmax(sqrt(primal * impulse / (velocity * dual)), 1e-3), 1e3);
}

static JnStatus adapt(Admm* a) {
	const double growth = imbalance(a);
	if (a->rho_changes >= RHO_CHANGES || (growth < rho_change && growth > 1 / rho_change)) return JN_OK;
	++a->rho_changes;
	return set_level(a, fmin(fmax(a->level * growth, 1e-9), 1e6));
}

// The set of pressing contacts has stayed the same since the last check. Sliding is no equation: not polished; nor is
// it worth while with the large penalties of polishing and inexact solves.
static bool is_settled(Admm* a) {
	const JnQpRows* rows = &a->base.rows;
	bool is_same = true, is_sliding = false;
	for (int i = 0; i < rows->contacts; ++i) {
		const int row = rows->first[i];
		if (rows->first[i + 1] == row) continue;
		a->pressing[i] = a->y[row] < 0;
		is_same = is_same && a->pressing[i] == a->tried[i];
		if (rows->first[i + 1] - row == 3 && a->pressing[i])
			is_sliding = is_sliding || hypot(a->y[row + 1], a->y[row + 2]) >= -rows->mu[i] * a->y[row] * (1 - 1e-9);
		a->tried[i] = a->pressing[i];
	}
	return is_same && !is_sliding && a->base.problem->matrix.blocks != NULL;
}

// Bring the multipliers into their cones and see what velocities belong to them: on stiff bodies, where all contacts move
// one mass, what is cut off adds up. When it is too much, go on to a smaller residual.
static JnStatus try_out(Admm* a, bool* is_solved) {
	JnQp* qp = &a->base;
	const JnContactMatrix* matrix = &qp->problem->matrix;
	*is_solved = false;
	if (!(jn_qp_rows_residual(qp) <= a->goal)) return JN_OK;
	for (int i = 0; i < qp->rows.contacts; ++i) jn_qp_rows_clip(qp, i);
	jn_qp_rows_transpose(qp, qp->rows.lambda, qp->rhs);
	JN_TRY(matrix->solve(matrix->user, qp->rhs, qp->change));
	++qp->report.solves;
	jn_qp_rows_apply(qp, qp->change, qp->rows.after);
	for (int row = 0; row < qp->rows.count; ++row) qp->rows.after[row] += qp->rows.before[row];
	*is_solved = jn_qp_rows_residual(qp) <= 0.3 * qp->options.tolerance;
	a->goal *= 0.3;
	return JN_OK;
}

// w = 0 at the contacts that press, no impulse at the others. True when that solves the problem.
static JnStatus polish(Admm* a, bool* worked) {
	const JnQpRows* rows = &a->base.rows;
	memcpy(a->old, a->y, (size_t)rows->count * sizeof *a->old);
	for (int i = 0; i < rows->contacts; ++i) {
		a->polished[i] = a->pressing[i] ? polish_penalty * fmax(a->level, 1) * a->unit[i] : 0;
		for (int row = rows->first[i]; row < rows->first[i + 1]; ++row) a->y[row] = a->pressing[i] ? a->y[row] : 0;
	}
	JN_TRY(jn_penalty_factor(&a->penalty, &a->base, a->polished));
	for (int step = 0; step < POLISH_STEPS && !*worked; ++step) {
		JN_TRY(find_velocities(a, a->polished, NULL));
		for (int row = 0; row < rows->count; ++row) a->y[row] = -rows->lambda[row];
		JN_TRY(try_out(a, worked));
	}
	if (*worked) return JN_OK;
	memcpy(a->y, a->old, (size_t)rows->count * sizeof *a->old);
	return jn_penalty_factor(&a->penalty, &a->base, a->rho);
}

static JnStatus iterate_until_solved(Admm* a) {
	JnQp* qp = &a->base;
	while (qp->report.iterations < qp->options.max_iterations) {
		bool is_solved = false;
		++qp->report.iterations;
		JN_TRY(iterate(a));
		JN_TRY(try_out(a, &is_solved));
		if (is_solved) return JN_OK;
		if (qp->report.iterations % CHECK != 0) continue;
		if (is_settled(a) && a->tries < POLISH_TRIES) {
			++a->tries;
			JN_TRY(polish(a, &is_solved));
		}
		if (is_solved) return JN_OK;
		JN_TRY(adapt(a));
	}
	return JN_NOT_CONVERGED;
}

static JnStatus solve(JnQp* qp) {
	Admm* a = (Admm*)qp;
	double softness;
	jn_penalty_begin(&a->penalty);
	JN_TRY(reserve(a));
	measure_units(a);
	JN_TRY(measure_softness(a, &softness));
	start(a);
	JN_TRY(set_level(a, first_rho * softness));
	a->goal = 0.1 * qp->options.tolerance;
	qp->report.rows = qp->rows.count;
	const JnStatus status = iterate_until_solved(a);
	for (int i = 0; i < qp->rows.contacts; ++i) jn_qp_rows_clip(qp, i);
	return status;
}

static void release(JnQp* qp) {
	Admm* a = (Admm*)qp;
	jn_penalty_release(&a->penalty);
	free(a->numbers.at);
	free(a->marks.at);
}

const JnQpType jn_qp_admm = {
	.row = {.name = "admm",
			.doc =
				"operator splitting as in OSQP: one sparse factor of C + rho G'G, many cheap iterations; the reference",
			.keys = jn_qp_keys,
			.options_size = sizeof(JnQpDef)},
	.size = sizeof(Admm),
	.solve = solve,
	.release = release,
};
