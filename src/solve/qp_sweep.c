// Gauss-Seidel sweeps over the contacts, each projected onto Coulomb's law (Jean 1999, Nonsmooth contact dynamics; Jourdan,
// Alart and Jean 1998): quick where bodies are soft within the step, and a way to find out who presses, sticks and slides.
#include <math.h>
#include <string.h>

#include "solve/qp_cone.h"
#include "solve/qp_delassus.h"

// STEPS: factorisations that the methods behind the sweeps usually take
enum { CHECK = 4, SWEEPS_MOST = 1000, STEPS = 3 };
static const double trial = 0.2;      // of the time of the other way is spent before rates are believed
static const double speed_ratio = 10; // of a factorisation to products with W, in operations a second, measured

// How many sweeps take as long as a factorisation over the contacts that press.
static JnStatus sweeps_per_factor(JnDelassus* d, double* sweeps) {
	JnBlockFactor* f = &d->factor;
	double work = 1;
	JN_TRY(jn_block_begin(f, d->group_count));
	for (int k = 0; k < d->working_count; ++k) {
		const int count = jn_delassus_row_count(d, k);
		if (d->lambda[d->start[k]] <= 0) continue;
		f->size[d->group_of[k]] += count;
		for (int t = d->touch_start[k]; t < d->touch_start[k + 1]; ++t)
			work += 2.0 * count * d->bodies[d->touches[t].body].rows;
	}
	jn_delassus_meet(d);
	JN_TRY(jn_block_analyze(f, false));
	*sweeps = f->work / (speed_ratio * work);
	return JN_OK;
}

// The law at one contact, whose block of W is w[column][row]: the normal first, then the tangents.
static void relax_contact(double mu, int count, double w[3][3], double after[3], double lambda[3]) {
	const double normal = fmax(0, lambda[0] - after[0] / w[0][0]);
	for (int a = 0; a < count; ++a) after[a] += (normal - lambda[0]) * w[0][a];
	lambda[0] = normal;
	if (count == 1) return;
	const double a = w[1][1], b = w[2][2], c = w[1][2];
	const double stiffest = 0.5 * (a + b) + hypot(0.5 * (a - b), c); // largest eigenvalue of the tangential block
	if (stiffest <= 0) return;
	double t1 = lambda[1] - after[1] / stiffest, t2 = lambda[2] - after[2] / stiffest;
	jn_disk_project(mu * normal, &t1, &t2);
	for (int r = 0; r < 3; ++r) after[r] += (t1 - lambda[1]) * w[1][r] + (t2 - lambda[2]) * w[2][r];
	lambda[1] = t1;
	lambda[2] = t2;
}

static void relax(JnDelassus* d, int k) {
	const int first = d->start[k], count = jn_delassus_row_count(d, k);
	double w[3][3], after[3], lambda[3], change[3];
	if (d->diagonal[first] <= 0) return; // a contact of held nodes alone
	jn_delassus_collect(d, k);
	if (d->lambda[first] == 0 && d->after[first] >= 0) return;
	jn_delassus_block(d, k, w);
	memcpy(after, d->after + first, (size_t)count * sizeof *after);
	memcpy(lambda, d->lambda + first, (size_t)count * sizeof *lambda);
	relax_contact(d->mu[k], count, w, after, lambda);
	bool is_changed = false;
	for (int j = 0; j < count; ++j) {
		change[j] = lambda[j] - d->lambda[first + j];
		is_changed = is_changed || change[j] != 0;
		d->lambda[first + j] = lambda[j];
	}
	if (is_changed) jn_delassus_push(d, k, change);
}

// Forth and back, so that neither end of the list is favoured.
static void sweep(JnDelassus* d, int count) {
	for (int s = 0; s < count; ++s)
		for (int k = 0; k < d->working_count; ++k) relax(d, s % 2 == 0 ? k : d->working_count - 1 - k);
	for (int k = 0; k < d->working_count; ++k) jn_delassus_collect(d, k);
	d->base.report.sweeps += count;
}

JnStatus jn_delassus_sweep(JnDelassus* d, double tolerance, int least, bool* is_quick) {
	double last = INFINITY, patience = 0;
	*is_quick = true;
	jn_delassus_velocities(d); // of contacts that have just arrived
	for (int count = CHECK; (count <= SWEEPS_MOST || count <= least) && *is_quick; count += CHECK) {
		sweep(d, CHECK);
		const double residual = jn_delassus_residual(d);
		if (!(residual > tolerance)) break;
		if (count == CHECK) {
			JN_TRY(sweeps_per_factor(d, &patience));
			patience *= STEPS;
		}
		const double left = residual < last ? CHECK * log(residual / tolerance) / log(last / residual) : INFINITY;
		*is_quick = count < least || count < trial * patience || left < patience;
		last = residual;
	}
	jn_delassus_velocities(d); // without the rounding of the updates
	return JN_OK;
}
