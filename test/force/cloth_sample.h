/// @file cloth_sample.h
/// Random elements of the kernels of cloth in chosen states: five without common nodes, so that one entry of all of them
/// can be varied at once.
#ifndef JN_TEST_FORCE_CLOTH_SAMPLE_H
#define JN_TEST_FORCE_CLOTH_SAMPLE_H

#include "eigen.h"
#include "force/cloth/cloth.h"

typedef enum ClothState { CLOTH_NEAR_REST, CLOTH_STRETCHED, CLOTH_COMPRESSED, CLOTH_FOLDED, CLOTH_STATES } ClothState;

static const char* const cloth_state_names[CLOTH_STATES] = {"near rest", "stretched", "compressed", "folded"};

/// Two wings at the edge between nodes 3 and 2; triangles and springs are the first nodes of it, in their own order.
static const double cloth_rest[4][3] = {{0.4, 0.9, 0}, {0.5, -1.1, 0}, {1, 0, 0}, {0, 0, 0}};

/// Like cloth_rest, with the strain or the fold of a state.
static inline void cloth_place(ClothState state, int node, double X[3]) {
	static const double scale[CLOTH_STATES][2] = {{1.01, 0.99}, {1.4, 1.2}, {0.7, 0.8}, {1, 1}};
	for (int a = 0; a < 3; a++) X[a] = cloth_rest[node][a] * (a < 2 ? scale[state][a] : 1);
	if (state != CLOTH_FOLDED || node != 0) return;
	X[2] = 0.8 * X[1]; // the wing turns by some 120 degrees
	X[1] *= -0.5;
}

typedef struct ClothSample {
	JnArena arena;
	JnGroup group;
	int reals;
	double x[SAMPLE_ELEMENTS * 12];
} ClothSample;

/// Numbers at rest as the headers of the kernels say, with a stiffness of order 1.
static inline void cloth_rest_numbers(JnClothKernel which, uint64_t* seed, double* rest) {
	static const double plain[JN_CLOTH_COUNT][JN_CLOTH_MOST_REALS] = {[JN_CLOTH_spring] = {0.09, 50},
																	  [JN_CLOTH_stretch] = {0, 0, 0, 0, 1.2, 0.8},
																	  [JN_CLOTH_shear] = {0, 0, 0, 0, 0.7},
																	  [JN_CLOTH_bend] = {0.1, 0.99498743710662, 0.6}};
	memcpy(rest, plain[which], sizeof plain[which]);
	if (which == JN_CLOTH_stretch ||
		which == JN_CLOTH_shear) { // inverse of the edges 0.1 (-0.6, 0.9), 0.1 (-0.5, -1.1)
		static const double B[4] = {-9.9099099099, 4.5045045045, -8.1081081081, -5.4054054054};
		for (int k = 0; k < 4; k++) rest[k] = B[k] * (1 + 0.05 * random_real(seed));
	}
}

static inline ClothSample cloth_sample(JnClothKernel which, int width, ClothState state, uint64_t seed) {
	ClothSample s = {0};
	JnClothElement elements[SAMPLE_ELEMENTS] = {0};
	const JnKernel* kernel = jn_cloth_kernel(which, width);
	s.reals = 3 * kernel->nodes;
	for (int e = 0; e < SAMPLE_ELEMENTS; e++) {
		double R[3][3];
		random_rotation(&seed, R);
		for (int i = 0; i < kernel->nodes; i++) {
			double X[3];
			cloth_place(state, i, X);
			elements[e].nodes[i] = e * kernel->nodes + i;
			for (int a = 0; a < 3; a++)
				s.x[3 * (e * kernel->nodes + i) + a] =
					0.1 * (R[a][0] * X[0] + R[a][1] * X[1] + R[a][2] * X[2] + 0.05 * random_real(&seed));
		}
		cloth_rest_numbers(which, &seed, elements[e].rest);
	}
	assert_int_equal(jn_cloth_group_create(kernel, SAMPLE_ELEMENTS, elements, &s.arena, &s.group), JN_OK);
	return s;
}

/// As a sample of sample.h, whose readers of forces and tangents serve here too.
static inline Sample cloth_view(ClothSample* s) {
	return (Sample){.group = s->group, .x = s->x, .reals = s->reals};
}

/// K p of each element.
static inline void cloth_product(const ClothSample* s, bool definite, const double* p,
								 double out[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS]) {
	const JnGroup* g = &s->group;
	const int width = g->kernel->width;
	double* lanes = malloc((size_t)g->batches * (size_t)s->reals * (size_t)width * sizeof(double));
	g->kernel->product(g, 0, g->batches, s->x, definite, p, lanes);
	for (int e = 0; e < SAMPLE_ELEMENTS; e++)
		for (int k = 0; k < s->reals; k++) out[e][k] = lanes[((e / width) * s->reals + k) * width + e % width];
	free(lanes);
}

static inline void cloth_expect(double value, double expected, double tolerance, const char* what, const ClothSample* s,
								ClothState state) {
	if (fabs(value - expected) <= tolerance) return;
	fail_msg("%s of %s, %d lanes, %s: %.17g, expected %.17g, tolerance %.3g", what, s->group.kernel->name,
			 s->group.kernel->width, cloth_state_names[state], value, expected, tolerance);
}

typedef void ClothCheck(ClothSample* s, JnClothKernel which, ClothState state);

/// Run a check for every kernel, width of this processor and state.
static inline void for_all_cloth(ClothCheck* check) {
	for (int which = 0; which < JN_CLOTH_COUNT; which++)
		for (int width = 2; width <= 8; width *= 2) {
			if (jn_cloth_kernel(which, width) == NULL) continue;
			for (int state = 0; state < CLOTH_STATES; state++) {
				ClothSample s = cloth_sample(which, width, state, (uint64_t)(100 * which + state));
				check(&s, which, state);
				jn_arena_free(&s.arena);
			}
		}
}

#endif
