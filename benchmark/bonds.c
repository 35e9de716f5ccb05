// Peridynamic plates: what force, energy, product and diagonal cost a bond, and conjugate gradients an iteration.
#include <math.h>
#include <string.h>

#include "base/space.h"
#include "bench.h"
#include "model/system.h"

typedef struct Plate {
	const char* size;
	const char* counts;
} Plate;

static const Plate plates[] = {{"points50k", "bodies[0].shape.counts=[112,112,4]"},
							   {"points500k", "bodies[0].shape.counts=[354,354,4]"}};

typedef struct Subject {
	JnModel* model;
	JnModelSystem* sys;
	JnState state;
	JnReport report;
	JnVec in, out;
	JnMatrix* matrix;
} Subject;

static void energy(void* context) {
	Subject* s = context;
	s->out[0] = jn_assembly_energy(s->sys->assembly, s->state.x);
}

static void force(void* context) {
	Subject* s = context;
	memset(s->out, 0, s->sys->base.space->length * sizeof *s->out);
	jn_assembly_force(s->sys->assembly, s->state.x, s->out);
}

static void product(void* context) {
	Subject* s = context;
	memset(s->out, 0, s->sys->base.space->length * sizeof *s->out);
	jn_assembly_product(s->sys->assembly, (JnTangentAt){.x = s->state.x}, 1, s->in, s->out);
}

static void diagonal(void* context) {
	Subject* s = context;
	jn_assembly_tangent(s->sys->assembly, s->state.x, JN_EXACT, NULL, s->sys->stiffness);
}

static void solve(void* context) {
	Subject* s = context;
	s->report.iterations = 0;
	if (s->matrix->ops->solve(s->matrix, s->in, s->out) != JN_OK) s->report.iterations = -1;
}

static const struct {
	const char* name;
	void (*run)(void*);
} rows[] = {{"energy", energy}, {"force", force}, {"product", product}, {"diagonal", diagonal}, {"iteration", solve}};
enum { ROWS = sizeof rows / sizeof *rows };

// Bytes of a bond that every verb reads: two node numbers and its rest data.
static double bytes_of(const JnGroup* group) {
	return 2.0 * sizeof(int) + 8.0 * group->kernel->rest_reals;
}

static void report_row(const Bench* bench, Subject* s, const char* size, int which) {
	const JnGroup* group = &s->model->groups[0];
	if (!bench_wants(bench, "bond", rows[which].name, size)) return;
	const Timing seconds = measure(rows[which].run, s, s->model->threads, 0.5, 3);
	const double calls = rows[which].run == solve ? s->report.iterations : 1;
	const double bytes = bytes_of(group) * group->count;
	Row row = {.group = "bond", .name = rows[which].name, .size = size, .threads = s->model->threads};
	row.width = group->kernel->width;
	row.unit = "ns/bond";
	row.value = timing_in(seconds, 1e-9, calls * group->count);
	row_set_bytes(bench, &row, seconds.median / calls, bytes, bytes);
	bench_report(bench, &row);
}

static JnStatus prepare(Subject* s) {
	JnSpace* space = s->sys->base.space;
	JnSystem* sys = &s->sys->base;
	JN_TRY(jn_state_create(space, &s->state));
	s->in = space->ops->create(space);
	s->out = space->ops->create(space);
	if (s->in == NULL || s->out == NULL) return JN_OUT_OF_MEMORY;
	jn_model_start(s->model, 0, &s->state);
	for (size_t k = 0; k < space->length; ++k) {
		s->in[k] = sin(0.37 * (double)k);
		s->state.x[k] += 1e-6 * sin(0.11 * (double)k);
	}
	jn_state_touch(space, &s->state);
	sys->report = &s->report;
	JN_TRY(sys->ops->linearize(sys, &s->state));
	return sys->ops->matrix(sys, (JnShift){.mass = 1, .stiffness = 1e-12}, &s->matrix);
}

static JnStatus measure_plate(const Bench* bench, const Plate* plate, int threads) {
	char path[512];
	JnScene* scene = NULL;
	Subject s = {0};
	snprintf(path, sizeof path, "%s/benchmark/scenes/points.yaml", JN_SOURCE_DIR);
	JN_TRY(jn_scene_load(path, 1, (const char* const[]){plate->counts}, &scene));
	JnStatus status = jn_model_create(&jn_scene_def(scene)->sim.model, threads, &s.model);
	if (status == JN_OK) {
		s.sys = (JnModelSystem*)jn_model_system(s.model);
		status = prepare(&s);
		for (int i = 0; i < ROWS && status == JN_OK; ++i) report_row(bench, &s, plate->size, i);
		JnSpace* space = s.sys->base.space;
		jn_state_destroy(space, &s.state);
		space->ops->destroy(space, s.in);
		space->ops->destroy(space, s.out);
	}
	jn_model_destroy(s.model);
	jn_scene_destroy(scene);
	return status;
}

JnStatus bench_bonds(const Bench* bench) {
	for (size_t p = 0; p < sizeof plates / sizeof *plates; ++p) {
		bool is_wanted = false;
		for (int i = 0; i < ROWS; ++i) is_wanted |= bench_wants(bench, "bond", rows[i].name, plates[p].size);
		if (!is_wanted) continue;
		JN_TRY(measure_plate(bench, &plates[p], 1));
		if (bench->threads > 1) JN_TRY(measure_plate(bench, &plates[p], bench->threads));
	}
	return JN_OK;
}
