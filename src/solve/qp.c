// What all contact solvers share: checks, the scaled rows, and from the multipliers the velocities
// v = vp + C^-1 G' lambda, refined once, and their residuals.
#include "solve/qp.h"

#include <math.h>
#include <string.h>

#include "base/log.h"
#include "solve/qp_rows.h"

JnStatus jn_qp_create(const JnQpType* type, const JnQpDef* options, JnQp** out) {
	*out = calloc(1, type->size);
	if (*out == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: contact solver");
	(*out)->type = type;
	(*out)->options = *options;
	return JN_OK;
}

void jn_qp_destroy(JnQp* qp) {
	if (qp == NULL) return;
	qp->type->release(qp);
	free(qp->row_numbers.at);
	free(qp->row_indices.at);
	free(qp->vectors.at);
	free(qp->marks.at);
	free(qp);
}

static JnStatus check_nodes(const JnContactProblem* problem) {
	for (int i = 0; i < problem->count; ++i)
		for (int k = problem->start[i]; k < problem->start[i + 1]; ++k)
			if (problem->node[k] < 0 || problem->node[k] >= problem->nodes)
				return jn_error(JN_BAD_INPUT, "contact %d names node %d, but there are %d nodes", i, problem->node[k],
								problem->nodes);
	return JN_OK;
}

static bool are_finite(const double* numbers, size_t count) {
	for (size_t k = 0; k < count; ++k)
		if (!isfinite(numbers[k])) return false;
	return true;
}

static bool is_finite_input(const JnContactProblem* problem, const double* lambda) {
	const size_t count = (size_t)problem->count;
	for (size_t i = 0; i < count; ++i) {
		const bool has_friction = problem->friction != NULL && problem->friction[i] != 0;
		if (!are_finite(problem->frame[i], has_friction ? 9 : 3)) return false;
		if (!are_finite(problem->bound[i], has_friction ? 3 : 1)) return false;
		if (has_friction && !isfinite(problem->friction[i])) return false;
		double u[3];
		jn_contact_velocity(problem, (int)i, problem->vp, u);
		if (!are_finite(u, 3)) return false;
	}
	return are_finite(lambda, 3 * count) && are_finite(problem->weight, count > 0 ? (size_t)problem->start[count] : 0);
}

static void keep_prediction(const JnContactProblem* problem, double* v, double* lambda) {
	memcpy(v, problem->vp, 3 * (size_t)problem->nodes * sizeof *v);
	memset(lambda, 0, 3 * (size_t)problem->count * sizeof *lambda);
}

// No contact is violated at vp: lambda = 0 is the solution.
static bool is_free(const JnQpRows* rows) {
	for (int i = 0; i < rows->contacts; ++i)
		if (rows->first[i + 1] > rows->first[i] && rows->before[rows->first[i]] < 0) return false;
	return true;
}

static bool is_pushed(const double* lambda) {
	return lambda[0] != 0 || lambda[1] != 0 || lambda[2] != 0;
}

// marks[b] = whether some contact pushes body b.
static JnStatus mark_bodies(JnQp* qp, const double* lambda) {
	const JnContactProblem* problem = qp->problem;
	const size_t bodies = problem->body_count > 0 ? (size_t)problem->body_count : 1;
	JN_TRY(jn_indices_reserve(&qp->marks, bodies));
	memset(qp->marks.at, 0, bodies * sizeof *qp->marks.at);
	for (int i = 0; i < problem->count; ++i)
		for (int k = problem->start[i]; is_pushed(lambda + 3 * (size_t)i) && k < problem->start[i + 1]; ++k)
			qp->marks.at[jn_qp_body_of(problem, problem->node[k])] = 1;
	return JN_OK;
}

static JnStatus solve_change(JnQp* qp) {
	const JnContactMatrix* matrix = &qp->problem->matrix;
	const bool* held = qp->problem->held;
	const size_t entries = 3 * (size_t)qp->problem->nodes;
	double *product = qp->work, *correction = qp->work + entries;
	jn_qp_rows_transpose(qp, qp->rows.lambda, qp->rhs);
	JN_TRY(matrix->solve(matrix->user, qp->rhs, qp->change));
	matrix->apply(matrix->user, qp->change, product);
	for (size_t k = 0; k < entries; ++k) product[k] = held != NULL && held[k] ? 0 : qp->rhs[k] - product[k];
	JN_TRY(matrix->solve(matrix->user, product, correction));
	for (size_t k = 0; k < entries; ++k) qp->change[k] += correction[k];
	qp->report.solves += 2;
	return JN_OK;
}

// v = vp + C^-1 G' lambda in the bodies that some contact pushes, vp in the others and in held entries.
static JnStatus find_velocities(JnQp* qp, const double* lambda, double* v) {
	const JnContactProblem* problem = qp->problem;
	JN_TRY(mark_bodies(qp, lambda));
	JN_TRY(solve_change(qp));
	const int bodies = problem->body_count > 0 ? problem->body_count : 1;
	for (int body = 0; body < bodies; ++body) {
		if (!qp->marks.at[body]) continue;
		const size_t begin = problem->body_count > 0 ? 3 * (size_t)problem->first_node[body] : 0;
		const size_t end = 3 * (size_t)(problem->body_count > 0 ? problem->first_node[body + 1] : problem->nodes);
		for (size_t k = begin; k < end; ++k)
			if (problem->held == NULL || !problem->held[k]) v[k] = problem->vp[k] + qp->change[k];
	}
	return JN_OK;
}

// The multipliers of the rows and the velocities; prediction and zeros where they are not finite.
static JnStatus solve_rows(JnQp* qp, double* v, double* lambda) {
	const JnContactProblem* problem = qp->problem;
	const JnStatus outcome = qp->type->solve(qp);
	if (outcome < 0) return outcome;
	const bool is_sane = are_finite(qp->rows.lambda, (size_t)qp->rows.count);
	if (!is_sane) return JN_NOT_FINITE;
	jn_qp_rows_unscale(qp, lambda);
	JN_TRY(find_velocities(qp, lambda, v));
	return are_finite(v, 3 * (size_t)problem->nodes) ? outcome : JN_NOT_FINITE;
}

JnStatus jn_qp_solve(JnQp* qp, const JnContactProblem* problem, double* v, double* lambda, JnQpReport* report) {
	qp->report = (JnQpReport){0};
	*report = qp->report;
	JN_TRY(check_nodes(problem));
	const bool is_sane = is_finite_input(problem, lambda);
	if (is_sane) JN_TRY(jn_qp_rows_prepare(qp, problem, lambda));
	keep_prediction(problem, v, lambda);
	if (!is_sane) return JN_NOT_FINITE;
	JnStatus status = is_free(&qp->rows) ? JN_OK : solve_rows(qp, v, lambda);
	if (status == JN_NOT_FINITE) keep_prediction(problem, v, lambda);
	if (status >= 0) jn_contact_residual(problem, v, lambda, qp->work, &qp->report.residual);
	*report = qp->report;
	if (status != JN_OK && status != JN_NOT_CONVERGED) return status;
	return jn_contact_residual_max(&report->residual) <= qp->options.tolerance ? JN_OK : JN_NOT_CONVERGED;
}
