/// @file sample.h
/// Random elements in chosen states, for the tests of kernels: five elements without common nodes, so that one entry of
/// all of them can be varied at once, in batches whose last one is padded at every width.
#ifndef JN_TEST_FORCE_SAMPLE_H
#define JN_TEST_FORCE_SAMPLE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "force/kernel.h"
#include "force/solid.h"

enum { SAMPLE_ELEMENTS = 5, SAMPLE_MOST_REALS = 30 };

/// Principal stretches of F before random rotations and a random 2 % on top.
typedef enum State { NEAR_REST, STRETCHED, LARGE, INVERTED, FLAT, STATE_COUNT } State;

static const char* const state_names[STATE_COUNT] = {"near rest", "stretched", "large", "inverted", "flat"};
static const double state_stretch[STATE_COUNT][3] = {
	{1, 1, 1}, {1.1, 1.1, 1.1}, {1.7, 1.1, 0.6}, {1.4, 0.9, -0.5}, {1.2, 0.8, 0}};

typedef struct Sample {
	JnArena arena;
	JnMesh mesh;
	JnGroup group;
	double* x;
	int reals; ///< 3 * nodes of an element
} Sample;

/// Uniform in [-1, 1].
static inline double random_real(uint64_t* seed) {
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(*seed >> 11) / (double)((uint64_t)1 << 52) - 1;
}

/// A random rotation, from a random unit quaternion.
static inline void random_rotation(uint64_t* seed, double R[3][3]) {
	double q[4], norm = 0;
	for (int i = 0; i < 4; i++) {
		q[i] = random_real(seed);
		norm += q[i] * q[i];
	}
	for (int i = 0; i < 4; i++) q[i] /= sqrt(norm);
	const double w = q[0], a = q[1], b = q[2], c = q[3];
	const double rows[3][3] = {{1 - 2 * (b * b + c * c), 2 * (a * b - w * c), 2 * (a * c + w * b)},
							   {2 * (a * b + w * c), 1 - 2 * (a * a + c * c), 2 * (b * c - w * a)},
							   {2 * (a * c - w * b), 2 * (b * c + w * a), 1 - 2 * (a * a + b * b)}};
	memcpy(R, rows, sizeof rows);
}

/// F = U diag(stretch) V^T with random rotations; no rotation near rest.
static inline void random_gradient(State state, uint64_t* seed, double F[3][3]) {
	double U[3][3], V[3][3];
	random_rotation(seed, U);
	random_rotation(seed, V);
	for (int k = 0; k < 9; k++) {
		F[k / 3][k % 3] = 0.02 * random_real(seed) + (state == NEAR_REST && k % 4 == 0);
		for (int i = 0; i < 3 && state != NEAR_REST; i++) {
			F[k / 3][k % 3] += U[k / 3][i] * state_stretch[state][i] * V[k % 3][i];
		}
	}
}

static const double sample_hex[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
										{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
static const double sample_tet[10][3] = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {0, 0, 1},   {.5, 0, 0},
										 {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {0, .5, .5}};

/// Elements of size 0.1 m, whose corners are moved by up to `distortion` of it.
static inline void sample_mesh(Sample* s, JnShape shape, double distortion, uint64_t* seed) {
	const int nodes = jn_shape_info[shape].nodes;
	s->mesh = (JnMesh){.shape = shape, .node_count = SAMPLE_ELEMENTS * nodes, .cell_count = SAMPLE_ELEMENTS};
	s->mesh.nodes = jn_arena_take(&s->arena, 3 * (size_t)s->mesh.node_count, sizeof(double));
	s->mesh.cells = jn_arena_take(&s->arena, (size_t)s->mesh.node_count, sizeof(int));
	assert_true(s->mesh.nodes != NULL && s->mesh.cells != NULL);
	for (int i = 0; i < s->mesh.node_count; i++) {
		s->mesh.cells[i] = i;
		const double* reference = shape == JN_HEX8 ? sample_hex[i % nodes] : sample_tet[i % nodes];
		for (int a = 0; a < 3; a++) s->mesh.nodes[3 * i + a] = 0.1 * (reference[a] + distortion * random_real(seed));
	}
}

static inline void sample_group(Sample* s, const JnLaw* law, int width) {
	const JnKernel* kernel = jn_kernel_find(s->mesh.shape, law, width);
	assert_non_null(kernel);
	const JnMaterialDef material = {.density = 1000, .young = 1e5, .poisson = 0.4};
	assert_int_equal(jn_group_create(kernel, &s->mesh, 0, &material, "body", &s->arena, &s->group), JN_OK);
	if (kernel->freeze != NULL) kernel->freeze(&s->group, 0, s->group.batches, s->x);
}

static inline Sample sample_create(JnShape shape, const JnLaw* law, int width, State state, uint64_t seed) {
	Sample s = {.reals = 3 * jn_shape_info[shape].nodes};
	sample_mesh(&s, shape, 0.05, &seed);
	s.x = jn_arena_take(&s.arena, 3 * (size_t)s.mesh.node_count, sizeof(double));
	assert_non_null(s.x);
	double F[3][3] = {{0}};
	for (int i = 0; i < s.mesh.node_count; i++) {
		if (i % jn_shape_info[shape].nodes == 0) random_gradient(state, &seed, F);
		for (int a = 0; a < 3; a++) {
			s.x[3 * i + a] = 0.001 * random_real(&seed);
			for (int c = 0; c < 3; c++) s.x[3 * i + a] += F[a][c] * s.mesh.nodes[3 * i + c];
		}
	}
	sample_group(&s, law, width);
	return s;
}

/// Energies of the elements [J].
static inline void sample_energy(const Sample* s, double out[SAMPLE_ELEMENTS]) {
	const JnGroup* g = &s->group;
	double lanes[SAMPLE_ELEMENTS + 8];
	g->kernel->energy(g, 0, g->batches, s->x, lanes);
	memcpy(out, lanes, SAMPLE_ELEMENTS * sizeof(double));
}

/// Forces [element][3 * nodes].
static inline void sample_force(const Sample* s, double out[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS]) {
	const JnGroup* g = &s->group;
	const int width = g->kernel->width;
	double* lanes = malloc((size_t)g->batches * s->reals * width * sizeof(double));
	g->kernel->force(g, 0, g->batches, s->x, lanes);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		for (int k = 0; k < s->reals; k++) out[e][k] = lanes[((e / width) * s->reals + k) * width + e % width];
	}
	free(lanes);
}

typedef double SampleMatrix[SAMPLE_MOST_REALS][SAMPLE_MOST_REALS];

/// Dense symmetric element matrices K.
static inline void sample_tangent(const Sample* s, bool definite, SampleMatrix out[SAMPLE_ELEMENTS]) {
	const JnGroup* g = &s->group;
	const int width = g->kernel->width, nodes = g->kernel->nodes, pairs = nodes * (nodes + 1) / 2;
	double* lanes = malloc((size_t)g->batches * pairs * 9 * width * sizeof(double));
	g->kernel->tangent(g, 0, g->batches, s->x, definite, lanes);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		for (int row = 0; row < s->reals; row++) {
			for (int column = 0; column < s->reals; column++) {
				const bool lower = row / 3 >= column / 3;
				const int r = lower ? row : column, c = lower ? column : row;
				const int pair = (r / 3) * (r / 3 + 1) / 2 + c / 3, entry = r % 3 * 3 + c % 3;
				out[e][row][column] = lanes[(((e / width) * pairs + pair) * 9 + entry) * width + e % width];
			}
		}
	}
	free(lanes);
}

static inline double largest(const double* values, int count) {
	double most = 0;
	for (int i = 0; i < count; i++) most = fmax(most, isnan(values[i]) ? INFINITY : fabs(values[i]));
	return most;
}

/// Fail with value, expected and tolerance unless |value - expected| <= tolerance.
static inline void expect_near(double value, double expected, double tolerance, const char* what, const Sample* s,
							   State state) {
	if (fabs(value - expected) <= tolerance) return;
	fail_msg("%s of %s %s, %d lanes, %s: %.17g, expected %.17g, tolerance %.3g", what,
			 jn_shape_info[s->mesh.shape].name, s->group.kernel->law->row.name, s->group.kernel->width,
			 state_names[state], value, expected, tolerance);
}

/// A check of one sample; `state` is its state.
typedef void SampleCheck(Sample* s, State state);

/// Whether a law is defined in a state: the logarithm of J <= 0 is not.
static inline bool is_defined(const JnLaw* law, State state) {
	return strcmp(law->row.name, "neo_hookean") != 0 || state < INVERTED;
}

/// Run a check for every law, element, width of this processor and state.
static inline void for_all_samples(SampleCheck* check) {
	for (int row = 0; row < JN_SOLID_LAW_COUNT; row++) {
		const JnLaw* law = (const JnLaw*)jn_law_list.rows[row];
		for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
			for (int width = 2; width <= 8; width *= 2) {
				if (jn_kernel_find(shape, law, width) == NULL) continue;
				for (int state = 0; state < STATE_COUNT; state++) {
					if (!is_defined(law, state)) continue;
					Sample s = sample_create(shape, law, width, state, (uint64_t)(1000 * row + 10 * shape + state));
					check(&s, state);
					jn_arena_free(&s.arena);
				}
			}
		}
	}
}

/// What `collect` gathers of the sample must be the same, bit for bit, with every width of vectors that the processor has.
static inline void sample_check_widths(Sample* s, State state, int (*collect)(Sample* s, double* out)) {
	static double reference[20000], other[20000];
	if (s->group.kernel->width != 4) return;
	const int count = collect(s, reference);
	for (int width = 8; width >= 2; width -= 6) {
		if (jn_kernel_find(s->mesh.shape, s->group.kernel->law, width) == NULL) continue;
		Sample wide = *s;
		wide.arena = (JnArena){0};
		sample_group(&wide, s->group.kernel->law, width);
		assert_int_equal(collect(&wide, other), count);
		for (int k = 0; k < count; k++) expect_near(other[k], reference[k], 0, "another width's number", &wide, state);
		jn_arena_free(&wide.arena);
	}
}

#endif
