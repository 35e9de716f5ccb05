// Semismooth Newton on Coulomb's law (Alart and Curnier 1991; Hueeber, Stadler and Wohlmuth 2008). With w the relative
// velocity less its bound, x = lambda_t - rho w_t and d = x / |x|, a contact is
//   open    lambda_n <= rho w_n:    lambda = 0
//   stuck   |x| <= mu lambda_n:     w = 0
//   sliding                         w_n = 0,  lambda_t = mu lambda_n d
// and the step solves these equations, linearised, for the contacts that are not open. Redundant contacts make W singular:
// eps times its diagonal is added in the matrix of the step alone, so that the solution is not changed.
#include <math.h>
#include <string.h>

#include "math/lapack.h"
#include "solve/qp_cone.h"
#include "solve/qp_delassus.h"

static const double proximity = 1e-9;
enum { STEPS = 12, PATIENCE = 4 }; // PATIENCE: first steps that may go uphill

typedef struct Newton {
	JnDelassus* d;
	JnQpRows* rows;
	int count;             // unknowns
	int *row, *column;     // of an unknown: row of G, column of W
	int *contact, *pivots; // contact whose first unknown this is, or -1
	double *best, *change; // the best lambda so far, and the change of a step, by rows
	double *matrix, *rhs;
} Newton;

static double steepness(const JnDelassus* d, int contact) {
	return jn_delassus_entry(d, d->base.rows.first[contact], d->column_of[contact]);
}

// Sum of squares of the natural map, in velocities.
static double merit(const JnDelassus* d) {
	const JnQpRows* rows = &d->base.rows;
	double sum = 0;
	for (int k = 0; k < d->working_count; ++k) {
		const int i = d->working[k], row = rows->first[i];
		const double steep = steepness(d, i);
		double w[3] = {0}, l[3] = {0}, rest[3];
		memcpy(w, rows->after + row, (size_t)(rows->first[i + 1] - row) * sizeof *w);
		memcpy(l, rows->lambda + row, (size_t)(rows->first[i + 1] - row) * sizeof *l);
		if (steep <= 0) continue;
		jn_coulomb_residual(rows->mu[i], 1 / steep, w, l, rest);
		for (int axis = 0; axis < 3; ++axis) sum += steep * rest[axis] * steep * rest[axis];
	}
	return sum;
}

static JnStatus reserve(Newton* n) {
	const size_t columns = (size_t)n->d->columns, all = (size_t)n->rows->count;
	JN_TRY(jn_numbers_reserve(&n->d->numbers, 2 * all + columns));
	JN_TRY(jn_indices_reserve(&n->d->marks, 4 * columns));
	n->best = n->d->numbers.at;
	n->change = n->best + all;
	n->rhs = n->change + all;
	n->row = n->d->marks.at;
	n->column = n->row + columns;
	n->contact = n->column + columns;
	n->pivots = n->contact + columns;
	return JN_OK;
}

// Unknowns of contacts that are not open; the others go to 0.
static void list_unknowns(Newton* n) {
	const JnQpRows* rows = n->rows;
	n->count = 0;
	memset(n->change, 0, (size_t)rows->count * sizeof *n->change);
	for (int k = 0; k < n->d->working_count; ++k) {
		const int i = n->d->working[k], first = rows->first[i], end = rows->first[i + 1];
		const double steep = steepness(n->d, i);
		const bool is_open = steep <= 0 || rows->lambda[first] - rows->after[first] / steep <= 0;
		for (int row = first; row < end; ++row) {
			if (is_open) n->change[row] = -rows->lambda[row];
			if (is_open) continue;
			n->row[n->count] = row;
			n->column[n->count] = n->d->column_of[i] + row - first;
			n->contact[n->count++] = row == first ? i : -1;
		}
	}
}

static double* entry(const Newton* n, int i, int j) {
	return n->matrix + (size_t)j * (size_t)n->count + (size_t)i;
}

// Equations w = 0 for all unknowns, with what the open contacts take away.
static void gather(Newton* n) {
	for (int j = 0; j < n->count; ++j)
		for (int i = 0; i < n->count; ++i) *entry(n, i, j) = jn_delassus_entry(n->d, n->row[i], n->column[j]);
	for (int i = 0; i < n->count; ++i) {
		*entry(n, i, i) *= 1 + proximity;
		n->rhs[i] = -n->rows->after[n->row[i]];
	}
	for (int k = 0; k < n->d->working_count; ++k) {
		const int contact = n->d->working[k], first = n->rows->first[contact];
		for (int row = first; row < n->rows->first[contact + 1]; ++row) {
			const double change = n->change[row];
			const int column = n->d->column_of[contact] + row - first;
			for (int i = 0; change != 0 && i < n->count; ++i)
				n->rhs[i] -= change * jn_delassus_entry(n->d, n->row[i], column);
		}
	}
}

// Replace the tangential equations k + 1, k + 2 of a sliding contact by
//   (I - c Q) dl_t - mu d dl_n + c rho Q dw_t = mu lambda_n d - lambda_t,   c = mu lambda_n / |x|,  Q = I - d d',
// times the diagonal of W, so that all equations are velocities.
static void slide(Newton* n, int k, int contact) {
	const JnQpRows* rows = n->rows;
	const double mu = rows->mu[contact], steep = steepness(n->d, contact);
	const double* l = rows->lambda + n->row[k];
	const double* w = rows->after + n->row[k];
	const double x[2] = {l[1] - w[1] / steep, l[2] - w[2] / steep}, length = hypot(x[0], x[1]);
	const double radius = mu * fmax(0, l[0]);
	if (length <= radius || length == 0) return;
	const double c = radius / length, side[2] = {-x[1] / length, x[0] / length}, d[2] = {x[0] / length, x[1] / length};
	const double target[2] = {-n->rhs[k + 1], -n->rhs[k + 2]}; // w_t with what the open contacts take away
	const double across = c * (side[0] * target[0] + side[1] * target[1]) - c * (side[0] * w[1] + side[1] * w[2]);
	for (int j = 0; j < n->count; ++j) {
		const double turned = c * (side[0] * *entry(n, k + 1, j) + side[1] * *entry(n, k + 2, j));
		for (int a = 0; a < 2; ++a) *entry(n, k + 1 + a, j) = side[a] * turned;
	}
	for (int a = 0; a < 2; ++a) {
		for (int b = 0; b < 2; ++b) *entry(n, k + 1 + a, k + 1 + b) += steep * ((a == b) - c * side[a] * side[b]);
		*entry(n, k + 1 + a, k) -= steep * mu * d[a];
		n->rhs[k + 1 + a] = steep * (radius * d[a] - l[1 + a]) - side[a] * across;
	}
}

static bool solve_step(Newton* n) {
	const int one = 1, order = n->count > 0 ? n->count : 1;
	int info = 0;
	for (int k = 0; k < n->count; ++k)
		if (n->contact[k] >= 0 && k + 2 < n->count && n->contact[k + 1] < 0) slide(n, k, n->contact[k]);
	if (n->count > 0) dgetrf_(&n->count, &n->count, n->matrix, &order, n->pivots, &info);
	++n->d->base.report.factorizations;
	if (info != 0) return false;
	if (n->count > 0) dgetrs_("N", &n->count, &one, n->matrix, &order, n->pivots, n->rhs, &order, &info, 1);
	for (int k = 0; k < n->count; ++k) n->change[n->row[k]] = n->rhs[k];
	return true;
}

// One full step. False when its matrix is singular.
static JnStatus step(Newton* n, bool* worked) {
	list_unknowns(n);
	JN_TRY(jn_numbers_reserve(&n->d->dense, (size_t)n->count * (size_t)n->count));
	n->matrix = n->d->dense.at;
	gather(n);
	*worked = solve_step(n);
	if (!*worked) return JN_OK;
	for (int row = 0; row < n->rows->count; ++row) n->rows->lambda[row] += n->change[row];
	jn_delassus_velocities(n->d);
	return JN_OK;
}

JnStatus jn_delassus_newton(JnDelassus* d, double tolerance, bool* worked) {
	Newton n = {.d = d, .rows = &d->base.rows};
	JN_TRY(reserve(&n));
	const size_t bytes = (size_t)n.rows->count * sizeof *n.best;
	memcpy(n.best, n.rows->lambda, bytes);
	const double before = merit(d);
	double least = before;
	bool is_regular = true;
	for (int k = 0; k < STEPS && is_regular && jn_qp_rows_residual(&d->base) > tolerance; ++k) {
		JN_TRY(step(&n, &is_regular));
		const double now = merit(d);
		if (!(now < least) && k >= PATIENCE) break;
		if (!(now < least)) continue;
		least = now;
		memcpy(n.best, n.rows->lambda, bytes);
	}
	memcpy(n.rows->lambda, n.best, bytes);
	for (int i = 0; i < n.rows->contacts; ++i) jn_qp_rows_clip(&d->base, i);
	jn_delassus_velocities(d);
	*worked = least < 0.01 * before;
	return JN_OK;
}
