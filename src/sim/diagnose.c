#include "sim/diagnose.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "base/space.h"
#include "integrate/composition.h"
#include "integrate/integrator.h"
#include "integrate/properties.h"
#include "model/examine.h"
#include "model/system.h"
#include "sim/simulation.h"
#include "sim/stability.h"

// A node at its last good position, or the number of a coordinate.
static void name_place(const JnSim* sim, int entry, size_t size, char* place) {
	if (sim->model == NULL) {
		snprintf(place, size, "coordinate %d", entry);
		return;
	}
	const JnSpot spot = jn_model_node(sim->model, entry / 3);
	jn_spot_name(sim->model, &spot, sim->start.x, size, place);
}

// The node with the longest part of a vector, or that which is not finite; -1: all are zero.
static int worst_entry(const JnSpace* space, const double* vec) {
	const size_t entries = space->node_entries > 1 ? (size_t)space->node_entries : 1;
	double most = 0;
	int worst = -1;
	for (size_t k = 0; k < space->length; k += entries) {
		double square = 0;
		for (size_t i = 0; i < entries; ++i) square += vec[k + i] * vec[k + i];
		if (!isfinite(square)) return (int)k;
		if (square > most) most = square, worst = (int)k;
	}
	return worst;
}

static void place_worst(JnFailure* f, const double* vec) {
	const int entry = worst_entry(f->sim->sys->space, vec);
	if (entry >= 0) name_place(f->sim, entry, sizeof f->place, f->place);
}

static bool is_implicit(const JnFailure* f) {
	return (f->sim->integrator->type->needs & JN_NEEDS_TANGENT) != 0;
}

// ---- the causes, in the order in which they are looked for

// The step works, but the controller may not accept it and may not try a smaller one.
static bool find_refusal(JnFailure* f) {
	if (f->outcome != JN_OK || f->complaint.cause[0] == '\0') return false;
	snprintf(f->cause, sizeof f->cause, "%s", f->complaint.cause);
	return true;
}

static bool find_in_pass(JnFailure* f) {
	JnPassComplaint complaint;
	jn_passes_explain(&f->sim->passes, &complaint);
	if (complaint.cause[0] == '\0' || f->outcome == JN_OK || f->step == NULL) return false;
	snprintf(f->cause, sizeof f->cause, "%s %s", jn_status_name(f->outcome), complaint.cause);
	if (complaint.node >= 0) name_place(f->sim, 3 * complaint.node, sizeof f->place, f->place);
	const size_t size = sizeof f->remedy;
	size_t used = 0;
	if (complaint.remedy[0] != '\0') used += (size_t)snprintf(f->remedy, size, "%s, ", complaint.remedy);
	if (complaint.share > 0)
		used +=
			(size_t)snprintf(f->remedy + used, size - used, "steps of about %.2g s, ", complaint.share * f->step->dt);
	snprintf(f->remedy + used, size - used, "%s", f->complaint.remedy);
	return true;
}

// The held node that moves farthest from the start of the step to its end.
static int fastest_held(const JnSim* sim, const double* x, double* move) {
	int fastest = -1;
	*move = 0;
	for (int i = 0; i < sim->model->held_count; ++i) {
		const int node = sim->model->held_list[i].entry / 3;
		double square = 0;
		for (int axis = 0; axis < 3; ++axis) {
			const int k = 3 * node + axis;
			if (sim->model->held[k]) square += (x[k] - sim->start.x[k]) * (x[k] - sim->start.x[k]);
		}
		if (square > *move * *move) *move = sqrt(square), fastest = node;
	}
	return fastest;
}

static bool find_fast_motion(JnFailure* f) {
	static const double most = 0.5; // of an edge
	JnSim* sim = f->sim;
	JnSystem* sys = sim->sys;
	if (f->step == NULL || sim->model == NULL || sim->model->held_count == 0) return false;
	JnState at_end;
	if (jn_state_create(sys->space, &at_end) != JN_OK) return false;
	jn_state_copy(sys->space, &sim->start, &at_end);
	at_end.t = sim->start.t + f->step->dt;
	sys->ops->prescribe(sys, &at_end, NULL);
	double move;
	const int node = fastest_held(sim, at_end.x, &move);
	jn_state_destroy(sys->space, &at_end);
	const double edge = node >= 0 ? jn_model_edge_at(sim->model, node) : INFINITY;
	if (!(move > most * edge)) return false;
	name_place(sim, 3 * node, sizeof f->place, f->place);
	snprintf(
		f->cause, sizeof f->cause,
		"the prescribed motion is too fast: it moves a node by %.3g m within the step, and the shortest edge there is "
		"%.3g m",
		move, edge);
	snprintf(f->remedy, sizeof f->remedy,
			 "a slower motion (drive), or a smaller %s.dt, such as %.2g s, at which it moves by a tenth of an edge",
			 f->sim->controller->path, 0.1 * edge / move * f->step->dt);
	return true;
}

// Which explicit method to take where the present one is unstable at any step.
static const JnIntegratorType* stable_method(const JnIntegratorType* method, const JnStability* found) {
	return found->nu > 0 ? method : &jn_verlet;
}

bool jn_sim_find_instability(JnSim* sim, double dt, JnFailure* f) {
	const JnIntegratorType* method = sim->integrator->type;
	JnStability found;
	const double used = sim->longest_dt > 0 ? sim->longest_dt : dt;
	if (!jn_sim_is_unstable(sim, method, used, &found)) return false;
	name_place(sim, found.entry, sizeof f->place, f->place);
	if (found.nu > 0)
		snprintf(
			f->cause, sizeof f->cause,
			"steps of %.3g s are above the limit of stability of %s, %.3g / omega = %.3g s, where omega = %.3g 1/s is "
			"the largest frequency %s (damping ratio %.2g)",
			used, method->row.name, found.nu, found.limit, found.omega,
			found.at_start ? "at the start of the run" : "of the last good state", found.xi);
	else
		snprintf(
			f->cause, sizeof f->cause,
			"no step of %s is stable without damping, least of all one of %.3g s at the largest frequency, %.3g 1/s",
			method->row.name, used, found.omega);
	const double share = 0.8;
	const JnIntegratorType* other = stable_method(method, &found);
	double nu;
	if (jn_integrator_stability_limit(other, fmax(found.xi, 0), &nu) != JN_OK) return true;
	if (!(nu > 0)) snprintf(f->remedy, sizeof f->remedy, "an implicit method such as integrator.method: sdirk2");
	if (!(nu > 0)) return true;
	snprintf(f->remedy, sizeof f->remedy,
			 "%s%s%sstep.dt = %.2g s, step.controller: stable, which follows that limit, or an implicit method such as "
			 "integrator.method: sdirk2",
			 other != method ? "integrator.method: " : "", other != method ? other->row.name : "",
			 other != method ? " with " : "", share * nu / found.omega);
	return true;
}

static bool find_instability(JnFailure* f) {
	return f->outcome != JN_OK && jn_sim_find_instability(f->sim, f->step != NULL ? f->step->dt : f->sim->last_dt, f);
}

// Inside out already, or on the way there.
static bool find_inversion(JnFailure* f) {
	const JnSim* sim = f->sim;
	if (sim->model == NULL || f->outcome == JN_OK) return false;
	const JnSpot now = jn_model_most_squeezed(sim->model, sim->start.x);
	const JnSpot then = jn_model_most_squeezed(sim->model, sim->end.x);
	const bool is_now = now.body >= 0 && now.value <= 0, is_then = then.body >= 0 && then.value <= 0;
	if (!is_now && !is_then) return false;
	const JnSpot* spot = is_now ? &now : &then;
	const JnBody* body = &sim->model->bodies[spot->body];
	jn_spot_name(sim->model, spot, sim->start.x, sizeof f->place, f->place);
	snprintf(f->cause, sizeof f->cause, "%s: an element %s inside out (volume ratio %.3g)", jn_status_name(f->outcome),
			 is_now ? "is" : "turns", spot->value);
	if (strcmp(body->law->row.name, "neo_hookean") == 0)
		snprintf(
			f->remedy, sizeof f->remedy,
			"material.law: stable_neo_hookean, which is defined there too (neo_hookean is not), a smaller %s.dt, or a "
			"finer mesh",
			sim->controller->path);
	return true;
}

static bool find_indefinite(JnFailure* f) {
	static const double most = 1e14, easy = 1e12; // (omega dt)^2, of the 16 digits of a number
	JnStability found;
	if (f->outcome != JN_INDEFINITE) return false;
	const int used = snprintf(f->cause, sizeof f->cause, "%s: M + dt D + dt^2 K of the step is not positive definite",
							  jn_status_name(f->outcome));
	if (f->step == NULL || !jn_sim_largest_frequency(f->sim, &found)) return true;
	const double turns = found.omega * f->step->dt;
	if (!(turns * turns > most)) return true;
	snprintf(
		f->cause + used, sizeof f->cause - (size_t)used,
		", as its parts are too far apart for numbers of 16 digits: (omega dt)^2 = %.2g, where omega = %.3g 1/s is the "
		"largest frequency",
		turns * turns, found.omega);
	name_place(f->sim, found.entry, sizeof f->place, f->place);
	snprintf(f->remedy, sizeof f->remedy, "steps of %.2g s, a softer material, %s", sqrt(easy) / found.omega,
			 f->complaint.remedy);
	return true;
}

static bool find_residual(JnFailure* f) {
	static const int plenty = 200; // iterations
	JnSim* sim = f->sim;
	if (f->outcome != JN_NOT_CONVERGED || !is_implicit(f)) return false;
	const JnNewtonDef* newton = &sim->integrator->newton;
	const double* residual = jn_integrator_residual(sim->integrator);
	const double scale = sim->sys->force_scale;
	const double norm = sqrt(sim->sys->space->ops->dot(sim->sys->space, residual, residual));
	if (!(scale > 0) || !(norm > newton->tolerance * scale)) return false; // NAN, or of a method without stages
	place_worst(f, residual);
	snprintf(f->cause, sizeof f->cause, "%s: a residual of %.2g is left, above newton.tolerance, %.2g",
			 jn_status_name(f->outcome), norm / scale, newton->tolerance);
	if (newton->max_iterations < plenty)
		snprintf(f->remedy, sizeof f->remedy, "newton: {mode: auto, max_iterations: %d}, %.300s", plenty,
				 f->complaint.remedy);
	return true;
}

static bool find_anything(JnFailure* f) {
	JnSpace* space = f->sim->sys->space;
	const JnState* end = &f->sim->end;
	snprintf(f->cause, sizeof f->cause, "%s", jn_status_name(f->outcome));
	if (f->outcome == JN_NOT_FINITE && jn_state_check(space, end) != JN_OK)
		place_worst(f, isfinite(space->ops->max(space, end->x)) ? end->v : end->x);
	return true;
}

static bool (*const causes[])(JnFailure*) = {find_refusal,   find_in_pass,    find_fast_motion, find_instability,
											 find_inversion, find_indefinite, find_residual,    find_anything};

// ---- the message

static double largest_size(const JnModel* model) {
	double size = DBL_MIN;
	for (int k = 0; k < 3 * model->node_count; ++k) size = fmax(size, fabs(model->rest[k]));
	return size;
}

bool jn_sim_is_lost(const JnSim* sim) {
	double bound = 1e100; // of a system that does not tell its size
	if (sim->model != NULL) bound = 1e6 * largest_size(sim->model);
	JnSpace* space = sim->sys->space;
	return space->ops->max(space, sim->start.x) > bound;
}

void jn_sim_explain(JnFailure* f) {
	jn_controller_explain(f->sim->controller, &f->complaint);
	for (size_t i = 0; i < sizeof causes / sizeof *causes && !causes[i](f); ++i) f->cause[0] = '\0';
	if (f->place[0] == '\0') place_worst(f, f->sim->start.v);
	if (f->remedy[0] == '\0') snprintf(f->remedy, sizeof f->remedy, "%s", f->complaint.remedy);
}

JnStatus jn_sim_fail(JnSim* sim, const JnStep* step, JnStatus outcome, bool is_smallest) {
	JnFailure f = {.sim = sim, .step = step, .outcome = outcome};
	jn_sim_explain(&f);
	const bool has_limit = is_smallest && f.complaint.limit[0] != '\0';
	return jn_error(
		JN_RUN_FAILED,
		"step %ld at t = %.9g s failed: %s%s%s, with dt = %.3g s%s%s%s%s; the last good state is at t = %.9g s. "
		"Try %s",
		sim->steps + 1, sim->start.t, f.cause, f.place[0] != '\0' ? ", at " : "", f.place, step->dt,
		is_smallest ? ", the smallest step allowed" : "", has_limit ? " (" : "", f.complaint.limit,
		has_limit ? ")" : "", sim->start.t, f.remedy);
}

// Positions and velocities are finite, but where elements are inside out, or out of the range of squares.
JnStatus jn_sim_fail_at_end(JnSim* sim, const char* what, JnStatus outcome) {
	JnFailure f = {.sim = sim, .outcome = outcome};
	jn_sim_explain(&f);
	return jn_error(JN_RUN_FAILED, "step %ld at t = %.9g s failed: %s; %s%s%s. Try %s", sim->steps, sim->end.t, what,
					f.cause, f.place[0] != '\0' ? ", at " : "", f.place, f.remedy);
}
