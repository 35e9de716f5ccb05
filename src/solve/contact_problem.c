#include "solve/contact_problem.h"

#include <math.h>
#include <string.h>

#include "solve/qp_cone.h"

// Like fmax, but NAN stays.
static double larger(double a, double b) {
	return a >= b ? a : b >= a ? b : NAN;
}

double jn_contact_residual_max(const JnContactResidual* r) {
	return larger(larger(larger(r->stationarity, r->primal), larger(r->dual, r->complementarity)), r->friction);
}

double jn_contact_row_scale(const JnContactProblem* problem, int contact) {
	const double* normal = problem->frame[contact];
	const double axis = fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2])));
	double most = 0;
	for (int k = problem->start[contact]; k < problem->start[contact + 1]; ++k)
		most = fmax(most, fabs(problem->weight[k]) * axis);
	return most > 0 ? 1 / most : 0;
}

void jn_contact_velocity(const JnContactProblem* problem, int contact, const double* v, double u[3]) {
	double sum[3] = {0};
	for (int k = problem->start[contact]; k < problem->start[contact + 1]; ++k)
		for (int axis = 0; axis < 3; ++axis)
			sum[axis] += problem->weight[k] * v[3 * (size_t)problem->node[k] + (size_t)axis];
	const double* frame = problem->frame[contact];
	const bool has_friction = problem->friction != NULL && problem->friction[contact] > 0;
	u[0] = frame[0] * sum[0] + frame[1] * sum[1] + frame[2] * sum[2];
	u[1] = has_friction ? frame[3] * sum[0] + frame[4] * sum[1] + frame[5] * sum[2] : 0;
	u[2] = has_friction ? frame[6] * sum[0] + frame[7] * sum[1] + frame[8] * sum[2] : 0;
}

double jn_contact_least_velocity(const JnContactProblem* problem, int contact, const double* v) {
	double most = 0;
	for (int k = problem->start[contact]; k < problem->start[contact + 1]; ++k)
		for (int axis = 0; axis < 3; ++axis) most = larger(most, fabs(v[3 * (size_t)problem->node[k] + (size_t)axis]));
	return 1e-8 * most;
}

void jn_contact_bound(const JnContactProblem* problem, int contact, double bound[3]) {
	const bool has_friction = problem->friction != NULL && problem->friction[contact] > 0;
	for (int axis = 0; axis < 3; ++axis) bound[axis] = axis == 0 || has_friction ? problem->bound[contact][axis] : 0;
}

void jn_contact_add_impulse(const JnContactProblem* problem, int contact, const double lambda[3], double* f) {
	const double* frame = problem->frame[contact];
	const bool has_friction = problem->friction != NULL && problem->friction[contact] > 0;
	double force[3];
	for (int axis = 0; axis < 3; ++axis)
		force[axis] =
			frame[axis] * lambda[0] + (has_friction ? frame[3 + axis] * lambda[1] + frame[6 + axis] * lambda[2] : 0);
	for (int k = problem->start[contact]; k < problem->start[contact + 1]; ++k)
		for (int axis = 0; axis < 3; ++axis)
			f[3 * (size_t)problem->node[k] + (size_t)axis] += problem->weight[k] * force[axis];
}

// v holds v - vp up to its own rounding, some 1e-16 |v|, of which C makes 1e-16 |C| |v|, and |C| is up to some hundred times
// its diagonal scale. Impulses below that cannot be told from rounding: stationarity is judged against this share of
// P^-1/2 v at least, so that rounding stays some 1e-8.
static const double inertia = 1e-6;

static void measure_stationarity(const JnContactProblem* problem, const double* v, const double* lambda, double* work,
								 JnContactResidual* out) {
	const size_t entries = 3 * (size_t)problem->nodes;
	double *change = work, *left = work + entries, *right = work + 2 * entries;
	for (size_t k = 0; k < entries; ++k) change[k] = v[k] - problem->vp[k];
	problem->matrix.apply(problem->matrix.user, change, left);
	memset(right, 0, entries * sizeof *right);
	for (int i = 0; i < problem->count; ++i) jn_contact_add_impulse(problem, i, lambda + 3 * (size_t)i, right);
	double* diagonal = change;
	problem->matrix.diagonal(problem->matrix.user, diagonal);
	double error = 0, scale = 0, momentum = 0;
	for (size_t k = 0; k < entries; ++k) {
		if (problem->held != NULL && problem->held[k]) continue;
		const double root = sqrt(diagonal[k]);
		error = larger(error, fabs(left[k] - right[k]) / root);
		scale = larger(scale, fabs(right[k]) / root);
		momentum = larger(momentum, fabs(v[k]) * root);
	}
	out->stationarity = error == 0 ? 0 : error / larger(scale, inertia * momentum);
}

static void measure_scales(const JnContactProblem* problem, const double* v, const double* lambda,
						   JnContactResidual* out) {
	for (int i = 0; i < problem->count; ++i) {
		const double e = jn_contact_row_scale(problem, i);
		double before[3], after[3], bound[3];
		jn_contact_velocity(problem, i, problem->vp, before);
		jn_contact_velocity(problem, i, v, after);
		jn_contact_bound(problem, i, bound);
		if (e > 0)
			out->velocity_scale = larger(out->velocity_scale, jn_contact_least_velocity(problem, i, problem->vp));
		for (int axis = 0; axis < 3; ++axis) {
			out->velocity_scale = larger(out->velocity_scale, e * larger(fabs(before[axis]), fabs(after[axis])));
			out->velocity_scale = larger(out->velocity_scale, e * fabs(bound[axis]));
			if (e > 0) out->impulse_scale = larger(out->impulse_scale, fabs(lambda[3 * (size_t)i + (size_t)axis]) / e);
		}
	}
}

// All in units of the scales, so that the natural map compares like with like.
static void measure_contact(const JnContactProblem* problem, int i, const double* v, const double* lambda,
							JnContactResidual* out) {
	const double e = jn_contact_row_scale(problem, i);
	if (e == 0) return; // a row of zeros: only its bound can be violated, and nothing helps
	const double mu = problem->friction != NULL ? problem->friction[i] : 0;
	double w[3], l[3], rest[3], bound[3];
	jn_contact_velocity(problem, i, v, w);
	jn_contact_bound(problem, i, bound);
	for (int axis = 0; axis < 3; ++axis) {
		w[axis] = out->velocity_scale > 0 ? (w[axis] - bound[axis]) * e / out->velocity_scale : 0;
		l[axis] = out->impulse_scale > 0 ? lambda[3 * (size_t)i + (size_t)axis] / (e * out->impulse_scale) : 0;
	}
	jn_coulomb_residual(mu, 1, w, l, rest);
	out->primal = larger(out->primal, larger(0, -w[0]));
	out->dual = larger(out->dual, larger(0, -l[0]));
	if (mu > 0) out->dual = larger(out->dual, larger(0, hypot(l[1], l[2]) - mu * l[0]));
	out->complementarity = larger(out->complementarity, fabs(rest[0]));
	out->friction = larger(out->friction, hypot(rest[1], rest[2]));
}

void jn_contact_residual(const JnContactProblem* problem, const double* v, const double* lambda, double* work,
						 JnContactResidual* out) {
	*out = (JnContactResidual){0};
	measure_scales(problem, v, lambda, out);
	for (int i = 0; i < problem->count; ++i) measure_contact(problem, i, v, lambda, out);
	measure_stationarity(problem, v, lambda, work, out);
}
