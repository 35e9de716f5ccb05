// Contacts on the Delassus matrix: sweeps (qp_sweep.c), and Newton steps (qp_newton.c) where those are slow, which then
// converge in a few. Where Newton steps fail, more sweeps follow. Contacts enter when they are first violated.
#include <math.h>

#include "solve/qp_delassus.h"

// Hard problems take ten rounds; with bounds that contradict each other none would do, and STALL rounds without progress end.
enum { SWEEPS_LEAST = 8, SHARE_MOST = 64, ROUNDS = 60, STALL = 24 };

static const double coarse = 0.03; // residual of Newton steps before contacts that are violated are looked for

typedef struct Progress {
	double least; // residual
	int stalled;  // rounds since it fell
} Progress;

static bool is_stalled(Progress* p, double residual) {
	const bool is_better = residual < 0.7 * p->least;
	p->least = is_better ? residual : p->least;
	p->stalled = is_better ? 0 : p->stalled + 1;
	return p->stalled > STALL;
}

JnStatus jn_delassus_iterate(JnDelassus* d) {
	JnQp* qp = &d->base;
	const double tolerance = 0.1 * qp->options.tolerance, slack = tolerance * qp->rows.velocity_scale;
	int added = 0, least = SWEEPS_LEAST; // sweeps between Newton steps grow while those fail
	bool is_sweeping = !jn_qp_rows_press(&qp->rows), is_complete = false;
	Progress progress = {.least = INFINITY};
	JN_TRY(jn_delassus_extend(d, 0, &added));
	const int most = qp->options.max_iterations < ROUNDS ? qp->options.max_iterations : ROUNDS;
	jn_delassus_velocities(d);
	while (qp->report.iterations < most) {
		++qp->report.iterations;
		if (is_sweeping) {
			JN_TRY(jn_delassus_sweep(d, tolerance, least, &is_sweeping));
			JN_TRY(jn_delassus_extend(d, slack, &added));
			if (added == 0 && jn_delassus_residual(d) <= tolerance) return JN_OK;
			if (added > 0) jn_delassus_velocities(d);
			if (is_sweeping) continue;
		}
		bool worked = false;
		JN_TRY(jn_delassus_newton(d, is_complete ? tolerance : fmax(tolerance, coarse), &worked));
		JN_TRY(jn_delassus_extend(d, slack, &added));
		if (added > 0) jn_delassus_velocities(d);
		if (added == 0 && jn_delassus_residual(d) <= tolerance) return JN_OK;
		if (added == 0 && is_stalled(&progress, jn_delassus_residual(d))) return JN_NOT_CONVERGED;
		is_complete = added == 0;
		is_sweeping = !worked && added == 0;
		least = worked ? SWEEPS_LEAST : least < SWEEPS_LEAST * SHARE_MOST ? 2 * least : least;
	}
	return JN_NOT_CONVERGED;
}
