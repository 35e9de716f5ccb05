#include "solve/qp_delassus.h"

#include <math.h>
#include <string.h>

#include "solve/qp_cone.h"

JnStatus jn_delassus_begin(JnDelassus* d) {
	const size_t contacts = (size_t)d->base.rows.contacts, rows = (size_t)d->base.rows.count;
	JN_TRY(jn_indices_reserve(&d->slot_indices, 6 * contacts + 2));
	JN_TRY(jn_numbers_reserve(&d->slot_numbers, contacts + 4 * rows));
	d->working = d->slot_indices.at;
	d->is_working = d->working + contacts;
	d->start = d->is_working + contacts;
	d->touch_start = d->start + contacts + 1;
	d->group_of = d->touch_start + contacts + 1;
	d->met = d->group_of + contacts;
	d->mu = d->slot_numbers.at;
	d->before = d->mu + contacts;
	d->lambda = d->before + rows;
	d->after = d->lambda + rows;
	d->diagonal = d->after + rows;
	d->working_count = d->slots = d->start[0] = d->touch_start[0] = 0;
	memset(d->is_working, 0, contacts * sizeof *d->is_working);
	return jn_delassus_begin_matrix(d);
}

static void write_lambda(JnDelassus* d) {
	for (int k = 0; k < d->working_count; ++k)
		memcpy(d->base.rows.lambda + d->base.rows.first[d->working[k]], d->lambda + d->start[k],
			   (size_t)(d->start[k + 1] - d->start[k]) * sizeof *d->lambda);
}

// rows.after of all rows, those that have no slots included: through the velocities of the bodies, one solve.
static JnStatus find_velocities(JnDelassus* d) {
	JnQp* qp = &d->base;
	JnQpRows* rows = &qp->rows;
	const JnContactMatrix* matrix = &qp->problem->matrix;
	write_lambda(d);
	memset(rows->after, 0, (size_t)rows->count * sizeof *rows->after);
	if (jn_qp_rows_press(rows)) {
		jn_qp_rows_transpose(qp, rows->lambda, qp->rhs);
		JN_TRY(matrix->solve(matrix->user, qp->rhs, qp->change));
		jn_qp_rows_apply(qp, qp->change, rows->after);
		++qp->report.solves;
	}
	for (int row = 0; row < rows->count; ++row) rows->after[row] += rows->before[row];
	return JN_OK;
}

static void add_working(JnDelassus* d, int contact) {
	const JnQpRows* rows = &d->base.rows;
	const int first = rows->first[contact], count = rows->first[contact + 1] - first;
	const size_t bytes = (size_t)count * sizeof(double);
	memcpy(d->before + d->slots, rows->before + first, bytes);
	memcpy(d->lambda + d->slots, rows->lambda + first, bytes);
	memcpy(d->after + d->slots, rows->after + first, bytes);
	d->mu[d->working_count] = count == 3 ? rows->mu[contact] : 0;
	d->is_working[contact] = 1;
	d->working[d->working_count++] = contact;
	d->start[d->working_count] = d->slots += count;
}

JnStatus jn_delassus_extend(JnDelassus* d, double slack, int* added) {
	const JnQpRows* rows = &d->base.rows;
	const int old_count = d->working_count;
	*added = 0;
	if (d->slots == rows->count) return JN_OK;
	JN_TRY(find_velocities(d));
	for (int i = 0; i < rows->contacts; ++i) {
		const int row = rows->first[i];
		if (d->is_working[i] || rows->first[i + 1] == row) continue;
		if (rows->lambda[row] > 0 || rows->after[row] < -slack) add_working(d, i);
	}
	*added = d->working_count - old_count;
	d->base.report.rows = d->slots;
	return *added > 0 ? jn_delassus_fill(d, old_count) : JN_OK;
}

double jn_delassus_residual(const JnDelassus* d) {
	double most_lambda = 0, error = 0;
	for (int s = 0; s < d->slots; ++s) most_lambda = fmax(most_lambda, fabs(d->lambda[s]));
	if (most_lambda == 0) most_lambda = 1;
	for (int k = 0; k < d->working_count; ++k) {
		double w[3] = {0}, l[3] = {0}, rest[3];
		for (int s = d->start[k]; s < d->start[k + 1]; ++s) {
			w[s - d->start[k]] = d->after[s] / d->base.rows.velocity_scale;
			l[s - d->start[k]] = d->lambda[s] / most_lambda;
		}
		jn_coulomb_residual(d->mu[k], 1, w, l, rest);
		const double contact = fmax(fabs(rest[0]), hypot(rest[1], rest[2]));
		if (!(contact <= error)) error = contact;
		if (isnan(error)) return NAN;
	}
	return error;
}

void jn_delassus_clip(JnDelassus* d) {
	for (int k = 0; k < d->working_count; ++k) {
		double* l = d->lambda + d->start[k];
		l[0] = fmax(0, l[0]);
		if (d->start[k + 1] - d->start[k] == 3) jn_disk_project(d->mu[k] * l[0], &l[1], &l[2]);
	}
}

static JnStatus solve(JnQp* qp) {
	JnDelassus* d = (JnDelassus*)qp;
	JN_TRY(jn_delassus_begin(d));
	const JnStatus status = jn_delassus_iterate(d);
	write_lambda(d);
	return status;
}

static void release(JnQp* qp) {
	JnDelassus* d = (JnDelassus*)qp;
	jn_delassus_release_matrix(d);
	free(d->slot_numbers.at);
	free(d->slot_indices.at);
	free(d->numbers.at);
	jn_block_release(&d->factor);
	free(d->marks.at);
}

const JnQpType jn_qp_delassus = {
	.row = {.name = "delassus",
			.doc = "sweeps and semismooth Newton steps on the matrix G C^-1 G' of the contacts that touch",
			.keys = jn_qp_keys,
			.options_size = sizeof(JnQpDef)},
	.size = sizeof(JnDelassus),
	.solve = solve,
	.release = release,
};
