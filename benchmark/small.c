// Steps of the smallest models, in microseconds: four hexahedra in a row, and a pendulum. What their forces alone take, evaluated as
// often as a step does, is the fraction of `arithmetic`; the rest is solving and bookkeeping.
#include <stdlib.h>

#include "bench.h"

#define BAR "bodies[0].shape.cells=[1,1,4]", "bodies[0].mass=lumped"

typedef struct Case {
	const char *size, *scene, *method, *dt;
	const char* sets[3]; ///< NULL behind the last
} Case;

static const Case cases[] = {
	{"hexes4", "beam", "verlet", "1ms", {BAR}},         {"hexes4", "beam", "sdirk2", "5ms", {BAR}},
	{"hexes4", "beam", "backward_euler", "5ms", {BAR}}, {"one", "pendulum", "verlet", "1ms", {NULL}},
	{"one", "pendulum", "sdirk2", "5ms", {NULL}},
};

enum { STEPS = 100, MOST_SETS = 8 }; // a sample

typedef struct Subject {
	JnSim* sim;
	JnVec f;
	JnState state; ///< with which forces are asked for
	JnStatus status;
	double forces; ///< of a step
} Subject;

static void take_steps(void* context) {
	Subject* s = context;
	int forces = 0;
	for (int i = 0; i < STEPS && s->status == JN_OK; ++i) {
		s->status = jn_sim_step(s->sim);
		forces += jn_sim_last_report(s->sim)->forces;
	}
	s->forces = (double)forces / STEPS;
}

static void evaluate_forces(void* context) {
	Subject* s = context;
	JnSystem* sys = jn_sim_system(s->sim);
	for (int i = 0; i < STEPS && s->status == JN_OK; ++i) {
		jn_state_touch(sys->space, &s->state);
		s->status = sys->ops->force(sys, &s->state, s->f);
	}
}

static void report(const Bench* bench, const Case* c, const Subject* s, Timing steps, Timing forces) {
	char name[80];
	snprintf(name, sizeof name, "%s.%s", c->method, c->dt);
	Row row = {.group = "small", .name = name, .size = c->size, .threads = 1, .width = jn_kernel_best_width()};
	row.value = timing_in(steps, 1e-6, STEPS);
	row.unit = "us/step";
	if (s->forces > 0) {
		row.fraction_of = "arithmetic";
		row.fraction = s->forces * forces.median / steps.median;
	}
	bench_report(bench, &row);
}

static JnStatus measure_subject(const Bench* bench, const Case* c, Subject* s) {
	JnSpace* space = jn_sim_system(s->sim)->space;
	s->f = space->ops->create(space);
	if (s->f == NULL) return JN_OUT_OF_MEMORY;
	const Timing steps = measure(take_steps, s, 1, 0.3, 5);
	s->state = *jn_sim_state(s->sim);
	const Timing forces = measure(evaluate_forces, s, 1, 0.1, 5);
	if (s->status == JN_OK) report(bench, c, s, steps, forces);
	space->ops->destroy(space, s->f);
	return s->status;
}

static JnStatus measure_case(const Bench* bench, const Case* c) {
	char method[80], dt[40];
	const SceneOf of = scene_of(c->scene);
	snprintf(method, sizeof method, "integrator.method=%s", c->method);
	snprintf(dt, sizeof dt, "step.dt=%s", c->dt);
	const char* sets[MOST_SETS] = {method, dt, "duration=100000s"};
	int set_count = 3;
	for (int i = 0; c->sets[i] != NULL; ++i) sets[set_count++] = c->sets[i];
	JnScene* scene = NULL;
	JN_TRY(jn_scene_load(of.path, set_count, sets, &scene));
	Subject subject = {0};
	JnStatus status = jn_sim_create(&jn_scene_def(scene)->sim, 1, &subject.sim);
	if (status == JN_OK) status = measure_subject(bench, c, &subject);
	jn_sim_destroy(subject.sim);
	jn_scene_destroy(scene);
	return status;
}

JnStatus bench_small(const Bench* bench) {
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		char name[80];
		snprintf(name, sizeof name, "%s.%s", cases[i].method, cases[i].dt);
		if (bench_wants(bench, "small", name, cases[i].size)) JN_TRY(measure_case(bench, &cases[i]));
	}
	return JN_OK;
}
