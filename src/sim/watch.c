// The work of a step, from its start (t0, x0, v0) to its end (t1, x1, v1), on held nodes is that of their reactions R, on
// all nodes that of the wind's forces w:
//   W = sum over held of (M (v1 - v0)) . (v0 + v1) / 2  -  (f0 + f1) / 2 . (x1 - x0)  +  sum over all of (w0 + w1) / 2 . (x1 - x0)
// f are all forces on the nodes but R, those of contact among them. Its first part is exact for the kinetic energy also where
// velocities jump; the error of the others is of third order in the step.
#include "sim/watch.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "base/space.h"
#include "model/examine.h"
#include "model/system.h"
#include "model/wind.h"
#include "sim/diagnose.h"
#include "sim/simulation.h"

static bool is_driven(const JnModel* model) {
	bool is_moved = model->guide_count > 0 || model->input_count > 0;
	for (int i = 0; i < model->held_count; ++i) is_moved |= model->held_list[i].motion != NULL;
	return is_moved;
}

// The weight over a thousandth of the model's size, and the energy of a strain of 1e-4.
static double least_energy(const JnSim* sim) {
	const JnModel* model = sim->model;
	if (model == NULL) return 0;
	double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (int k = 0; k < 3 * model->node_count; ++k) {
		low[k % 3] = fmin(low[k % 3], model->rest[k]);
		high[k % 3] = fmax(high[k % 3], model->rest[k]);
	}
	const double size = sqrt(pow(high[0] - low[0], 2) + pow(high[1] - low[1], 2) + pow(high[2] - low[2], 2));
	const double* g = model->gravity;
	const double weight = model->total_mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
	const double unit_strain = sim->sys->force_floor / DBL_EPSILON;
	return 1e-3 * weight * size + 0.5e-8 * unit_strain * size / sqrt(3.0 * model->node_count);
}

JnStatus jn_watch_create(JnSim* sim) {
	JnEnergyWatch* watch = &sim->watch;
	const JnModel* model = sim->model;
	watch->floor = least_energy(sim);
	if (sim->def->watch.energy == 0 || model == NULL || (!is_driven(model) && model->wind == NULL)) return JN_OK;
	for (int i = 0; i < JN_WATCH_VECTORS; ++i)
		if ((watch->vectors[i] = sim->sys->space->ops->create(sim->sys->space)) == NULL) return JN_OUT_OF_MEMORY;
	return JN_OK;
}

void jn_watch_destroy(JnSim* sim) {
	JnEnergyWatch* watch = &sim->watch;
	for (int i = 0; i < JN_WATCH_VECTORS; ++i) {
		if (watch->vectors[i] != NULL) sim->sys->space->ops->destroy(sim->sys->space, watch->vectors[i]);
		watch->vectors[i] = NULL;
	}
	watch->has_forces = false;
}

void jn_watch_archive(JnSim* sim, JnArchive* archive) {
	JnEnergyWatch* watch = &sim->watch;
	double* const places[] = {&watch->lowest, &watch->largest, &watch->work,
							  &watch->passed, &watch->t,       &sim->longest_dt};
	jn_archive_switch(archive, "watch", &watch->has_begun);
	jn_archive_switch(archive, "warned", &watch->has_warned);
	for (size_t i = 0; i < sizeof places / sizeof *places; ++i) jn_archive_real(archive, "watch", places[i]);
}

static void exchange(JnVec* vectors, int i, int j) {
	JnVec swap = vectors[i];
	vectors[i] = vectors[j];
	vectors[j] = swap;
}

// Forces and wind at a state. What they cost is not the integrator's.
static JnStatus find_forces(JnSim* sim, const JnState* state) {
	JnVec* vectors = sim->watch.vectors;
	JnReport aside = {0}, *report = sim->sys->report;
	sim->sys->report = &aside;
	const JnStatus status = sim->sys->ops->force(sim->sys, state, vectors[JN_WATCH_FORCE]);
	sim->sys->report = report;
	if (status != JN_OK) return status;
	jn_passes_react(&sim->passes, vectors[JN_WATCH_FORCE]);
	if (sim->model->wind == NULL) return JN_OK;
	memset(vectors[JN_WATCH_WIND], 0, sim->sys->space->length * sizeof(double));
	jn_wind_force(sim->model->wind, state, vectors[JN_WATCH_WIND]);
	return JN_OK;
}

static double work_on_held(const JnSim* sim) {
	const JnVec* vectors = sim->watch.vectors;
	const JnState *from = &sim->end, *to = &sim->start;
	JnVec change = vectors[JN_WATCH_WORK], momentum = vectors[JN_WATCH_FORCE_BEFORE]; // the latter is done with here
	JnMatrix* mass = NULL;
	double work = 0;
	for (int i = 0; i < sim->model->held_count; ++i) {
		const int k = sim->model->held_list[i].entry;
		work -= 0.5 * (vectors[JN_WATCH_FORCE_BEFORE][k] + vectors[JN_WATCH_FORCE][k]) * (to->x[k] - from->x[k]);
	}
	sim->sys->space->ops->combine(sim->sys->space, change, 2, (JnTerm[]){{1, to->v}, {-1, from->v}});
	sim->sys->ops->matrix(sim->sys, (JnShift){.mass = 1}, &mass);
	mass->ops->apply(mass, change, momentum);
	for (int i = 0; i < sim->model->held_count; ++i) {
		const int k = sim->model->held_list[i].entry;
		work += 0.5 * momentum[k] * (to->v[k] + from->v[k]);
	}
	return work;
}

static double work_of_wind(const JnSim* sim) {
	JnSpace* space = sim->sys->space;
	const JnVec* vectors = sim->watch.vectors;
	JnVec moved = vectors[JN_WATCH_WORK];
	space->ops->combine(space, moved, 2, (JnTerm[]){{0.5, sim->start.x}, {-0.5, sim->end.x}});
	return space->ops->dot(space, moved, vectors[JN_WATCH_WIND]) +
		   space->ops->dot(space, moved, vectors[JN_WATCH_WIND_BEFORE]);
}

static JnStatus add_work(JnSim* sim) {
	JnEnergyWatch* watch = &sim->watch;
	if (watch->vectors[0] == NULL) return JN_OK;
	if (watch->has_begun && !watch->has_forces) JN_TRY(find_forces(sim, &sim->end)); // the simulation has been renewed
	exchange(watch->vectors, JN_WATCH_FORCE, JN_WATCH_FORCE_BEFORE);
	exchange(watch->vectors, JN_WATCH_WIND, JN_WATCH_WIND_BEFORE);
	JN_TRY(find_forces(sim, &sim->start));
	watch->has_forces = true;
	if (!watch->has_begun) return JN_OK;
	const double work = (sim->model->wind != NULL ? work_of_wind(sim) : 0) + work_on_held(sim);
	watch->work += work;
	watch->passed += fabs(work);
	return JN_OK;
}

// The body whose kinetic and elastic energy has grown most in the last step; -1: the system is no model.
static int gainer(const JnSim* sim, double* most) {
	int body = -1;
	for (int b = 0; sim->model != NULL && b < sim->model->body_count; ++b) {
		const double gain =
			jn_model_body_energy(sim->model, b, &sim->start) - jn_model_body_energy(sim->model, b, &sim->end);
		if (body < 0 || !(gain <= *most)) *most = gain, body = b;
	}
	return body;
}

static void tell(JnSim* sim, double before, bool is_fatal) {
	JnFailure f = {.sim = sim};
	char who[160] = "", message[1800];
	double most = 0;
	const int body = gainer(sim, &most);
	if (body >= 0)
		snprintf(who, sizeof who, ", most in '%.80s' (%.3g J in this step)", sim->model->bodies[body].name, most);
	if (!jn_sim_find_instability(sim, sim->last_dt, &f))
		snprintf(
			f.remedy, sizeof f.remedy,
			"a smaller %s.dt, a method that loses energy (integrator.method: backward_euler), or a larger watch.%s if "
			"something gives energy on purpose",
			sim->controller->path, is_fatal ? "stop" : "energy");
	snprintf(
		message, sizeof message,
		"step %ld at t = %.9g s%s: the run has gained %.3g J from nowhere, %.3g times the largest kinetic and elastic "
		"energy before, %.3g J%s%s%s%s%s. Try %s",
		sim->steps, sim->end.t, is_fatal ? " failed" : "", sim->watch.gain, sim->watch.gain / before, before, who,
		f.cause[0] != '\0' ? "; " : "", f.cause, f.place[0] != '\0' ? ", at " : "", f.place, f.remedy);
	if (is_fatal)
		jn_error(JN_RUN_FAILED, "%s", message);
	else
		jn_warn("%s", message);
}

JnStatus jn_sim_watch(JnSim* sim, const JnEnergies* energies) {
	JnEnergyWatch* watch = &sim->watch;
	const JnWatchDef* def = &sim->def->watch;
	if (def->energy == 0 || (sim->model == NULL && sim->sys->depends_on_time)) return JN_OK;
	if (watch->has_begun && watch->t == sim->start.t) return JN_OK; // again, after a break
	watch->t = sim->start.t;
	const JnStatus status = add_work(sim);
	if (status < JN_OK) return status;
	const double inside = energies->kinetic + energies->elastic, own = inside + energies->gravity - watch->work;
	if (!watch->has_begun || own < watch->lowest) watch->lowest = own;
	watch->has_begun = true;
	watch->gain = own - watch->lowest;
	const double before = fmax(fmax(watch->largest, watch->floor), watch->passed);
	if (!isfinite(own)) return jn_sim_fail_at_end(sim, "it leaves no finite energy", JN_NOT_FINITE);
	if (watch->gain <= def->energy * fmax(before, inside)) {
		watch->largest = fmax(watch->largest, inside);
		return JN_OK;
	}
	const bool is_fatal = !(watch->gain <= def->stop * before);
	if (is_fatal || !watch->has_warned) tell(sim, before, is_fatal);
	watch->has_warned = true;
	return is_fatal ? JN_RUN_FAILED : JN_OK;
}

const JnKey jn_watch_keys[] = {
	{.name = "energy",
	 .kind = JN_REAL,
	 .field = offsetof(JnWatchDef, energy),
	 .value = {0.1},
	 .low = 0,
	 .high = 1e9,
	 .meaning =
		 "share of the largest kinetic and elastic energy that a run may gain from nowhere before it warns; 0: no "
		 "watch"},
	{.name = "stop",
	 .kind = JN_REAL,
	 .field = offsetof(JnWatchDef, stop),
	 .value = {100},
	 .low = 1,
	 .high = 1e300,
	 .meaning = "multiple of that energy whose gain ends the run"},
	{0},
};
