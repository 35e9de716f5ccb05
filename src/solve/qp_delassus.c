#include "solve/qp_delassus.h"

#include <string.h>

#include "base/log.h"

enum { BATCH = 32 }; // right-hand sides at once: enough for matrix products within the factor, small beside it

JnStatus jn_delassus_begin(JnDelassus* d) {
	const int contacts = d->base.rows.contacts;
	JN_TRY(jn_indices_reserve(&d->indices, 2 * (size_t)contacts));
	JN_TRY(jn_numbers_reserve(&d->batch, 2 * BATCH * 3 * (size_t)d->base.problem->nodes));
	d->working = d->indices.at;
	d->column_of = d->working + contacts;
	d->working_count = d->columns = 0;
	for (int i = 0; i < contacts; ++i) d->column_of[i] = -1;
	return JN_OK;
}

static JnStatus reserve_columns(JnDelassus* d, int columns) {
	const size_t count = (size_t)d->base.rows.count * (size_t)columns;
	if (count <= d->capacity) return JN_OK;
	const size_t capacity = count + count / 2;
	double* grown = realloc(d->at, capacity * sizeof *grown);
	if (grown == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: the Delassus matrix of %d rows", d->base.rows.count);
	d->at = grown;
	d->capacity = capacity;
	return JN_OK;
}

static JnStatus solve_batch(JnDelassus* d, int count, const double* rhs, double* out) {
	const JnContactMatrix* matrix = &d->base.problem->matrix;
	const size_t entries = 3 * (size_t)d->base.problem->nodes;
	d->base.report.solves += count;
	if (matrix->solve_many != NULL) return matrix->solve_many(matrix->user, count, rhs, out);
	for (size_t k = 0; k < (size_t)count; ++k)
		JN_TRY(matrix->solve(matrix->user, rhs + k * entries, out + k * entries));
	return JN_OK;
}

// The columns first .. last - 1, which belong to the working contacts from `contact` on.
static JnStatus fill_columns(JnDelassus* d, int contact, int first, int last) {
	const JnQpRows* rows = &d->base.rows;
	const size_t entries = 3 * (size_t)d->base.problem->nodes;
	double *rhs = d->batch.at, *out = rhs + BATCH * entries;
	int axis = 0;
	while (first < last) {
		const int count = last - first < BATCH ? last - first : BATCH;
		memset(rhs, 0, (size_t)count * entries * sizeof *rhs);
		for (int k = 0; k < count; ++k) {
			const int i = d->working[contact];
			jn_qp_row_add(&d->base, i, axis, rhs + (size_t)k * entries);
			if (++axis < rows->first[i + 1] - rows->first[i]) continue;
			axis = 0;
			++contact;
		}
		JN_TRY(solve_batch(d, count, rhs, out));
		for (int k = 0; k < count; ++k)
			jn_qp_rows_apply(&d->base, out + (size_t)k * entries, d->at + (size_t)(first + k) * (size_t)rows->count);
		first += count;
	}
	return JN_OK;
}

static bool needs_columns(const JnDelassus* d, int i, double slack) {
	const JnQpRows* rows = &d->base.rows;
	const int row = rows->first[i];
	return d->column_of[i] < 0 && rows->first[i + 1] > row && (rows->lambda[row] > 0 || rows->after[row] < -slack);
}

JnStatus jn_delassus_extend(JnDelassus* d, double slack, int* added) {
	const JnQpRows* rows = &d->base.rows;
	const int old_count = d->working_count, old_columns = d->columns;
	for (int i = 0; i < rows->contacts; ++i) {
		if (!needs_columns(d, i, slack)) continue;
		d->column_of[i] = d->columns;
		d->columns += rows->first[i + 1] - rows->first[i];
		d->working[d->working_count++] = i;
	}
	*added = d->working_count - old_count;
	d->base.report.rows = d->columns;
	if (*added == 0) return JN_OK;
	JN_TRY(reserve_columns(d, d->columns));
	return fill_columns(d, old_count, old_columns, d->columns);
}

void jn_delassus_velocities(JnDelassus* d) {
	const JnQpRows* rows = &d->base.rows;
	memcpy(rows->after, rows->before, (size_t)rows->count * sizeof *rows->after);
	for (int k = 0; k < d->working_count; ++k) {
		const int i = d->working[k];
		for (int row = rows->first[i]; row < rows->first[i + 1]; ++row) {
			const double* column = d->at + (size_t)(d->column_of[i] + row - rows->first[i]) * (size_t)rows->count;
			const double lambda = rows->lambda[row];
			for (int r = 0; lambda != 0 && r < rows->count; ++r) rows->after[r] += lambda * column[r];
		}
	}
}

static bool has_friction(const JnQpRows* rows) {
	for (int i = 0; i < rows->contacts; ++i)
		if (rows->first[i + 1] - rows->first[i] == 3) return true;
	return false;
}

static JnStatus solve(JnQp* qp) {
	JnDelassus* d = (JnDelassus*)qp;
	JN_TRY(jn_delassus_begin(d));
	memcpy(qp->rows.after, qp->rows.before, (size_t)qp->rows.count * sizeof *qp->rows.after);
	return has_friction(&qp->rows) ? jn_delassus_coulomb(d) : jn_delassus_pivot(d);
}

static void release(JnQp* qp) {
	JnDelassus* d = (JnDelassus*)qp;
	free(d->at);
	free(d->indices.at);
	free(d->batch.at);
	free(d->numbers.at);
	free(d->dense.at);
	free(d->marks.at);
}

const JnQpType jn_qp_delassus = {
	.row = {.name = "delassus",
			.doc = "active sets and semismooth Newton steps on the dense matrix G C^-1 G' of the contacts that touch",
			.keys = jn_qp_keys,
			.options_size = sizeof(JnQpDef)},
	.size = sizeof(JnDelassus),
	.solve = solve,
	.release = release,
};
