// How cost grows with the number of unknowns: blocks of n^3 hexahedra, bottom held, from 2,000 to 824,000 unknowns. A solve is
// of m M + k K with the weight as right-hand side, to 1e-4, for the stages of SDIRK2 with 5 ms and 33 ms and without mass.
// Steps are whole ones from rest, with the solver that chooses. Few samples: the large ones take seconds.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/space.h"
#include "bench.h"
#include "model/system.h"
#include "solve/cg_single.h"

typedef struct Size {
	const char* name;
	int steps;    ///< measured; 0: none
	bool direct;  ///< a factor fits
	bool slow;    ///< iterations of diagonal blocks without mass end in bearable time
	bool threads; ///< enough for several
} Size;

static const Size sizes[] = {
	{"block8", 20, true, true, false},   {"block16", 8, true, true, false},  {"block32", 2, true, true, true},
	{"block48", 0, false, false, false}, {"block64", 1, false, false, true},
};

typedef struct Problem {
	const char* name;
	double dt; ///< [s]; 0: no mass
} Problem;

static const double stage_part = 0.2928932188134525; // of the step of SDIRK2
static const Problem problems[] = {{"5ms", 5e-3}, {"33ms", 33e-3}, {"static", 0}};
static const double tolerance = 1e-4;
enum { MOST_ITERATIONS = 5000 };

typedef struct Subject {
	const Size* size;
	JnModel* model;
	JnModelSystem* sys;
	JnState state;
	JnReport report;
	JnVec in, out;
	JnOperator matrices;
	JnCgSingle cg;
	int slot;
	JnPrecondition* precondition;
	JnSolver* direct;
	JnStatus status;
	int iterations;
} Subject;

// ---- the work ----

static void force(void* context) {
	Subject* s = context;
	jn_assembly_force(s->sys->assembly, s->state.x, s->out);
}

static void product(void* context) {
	Subject* s = context;
	s->matrices.apply(s->matrices.user, s->slot, s->in, s->out);
}

static void product_single(void* context) {
	Subject* s = context;
	s->matrices.apply_single(s->matrices.user, s->slot, s->cg.r, s->cg.q);
}

static void assemble(void* context) {
	Subject* s = context;
	jn_assembly_tangent(s->sys->assembly, s->state.x, JN_EXACT, NULL, s->sys->stiffness);
}

static void renew(void* context) {
	Subject* s = context;
	s->status = s->precondition->type->update(s->precondition, s->slot, true);
}

static void solve(void* context) {
	Subject* s = context;
	s->cg.algebra->pack((size_t)s->model->node_count, 1, s->in, s->model->held, s->cg.r);
	s->iterations = 0;
	s->status =
		jn_cg_single_solve(&s->cg, &s->matrices, s->slot, s->precondition, tolerance, MOST_ITERATIONS, &s->iterations);
}

static void factor(void* context) {
	Subject* s = context;
	const double* blocks = s->matrices.blocks(s->matrices.user, s->slot);
	s->status = s->direct->type->factor(s->direct, 0, blocks);
}

static void solve_direct(void* context) {
	Subject* s = context;
	s->status = s->direct->type->solve(s->direct, 0, s->in, s->out);
}

// ---- rows ----

static bool wants(const Bench* bench, const Subject* s, const char* name) {
	return bench_wants(bench, "scaling", name, s->size->name);
}

static void report_time(const Bench* bench, const Subject* s, const char* name, Timing seconds) {
	const Row row = {.group = "scaling",
					 .name = name,
					 .size = s->size->name,
					 .threads = s->model->threads,
					 .width = jn_kernel_best_width(),
					 .value = timing_in(seconds, 1e-3, 1),
					 .unit = "ms",
					 .rate = 3e-6 * s->model->node_count / seconds.median,
					 .rate_unit = "Munknowns/s"};
	bench_report(bench, &row);
}

static void report_number(const Bench* bench, const Subject* s, const char* name, double number, const char* unit) {
	const Row row = {.group = "scaling",
					 .name = name,
					 .size = s->size->name,
					 .threads = s->model->threads,
					 .value = {number, number, number},
					 .unit = unit};
	bench_report(bench, &row);
}

static void measure_part(const Bench* bench, Subject* s, const char* name, void (*run)(void*)) {
	if (wants(bench, s, name)) report_time(bench, s, name, measure(run, s, s->model->threads, 0.1, 2));
}

static void measure_iterated(const Bench* bench, Subject* s, const JnPreconditionType* type, const Problem* problem) {
	char name[64];
	const bool is_block = type == &jn_precondition_block;
	snprintf(name, sizeof name, "solve.%s.%s", problem->name, type->name);
	if (!wants(bench, s, name) || (is_block && problem->dt == 0 && !s->size->slow)) return;
	s->status = type->create(&s->model->pattern, s->model->held, s->model->threads, &s->matrices, &s->precondition);
	if (s->status != JN_OK) return;
	const Timing set_up = measure(renew, s, s->model->threads, 0, 1);
	const Timing seconds = s->status == JN_OK ? measure(solve, s, s->model->threads, 0, 1) : (Timing){0};
	if (s->status == JN_OK) {
		report_time(bench, s, name, seconds);
		snprintf(name, sizeof name, "renew.%s.%s", problem->name, type->name);
		report_time(bench, s, name, set_up);
		snprintf(name, sizeof name, "iterations.%s.%s", problem->name, type->name);
		report_number(bench, s, name, s->iterations, "");
		snprintf(name, sizeof name, "memory.%s.%s", problem->name, type->name);
		report_number(bench, s, name, 1e-6 * (double)type->bytes(s->precondition), "MB");
	}
	type->destroy(s->precondition);
}

static JnStatus measure_direct(const Bench* bench, Subject* s, const Problem* problem) {
	static const JnDirectDef options = {0};
	char name[64];
	snprintf(name, sizeof name, "solve.%s.direct", problem->name);
	if (!s->size->direct || s->model->threads > 1 || problem->dt == 0 || !wants(bench, s, name)) return JN_OK;
	JN_TRY(jn_solver_direct.create(&options, &s->model->pattern, s->model->held, 1, &s->direct));
	const Timing seconds = measure(factor, s, 1, 0, 1);
	report_time(bench, s, name, measure(solve_direct, s, 1, 0, 1));
	snprintf(name, sizeof name, "renew.%s.direct", problem->name);
	report_time(bench, s, name, seconds);
	snprintf(name, sizeof name, "memory.%s.direct", problem->name);
	report_number(bench, s, name, 1e-6 * (double)jn_solver_direct.cost(s->direct).bytes, "MB");
	jn_solver_direct.destroy(s->direct);
	return s->status;
}

static JnStatus measure_problem(const Bench* bench, Subject* s, const Problem* problem) {
	const double h = stage_part * problem->dt;
	const JnShift shift = {.mass = h > 0, .stiffness = h > 0 ? h * h : 1};
	JnMatrix* matrix = NULL;
	JN_TRY(s->sys->base.ops->matrix(&s->sys->base, shift, &matrix));
	s->slot = ((JnModelMatrix*)matrix)->slot;
	if (problem == problems) {
		measure_part(bench, s, "product", product);
		measure_part(bench, s, "product.single", product_single);
	}
	measure_iterated(bench, s, &jn_precondition_block, problem);
	measure_iterated(bench, s, &jn_precondition_multigrid, problem);
	JN_TRY(s->status);
	return measure_direct(bench, s, problem);
}

// ---- a block ----

// The weight, of norm 1, as right-hand side.
static JnStatus prepare(Subject* s) {
	JnSpace* space = s->sys->base.space;
	JN_TRY(jn_state_create(space, &s->state));
	s->in = space->ops->create(space);
	s->out = space->ops->create(space);
	if (s->in == NULL || s->out == NULL) return JN_OUT_OF_MEMORY;
	JN_TRY(jn_cg_single_create(&s->cg, &s->model->pattern, s->model->held, s->model->threads));
	jn_model_start(s->model, 0, &s->state);
	for (size_t k = 1; k < space->length; k += 3) s->in[k] = s->model->held[k] ? 0 : s->model->nodal_mass[k / 3];
	const double norm = sqrt(space->ops->dot(space, s->in, s->in));
	for (size_t k = 1; k < space->length; k += 3) s->in[k] /= norm;
	s->sys->base.report = &s->report;
	s->matrices = jn_model_matrix_operator(s->sys);
	return s->sys->base.ops->linearize(&s->sys->base, &s->state);
}

static JnStatus measure_parts(const Bench* bench, Subject* s) {
	JN_TRY(prepare(s));
	measure_part(bench, s, "force", force);
	measure_part(bench, s, "tangent", assemble);
	for (size_t i = 0; i < sizeof problems / sizeof *problems; ++i) JN_TRY(measure_problem(bench, s, &problems[i]));
	return JN_OK;
}

static JnStatus measure_block(const Bench* bench, const Size* size, int threads) {
	const SceneOf of = scene_of(size->name);
	const char* const sets[] = {"solver.method=cg", of.cells};
	JnScene* scene = NULL;
	Subject s = {.size = size};
	JN_TRY(jn_scene_load(of.path, 2, sets, &scene));
	JnStatus status = jn_model_create(&jn_scene_def(scene)->sim.model, threads, &s.model);
	if (status == JN_OK) {
		s.sys = (JnModelSystem*)jn_model_system(s.model);
		status = measure_parts(bench, &s);
		JnSpace* space = s.sys->base.space;
		jn_cg_single_destroy(&s.cg);
		jn_state_destroy(space, &s.state);
		space->ops->destroy(space, s.in);
		space->ops->destroy(space, s.out);
	}
	jn_model_destroy(s.model);
	jn_scene_destroy(scene);
	return status;
}

// A model is dear to make: none where no row of it is wanted.
static bool wants_any(const Bench* bench, const char* size) {
	static const char* const names[] = {"force",
										"tangent",
										"product",
										"product.single",
										"solve.5ms.block",
										"solve.33ms.block",
										"solve.static.block",
										"solve.5ms.multigrid",
										"solve.33ms.multigrid",
										"solve.static.multigrid",
										"solve.5ms.direct",
										"solve.33ms.direct"};
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
		if (bench_wants(bench, "scaling", names[i], size)) return true;
	return false;
}

static JnStatus measure_size(const Bench* bench, const Size* size, int threads) {
	if (wants_any(bench, size->name)) JN_TRY(measure_block(bench, size, threads));
	return size->steps > 0 ? bench_scaling_steps(bench, size->name, size->steps, threads) : JN_OK;
}

JnStatus bench_scaling(const Bench* bench) {
	for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
		JN_TRY(measure_size(bench, &sizes[i], 1));
		if (bench->threads > 1 && sizes[i].threads) JN_TRY(measure_size(bench, &sizes[i], bench->threads));
	}
	return JN_OK;
}
