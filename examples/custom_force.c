// A force of your own on a jounce model: the beam of a scene file pulled towards a point by a magnet, without touching the
// library. The wrapper passes every verb on to the model and adds its force; K stays that of the model, which slows Newton
// a little and changes nothing else.
//
//   cc custom_force.c $(pkg-config --cflags --libs jounce) -o custom_force && ./custom_force scenes/beam.yaml
#include <stdio.h>

#include "jounce/extend.h"
#include "jounce/jounce.h"

typedef struct Magnet {
	JnSystem base;    // what the integrator sees
	JnSystem* model;  // what it wraps
	int node;         // the node that is pulled
	double at[3];     // towards this point [m]
	double stiffness; // [N/m]
} Magnet;

// The wrapper's public fields follow those of the model, and the model counts its work where the wrapper does.
static JnSystem* model_of(JnSystem* base) {
	JnSystem* model = ((Magnet*)base)->model;
	model->report = base->report;
	return model;
}

static JnStatus begin(JnSystem* base, const JnState* start) {
	JnSystem* model = model_of(base);
	const JnStatus status = model->ops->begin(model, start);
	base->force_scale = model->force_scale;
	return status;
}

static void prescribe(JnSystem* base, JnState* s, JnVec a) {
	model_of(base)->ops->prescribe(model_of(base), s, a);
}

static void hold(JnSystem* base, JnVec r) {
	model_of(base)->ops->hold(model_of(base), r);
}

static JnStatus force(JnSystem* base, const JnState* s, JnVec f) {
	const Magnet* magnet = (const Magnet*)base;
	const JnStatus status = model_of(base)->ops->force(model_of(base), s, f);
	for (int axis = 0; axis < 3; ++axis) {
		const int k = 3 * magnet->node + axis;
		f[k] += magnet->stiffness * (magnet->at[axis] - s->x[k]);
	}
	return status;
}

static double energy(JnSystem* base, const JnState* s) {
	const Magnet* magnet = (const Magnet*)base;
	double sum = model_of(base)->ops->energy(model_of(base), s);
	for (int axis = 0; axis < 3; ++axis) {
		const double d = magnet->at[axis] - s->x[3 * magnet->node + axis];
		sum += 0.5 * magnet->stiffness * d * d;
	}
	return sum;
}

static JnStatus linearize(JnSystem* base, const JnState* s) {
	return model_of(base)->ops->linearize(model_of(base), s);
}

static JnStatus matrix(JnSystem* base, JnShift shift, JnMatrix** out) {
	return model_of(base)->ops->matrix(model_of(base), shift, out);
}

static double stretch(JnSystem* base, const JnState* from, const JnState* to) {
	return model_of(base)->ops->stretch(model_of(base), from, to);
}

static JnStatus simulate(JnModel* model) {
	static const JnSystemOps ops = {begin, prescribe, hold, force, energy, linearize, matrix, stretch};
	const double middle[3] = {0.125, 0.125, 1};
	Magnet magnet = {.base = *jn_model_system(model),
					 .model = jn_model_system(model),
					 .node = jn_model_nearest(model, middle),
					 .at = {0.625, 0.125, 1},
					 .stiffness = 500};
	magnet.base.ops = &ops;
	JnSim* sim = NULL;
	JnState start;
	JnSpace* space = magnet.base.space;
	start = (JnState){.x = space->ops->create(space), .v = space->ops->create(space)};
	if (start.x == NULL || start.v == NULL) return JN_OUT_OF_MEMORY;
	jn_model_start(model, 0, &start);
	const char* settings = "{duration: 1 s, step: {dt: 5 ms}, integrator: {method: sdirk2}}";
	JnStatus status = jn_sim_create_for(&magnet.base, settings, start.x, start.v, &sim);
	while (status == JN_OK && !jn_sim_is_done(sim)) status = jn_sim_step(sim);
	if (status == JN_OK) {
		const double* x = jn_sim_state(sim)->x + 3 * magnet.node;
		printf("after 1 s the middle is at (%.4f, %.4f, %.4f) m\n", x[0], x[1], x[2]);
	}
	jn_sim_destroy(sim);
	space->ops->destroy(space, start.x);
	space->ops->destroy(space, start.v);
	return status;
}

int main(int count, char** arguments) {
	JnScene* scene = NULL;
	JnModel* model = NULL;
	if (count != 2) return fprintf(stderr, "usage: custom_force SCENE\n"), 2;
	JnStatus status = jn_scene_load(arguments[1], 0, NULL, &scene);
	if (status == JN_OK) status = jn_model_create(&jn_scene_def(scene)->sim.model, 1, &model);
	if (status == JN_OK) status = simulate(model);
	jn_model_destroy(model);
	jn_scene_destroy(scene);
	return status == JN_OK ? 0 : 1;
}
