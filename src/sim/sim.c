// The loop of every simulation:
//   repeat (passes: prepare; integrator: start -> end; passes: correct; controller: accept?) until accepted
//   -> passes: commit -> swap -> begin the next step
// The system begins a step as soon as its start is known, so that energies reported for a state use the rotations of
// that state.
#include "jounce/sim.h"

#include <math.h>
#include <stdlib.h>

#include "base/key.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/space.h"
#include "base/timer.h"
#include "control/controller.h"
#include "integrate/integrator.h"
#include "pass/pass.h"
#include "sim/sim_keys.h"

struct JnSim {
	const JnSimDef* def;
	JnArena arena; // of settings given as text
	JnSimDef settings;
	int threads;
	JnModel* model; // NULL when the system is the user's
	JnSystem* sys;
	JnIntegrator* integrator;
	JnController* controller;
	JnPasses passes;
	JnState start, end; // start is the state of the last accepted step
	double next_dt, last_dt;
	long steps;
	JnReport report;
};

// Everything but the system and its first state.
static JnStatus create_parts(JnSim* sim) {
	const JnSimDef* def = sim->def;
	JN_TRY(jn_integrator_accepts((const JnIntegratorType*)def->integrator.row, sim->sys));
	JN_TRY(jn_state_create(sim->sys->space, &sim->start));
	JN_TRY(jn_state_create(sim->sys->space, &sim->end));
	sim->integrator = jn_integrator_create(&def->integrator, &def->newton, sim->sys->space);
	sim->controller = jn_controller_create(&def->step);
	if (sim->integrator == NULL || sim->controller == NULL) return JN_OUT_OF_MEMORY;
	sim->next_dt = sim->controller->type->first(sim->controller);
	return JN_OK;
}

static JnStatus begin_first_step(JnSim* sim) {
	sim->sys->report = &sim->report;
	const JnStatus status = sim->sys->ops->begin(sim->sys, &sim->start);
	if (status <= JN_OK) return status;
	return jn_error(JN_BAD_INPUT, "the forces at the start cannot be evaluated: %s; start from another state",
					jn_status_name(status));
}

static JnStatus create_with_model(JnSim* sim, const JnSimDef* def) {
	sim->def = def;
	JN_TRY(jn_model_create(&def->model, sim->threads, &sim->model));
	sim->sys = jn_model_system(sim->model);
	JN_TRY(create_parts(sim));
	JN_TRY(jn_passes_create(def, sim->model, &sim->passes));
	jn_model_start(sim->model, 0, &sim->start);
	return begin_first_step(sim);
}

static JnStatus create_for_system(JnSim* sim, JnSystem* sys, const char* settings, const double* x, const double* v) {
	JnDocument document;
	JN_TRY(jn_document_parse("settings", settings, &sim->arena, &document));
	JN_TRY(jn_keys_read(jn_sim_keys, document.root, "", &sim->arena, &sim->settings));
	sim->def = &sim->settings;
	sim->sys = sys;
	JN_TRY(create_parts(sim));
	JnSpace* space = sys->space;
	space->ops->combine(space, sim->start.x, 1, &(JnTerm){1, x});
	space->ops->combine(space, sim->start.v, 1, &(JnTerm){1, v});
	sys->ops->prescribe(sys, &sim->start, NULL);
	jn_state_touch(space, &sim->start);
	JN_TRY(jn_state_check(space, &sim->start) == JN_OK
			   ? JN_OK
			   : jn_error(JN_BAD_INPUT, "a start position or velocity is not finite"));
	return begin_first_step(sim);
}

static JnSim* allocate(int threads) {
	JnSim* sim = calloc(1, sizeof *sim);
	if (sim == NULL)
		jn_error(JN_OUT_OF_MEMORY, "out of memory: simulation");
	else
		sim->threads = threads > 0 ? threads : jn_threads_available();
	return sim;
}

static JnStatus deliver(JnSim* sim, JnStatus status, JnSim** out) {
	if (status == JN_OK)
		*out = sim;
	else
		jn_sim_destroy(sim);
	return status;
}

JnStatus jn_sim_create(const JnSimDef* def, int threads, JnSim** out) {
	*out = NULL;
	JnSim* sim = allocate(threads);
	return sim != NULL ? deliver(sim, create_with_model(sim, def), out) : JN_OUT_OF_MEMORY;
}

JnStatus jn_sim_create_for(JnSystem* sys, const char* settings, const double* x, const double* v, JnSim** out) {
	*out = NULL;
	JnSim* sim = allocate(1);
	return sim != NULL ? deliver(sim, create_for_system(sim, sys, settings, x, v), out) : JN_OUT_OF_MEMORY;
}

void jn_sim_destroy(JnSim* sim) {
	if (sim == NULL) return;
	jn_passes_destroy(&sim->passes);
	jn_controller_destroy(sim->controller);
	jn_integrator_destroy(sim->integrator);
	if (sim->sys != NULL) {
		jn_state_destroy(sim->sys->space, &sim->start);
		jn_state_destroy(sim->sys->space, &sim->end);
	}
	jn_model_destroy(sim->model);
	jn_arena_free(&sim->arena);
	free(sim);
}

static void add_report(JnReport* sum, const JnReport* one) {
	sum->newton += one->newton;
	sum->forces += one->forces;
	sum->tangents += one->tangents;
	sum->factorizations += one->factorizations;
	sum->solves += one->solves;
	sum->indefinite += one->indefinite;
	sum->backtracks += one->backtracks;
	sum->minimized += one->minimized;
	sum->residual = one->residual;
	sum->seconds_predict += one->seconds_predict;
}

// The last step ends on the duration; a difference that is only rounding leaves the step as it is.
static double clip(const JnSim* sim, double dt) {
	const double left = sim->def->duration - sim->start.t;
	return left < dt * (1 - 1e-9) ? left : dt;
}

static JnStatus explain_failure(const JnSim* sim, const JnStep* step, JnStatus outcome) {
	char reason[256];
	jn_passes_explain(&sim->passes, sizeof reason, reason);
	return jn_error(
		JN_RUN_FAILED,
		"step %ld at t = %.9g s failed: %s%s with dt = %.3g s, the smallest step allowed; the last good state "
		"is at t = %.9g s. Try a smaller step.dt, a more robust method (backward_euler), or more step.cuts",
		sim->steps + 1, sim->start.t, jn_status_name(outcome), reason, step->dt, sim->start.t);
}

// Predict and correct, in as many rounds as the passes ask for. *edited: the end is no longer the integrator's.
static JnStatus attempt(JnSim* sim, JnStep* step, bool* edited) {
	bool again = true;
	*edited = false;
	for (int round = 0; again; ++round) {
		step->report = (JnReport){0};
		JN_TRY(jn_passes_prepare(&sim->passes, step, round));
		const double began = jn_seconds();
		const JnStatus outcome = sim->integrator->type->step(sim->integrator, step);
		step->report.seconds_predict = jn_seconds() - began;
		sim->sys->report = &sim->report;
		add_report(&sim->report, &step->report);
		if (outcome != JN_OK) return outcome;
		JN_TRY(jn_passes_correct(&sim->passes, step, round, edited, &again));
	}
	return JN_OK;
}

// History that a method kept of an end that was edited is history of another state.
static void accept(JnSim* sim, const JnStep* step, bool edited) {
	if (edited)
		jn_integrator_reset(sim->integrator);
	else if (sim->integrator->type->commit != NULL)
		sim->integrator->type->commit(sim->integrator, step);
	jn_passes_commit(&sim->passes, step);
	sim->last_dt = step->dt;
}

JnStatus jn_sim_step(JnSim* sim) {
	sim->report = (JnReport){0};
	sim->sys->report = &sim->report;
	JnVerdict verdict = {0};
	while (!verdict.accepted) {
		bool edited;
		JnStep step = {.sys = sim->sys, .start = &sim->start, .end = &sim->end, .dt = clip(sim, sim->next_dt)};
		step.method = sim->integrator->type;
		const JnStatus outcome = attempt(sim, &step, &edited);
		if (outcome < JN_OK) return outcome;
		if (sim->controller->type->judge(sim->controller, &step, outcome, &verdict) != JN_OK)
			return explain_failure(sim, &step, outcome);
		if (verdict.accepted) {
			accept(sim, &step, edited);
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
	return sim->sys->ops->begin(sim->sys, &sim->start);
}

bool jn_sim_is_done(const JnSim* sim) {
	return sim->def->duration - sim->start.t <= 1e-9 * sim->next_dt;
}

JnModel* jn_sim_model(JnSim* sim) {
	return sim->model;
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
