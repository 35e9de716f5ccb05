// Building a simulation, and taking it apart.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/space.h"
#include "model/model.h"
#include "model/system.h"
#include "model/system_list.h"
#include "sim/sim_keys.h"
#include "sim/simulation.h"

// Everything but the system and its first state.
static JnStatus create_parts(JnSim* sim) {
	const JnSimDef* def = sim->def;
	JN_TRY(jn_integrator_accepts((const JnIntegratorType*)def->integrator.row, sim->sys));
	JN_TRY(jn_state_create(sim->sys->space, &sim->start));
	JN_TRY(jn_state_create(sim->sys->space, &sim->end));
	sim->integrator = jn_integrator_create(&def->integrator, &def->newton, sim->sys->space);
	if (sim->integrator == NULL) return JN_OUT_OF_MEMORY;
	JN_TRY(jn_controller_create(&def->step, "step", sim->integrator, sim->sys, &sim->controller));
	sim->stop = INFINITY;
	sim->next_dt = sim->controller->type->first(sim->controller);
	return jn_watch_create(sim);
}

static JnStatus begin_first_step(JnSim* sim) {
	sim->sys->report = &sim->report;
	const JnStatus status = sim->sys->ops->begin(sim->sys, &sim->start);
	if (status <= JN_OK) return status;
	return jn_error(JN_BAD_INPUT, "the forces at the start cannot be evaluated: %s; start from another state",
					jn_status_name(status));
}

// What a simulation of a model has beside it.
static JnStatus create_for_model(JnSim* sim) {
	sim->sys = jn_model_system(sim->model);
	JN_TRY(create_parts(sim));
	JN_TRY(jn_passes_create(sim->def, sim->model, &sim->passes));
	if (sim->model->input_count > 0 && (sim->work[0] = sim->sys->space->ops->create(sim->sys->space)) == NULL)
		return JN_OUT_OF_MEMORY;
	return JN_OK;
}

static JnStatus create_with_model(JnSim* sim, const JnSimDef* def) {
	sim->def = def;
	JN_TRY(jn_model_create(&def->model, sim->threads, &sim->model));
	JN_TRY(create_for_model(sim));
	jn_model_start(sim->model, 0, &sim->start);
	return begin_first_step(sim);
}

// What acts on bodies has nothing to act on in a system of equations.
static JnStatus check_system(const JnSimDef* def) {
	const char* extra = def->model.bodies.count > 0      ? "bodies"
						: def->model.obstacles.count > 0 ? "obstacles"
						: def->model.wind != NULL        ? "wind"
						: def->contact != NULL           ? "contact"
						: def->collision != NULL         ? "collision"
						: def->suture != NULL            ? "suture"
						: def->relax != NULL             ? "relax"
														 : NULL;
	if (extra == NULL) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: stand%s beside 'system: %s', which is simulated alone; take one of them out",
					extra, extra[strlen(extra) - 1] == 's' ? "" : "s", def->system.row->name);
}

static JnStatus create_for_built_in(JnSim* sim) {
	JnSpace* space = sim->sys->space;
	for (int i = 0; i < 2; ++i)
		if ((sim->work[i] = space->ops->create(space)) == NULL) return JN_OUT_OF_MEMORY;
	return create_parts(sim);
}

static JnStatus create_with_built_in(JnSim* sim, const JnSimDef* def) {
	const JnSystemType* type = (const JnSystemType*)def->system.row;
	sim->def = def;
	JN_TRY(check_system(def));
	JN_TRY(type->create(def->system.options, &sim->built_in));
	sim->sys = sim->built_in;
	JN_TRY(create_for_built_in(sim));
	type->start(def->system.options, sim->start.x, sim->start.v);
	jn_state_touch(sim->sys->space, &sim->start);
	return begin_first_step(sim);
}

static JnStatus create_from(JnSim* sim, const JnSimDef* def) {
	if (def->system.row != NULL) return create_with_built_in(sim, def);
	if (def->model.bodies.count > 0) return create_with_model(sim, def);
	return jn_error(JN_BAD_INPUT,
					"bodies: there are none, and no system in their place; give bodies, or a system such as "
					"'system: spring_1d'");
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
	return sim != NULL ? deliver(sim, create_from(sim, def), out) : JN_OUT_OF_MEMORY;
}

JnStatus jn_sim_create_for(JnSystem* sys, const char* settings, const double* x, const double* v, JnSim** out) {
	*out = NULL;
	JnSim* sim = allocate(1);
	return sim != NULL ? deliver(sim, create_for_system(sim, sys, settings, x, v), out) : JN_OUT_OF_MEMORY;
}

// All that steps the system, and all vectors of its space.
static void destroy_parts(JnSim* sim) {
	jn_passes_destroy(&sim->passes);
	jn_controller_destroy(sim->controller);
	jn_integrator_destroy(sim->integrator);
	sim->controller = NULL;
	sim->integrator = NULL;
	for (int i = 0; i < 2 && sim->work[i] != NULL; ++i) {
		sim->sys->space->ops->destroy(sim->sys->space, sim->work[i]);
		sim->work[i] = NULL;
	}
	if (sim->sys == NULL) return;
	jn_watch_destroy(sim);
	jn_state_destroy(sim->sys->space, &sim->start);
	jn_state_destroy(sim->sys->space, &sim->end);
}

void jn_sim_destroy(JnSim* sim) {
	if (sim == NULL) return;
	destroy_parts(sim);
	jn_model_destroy(sim->model);
	jn_user_system_destroy(sim->built_in);
	jn_arena_free(&sim->arena);
	free(sim);
}

// A system of the user's own stays: its stamps go on, so that nothing it knows is taken for what comes.
JnStatus jn_sim_renew(JnSim* sim) {
	destroy_parts(sim);
	if (sim->model == NULL) return sim->built_in != NULL ? create_for_built_in(sim) : create_parts(sim);
	sim->sys = NULL; // until there is one again
	JN_TRY(jn_model_system_renew(sim->model, &sim->def->model.solver));
	return create_for_model(sim);
}
