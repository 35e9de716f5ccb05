// W = G C^-1 G', a dense matrix a body, for contacts that have just arrived, against themselves and all that came before: by
// halves, H_b' H_b, where the matrix of the problem knows them; by solving for each column, as if all were one body, where
// it does not.
#include <string.h>

#include "base/log.h"
#include "solve/qp_delassus.h"

enum { BATCH = 32, TILE = 32 }; // right-hand sides at once: enough for matrix products within the factor

JnStatus jn_delassus_begin_matrix(JnDelassus* d) {
	const JnContactProblem* problem = d->base.problem;
	d->body_count = problem->body_count > 0 && problem->matrix.half != NULL ? problem->body_count : 1;
	if (d->body_count > d->body_capacity) {
		JnDelassusBody* grown = realloc(d->bodies, (size_t)d->body_count * sizeof *grown);
		if (grown == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: %d bodies in contact", d->body_count);
		d->bodies = grown;
		for (; d->body_capacity < d->body_count; ++d->body_capacity) d->bodies[d->body_capacity] = (JnDelassusBody){0};
	}
	d->group_count = 0;
	for (int b = 0; b < d->body_count; ++b) {
		JnDelassusBody* body = &d->bodies[b];
		body->rows = 0;
		body->stride = 0;
		body->first = body->first_new = body->last = body->group = -1;
		jn_half_clear(&body->half);
	}
	return JN_OK;
}

void jn_delassus_release_matrix(JnDelassus* d) {
	for (int b = 0; b < d->body_capacity; ++b) {
		jn_half_release(&d->bodies[b].half);
		free(d->bodies[b].w);
		free(d->bodies[b].lambda);
		free(d->bodies[b].after);
	}
	free(d->bodies);
	free(d->touches);
	free(d->groups);
	free(d->batch.at);
	free(d->column_values.at);
	free(d->column_entries.at);
}

static int body_of(const JnDelassus* d, int node) {
	return d->body_count > 1 ? jn_qp_body_of(d->base.problem, node) : 0;
}

static void append_touch(JnDelassus* d, int contact, int b) {
	JnDelassusBody* body = &d->bodies[b];
	const int t = d->touch_start[contact + 1]++;
	d->touches[t] = (JnTouch){contact, b, body->rows, -1};
	body->rows += jn_delassus_row_count(d, contact);
	if (body->last >= 0) d->touches[body->last].next = t;
	if (body->first < 0) body->first = t;
	if (body->first_new < 0) body->first_new = t;
	body->last = t;
}

static bool touches_body(const JnDelassus* d, int contact, int body) {
	for (int t = d->touch_start[contact]; t < d->touch_start[contact + 1]; ++t)
		if (d->touches[t].body == body) return true;
	return false;
}

// Whether two contacts touch the same bodies.
static bool are_alike(const JnDelassus* d, int a, int b) {
	if (d->touch_start[a + 1] - d->touch_start[a] != d->touch_start[b + 1] - d->touch_start[b]) return false;
	for (int t = d->touch_start[a]; t < d->touch_start[a + 1]; ++t)
		if (!touches_body(d, b, d->touches[t].body)) return false;
	return true;
}

static JnStatus find_group(JnDelassus* d, int contact) {
	int least = 0;
	for (int t = d->touch_start[contact]; t < d->touch_start[contact + 1]; ++t)
		if (t == d->touch_start[contact] || d->touches[t].body < least) least = d->touches[t].body;
	int group = d->bodies[least].group;
	while (group >= 0 && !are_alike(d, contact, d->groups[group].contact)) group = d->groups[group].next;
	if (group < 0) {
		JN_TRY(jn_grow((void**)&d->groups, &d->group_capacity, (size_t)d->group_count + 1, sizeof *d->groups));
		group = d->group_count++;
		d->groups[group] = (JnDelassusGroup){contact, d->bodies[least].group};
		d->bodies[least].group = group;
	}
	d->group_of[contact] = group;
	return JN_OK;
}

static JnStatus append_touches(JnDelassus* d, int first) {
	const JnContactProblem* problem = d->base.problem;
	for (int b = 0; b < d->body_count; ++b) d->bodies[b].first_new = -1;
	for (int k = first; k < d->working_count; ++k) {
		const int begin = problem->start[d->working[k]], end = problem->start[d->working[k] + 1];
		d->touch_start[k + 1] = d->touch_start[k];
		JN_TRY(jn_grow((void**)&d->touches, &d->touch_capacity, (size_t)(d->touch_start[k] + end - begin),
					   sizeof *d->touches));
		for (int e = begin; e < end; ++e) {
			const int b = body_of(d, problem->node[e]), last = d->bodies[b].last;
			if (last < 0 || d->touches[last].contact != k) append_touch(d, k, b);
		}
		JN_TRY(find_group(d, k));
	}
	return JN_OK;
}

// Room for the rows of a body, of which the first `old` have their numbers. Columns move towards the end, the last first.
static JnStatus reserve_rows(JnDelassusBody* body, size_t old) {
	const size_t rows = (size_t)body->rows;
	if (rows > body->stride) {
		const size_t stride = old == 0 ? rows : rows + rows / 4;
		JN_TRY(jn_grow((void**)&body->w, &body->w_capacity, stride * stride, sizeof *body->w));
		for (size_t j = old; j-- > 1;) memmove(body->w + j * stride, body->w + j * body->stride, old * sizeof *body->w);
		body->stride = stride;
	}
	JN_TRY(jn_grow((void**)&body->lambda, &body->lambda_capacity, rows, sizeof *body->lambda));
	JN_TRY(jn_grow((void**)&body->after, &body->after_capacity, rows, sizeof *body->after));
	for (size_t j = 0; j < rows; ++j) {
		const size_t begin = j < old ? old : j;
		memset(body->w + j * body->stride + begin, 0, (rows - begin) * sizeof *body->w);
	}
	return JN_OK;
}

// The upper triangle of the columns from `old` on, tile by tile.
static void mirror(JnDelassusBody* body, int old) {
	for (int i0 = old; i0 < body->rows; i0 += TILE)
		for (int j0 = 0; j0 < body->rows && j0 < i0 + TILE; j0 += TILE)
			for (int i = i0; i < i0 + TILE && i < body->rows; ++i)
				for (int j = j0; j < j0 + TILE && j < i; ++j)
					body->w[(size_t)i * body->stride + (size_t)j] = body->w[(size_t)j * body->stride + (size_t)i];
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

// Column `slot` of W, below its diagonal: G x for one solution.
static void write_column(JnDelassus* d, int slot, const double* x, double* by_rows) {
	const JnDelassusBody* body = &d->bodies[0];
	jn_qp_rows_apply(&d->base, x, by_rows);
	for (int k = 0; k < d->working_count; ++k)
		for (int s = d->start[k]; s < d->start[k + 1]; ++s) {
			const size_t low = (size_t)(s < slot ? s : slot), high = (size_t)(s < slot ? slot : s);
			body->w[low * body->stride + high] = by_rows[d->base.rows.first[d->working[k]] + s - d->start[k]];
		}
}

// All are one body, whose rows are the slots.
static JnStatus fill_by_solutions(JnDelassus* d, int first) {
	const size_t entries = 3 * (size_t)d->base.problem->nodes;
	JN_TRY(jn_numbers_reserve(&d->batch, 2 * BATCH * entries + (size_t)d->base.rows.count));
	double *rhs = d->batch.at, *out = rhs + BATCH * entries, *by_rows = out + BATCH * entries;
	int contact = first, axis = 0;
	for (int slot = d->start[first]; slot < d->slots; slot += BATCH) {
		const int count = d->slots - slot < BATCH ? d->slots - slot : BATCH;
		memset(rhs, 0, (size_t)count * entries * sizeof *rhs);
		for (int k = 0; k < count; ++k) {
			jn_qp_row_add(&d->base, d->working[contact], axis, rhs + (size_t)k * entries);
			if (++axis < jn_delassus_row_count(d, contact)) continue;
			axis = 0;
			++contact;
		}
		JN_TRY(solve_batch(d, count, rhs, out));
		for (int k = 0; k < count; ++k) write_column(d, slot + k, out + (size_t)k * entries, by_rows);
	}
	return JN_OK;
}

// The rows of a contact as columns of the body that it touches, after those that are there.
static int write_rows(JnDelassus* d, const JnTouch* t, int column, int* start, int* entry) {
	const JnContactProblem* problem = d->base.problem;
	const int contact = d->working[t->contact], first_node = problem->body_count > 0 ? problem->first_node[t->body] : 0;
	for (int row = 0; row < jn_delassus_row_count(d, t->contact); ++row) {
		const double* axis = problem->frame[contact] + 3 * row;
		int end = start[column];
		for (int e = problem->start[contact]; e < problem->start[contact + 1]; ++e) {
			if (body_of(d, problem->node[e]) != t->body) continue;
			for (int a = 0; a < 3; ++a) {
				entry[end] = 3 * (problem->node[e] - first_node) + a;
				d->column_values.at[end++] = d->base.rows.scale[contact] * problem->weight[e] * axis[a];
			}
		}
		start[++column] = end;
	}
	return column;
}

static JnStatus fill_by_halves(JnDelassus* d, int b, int old) {
	const JnContactProblem* problem = d->base.problem;
	JnDelassusBody* body = &d->bodies[b];
	size_t most = 0;
	const size_t columns = (size_t)(body->rows - old);
	for (const JnTouch* t = jn_touch_at(d, body->first_new); t != NULL; t = jn_touch_at(d, t->next))
		most += 9 * (size_t)(problem->start[d->working[t->contact] + 1] - problem->start[d->working[t->contact]]);
	JN_TRY(jn_numbers_reserve(&d->column_values, most));
	JN_TRY(jn_indices_reserve(&d->column_entries, most + columns + 1));
	int *start = d->column_entries.at, *entry = start + columns + 1, count = 0;
	start[0] = 0;
	for (const JnTouch* t = jn_touch_at(d, body->first_new); t != NULL; t = jn_touch_at(d, t->next))
		count = write_rows(d, t, count, start, entry);
	const JnColumns all = {count, start, entry, d->column_values.at};
	JN_TRY(problem->matrix.half(problem->matrix.user, b, &all, &body->half));
	return jn_half_products(&body->half, old, body->stride, body->w);
}

static void write_diagonal(JnDelassus* d, int first) {
	double block[3][3];
	for (int k = first; k < d->working_count; ++k) {
		jn_delassus_block(d, k, block);
		for (int a = 0; a < jn_delassus_row_count(d, k); ++a) d->diagonal[d->start[k] + a] = block[a][a];
	}
}

JnStatus jn_delassus_fill(JnDelassus* d, int first) {
	JN_TRY(append_touches(d, first));
	for (int b = 0; b < d->body_count; ++b) {
		JnDelassusBody* body = &d->bodies[b];
		if (body->first_new < 0) continue;
		const int old = d->touches[body->first_new].local;
		JN_TRY(reserve_rows(body, (size_t)old));
		if (d->base.problem->matrix.half != NULL)
			JN_TRY(fill_by_halves(d, b, old));
		else
			JN_TRY(fill_by_solutions(d, first));
		mirror(body, old);
	}
	write_diagonal(d, first);
	return JN_OK;
}

void jn_delassus_meet(JnDelassus* d) {
	for (int b = 0; b < d->body_count; ++b) {
		const JnDelassusBody* body = &d->bodies[b];
		int count = 0;
		for (const JnTouch* t = jn_touch_at(d, body->first); t != NULL; t = jn_touch_at(d, t->next)) {
			const int group = d->group_of[t->contact];
			if (d->groups[group].contact == t->contact) d->met[count++] = group;
		}
		for (int i = 0; i < count; ++i)
			for (int j = 0; j < i; ++j) jn_block_meet(&d->factor, d->met[i], d->met[j]);
	}
}
