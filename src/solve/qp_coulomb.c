// Contacts with Coulomb friction on the Delassus matrix: Gauss-Seidel sweeps, contact by contact, each projected onto the
// law (Jean 1999, Nonsmooth contact dynamics; Jourdan, Alart and Jean 1998), which find out who presses, sticks and slides,
// and Newton steps (qp_newton.c), which then converge in a few. Where a Newton step fails, sweeps go on. Contacts enter
// when they are first violated.
#include <math.h>

#include "solve/qp_cone.h"
#include "solve/qp_delassus.h"

// ROUNDS: hard problems take ten; with bounds that contradict each other none would do
enum { SWEEPS_LEAST = 8, SWEEPS_MOST = 64, SWEEP_ROWS = 40, SHARE_MOST = 16, ROUNDS = 60 };

// A Newton step takes 2/3 rows^3 operations near the speed of the processor, a sweep 2 rows^2 at that of the memory, which
// is some twenty times slower: rows / 40 sweeps take about as long as a step. Both get equal shares.
static int sweeps_per_step(int rows) {
	const int sweeps = rows / SWEEP_ROWS;
	return sweeps < SWEEPS_LEAST ? SWEEPS_LEAST : sweeps < SWEEPS_MOST ? sweeps : SWEEPS_MOST;
}

// Set the multiplier of a row, and let all velocities follow.
static void set_lambda(JnDelassus* d, int row, int column, double value) {
	const double change = value - d->base.rows.lambda[row];
	if (change == 0) return;
	const double* w = d->at + (size_t)column * (size_t)d->base.rows.count;
	double* after = d->base.rows.after;
	for (int r = 0; r < d->base.rows.count; ++r) after[r] += change * w[r];
	d->base.rows.lambda[row] = value;
}

static void relax(JnDelassus* d, int contact) {
	JnQpRows* rows = &d->base.rows;
	const int row = rows->first[contact], column = d->column_of[contact];
	const double normal = jn_delassus_entry(d, row, column);
	if (normal <= 0) return; // a contact of held nodes alone
	set_lambda(d, row, column, fmax(0, rows->lambda[row] - rows->after[row] / normal));
	if (rows->first[contact + 1] - row == 1) return;
	const double a = jn_delassus_entry(d, row + 1, column + 1), b = jn_delassus_entry(d, row + 2, column + 2);
	const double c = jn_delassus_entry(d, row + 1, column + 2);
	const double stiffest = 0.5 * (a + b) + hypot(0.5 * (a - b), c); // largest eigenvalue of the tangential block
	double t1 = rows->lambda[row + 1] - rows->after[row + 1] / stiffest;
	double t2 = rows->lambda[row + 2] - rows->after[row + 2] / stiffest;
	jn_disk_project(rows->mu[contact] * rows->lambda[row], &t1, &t2);
	set_lambda(d, row + 1, column + 1, t1);
	set_lambda(d, row + 2, column + 2, t2);
}

// Forth and back, so that neither end of the list is favoured.
static void sweep(JnDelassus* d, int count) {
	for (int s = 0; s < count; ++s)
		for (int k = 0; k < d->working_count; ++k) relax(d, d->working[s % 2 == 0 ? k : d->working_count - 1 - k]);
	d->base.report.sweeps += count;
	jn_delassus_velocities(d); // without the rounding of the updates
}

JnStatus jn_delassus_coulomb(JnDelassus* d) {
	JnQp* qp = &d->base;
	const double tolerance = 0.1 * qp->options.tolerance;
	int added = 0, share = 1; // share: sweeps between Newton steps grow while those fail
	JN_TRY(jn_delassus_extend(d, 0, &added));
	jn_delassus_velocities(d);
	const int most = qp->options.max_iterations < ROUNDS ? qp->options.max_iterations : ROUNDS;
	while (qp->report.iterations < most) {
		++qp->report.iterations;
		sweep(d, share * sweeps_per_step(d->columns));
		JN_TRY(jn_delassus_extend(d, tolerance * qp->rows.velocity_scale, &added));
		if (added > 0) continue;
		if (jn_qp_rows_residual(qp) <= tolerance) return JN_OK;
		bool worked = false;
		JN_TRY(jn_delassus_newton(d, tolerance, &worked));
		JN_TRY(jn_delassus_extend(d, tolerance * qp->rows.velocity_scale, &added));
		if (added == 0 && jn_qp_rows_residual(qp) <= tolerance) return JN_OK;
		share = worked ? 1 : share < SHARE_MOST ? 2 * share : share;
	}
	return JN_NOT_CONVERGED;
}
