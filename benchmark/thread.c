// Small explicit steps: a swinging thread of scenes/thread.yaml by symplectic Euler, at the start of a run, without
// recording. Rows "kernels" are the element forces alone, so that the rest of a step is what everything beside them costs.
// Rates: how many times faster than real time steps of 1 ms are; of rows named after a scene, its own steps are, some way into
// the run.
#include <stdlib.h>

#include "bench.h"
#include "model/model.h"

static const double real_step = 1e-3; // [s]

typedef struct Case {
	const char *name, *size, *links, *material;
	const char* kernels; ///< name of the row of these; NULL: not measured
	const char *collision, *obstacles;
} Case;

#define MATERIAL(text) "bodies[0].material={law: " text "}"
#define SPRINGS "constraints, density: 1000, stiffness: 100 kPa"
#define DAMPED SPRINGS ", damping: 1 us"
#define FULL SPRINGS ", volume: 50 kPa, collapse: 50 kPa, torsion: 1e-6"
#define FULL_DAMPED FULL ", damping: 1 us"
#define ROD "rod, density: 1000, young: 200 kPa"
#define COLLIDE "collision={friction: 0.3}"
#define BAR                                                                                                            \
	"obstacles=[{name: bar, shape: {type: capsule, from: [0.25, -0.0145, -1], to: [0.25, -0.0145, 1], radius: 1 cm}}]"
// with collisions: free, and hanging over a bar that some five frames touch
#define OF_SIZE(count)                                                                                                 \
	{"step", "links" count, "bodies[0].shape.links=" count, MATERIAL(SPRINGS), "kernels", NULL, NULL},                 \
		{"step_damped", "links" count, "bodies[0].shape.links=" count, MATERIAL(DAMPED), NULL, NULL, NULL},            \
		{"step_full", "links" count, "bodies[0].shape.links=" count, MATERIAL(FULL), "kernels_full", NULL, NULL},      \
		{"step_full_damped", "links" count, "bodies[0].shape.links=" count, MATERIAL(FULL_DAMPED), NULL, NULL, NULL},  \
		{"step_rod", "links" count, "bodies[0].shape.links=" count, MATERIAL(ROD), "kernels_rod", NULL, NULL},         \
		{"collide", "links" count, "bodies[0].shape.links=" count, MATERIAL(FULL), NULL, COLLIDE, NULL},               \
		{"collide_bar", "links" count, "bodies[0].shape.links=" count, MATERIAL(FULL), NULL, COLLIDE, BAR},

static const Case cases[] = {OF_SIZE("100") OF_SIZE("1000")};

/// A scene as it stands, after some steps.
typedef struct SceneCase {
	const char *name, *scene, *size;
	int steps;
	const char* sets[3]; ///< NULL behind the last
} SceneCase;

#define LONG_CURVE "bodies[0].shape.curve={type: polyline, points: [{at: [-5, 0, 0]}, {at: [5, 0, 0]}]}"
#define BAR_AT(x)                                                                                                      \
	"{name: bar" #x ", shape: {type: capsule, from: [" #x ".5, -0.1, -1], to: [" #x ".5, -0.1, 1], radius: 2 cm}}, "
#define TEN_BARS                                                                                                       \
	"obstacles=[" BAR_AT(-4) BAR_AT(-3) BAR_AT(-2) BAR_AT(-1) BAR_AT(-0) BAR_AT(0) BAR_AT(1) BAR_AT(2) BAR_AT(3)       \
		BAR_AT(4) "]"

static const SceneCase scenes[] = {
	{"thread_bar", "thread_bar", "links100", 1000, {NULL}}, // hangs, and rubs at the bar
	{"thread_bars",
	 "thread_bar",
	 "links1000",
	 1000,
	 {"bodies[0].shape.links=1000", LONG_CURVE, TEN_BARS}}, // ten times that
	{"coil", "coil", "links1000", 150, {NULL}},             // falls, some hundred contacts
	{"coil_heap", "coil", "links1000", 1500, {NULL}},       // lies, eleven hundred contacts
	{"knot", "knot", "links120", 40000, {NULL}},            // tight
	{"suture", "suture", "links104", 20000, {NULL}},        // half sewn
};

typedef struct Subject {
	JnSim* sim;
	JnStatus status;
	double* out; ///< element forces of the largest group
} Subject;

static void run_step(void* context) {
	Subject* subject = context;
	if (subject->status == JN_OK) subject->status = jn_sim_step(subject->sim);
}

static void run_kernels(void* context) {
	const Subject* subject = context;
	const JnModel* model = jn_sim_model(subject->sim);
	for (int g = 0; g < model->group_count; ++g) {
		const JnGroup* group = &model->groups[g];
		group->kernel->force(group, 0, group->batches, jn_sim_state(subject->sim)->x, subject->out);
	}
}

static void report(const Bench* bench, const char* size, const char* name, Timing seconds, double dt) {
	Row row = {.group = "thread", .name = name, .size = size, .threads = 1, .width = jn_kernel_best_width()};
	row.value = timing_in(seconds, 1e-6, 1);
	row.unit = "us/step";
	row.rate = dt / seconds.median;
	row.rate_unit = "x real time";
	bench_report(bench, &row);
}

static JnStatus allocate(Subject* subject) {
	const JnModel* model = jn_sim_model(subject->sim);
	size_t most = 0;
	for (int g = 0; g < model->group_count; ++g) {
		const JnKernel* kernel = model->groups[g].kernel;
		const size_t reals = (size_t)model->groups[g].batches * (size_t)(kernel->width * 3 * kernel->nodes);
		most = reals > most ? reals : most;
	}
	subject->out = calloc(most, sizeof *subject->out);
	return subject->out != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static JnStatus measure_subject(const Bench* bench, const Case* c, Subject* subject) {
	JN_TRY(allocate(subject));
	const Timing step = measure(run_step, subject, 1, 0.5, 9);
	JN_TRY(subject->status);
	report(bench, c->size, c->name, step, real_step);
	if (c->kernels != NULL && bench_wants(bench, "thread", c->kernels, c->size))
		report(bench, c->size, c->kernels, measure(run_kernels, subject, 1, 0.5, 9), real_step);
	return JN_OK;
}

static JnStatus measure_case(const Bench* bench, const Case* c) {
	char path[512];
	const char* const sets[] = {c->links,     c->material, "duration=1e8s", "step.dt=2e-6", // stable for all of them
								c->collision, c->obstacles};
	const int count = 4 + (c->collision != NULL) + (c->obstacles != NULL);
	JnScene* scene = NULL;
	Subject subject = {0};
	snprintf(path, sizeof path, "%s/scenes/thread.yaml", JN_SOURCE_DIR);
	JnStatus status = jn_scene_load(path, count, sets, &scene);
	if (status == JN_OK) status = jn_sim_create(&jn_scene_def(scene)->sim, 1, &subject.sim);
	if (status == JN_OK) status = measure_subject(bench, c, &subject);
	free(subject.out);
	jn_sim_destroy(subject.sim);
	jn_scene_destroy(scene);
	return status;
}

static JnStatus measure_scene(const Bench* bench, const SceneCase* c) {
	const char* sets[4] = {"duration=1e8s"};
	int count = 1;
	for (int i = 0; i < 3 && c->sets[i] != NULL; ++i) sets[count++] = c->sets[i];
	char path[512];
	JnScene* scene = NULL;
	Subject subject = {0};
	snprintf(path, sizeof path, "%s/scenes/%s.yaml", JN_SOURCE_DIR, c->scene);
	JnStatus status = jn_scene_load(path, count, sets, &scene);
	if (status == JN_OK) status = jn_sim_create(&jn_scene_def(scene)->sim, 1, &subject.sim);
	for (int i = 0; i < c->steps && status == JN_OK; ++i) status = jn_sim_step(subject.sim);
	if (status == JN_OK) {
		const Timing step = measure(run_step, &subject, 1, 0.5, 9);
		report(bench, c->size, c->name, step, jn_sim_last_dt(subject.sim));
		status = subject.status;
	}
	jn_sim_destroy(subject.sim);
	jn_scene_destroy(scene);
	return status;
}

JnStatus bench_threads(const Bench* bench) {
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
		if (bench_wants(bench, "thread", cases[i].name, cases[i].size)) JN_TRY(measure_case(bench, &cases[i]));
	for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i)
		if (bench_wants(bench, "thread", scenes[i].name, scenes[i].size)) JN_TRY(measure_scene(bench, &scenes[i]));
	return JN_OK;
}
