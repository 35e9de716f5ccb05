/// @file ipopt.h
/// Contact problems without friction by Ipopt (Waechter and Biegler 2006), an interior-point method by other hands.
#ifndef JN_TEST_SOLVE_IPOPT_H
#define JN_TEST_SOLVE_IPOPT_H

#include <coin/IpStdCInterface.h>

#include "solve/qp_case.h"

static inline double* ipopt_difference(const QpCase* c, const double* v, double* product) {
	const int n = 3 * c->pattern.nodes;
	double* change = malloc((size_t)n * sizeof *change);
	for (int k = 0; k < n; ++k) change[k] = v[k] - c->vp[k];
	qp_apply((void*)c, change, product);
	return change;
}

static Bool ipopt_objective(Index n, Number* v, Bool is_new, Number* out, UserDataPtr user) {
	(void)is_new;
	double* product = malloc((size_t)n * sizeof *product);
	double* change = ipopt_difference(user, v, product);
	*out = 0;
	for (int k = 0; k < n; ++k) *out += 0.5 * change[k] * product[k];
	free(change);
	free(product);
	return TRUE;
}

static Bool ipopt_gradient(Index n, Number* v, Bool is_new, Number* out, UserDataPtr user) {
	(void)n, (void)is_new;
	free(ipopt_difference(user, v, out));
	return TRUE;
}

static Bool ipopt_constraints(Index n, Number* v, Bool is_new, Index m, Number* out, UserDataPtr user) {
	(void)n, (void)is_new;
	for (int i = 0; i < m; ++i) {
		double u[3];
		jn_contact_velocity(&((const QpCase*)user)->problem, i, v, u);
		out[i] = u[0];
	}
	return TRUE;
}

static Bool ipopt_jacobian(Index n, Number* v, Bool is_new, Index m, Index entries, Index* row, Index* column,
						   Number* value, UserDataPtr user) {
	(void)n, (void)v, (void)is_new, (void)entries;
	const QpCase* c = user;
	for (int i = 0, at = 0; i < m; ++i)
		for (int k = c->start[i]; k < c->start[i + 1]; ++k)
			for (int axis = 0; axis < 3; ++axis, ++at) {
				if (value != NULL) value[at] = c->weight[k] * c->frame[i][axis];
				if (value == NULL) row[at] = i, column[at] = 3 * c->node[k] + axis;
			}
	return TRUE;
}

// The lower triangle of C; `row` and `value` may be NULL. Returns the count of entries.
static inline int ipopt_matrix(const QpCase* c, double factor, Index* row, Index* column, Number* value) {
	int at = 0;
	for (int node = 0; node < c->pattern.nodes; ++node)
		for (int k = c->pattern.column_start[node]; k < c->pattern.column_start[node + 1]; ++k)
			for (int e = 0; e < 9; ++e) {
				const int i = 3 * c->pattern.row[k] + e / 3, j = 3 * node + e % 3;
				if (i < j) continue;
				if (value != NULL) value[at] = factor * c->blocks[9 * (size_t)k + (size_t)e];
				if (row != NULL) row[at] = i, column[at] = j;
				++at;
			}
	return at;
}

static Bool ipopt_hessian(Index n, Number* v, Bool is_new, Number factor, Index m, Number* lambda, Bool is_new_lambda,
						  Index entries, Index* row, Index* column, Number* value, UserDataPtr user) {
	(void)n, (void)v, (void)is_new, (void)m, (void)lambda, (void)is_new_lambda, (void)entries;
	ipopt_matrix(user, factor, row, column, value);
	return TRUE;
}

static inline void ipopt_number(IpoptProblem ipopt, const char* name, double value) {
	assert_true(AddIpoptNumOption(ipopt, (char*)name, value));
}

/// Solve from vp, to some ten digits, into v[3 * nodes].
static inline void ipopt_solve(const QpCase* c, double* v) {
	const int n = 3 * c->pattern.nodes, m = c->problem.count;
	double *low = malloc((size_t)n * sizeof *low), *high = malloc((size_t)n * sizeof *high);
	double *least_speed = malloc((size_t)m * sizeof *least_speed), *infinite = malloc((size_t)m * sizeof *infinite);
	for (int k = 0; k < n; ++k) {
		low[k] = c->held[k] ? c->vp[k] : -1e20;
		high[k] = c->held[k] ? c->vp[k] : 1e20;
	}
	for (int i = 0; i < m; ++i) least_speed[i] = c->bound[i][0], infinite[i] = 1e20;
	IpoptProblem ipopt = CreateIpoptProblem(n, low, high, m, least_speed, infinite, 3 * c->start[m],
											ipopt_matrix(c, 1, NULL, NULL, NULL), 0, ipopt_objective, ipopt_constraints,
											ipopt_gradient, ipopt_jacobian, ipopt_hessian);
	assert_non_null(ipopt);
	ipopt_number(ipopt, "tol", 1e-11);
	ipopt_number(ipopt, "bound_relax_factor", 0);
	assert_true(AddIpoptIntOption(ipopt, "print_level", 0));
	assert_true(AddIpoptStrOption(ipopt, "sb", "yes"));
	assert_true(AddIpoptStrOption(ipopt, "hessian_constant", "yes"));
	memcpy(v, c->vp, (size_t)n * sizeof *v);
	double least;
	const enum ApplicationReturnStatus status = IpoptSolve(ipopt, v, NULL, &least, NULL, NULL, NULL, (void*)c);
	if (status != Solve_Succeeded && status != Solved_To_Acceptable_Level) fail_msg("Ipopt ended with %d", (int)status);
	FreeIpoptProblem(ipopt);
	free(low);
	free(high);
	free(least_speed);
	free(infinite);
}

#endif
