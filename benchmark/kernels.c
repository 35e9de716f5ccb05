// The element kernels by themselves: every law on every element, and all vector widths for the main pair.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "force/constraint/constraint.h"
#include "force/solid.h"
#include "mesh/shape/shape.h"

const char* const verb_names[VERBS] = {"energy",  "force", "tangent",        "definite",
									   "product", "store", "product_single", "diagonal"};

enum { FORCE_CHUNK = 64, TANGENT_CHUNK = 16 }; // elements, as in the assembly

void kernel_run(void* context) {
	const KernelRun* run = context;
	const JnGroup* group = run->group;
	const JnKernel* kernel = group->kernel;
	const bool is_tangent = run->verb == TANGENT || run->verb == DEFINITE, is_constraint = kernel->law == NULL;
	const ptrdiff_t stored = (ptrdiff_t)kernel->width * kernel->points * kernel->stored_reals[0];
	const int step = (is_tangent ? TANGENT_CHUNK : FORCE_CHUNK) / kernel->width;
	for (int first = 0; first < run->batches; first += step) {
		const int last = first + step < run->batches ? first + step : run->batches;
		if (run->verb == PRODUCT)
			kernel->product(group, first, last, run->x, is_constraint, run->x, run->out);
		else if (run->verb == STORE)
			kernel->store(group, first, last, run->x, false, run->stored);
		else if (run->verb == PRODUCT_SINGLE)
			kernel->product_single(group, first, last, false, run->stored + stored * first, run->single,
								   (float*)run->out);
		else if (run->verb == DIAGONAL)
			kernel->diagonal(group, first, last, run->x, false, run->out);
		else if (is_tangent)
			kernel->tangent(group, first, last, run->x, run->verb == DEFINITE, run->out);
		else
			(run->verb == FORCE ? kernel->force : kernel->energy)(group, first, last, run->x, run->out);
	}
}

void deform(int node_count, const double* rest, double edge, double* x) {
	const double c = cos(0.3), s = sin(0.3);
	uint32_t noise = 1;
	for (int node = 0; node < node_count; node++) {
		const double* X = rest + 3 * (ptrdiff_t)node;
		const double bent = X[1] + 0.1 * X[0] * X[0] + 0.05 * X[2] * X[2];
		const double moved[3] = {c * X[0] - s * bent, s * X[0] + c * bent, X[2]};
		for (int a = 0; a < 3; a++) {
			noise = noise * 1664525u + 1013904223u;
			x[3 * (ptrdiff_t)node + a] = moved[a] + 0.1 * edge * ((double)(noise >> 8) / 16777216.0 - 0.5);
		}
	}
}

typedef struct Problem {
	JnArena arena;
	JnGroup group;
	double *x, *out;
	float *stored, *single;
} Problem;

static const JnMaterialDef material = {.density = 1000, .young = 1e6, .poisson = 0.4};

// 512 hexahedra or 480 tetrahedra, whose rest data fit into the second cache.
static JnStatus make_problem(const JnKernel* kernel, Problem* problem) {
	JnMesh mesh;
	const bool is_hexahedron = kernel->shape == JN_HEX8;
	const JnBoxDef box = {.size = {1, 1, 1},
						  .cells = {is_hexahedron ? 8 : 4, is_hexahedron ? 8 : 4, is_hexahedron ? 8 : 5},
						  .element = (int)kernel->shape};
	JN_TRY(jn_generate_box(&box, &problem->arena, &mesh));
	JN_TRY(jn_group_create(kernel, &mesh, 0, &material, "body", &problem->arena, &problem->group));
	JN_NEW(&problem->arena, problem->x, 3 * mesh.node_count);
	JN_NEW(&problem->arena, problem->out, KERNEL_RUN_REALS);
	deform(mesh.node_count, mesh.nodes, 1.0 / box.cells[2], problem->x);
	if (kernel->freeze != NULL) kernel->freeze(&problem->group, 0, problem->group.batches, problem->x);
	const int slots = (problem->group.batches + 1) / 2 * 2 * kernel->width;
	JN_NEW(&problem->arena, problem->stored, slots * kernel->points * kernel->stored_reals[0]);
	JN_NEW(&problem->arena, problem->single, 4 * mesh.node_count);
	for (int k = 0; k < 3 * mesh.node_count; k++) problem->single[4 * (k / 3) + k % 3] = (float)problem->x[k];
	return JN_OK;
}

// Rest numbers of sections with sides of 1 and links of 2, unstrained.
#define TORSION_REST -0.57735026918962576, 1.1547005383792515, 0, 1, 0.01
#define SKEW_REST -0.57735026918962576, 1.1547005383792515, 0, 0, 5
#define SIDES_REST 1, 50, 1, 50, 1, 50
#define LINES_REST 2, 50, 2, 50, 2, 50
#define DIAGONALS_REST 2.2360679775, 50, 2.2360679775, 50, 2.2360679775, 50
#define CELL_REST -0.2886751345948129, 1000, 0
#define GUARD_REST -0.11547005383792515, 0, 1000

static const double constraint_rest[JN_CONSTRAINT_COUNT][JN_CONSTRAINT_MOST_REALS] = {
	[JN_CONSTRAINT_spring] = {1.1, 50},
	[JN_CONSTRAINT_stretch] = {0, -1, 1, -0.5, 300, 200},
	[JN_CONSTRAINT_shear] = {0, -1, 1, -0.5, 40},
	[JN_CONSTRAINT_bend] = {0, 1, 1e-3},
	[JN_CONSTRAINT_strut] = {1.1, 50},
	[JN_CONSTRAINT_angle] = {0, 1e-3},
	[JN_CONSTRAINT_area] = {0.5, 50},
	[JN_CONSTRAINT_volume] = {CELL_REST},
	[JN_CONSTRAINT_torsion] = {TORSION_REST},
	[JN_CONSTRAINT_skew] = {SKEW_REST},
	[JN_CONSTRAINT_thread_link] = {SIDES_REST, LINES_REST, DIAGONALS_REST, CELL_REST, CELL_REST, CELL_REST,
								   TORSION_REST},
	[JN_CONSTRAINT_rod_link] = {SIDES_REST, LINES_REST, GUARD_REST, GUARD_REST, GUARD_REST, TORSION_REST, SKEW_REST}};

enum { ROW_ELEMENTS = 512, ROW_NODES = 3 * ROW_ELEMENTS + 4 };

// 512 elements of a kernel, each from a node, or from a frame, to those behind it, strained: a folded strip of cloth with
// node i at (i/2, i mod 2) times the edge, or a thread whose frames are triangles with sides of 1.
static JnStatus make_row(JnConstraintKernel which, int width, Problem* problem) {
	static const double section[3][2] = {{0, 0}, {1, 0}, {0.5, 0.8660254037844386}};
	const JnKernel* kernel = jn_constraint_kernel(which, width);
	const bool is_thread = kernel->nodes == 6 || which == JN_CONSTRAINT_volume;
	JnConstraint* elements;
	double nodes[3 * ROW_NODES];
	JN_NEW(&problem->arena, elements, ROW_ELEMENTS);
	for (int i = 0; i < ROW_NODES; ++i) {
		const double *corner = section[i % 3], strip[3] = {0.5 * i, i % 2, 0},
					 frame[3] = {2 * (i / 3), corner[0], corner[1]};
		memcpy(nodes + 3 * (ptrdiff_t)i, is_thread ? frame : strip, sizeof frame);
	}
	for (int e = 0; e < ROW_ELEMENTS; ++e) {
		const int hinge[4] = {e, e + 3, e + 2, e + 1};
		for (int i = 0; i < kernel->nodes; ++i) elements[e].nodes[i] = (is_thread ? 3 * e : e) + i;
		if (which == JN_CONSTRAINT_bend) memcpy(elements[e].nodes, hinge, sizeof hinge);
		memcpy(elements[e].rest, constraint_rest[which], sizeof constraint_rest[which]);
	}
	JN_TRY(jn_constraint_group_create(kernel, ROW_ELEMENTS, elements, &problem->arena, &problem->group));
	JN_NEW(&problem->arena, problem->x, sizeof nodes / sizeof *nodes);
	JN_NEW(&problem->arena, problem->out, KERNEL_RUN_REALS);
	deform(ROW_NODES, nodes, 1, problem->x);
	return JN_OK;
}

static bool has_verb(const JnKernel* kernel, Verb verb) {
	return verb == PRODUCT          ? kernel->product != NULL
		   : verb == STORE          ? kernel->store != NULL
		   : verb == PRODUCT_SINGLE ? kernel->product_single != NULL
		   : verb == DIAGONAL       ? kernel->diagonal != NULL
									: true;
}

static void measure_verb(const Bench* bench, const Problem* problem, Verb verb) {
	const JnGroup* group = &problem->group;
	if (!has_verb(group->kernel, verb)) return;
	char name[64], size[24];
	snprintf(name, sizeof name, "%s.%s.%s",
			 group->kernel->name != NULL ? "constraint" : jn_shape_info[group->kernel->shape].name,
			 group->kernel->name != NULL ? group->kernel->name : group->kernel->law->row.name, verb_names[verb]);
	snprintf(size, sizeof size, "%d", group->count);
	if (!bench_wants(bench, "kernel", name, size)) return;
	KernelRun run = {.group = group, .batches = 1, .x = problem->x, .out = problem->out, .verb = verb};
	run.stored = problem->stored;
	run.single = problem->single;
	const int lanes = verb == PRODUCT_SINGLE ? 2 * group->kernel->width : group->kernel->width;
	const double flops = count_flops(kernel_run, &run) / lanes; // of an element
	run.batches = group->batches;
	const Timing seconds = measure(kernel_run, &run, 1, 0.1, 7);
	Row row = {.group = "kernel", .name = name, .size = size, .threads = 1, .width = group->kernel->width};
	row.value = timing_in(seconds, 1e-9, group->count);
	row.unit = "ns/element";
	if (flops > 0) row_set_flops(bench, &row, seconds.median, flops * group->count);
	if (verb == PRODUCT_SINGLE) row.fraction /= 2; // twice as many floats as doubles fit into a register
	bench_report(bench, &row);
}

static void measure_pair(const Bench* bench, JnShape shape, const JnLaw* law, int width) {
	const JnKernel* kernel = jn_kernel_find(shape, law, width);
	Problem problem = {0};
	if (kernel != NULL && make_problem(kernel, &problem) == JN_OK)
		for (Verb verb = 0; verb < VERBS; verb++) measure_verb(bench, &problem, verb);
	jn_arena_free(&problem.arena);
}

static void measure_constraint(const Bench* bench, JnConstraintKernel which, int width) {
	Problem problem = {0};
	if (jn_constraint_kernel(which, width) != NULL && make_row(which, width, &problem) == JN_OK)
		for (Verb verb = 0; verb < VERBS; verb++) measure_verb(bench, &problem, verb);
	jn_arena_free(&problem.arena);
}

void bench_kernels(const Bench* bench) {
	for (JnShape shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++)
		for (int i = 0; i < JN_SOLID_LAW_COUNT; i++)
			measure_pair(bench, shape, (const JnLaw*)jn_law_list.rows[i], jn_kernel_best_width());
	for (int width = jn_kernel_best_width() / 2; width >= 2; width /= 2)
		measure_pair(bench, JN_HEX8, &jn_law_stable_neo_hookean, width);
	for (JnConstraintKernel which = 0; which < JN_CONSTRAINT_COUNT; which++)
		for (int width = jn_kernel_best_width(); width >= 2; width /= 2) measure_constraint(bench, which, width);
}
