// One correction: from the contacts found to velocities and positions, with further looks at where these lead.
#include <math.h>
#include <string.h>

#include "base/timer.h"
#include "math/vec3.h"
#include "pass/contact.h"

enum { LOOKS = 6 }; // corrections of a prediction, after which what still passes through fails the attempt

// No body becomes so many times as large in a step but where the integrator goes astray. Hundreds of contacts without a
// solution would be all that is left of its surface, and minutes spent on them.
static const double torn = 10;

// free_v = vp - dt C^-1 load
static JnStatus find_free_velocities(JnContactPass* pass, const JnStep* step) {
	const size_t n = jn_contact_entries(pass);
	memcpy(pass->free_v, step->end->v, n * sizeof *pass->free_v);
	if (!pass->is_loaded) return JN_OK;
	const JnContactMatrix matrix = jn_contact_matrix(pass);
	memcpy(pass->is_in, pass->moves, (size_t)pass->model->body_count * sizeof *pass->is_in);
	const JnStatus status = matrix.solve(pass, pass->tried, pass->work);
	memset(pass->is_in, 0, (size_t)pass->model->body_count * sizeof *pass->is_in);
	for (size_t k = 0; k < n; ++k) pass->free_v[k] -= step->dt * pass->work[k];
	return status;
}

// Forces that act in a damped prediction are taken off by a damped corrector, or energy comes in with them.
static bool has_damping(const JnContactPass* pass) {
	if (pass->def->damping == JN_DAMPING_AUTO) return pass->prediction != JN_PREDICTION_FREE;
	return pass->def->damping == JN_DAMPING_YES;
}

// The matrices of all bodies that take part, unless they are there already.
static void fill_matrices(JnContactPass* pass, const JnStep* step) {
	const double h = pass->theta * step->dt, damping = has_damping(pass) ? h : 0;
	const int bodies = pass->model->body_count;
	bool is_complete = true;
	for (int b = 0; b < bodies; ++b) is_complete &= pass->is_filled[b] || !pass->moves[b];
	if (is_complete) return;
	for (int b = 0; b < bodies; ++b) pass->is_filled[b] |= pass->moves[b];
	jn_body_matrices_fill(&pass->matrices, pass->is_filled, (JnShift){1, damping, h * h}, step->end->x);
}

static JnStatus solve_islands(JnContactPass* pass, const JnStep* step) {
	const int islands = jn_contact_islands_find(pass, step);
	pass->tally.pressing = 0;
	memcpy(pass->v, step->end->v, jn_contact_entries(pass) * sizeof *pass->v);
	if (islands == 0) return JN_OK;
	fill_matrices(pass, step);
	JN_TRY(find_free_velocities(pass, step));
	for (int i = 0; i < islands; ++i) {
		const JnStatus status = jn_contact_island_solve(pass, i);
		if (status < JN_OK || status == JN_NOT_FINITE) return status;
		if (status > JN_OK) return JN_NOT_CONVERGED;
	}
	return JN_OK;
}

// Bodies are factored when they are first solved with, so that the time of that is within.
static JnStatus solve(JnContactPass* pass, const JnStep* step) {
	JnReport* report = pass->sys->base.report;
	const double began = jn_seconds(), factored = report->seconds_factor;
	const JnStatus status = solve_islands(pass, step);
	report->seconds_qp += jn_seconds() - began - (report->seconds_factor - factored);
	return status;
}

// corrected = xp + theta dt (v - vp). Whether anything moved.
static bool find_positions(JnContactPass* pass, const JnStep* step) {
	const JnState* end = step->end;
	bool moved = false;
	for (size_t k = 0; k < jn_contact_entries(pass); ++k) {
		pass->corrected[k] = end->x[k];
		if (pass->v[k] == end->v[k]) continue;
		pass->corrected[k] += pass->theta * step->dt * (pass->v[k] - end->v[k]);
		moved = true;
	}
	return moved;
}

// The longest way of a node from start to end of the prediction.
static double longest_way(const JnContactPass* pass, const JnStep* step) {
	double most = 0;
	for (size_t k = 0; k < jn_contact_entries(pass); k += 3)
		most = fmax(most, vec3_distance(step->start->x + k, step->end->x + k));
	return most;
}

// Diagonal of the box about a body.
static double extent(const JnContactPass* pass, int body, const double* x) {
	const size_t first = jn_contact_first_entry(pass, body), end = first + jn_contact_entry_count(pass, body);
	double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (size_t k = first; k < end; ++k) {
		low[k % 3] = x[k] < low[k % 3] ? x[k] : low[k % 3];
		high[k % 3] = x[k] > high[k % 3] ? x[k] : high[k % 3];
	}
	return vec3_distance(low, high);
}

// Whether the prediction tears a body: what went wrong is the integrator's, for the words of other causes to tell.
static bool tears_a_body(const JnContactPass* pass, const JnStep* step) {
	for (int b = 0; b < pass->model->body_count; ++b) {
		const double end = extent(pass, b, step->end->x);
		if (end > torn * extent(pass, b, step->start->x) && end > torn * extent(pass, b, pass->model->rest))
			return true;
	}
	return false;
}

JnStatus jn_contact_correct(JnContactPass* pass, const JnStep* step) {
	memset(pass->is_filled, 0, (size_t)pass->model->body_count * sizeof *pass->is_filled);
	JN_TRY(jn_contact_find(pass, step, &pass->tally.pairs));
	if (pass->now.count > 0 && tears_a_body(pass, step)) return JN_NOT_CONVERGED;
	for (int k = 0; k < LOOKS; ++k) {
		int missed;
		double depth;
		JN_TRY(solve(pass, step));
		if (!find_positions(pass, step)) break;
		if (pass->def->rule == JN_RULE_TOUCHING) break; // lets fast bodies overlap for a step, as the paper does
		JN_TRY(jn_contact_look_again(pass, step, pass->corrected, &missed, &depth));
		if (missed == 0) break;
		if (k + 1 == LOOKS && depth > pass->margin) {
			pass->has_failed = true;
			pass->passed = depth;
			pass->travel = longest_way(pass, step);
			return JN_NOT_CONVERGED;
		}
		if (k + 1 < LOOKS) JN_TRY(jn_contact_extend(pass, step));
	}
	pass->tally.contacts = pass->now.count;
	return JN_OK;
}

bool jn_contact_move(JnContactPass* pass, JnStep* step) {
	JnState* end = step->end;
	bool edited = false;
	for (size_t k = 0; k < jn_contact_entries(pass); ++k) {
		if (pass->v[k] == end->v[k]) continue;
		end->x[k] = pass->corrected[k];
		end->v[k] = pass->v[k];
		edited = true;
	}
	if (edited) jn_state_touch(pass->sys->base.space, end);
	return edited;
}
