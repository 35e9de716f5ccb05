// Whole models: assembly, products with M and K, factorisation and solve of M + (gamma dt)^2 K.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/space.h"
#include "bench.h"
#include "model/system.h"

static const char* const sizes[] = {"beam", "cloth", "block16", "block32", "block64"};

// Sizes that are measured without a factorisation.
static bool is_for_products(const char* size) {
	return strcmp(size, "cloth") == 0 || strcmp(size, "block64") == 0;
}

typedef struct Subject {
	const char* size;
	JnModel* model;
	JnModelSystem* sys;
	JnState state; // deformed
	JnReport report;
	JnVec in, out;
	float *single_in, *single_out;
	JnOperator matrices;
	int slot; ///< of M + (gamma dt)^2 K
} Subject;

// ---- the work ----

static void assemble_energy(void* context) {
	Subject* s = context;
	s->out[0] = jn_assembly_energy(s->sys->assembly, s->state.x);
}

static void assemble_force(void* context) {
	Subject* s = context;
	jn_assembly_force(s->sys->assembly, s->state.x, s->out);
}

static void assemble_tangent(void* context) {
	Subject* s = context;
	jn_assembly_tangent(s->sys->assembly, s->state.x, JN_EXACT, NULL, s->sys->stiffness);
}

static void assemble_store(void* context) {
	Subject* s = context;
	jn_assembly_store(s->sys->assembly, (JnTangentAt){.x = s->state.x}, &s->sys->single[0]);
}

static void assemble_diagonal(void* context) {
	Subject* s = context;
	s->matrices.diagonal(s->matrices.user, s->slot);
}

static void multiply_elements(void* context) {
	Subject* s = context;
	jn_assembly_product(s->sys->assembly, (JnTangentAt){.x = s->state.x}, 1e-9, s->in, s->out);
}

static void multiply_single(void* context) {
	Subject* s = context;
	const JnSingleSum sum = {.stored = {{1e-9, &s->sys->single[0]}}};
	jn_assembly_apply_single(s->sys->assembly, &sum, s->single_in, s->single_out);
}

static void multiply_shifted(void* context) {
	Subject* s = context;
	s->matrices.apply_single(s->matrices.user, s->slot, s->single_in, s->single_out);
}

static void multiply_mass(void* context) {
	Subject* s = context;
	jn_scalars_apply(&s->model->pattern, s->model->mass, 1e-9, s->in, s->out, s->model->threads);
}

static void multiply_stiffness(void* context) {
	Subject* s = context;
	jn_blocks_apply(&s->model->pattern, s->sys->stiffness, 1e-9, s->in, s->out, s->model->threads);
}

static void factor(void* context) {
	Subject* s = context;
	s->sys->solver->type->factor(s->sys->solver, 0, s->sys->scratch);
}

static void solve(void* context) {
	Subject* s = context;
	s->sys->solver->type->solve(s->sys->solver, 0, s->in, s->out);
}

// ---- rows ----

// Assembly beside the bare kernels of the same elements: what gathering and scattering cost on top.
static void report_assembly(const Bench* bench, Subject* s, Verb verb, void (*run)(void*), double* buffer) {
	char name[64];
	snprintf(name, sizeof name, "assembly.%s", verb_names[verb]);
	if (!bench_wants(bench, "model", name, s->size)) return;
	const JnGroup* group = &s->model->groups[0];
	if (verb == DIAGONAL && group->kernel->diagonal == NULL) return;
	KernelRun bare = {.group = group, .batches = group->batches, .x = s->state.x, .out = buffer, .verb = verb};
	bare.stored = s->sys->single[0].numbers;
	bare.single = s->single_in;
	const double alone = measure(kernel_run, &bare, 1, 0.1, 3).median;
	const Timing seconds = measure(run, s, s->model->threads, 0.3, 5);
	const Row row = {.group = "model",
					 .name = name,
					 .size = s->size,
					 .threads = s->model->threads,
					 .width = group->kernel->width,
					 .value = timing_in(seconds, 1e-3, 1),
					 .unit = "ms",
					 .rate = 1e-6 * group->count / seconds.median,
					 .rate_unit = "Melement/s",
					 .fraction_of = "kernel",
					 .fraction = alone / (seconds.median * s->model->threads)};
	bench_report(bench, &row);
}

// Bytes that have to move: numbers of the lower triangle, the index of the full rows, x once, y in and out.
static double product_bytes(const JnPattern* pattern, int numbers) {
	const double full = pattern->full_start[pattern->nodes];
	return 8.0 * numbers * pattern->blocks + 8.0 * full + 4.0 * pattern->nodes + 72.0 * pattern->nodes;
}

static void report_product(const Bench* bench, Subject* s, const char* name, void (*run)(void*), int numbers) {
	if (!bench_wants(bench, "model", name, s->size)) return;
	const Timing seconds = measure(run, s, s->model->threads, 0.3, 5);
	Row row = {.group = "model", .name = name, .size = s->size, .threads = s->model->threads, .unit = "ms"};
	row.value = timing_in(seconds, 1e-3, 1);
	const double bytes = product_bytes(&s->model->pattern, numbers);
	row_set_bytes(bench, &row, seconds.median, bytes, bytes);
	bench_report(bench, &row);
}

// The matrix of an SDIRK2 stage at 5 ms.
static JnStatus make_matrix(Subject* s, JnMatrix** matrix) {
	const double h = 0.2928932188134525 * 5e-3;
	JnSystem* sys = &s->sys->base;
	JN_TRY(sys->ops->linearize(sys, &s->state));
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1, .stiffness = h * h}, matrix));
	s->slot = ((const JnModelMatrix*)*matrix)->slot;
	s->matrices = jn_model_matrix_operator(s->sys);
	return JN_OK;
}

// CHOLMOD runs in one thread; the numbers of `cost` are its own. A solve reads the factor twice.
static JnStatus report_solver(const Bench* bench, Subject* s) {
	const bool wants_factor = bench_wants(bench, "model", "factor", s->size);
	const bool wants_solve = bench_wants(bench, "model", "solve", s->size);
	if (s->model->threads > 1 || (!wants_factor && !wants_solve) || is_for_products(s->size)) return JN_OK;
	JnMatrix* matrix = NULL;
	JN_TRY(make_matrix(s, &matrix));
	JN_TRY(matrix->ops->solve(matrix, s->in, s->out)); // leaves the matrix in sys->scratch
	const JnSolverCost cost = s->sys->solver->type->cost(s->sys->solver);
	Row row = {.group = "model", .name = "factor", .size = s->size, .threads = 1, .unit = "ms"};
	if (wants_factor) {
		const Timing seconds = measure(factor, s, 1, 1, 3);
		row.value = timing_in(seconds, 1e-3, 1);
		row_set_flops(bench, &row, seconds.median, cost.factor_flops);
		bench_report(bench, &row);
	}
	if (wants_solve) {
		const Timing seconds = measure(solve, s, 1, 0.5, 5);
		row.name = "solve";
		row.value = timing_in(seconds, 1e-3, 1);
		row_set_bytes(bench, &row, seconds.median, 2.0 * (double)cost.bytes, (double)cost.bytes);
		bench_report(bench, &row);
	}
	return JN_OK;
}

// ---- a model ----

static JnStatus prepare(Subject* s, int count) {
	JnSpace* space = s->sys->base.space;
	JN_TRY(jn_state_create(space, &s->state));
	s->in = space->ops->create(space);
	s->out = space->ops->create(space);
	if (s->in == NULL || s->out == NULL) return JN_OUT_OF_MEMORY;
	jn_model_start(s->model, 0, &s->state);
	const double edge = cbrt(s->model->total_mass / s->model->bodies[0].density / count);
	deform(s->model->node_count, s->model->rest, edge, s->state.x);
	jn_state_touch(space, &s->state);
	for (size_t k = 0; k < space->length; ++k) s->in[k] = 1 + 1e-3 * (double)(k % 7);
	s->sys->base.report = &s->report;
	const size_t floats = 4 * (size_t)s->model->node_count;
	s->single_in = aligned_alloc(64, (floats * sizeof(float) + 63) / 64 * 64);
	s->single_out = aligned_alloc(64, (floats * sizeof(float) + 63) / 64 * 64);
	if (s->single_in == NULL || s->single_out == NULL) return JN_OUT_OF_MEMORY;
	for (size_t k = 0; k < floats; ++k) s->single_in[k] = k % 4 < 3 ? (float)s->in[3 * (k / 4) + k % 4] : 0;
	JnMatrix* matrix = NULL;
	return make_matrix(s, &matrix);
}

// M + (gamma dt)^2 K in single precision, as conjugate gradients multiply: what is stored, M, and vectors.
static void report_shifted(const Bench* bench, Subject* s) {
	const char* name = "product.shifted_single";
	if (!bench_wants(bench, "model", name, s->size)) return;
	const JnGroup* group = &s->model->groups[0];
	const JnPattern* pattern = &s->model->pattern;
	const Timing seconds = measure(multiply_shifted, s, s->model->threads, 0.3, 5);
	const double slots = (double)group->batches * group->kernel->width, points = group->kernel->points;
	const double mass = s->model->mass_is_diagonal ? 8.0 * pattern->nodes : 8.0 * pattern->full_start[pattern->nodes];
	const double bytes = 4 * slots * (points * group->kernel->stored_reals[0] + 6 * group->rest_points) + mass +
						 4 * slots * group->kernel->nodes + 48.0 * pattern->nodes;
	Row row = {.group = "model", .name = name, .size = s->size, .threads = s->model->threads, .unit = "ms"};
	row.value = timing_in(seconds, 1e-3, 1);
	row_set_bytes(bench, &row, seconds.median, bytes, bytes);
	bench_report(bench, &row);
}

static JnStatus report_all(const Bench* bench, Subject* s) {
	double* buffer = aligned_alloc(64, KERNEL_RUN_REALS * sizeof *buffer);
	if (buffer == NULL) return JN_OUT_OF_MEMORY;
	report_assembly(bench, s, ENERGY, assemble_energy, buffer);
	report_assembly(bench, s, FORCE, assemble_force, buffer);
	report_assembly(bench, s, TANGENT, assemble_tangent, buffer);
	report_assembly(bench, s, DIAGONAL, assemble_diagonal, buffer);
	report_assembly(bench, s, PRODUCT, multiply_elements, buffer);
	assemble_store(s);
	report_assembly(bench, s, STORE, assemble_store, buffer);
	report_assembly(bench, s, PRODUCT_SINGLE, multiply_single, buffer);
	free(buffer);
	report_shifted(bench, s);
	report_product(bench, s, "product.mass", multiply_mass, 1);
	report_product(bench, s, "product.stiffness", multiply_stiffness, 9);
	return report_solver(bench, s);
}

static JnStatus measure_model(const Bench* bench, const char* size, int threads) {
	SceneOf of = scene_of(size);
	const char* sets[2] = {of.cells};
	if (is_for_products(size)) sets[of.set_count++] = "solver.method=cg";
	JnScene* scene = NULL;
	Subject s = {.size = size};
	JN_TRY(jn_scene_load(of.path, of.set_count, sets, &scene));
	JnStatus status = jn_model_create(&jn_scene_def(scene)->sim.model, threads, &s.model);
	if (status == JN_OK) {
		s.sys = (JnModelSystem*)jn_model_system(s.model);
		status = prepare(&s, s.model->groups[0].count);
		if (status == JN_OK) status = report_all(bench, &s);
		JnSpace* space = s.sys->base.space;
		jn_state_destroy(space, &s.state);
		space->ops->destroy(space, s.in);
		space->ops->destroy(space, s.out);
		free(s.single_in);
		free(s.single_out);
	}
	jn_model_destroy(s.model);
	jn_scene_destroy(scene);
	return status;
}

static bool wants_any(const Bench* bench, const char* size) {
	static const char* const names[] = {
		"assembly.energy", "assembly.force",         "assembly.tangent",       "assembly.diagonal", "assembly.product",
		"assembly.store",  "product.mass",           "product.shifted_single", "product.stiffness", "factor",
		"solve",           "assembly.product_single"};
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
		if (bench_wants(bench, "model", names[i], size)) return true;
	return false;
}

JnStatus bench_models(const Bench* bench) {
	for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
		if (!wants_any(bench, sizes[i])) continue;
		JN_TRY(measure_model(bench, sizes[i], 1));
		if (bench->threads > 1) JN_TRY(measure_model(bench, sizes[i], bench->threads));
	}
	return JN_OK;
}
