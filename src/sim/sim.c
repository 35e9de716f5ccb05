// The loop of every simulation:
//   repeat (passes: prepare; integrator: start -> end; passes: correct; controller: accept?) until accepted
//   -> passes: commit -> swap -> begin the next step
// The system begins a step as soon as its start is known, so that energies reported for a state use the rotations of
// that state.
#include "jounce/sim.h"

#include <math.h>

#include "base/report.h"
#include "base/timer.h"
#include "model/system.h"
#include "sim/diagnose.h"
#include "sim/simulation.h"

// The last step ends on the duration; a difference that is only rounding leaves the step as it is.
static double clip(const JnSim* sim, double dt) {
	const double left = fmin(sim->def->duration, sim->stop) - sim->start.t;
	return left < dt * (1 - 1e-9) ? left : dt;
}

// Predict and correct, in as many rounds as the passes ask for. step->is_edited: the end is no longer the integrator's.
static JnStatus attempt(JnSim* sim, JnStep* step) {
	bool again = true;
	for (int round = 0; again; ++round) {
		step->report = (JnReport){0};
		JN_TRY(jn_passes_prepare(&sim->passes, step, round));
		JN_TRY(jn_controller_prepare(sim->controller, step));
		const double began = jn_seconds();
		const JnStatus outcome = sim->integrator->type->step(sim->integrator, step);
		step->report.seconds_predict = jn_seconds() - began;
		sim->sys->report = &sim->report;
		jn_report_add(&sim->report, &step->report);
		if (outcome != JN_OK) return outcome;
		JN_TRY(jn_passes_correct(&sim->passes, step, round, &step->is_edited, &again));
	}
	return sim->passes.count > 0 ? jn_state_check(sim->sys->space, step->end) : JN_OK; // integrators look at theirs
}

// History that a method kept of an end that was edited, or whose forces have changed since, is history of another state.
static void accept(JnSim* sim, const JnStep* step) {
	if (step->is_edited)
		jn_integrator_reset(sim->integrator);
	else if (sim->integrator->type->commit != NULL)
		sim->integrator->type->commit(sim->integrator, step);
	const uint64_t stamp = step->end->stamp;
	jn_passes_commit(&sim->passes, step);
	if (step->end->stamp != stamp) {
		jn_integrator_reset(sim->integrator);
		jn_integrator_forget(sim->integrator);
	}
	sim->last_dt = step->dt;
	sim->longest_dt = fmax(sim->longest_dt, step->dt);
	sim->was_edited = step->is_edited;
}

JnStatus jn_sim_step(JnSim* sim) {
	sim->report = (JnReport){0};
	sim->sys->report = &sim->report;
	JnVerdict verdict = {0};
	if (sim->model != NULL) jn_model_inputs_begin(sim->model, sim->start.t, clip(sim, sim->next_dt));
	while (!verdict.accepted) {
		JnStep step = {.sys = sim->sys,
					   .start = &sim->start,
					   .end = &sim->end,
					   .dt = clip(sim, sim->next_dt),
					   .wanted = sim->next_dt,
					   .method = sim->integrator->type};
		const JnStatus outcome = attempt(sim, &step);
		if (outcome < JN_OK) return outcome;
		const JnStatus judged = sim->controller->type->judge(sim->controller, &step, outcome, &verdict);
		const bool is_lost = outcome == JN_NOT_FINITE && jn_sim_is_lost(sim);
		if (judged == JN_RUN_FAILED || is_lost) return jn_sim_fail(sim, &step, outcome, !is_lost);
		if (judged != JN_OK) return judged;
		if (verdict.accepted) {
			accept(sim, &step);
		} else {
			++sim->report.rejected;
			jn_integrator_forget(sim->integrator);
		}
		sim->next_dt = verdict.dt;
	}
	const JnState swap = sim->start;
	sim->start = sim->end;
	sim->end = swap;
	++sim->steps;
	const JnStatus begun = sim->sys->ops->begin(sim->sys, &sim->start);
	return begun > JN_OK ? jn_sim_fail_at_end(sim, "the forces at its end cannot be evaluated", begun) : begun;
}

bool jn_sim_is_done(const JnSim* sim) {
	return sim->def->duration - sim->start.t <= 1e-9 * fmin(sim->next_dt, sim->def->duration);
}

void jn_sim_stop_at(JnSim* sim, double t) {
	sim->stop = t;
}

JnModel* jn_sim_model(JnSim* sim) {
	return sim->model;
}

JnSystem* jn_sim_system(JnSim* sim) {
	return sim->sys;
}

const JnState* jn_sim_state(const JnSim* sim) {
	return &sim->start;
}

long jn_sim_steps(const JnSim* sim) {
	return sim->steps;
}

double jn_sim_last_dt(const JnSim* sim) {
	return sim->last_dt;
}

double jn_sim_next_dt(const JnSim* sim) {
	return sim->next_dt;
}

const JnReport* jn_sim_last_report(const JnSim* sim) {
	return &sim->report;
}

JnPass* const* jn_sim_passes(const JnSim* sim, int* count) {
	*count = sim->passes.count;
	return sim->passes.list;
}

int jn_sim_threads(const JnSim* sim) {
	return sim->threads;
}
