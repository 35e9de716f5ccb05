// Products with K in single precision from stored numbers (JnKernel.store): K p = sum over points of sqrt(w) dP (sqrt(w) L)^T
// with dP = dP/dF : (dJ sqrt(w) L). Two batches of doubles are one batch of floats.
#define JN_SINGLE

#include "force/solid_single.h"

#include "force/jacobian.h"
#include "force/material/corotated.h"
#include "force/material/corotated_frozen.h"
#include "force/material/linear.h"
#include "force/material/neo_hookean.h"
#include "force/material/st_venant_kirchhoff.h"
#include "force/material/stable_neo_hookean.h"

#include "force/material/differential.h"

#define INLINE JN_INLINE

/// Directions at the nodes of two batches, from the last node.
INLINE void gather(const JnGroup* group, const JnElement* element, int batch, const float* p, Real edges[][3]) {
	const ptrdiff_t reals = (ptrdiff_t)element->nodes * JN_WIDE;
	const int *nodes = group->nodes + batch * reals, *second = batch + 1 < group->batches ? nodes + reals : nodes;
	const int end = (element->nodes - 1) * JN_WIDE;
	Real origin[3];
	wide_float_gather(p, nodes + end, second + end, origin);
	JN_UNROLL for (int i = 0; i < element->nodes - 1; i++) {
		wide_float_gather(p, nodes + i * JN_WIDE, second + i * JN_WIDE, edges[i]);
		JN_UNROLL for (int a = 0; a < 3; a++) edges[i][a] -= origin[a];
	}
}

INLINE void product_loop(const JnGroup* group, int first, int last, const float* stored, const float* p, float* out,
						 const JnElement* element, JnShape shape, int stored_reals, RealDifferential* differential) {
	const int step = group->rest_points == 1 ? 0 : 6 * JN_REALS;
	for (int batch = first; batch < last; batch += 2, out += 3 * element->nodes * JN_REALS) {
		Jacobians change, sums;
		Real edges[JN_ELEMENT_NODES][3], nodes[JN_ELEMENT_NODES][3];
		gather(group, element, batch, p, edges);
		jacobians_of(shape, edges, &change);
		jacobians_clear(shape, &sums);
		const float* rest = group->rest_single + (ptrdiff_t)(batch / 2) * group->rest_points * 6 * JN_REALS;
		const float* from = stored + (ptrdiff_t)((batch - first) / 2) * element->points * stored_reals * JN_REALS;
		for (int point = 0; point < element->points; point++, rest += step, from += stored_reals * JN_REALS) {
			Real L[6], numbers[WHOLE_REALS], J[3][3], D[3][3], dP[3][3], G[3][3];
			JN_UNROLL for (int k = 0; k < 6; k++) L[k] = real_load(rest + k * JN_REALS);
			JN_UNROLL for (int k = 0; k < stored_reals; k++) numbers[k] = real_load(from + k * JN_REALS);
			jacobian_at(shape, &change, point, J);
			times_lower(J, L, D);
			differential(group->constants, numbers, D, dP);
			times_upper(dP, L, G);
			jacobian_add(shape, &sums, point, G);
		}
		nodes_of(shape, &sums, nodes);
		JN_UNROLL for (int i = 0; i < 3 * element->nodes; i++) real_store(out + i * JN_REALS, nodes[i / 3][i % 3]);
	}
}

#define DEFINE_WHOLE(shape, index)                                                                                     \
	JN_SHARED void shape##_whole(const JnGroup* group, int first, int last, const float* stored, const float* p,       \
								 float* out) {                                                                         \
		product_loop(group, first, last, stored, p, out, &jn_element_##shape, index, WHOLE_REALS, whole_differential); \
	}
DEFINE_WHOLE(tet4, JN_TET4)
DEFINE_WHOLE(tet10, JN_TET10)
DEFINE_WHOLE(hex8, JN_HEX8)

#define DEFINE_PAIR(shape, index, law, frozen_reals, is_convex)                                                        \
	void JN_PRODUCT_SINGLE(shape, law)(const JnGroup* group, int first, int last, bool definite, const float* stored,  \
									   const float* p, float* out) {                                                   \
		if (definite && !(is_convex)) {                                                                                \
			shape##_whole(group, first, last, stored, p, out);                                                         \
		} else {                                                                                                       \
			product_loop(group, first, last, stored, p, out, &jn_element_##shape, index, law##_STORED,                 \
						 law##_differential);                                                                          \
		}                                                                                                              \
	}
#define DEFINE_PAIRS(law, frozen_reals, is_convex) JN_ON_SOLID_SHAPES(DEFINE_PAIR, law, frozen_reals, is_convex)
JN_SOLID_LAWS(DEFINE_PAIRS)
