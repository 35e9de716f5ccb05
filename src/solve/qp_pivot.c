// Contacts without friction: 0 <= lambda _|_ w = b + W lambda >= 0 by block principal pivoting (Judice and Pires 1994): all
// rows whose sign is wrong change sides at once, and one at a time (Murty 1974, which ends for any definite W) when that
// does not make them fewer.
//
// Redundant contacts make W singular. Each round therefore solves with W + eps D, D the diagonal of W, from the last
// lambda on: w = b + W lambda + eps D (lambda - lambda_last). That is the proximal point method; its rounds converge to a
// solution of the problem itself at the rate eps, and the pivots always see a definite matrix.
#include <math.h>
#include <string.h>

#include "math/lapack.h"
#include "solve/qp_delassus.h"

static const double proximity = 1e-9; // eps: far above rounding in W, and a round gains nine digits on regular rows
enum { ROUNDS = 30, PATIENCE = 3 };   // PATIENCE: exchanges of all rows that may fail to make the wrong ones fewer

typedef struct Pivot {
	JnDelassus* d;
	JnQpRows* rows;
	double *last, *rhs;   // lambda of the last round, and the right-hand side of the pressing rows
	int *pressing, count; // rows with lambda free to differ from 0, sorted into `pressing` by the order of columns
	int* state;           // a working contact presses (1) or not (0)
	double tiny_lambda, tiny_velocity;
} Pivot;

static int row_of(const Pivot* p, int k) {
	return p->rows->first[p->d->working[k]];
}

static JnStatus reserve(Pivot* p) {
	const size_t contacts = (size_t)p->rows->contacts;
	JN_TRY(jn_numbers_reserve(&p->d->numbers, 2 * contacts));
	JN_TRY(jn_indices_reserve(&p->d->marks, 2 * contacts));
	p->last = p->d->numbers.at;
	p->rhs = p->last + contacts;
	p->pressing = p->d->marks.at;
	p->state = p->pressing + contacts;
	return JN_OK;
}

static void list_pressing(Pivot* p) {
	p->count = 0;
	for (int k = 0; k < p->d->working_count; ++k)
		if (p->state[k]) p->pressing[p->count++] = k;
}

// The lower triangle of W + eps D over the pressing rows, and -(b - eps D last).
static void gather(Pivot* p, double* matrix) {
	for (int j = 0; j < p->count; ++j) {
		const int column = p->d->column_of[p->d->working[p->pressing[j]]], row = row_of(p, p->pressing[j]);
		const double shift = proximity * jn_delassus_entry(p->d, row, column);
		for (int i = j; i < p->count; ++i)
			matrix[(size_t)j * (size_t)p->count + (size_t)i] =
				jn_delassus_entry(p->d, row_of(p, p->pressing[i]), column);
		matrix[(size_t)j * (size_t)p->count + (size_t)j] += shift;
		p->rhs[j] = shift * p->last[row] - p->rows->before[row];
	}
}

// lambda of the pressing rows makes their w 0; the others are 0. `after` follows.
static JnStatus solve_pressing(Pivot* p) {
	JN_TRY(jn_numbers_reserve(&p->d->dense, (size_t)p->count * (size_t)p->count));
	gather(p, p->d->dense.at);
	int info = 0;
	const int one = 1, order = p->count > 0 ? p->count : 1;
	if (p->count > 0) dpotrf_("L", &p->count, p->d->dense.at, &order, &info, 1);
	if (info != 0) return JN_INDEFINITE;
	if (p->count > 0) dpotrs_("L", &p->count, &one, p->d->dense.at, &order, p->rhs, &order, &info, 1);
	++p->d->base.report.factorizations;
	memset(p->rows->lambda, 0, (size_t)p->rows->count * sizeof *p->rows->lambda);
	for (int k = 0; k < p->count; ++k) p->rows->lambda[row_of(p, p->pressing[k])] = p->rhs[k];
	jn_delassus_velocities(p->d);
	return JN_OK;
}

// w of a row that does not press, with the proximal term.
static double slack_of(const Pivot* p, int k) {
	const int row = row_of(p, k), column = p->d->column_of[p->d->working[k]];
	const double pull = proximity * jn_delassus_entry(p->d, row, column) * (p->rows->lambda[row] - p->last[row]);
	return p->rows->after[row] + pull;
}

static bool is_wrong(const Pivot* p, int k) {
	return p->state[k] ? p->rows->lambda[row_of(p, k)] < -p->tiny_lambda : slack_of(p, k) < -p->tiny_velocity;
}

static void set_thresholds(Pivot* p) {
	double most = 0;
	for (int k = 0; k < p->count; ++k) most = fmax(most, fabs(p->rows->lambda[row_of(p, p->pressing[k])]));
	p->tiny_lambda = 1e-3 * p->d->base.options.tolerance * most;
}

// The complementarity problem of one round. JN_NOT_CONVERGED when the iterations are used up.
static JnStatus solve_round(Pivot* p) {
	int fewest = p->d->working_count + 1, patience = PATIENCE;
	for (;;) {
		list_pressing(p);
		JN_TRY(solve_pressing(p));
		set_thresholds(p);
		int wrong = 0, last_wrong = -1;
		for (int k = 0; k < p->d->working_count; ++k)
			if (is_wrong(p, k)) ++wrong, last_wrong = k;
		if (wrong == 0) return JN_OK;
		if (++p->d->base.report.iterations >= p->d->base.options.max_iterations) return JN_NOT_CONVERGED;
		if (wrong < fewest)
			fewest = wrong, patience = PATIENCE;
		else
			--patience;
		for (int k = patience >= 0 ? 0 : last_wrong; k <= last_wrong; ++k)
			if (k == last_wrong || is_wrong(p, k)) p->state[k] = !p->state[k];
	}
}

// Working contacts that have just arrived: they press when their guess does or when they are violated.
static void admit(Pivot* p, int added) {
	for (int k = p->d->working_count - added; k < p->d->working_count; ++k)
		p->state[k] = p->rows->lambda[row_of(p, k)] > 0 || p->rows->after[row_of(p, k)] < 0;
}

static void clip(const Pivot* p) {
	for (int i = 0; i < p->rows->contacts; ++i) jn_qp_rows_clip(&p->d->base, i);
}

JnStatus jn_delassus_pivot(JnDelassus* d) {
	Pivot p = {.d = d, .rows = &d->base.rows};
	const double tolerance = 0.1 * d->base.options.tolerance;
	p.tiny_velocity = 1e-3 * d->base.options.tolerance * p.rows->velocity_scale;
	JN_TRY(reserve(&p));
	for (int round = 0; round < ROUNDS; ++round) {
		int added;
		JN_TRY(jn_delassus_extend(d, round == 0 ? 0 : tolerance * p.rows->velocity_scale, &added));
		admit(&p, added);
		memcpy(p.last, p.rows->lambda, (size_t)p.rows->count * sizeof *p.last);
		const JnStatus status = solve_round(&p);
		clip(&p);
		if (status != JN_OK) return status;
		jn_delassus_velocities(d);
		if (jn_qp_rows_residual(&d->base) <= tolerance) return JN_OK;
	}
	return JN_NOT_CONVERGED;
}
