#include "solve/qp_rows.h"

#include <math.h>
#include <string.h>

#include "base/log.h"
#include "solve/qp_cone.h"

JnStatus jn_numbers_reserve(JnNumbers* numbers, size_t count) {
	if (count <= numbers->capacity && numbers->at != NULL) return JN_OK;
	free(numbers->at);
	numbers->capacity = count + count / 2 + 1;
	numbers->at = malloc(numbers->capacity * sizeof *numbers->at);
	if (numbers->at != NULL) return JN_OK;
	numbers->capacity = 0;
	return jn_error(JN_OUT_OF_MEMORY, "out of memory: %zu numbers of a contact solver", count);
}

JnStatus jn_indices_reserve(JnIndices* indices, size_t count) {
	if (count <= indices->capacity && indices->at != NULL) return JN_OK;
	free(indices->at);
	indices->capacity = count + count / 2 + 1;
	indices->at = malloc(indices->capacity * sizeof *indices->at);
	if (indices->at != NULL) return JN_OK;
	indices->capacity = 0;
	return jn_error(JN_OUT_OF_MEMORY, "out of memory: %zu indices of a contact solver", count);
}

static JnStatus reserve(JnQp* qp, const JnContactProblem* problem) {
	const size_t contacts = (size_t)problem->count, entries = 3 * (size_t)problem->nodes;
	JN_TRY(jn_numbers_reserve(&qp->row_numbers, 11 * contacts));
	JN_TRY(jn_indices_reserve(&qp->row_indices, contacts + 1));
	JN_TRY(jn_numbers_reserve(&qp->vectors, 5 * entries));
	double* numbers = qp->row_numbers.at;
	qp->rows = (JnQpRows){.contacts = problem->count,
						  .first = qp->row_indices.at,
						  .scale = numbers,
						  .mu = numbers + contacts,
						  .before = numbers + 2 * contacts,
						  .lambda = numbers + 5 * contacts,
						  .after = numbers + 8 * contacts};
	qp->rhs = qp->vectors.at;
	qp->change = qp->rhs + entries;
	qp->work = qp->change + entries;
	return JN_OK;
}

static int row_count(const JnQp* qp, int contact) {
	return qp->rows.first[contact + 1] - qp->rows.first[contact];
}

void jn_qp_rows_clip(const JnQp* qp, int contact) {
	double* l = qp->rows.lambda + qp->rows.first[contact];
	const int rows = row_count(qp, contact);
	if (rows > 0) l[0] = l[0] > 0 ? l[0] : 0;
	if (rows == 3) jn_disk_project(qp->rows.mu[contact] * l[0], &l[1], &l[2]);
}

int jn_qp_body_of(const JnContactProblem* problem, int node) {
	int low = 0, high = problem->body_count - 1;
	while (low < high) {
		const int middle = low + (high - low + 1) / 2;
		if (problem->first_node[middle] <= node)
			low = middle;
		else
			high = middle - 1;
	}
	return low;
}

JnStatus jn_qp_rows_prepare(JnQp* qp, const JnContactProblem* problem, const double* guess) {
	JN_TRY(reserve(qp, problem));
	qp->problem = problem;
	JnQpRows* rows = &qp->rows;
	rows->velocity_scale = 1e-300; // nothing moves and nothing has to: any number serves
	for (int i = 0; i < rows->contacts; ++i) {
		const double mu = problem->friction != NULL ? problem->friction[i] : 0;
		const double e = jn_contact_row_scale(problem, i);
		const int count = e == 0 ? 0 : mu > 0 ? 3 : 1;
		double u[3], bound[3];
		jn_contact_velocity(problem, i, problem->vp, u);
		jn_contact_bound(problem, i, bound);
		rows->mu[i] = mu;
		rows->scale[i] = e;
		rows->first[i] = rows->count;
		for (int axis = 0; axis < count; ++axis) {
			rows->before[rows->count + axis] = e * (u[axis] - bound[axis]);
			rows->lambda[rows->count + axis] = guess[3 * (size_t)i + (size_t)axis] / e;
			rows->velocity_scale = fmax(rows->velocity_scale, e * fmax(fabs(u[axis]), fabs(bound[axis])));
		}
		if (count > 0)
			rows->velocity_scale = fmax(rows->velocity_scale, jn_contact_least_velocity(problem, i, problem->vp));
		rows->count += count;
		rows->first[i + 1] = rows->count;
		jn_qp_rows_clip(qp, i);
	}
	return JN_OK;
}

void jn_qp_rows_unscale(const JnQp* qp, double* lambda) {
	const JnQpRows* rows = &qp->rows;
	for (int i = 0; i < rows->contacts; ++i)
		for (int axis = 0; axis < 3; ++axis)
			lambda[3 * (size_t)i + (size_t)axis] =
				axis < row_count(qp, i) ? rows->scale[i] * rows->lambda[rows->first[i] + axis] : 0;
}

bool jn_qp_rows_press(const JnQpRows* rows) {
	for (int row = 0; row < rows->count; ++row)
		if (rows->lambda[row] != 0) return true;
	return false;
}

void jn_qp_rows_apply(const JnQp* qp, const double* v, double* out) {
	const JnQpRows* rows = &qp->rows;
	for (int i = 0; i < rows->contacts; ++i) {
		double u[3];
		jn_contact_velocity(qp->problem, i, v, u);
		for (int axis = 0; axis < row_count(qp, i); ++axis) out[rows->first[i] + axis] = rows->scale[i] * u[axis];
	}
}

void jn_qp_rows_transpose(const JnQp* qp, const double* l, double* f) {
	const JnQpRows* rows = &qp->rows;
	memset(f, 0, 3 * (size_t)qp->problem->nodes * sizeof *f);
	for (int i = 0; i < rows->contacts; ++i) {
		double lambda[3] = {0};
		for (int axis = 0; axis < row_count(qp, i); ++axis) lambda[axis] = rows->scale[i] * l[rows->first[i] + axis];
		if (row_count(qp, i) > 0) jn_contact_add_impulse(qp->problem, i, lambda, f);
	}
}

void jn_qp_row_add(const JnQp* qp, int contact, int axis, double* f) {
	double lambda[3] = {0};
	lambda[axis] = qp->rows.scale[contact];
	jn_contact_add_impulse(qp->problem, contact, lambda, f);
}

double jn_qp_rows_residual(const JnQp* qp) {
	const JnQpRows* rows = &qp->rows;
	double most_lambda = 0, error = 0;
	for (int row = 0; row < rows->count; ++row) most_lambda = fmax(most_lambda, fabs(rows->lambda[row]));
	if (most_lambda == 0) most_lambda = 1;
	for (int i = 0; i < rows->contacts; ++i) {
		double w[3] = {0}, l[3] = {0}, rest[3];
		for (int axis = 0; axis < row_count(qp, i); ++axis) {
			w[axis] = rows->after[rows->first[i] + axis] / rows->velocity_scale;
			l[axis] = rows->lambda[rows->first[i] + axis] / most_lambda;
		}
		jn_coulomb_residual(rows->mu[i], 1, w, l, rest);
		const double contact = fmax(fabs(rest[0]), hypot(rest[1], rest[2]));
		if (!(contact <= error)) error = contact;
		if (isnan(error)) return NAN;
	}
	return error;
}
