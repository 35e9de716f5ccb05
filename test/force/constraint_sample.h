/// @file constraint_sample.h
/// Random elements of the kernels of constraints in chosen states: five without common nodes, so that one entry of all of them
/// can be varied at once.
#ifndef JN_TEST_FORCE_CLOTH_SAMPLE_H
#define JN_TEST_FORCE_CLOTH_SAMPLE_H

#include "eigen.h"
#include "force/constraint/constraint.h"

typedef enum ClothState { CLOTH_NEAR_REST, CLOTH_STRETCHED, CLOTH_COMPRESSED, CLOTH_FOLDED, CLOTH_STATES } ClothState;

static const char* const cloth_state_names[CLOTH_STATES] = {"near rest", "stretched", "compressed", "folded"};

/// Two wings at the edge between nodes 3 and 2; triangles and springs are the first nodes of it, in their own order.
static const double cloth_rest[4][3] = {{0.4, 0.9, 0}, {0.5, -1.1, 0}, {1, 0, 0}, {0, 0, 0}};

/// A tetrahedron of the volume 1/6, and two sections of a thread of which the second is the first moved by z.
static const double cell_rest[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
static const double link_rest[6][3] = {{1, 0, 0}, {-0.5, 0.86602540378444, 0}, {-0.5, -0.86602540378444, 0},
									   {1, 0, 2}, {-0.5, 0.86602540378444, 2}, {-0.5, -0.86602540378444, 2}};

static const double place_scale[CLOTH_STATES][2] = {{1.01, 0.99}, {1.4, 1.2}, {0.7, 0.8}, {1, 1}};

/// Folded: inside out.
static inline void cell_place(ClothState state, int node, double X[3]) {
	for (int a = 0; a < 3; a++) X[a] = cell_rest[node][a] * place_scale[state][a % 2];
	if (state == CLOTH_FOLDED) X[2] *= -0.4;
}

/// Folded: the second section is turned by 2.2 rad about the axis, then by 0.9 rad across it.
static inline void link_place(ClothState state, int node, double X[3]) {
	for (int a = 0; a < 3; a++) X[a] = link_rest[node][a] * place_scale[state][a % 2];
	if (state != CLOTH_FOLDED || node < 3) return;
	const double c = cos(2.2), s = sin(2.2), C = cos(0.9), S = sin(0.9), x = c * X[0] - s * X[1];
	X[1] = s * X[0] + c * X[1];
	X[0] = C * x + S * X[2];
	X[2] = -S * x + C * X[2];
}

/// Like cloth_rest, with the strain or the fold of a state.
static inline void cloth_place(ClothState state, int node, double X[3]) {
	const double(*scale)[2] = place_scale;
	for (int a = 0; a < 3; a++) X[a] = cloth_rest[node][a] * (a < 2 ? scale[state][a] : 1);
	if (state != CLOTH_FOLDED || node != 0) return;
	X[2] = 0.8 * X[1]; // the wing turns by some 120 degrees
	X[1] *= -0.5;
}

typedef struct ConstraintSample {
	JnArena arena;
	JnGroup group;
	int reals;
	double x[SAMPLE_ELEMENTS * 18];
} ConstraintSample;

static inline void constraint_place(JnConstraintKernel which, int nodes, ClothState state, int node, double X[3]) {
	if (which == JN_CONSTRAINT_volume)
		cell_place(state, node, X);
	else if (nodes == 6)
		link_place(state, node, X);
	else
		cloth_place(state, node, X);
}

/// Numbers at rest as the headers of the kernels say, with a stiffness of order 1.
static inline void cloth_rest_numbers(JnConstraintKernel which, uint64_t* seed, double* rest) {
	static const double plain[JN_CONSTRAINT_COUNT][JN_CONSTRAINT_MOST_REALS] = {
		[JN_CONSTRAINT_spring] = {0.09, 50},
		[JN_CONSTRAINT_stretch] = {0, 0, 0, 0, 1.2, 0.8},
		[JN_CONSTRAINT_shear] = {0, 0, 0, 0, 0.7},
		[JN_CONSTRAINT_bend] = {0.1, 0.99498743710662, 0.6},
		[JN_CONSTRAINT_strut] = {0.09, 50},
		[JN_CONSTRAINT_angle] = {0.3, 0.6},
		[JN_CONSTRAINT_area] = {0.004, 4e3},
		[JN_CONSTRAINT_volume] = {1e-3 / 6, 1e6, 2e6},
		[JN_CONSTRAINT_torsion] = {0.57735026919, -1.15470053838, 0.1, 0.99498743710662, 0.6},
		[JN_CONSTRAINT_skew] = {0.57735026919, -1.15470053838, 0.01, -0.02, 300},
		[JN_CONSTRAINT_thread_link] = {0.17,
									   50,
									   0.18,
									   52,
									   0.17,
									   55,
									   0.2,
									   60,
									   0.2,
									   65,
									   0.21,
									   30,
									   0.26,
									   20,
									   0.25,
									   22,
									   0.27,
									   19,
									   4.3e-4,
									   1e6,
									   2e6,
									   4e-4,
									   1.1e6,
									   1e6,
									   4e-4,
									   0,
									   0,
									   0.57735026919,
									   -1.15470053838,
									   0.1,
									   0.99498743710662,
									   0.6},
		[JN_CONSTRAINT_rod_link] = {0.17,
									50,
									0.18,
									52,
									0.17,
									55,
									0.2,
									60,
									0.2,
									65,
									0.21,
									30,
									1.7e-4,
									0,
									2e6,
									1.6e-4,
									0,
									1e6,
									4.3e-4,
									0,
									1e6,
									0.57735026919,
									-1.15470053838,
									0.1,
									0.99498743710662,
									0.6,
									0.57735026919,
									-1.15470053838,
									0.01,
									-0.02,
									300}};
	memcpy(rest, plain[which], sizeof plain[which]);
	if (which == JN_CONSTRAINT_stretch ||
		which == JN_CONSTRAINT_shear) { // inverse of the edges 0.1 (-0.6, 0.9), 0.1 (-0.5, -1.1)
		static const double B[4] = {-9.9099099099, 4.5045045045, -8.1081081081, -5.4054054054};
		for (int k = 0; k < 4; k++) rest[k] = B[k] * (1 + 0.05 * random_real(seed));
	}
}

static inline ConstraintSample constraint_sample(JnConstraintKernel which, int width, ClothState state, uint64_t seed) {
	ConstraintSample s = {0};
	JnConstraint elements[SAMPLE_ELEMENTS] = {0};
	const JnKernel* kernel = jn_constraint_kernel(which, width);
	s.reals = 3 * kernel->nodes;
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		double R[3][3];
		random_rotation(&seed, R);
		for (int i = 0; i < kernel->nodes; i++) {
			double X[3];
			constraint_place(which, kernel->nodes, state, i, X);
			elements[e].nodes[i] = e * kernel->nodes + i;
			for (int a = 0; a < 3; a++)
				s.x[3 * (e * kernel->nodes + i) + a] =
					0.1 * (R[a][0] * X[0] + R[a][1] * X[1] + R[a][2] * X[2] + 0.05 * random_real(&seed));
		}
		cloth_rest_numbers(which, &seed, elements[e].rest);
	}
	assert_int_equal(jn_constraint_group_create(kernel, SAMPLE_ELEMENTS, elements, &s.arena, &s.group), JN_OK);
	return s;
}

/// As a sample of sample.h, whose readers of forces and tangents serve here too.
static inline Sample cloth_view(ConstraintSample* s) {
	return (Sample){.group = s->group, .x = s->x, .reals = s->reals};
}

/// K p of each element.
static inline void cloth_product(const ConstraintSample* s, bool definite, const double* p,
								 double out[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS]) {
	const JnGroup* g = &s->group;
	const int width = g->kernel->width;
	double* lanes = malloc((size_t)g->batches * (size_t)s->reals * (size_t)width * sizeof(double));
	g->kernel->product(g, 0, g->batches, s->x, definite, p, lanes);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++)
		for (int k = 0; k < s->reals; k++) out[e][k] = lanes[((e / width) * s->reals + k) * width + e % width];
	free(lanes);
}

static inline void cloth_expect(double value, double expected, double tolerance, const char* what,
								const ConstraintSample* s, ClothState state) {
	if (fabs(value - expected) <= tolerance) return;
	fail_msg("%s of %s, %d lanes, %s: %.17g, expected %.17g, tolerance %.3g", what, s->group.kernel->name,
			 s->group.kernel->width, cloth_state_names[state], value, expected, tolerance);
}

typedef void ClothCheck(ConstraintSample* s, JnConstraintKernel which, ClothState state);

/// Run a check for every kernel, width of this processor and state.
static inline void for_all_cloth(ClothCheck* check) {
	for (int which = 0; which < JN_CONSTRAINT_COUNT; which++)
		for (int width = 2; width <= 8; width *= 2) {
			if (jn_constraint_kernel(which, width) == NULL) continue;
			for (int state = 0; state < CLOTH_STATES; state++) {
				ConstraintSample s = constraint_sample(which, width, state, (uint64_t)(100 * which + state));
				check(&s, which, state);
				jn_arena_free(&s.arena);
			}
		}
}

#endif
