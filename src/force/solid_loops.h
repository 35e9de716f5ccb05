/// @file solid_loops.h
/// The loops over batches, points and nodes in double precision. Element and law are compile-time constants of these
/// always-inline functions, so that each instance is straight vector code. With x_i, p_i measured from the last node:
///
///   J = sum_i x_i (x) dN_i/dxi,  F = J L,  f_i = -w P L^T dN_i/dxi,  K_ij = w (g_i . dP/dF . g_j),  g_i = L^T dN_i/dxi
///
/// F and g_i are those of the rest state turned by the rotation Q of kernel.h. jacobian.h takes the sums over nodes.
#ifndef JN_FORCE_SOLID_LOOPS_H
#define JN_FORCE_SOLID_LOOPS_H

#include "force/element_loops.h"
#include "force/jacobian.h"
#include "force/kernel.h"
#include "force/material/definite.h"
#include "force/material/diagonal.h"

typedef void WideFreeze(double* frozen, const WideMat3* F);

enum { REST_REALS = 7 };

/// A point of a batch: its rest data and its deformation gradient.
typedef struct Point {
	Wide L[6];
	Wide weight;
	WideMat3 F;
} Point;

JN_INLINE const double* rest_at(const JnGroup* group, int batch, int p) {
	const ptrdiff_t point = group->rest_points == 1 ? batch : (ptrdiff_t)batch * group->rest_points + p;
	return group->rest + point * REST_REALS * JN_WIDE;
}

JN_INLINE void point_load(const JnGroup* group, JnShape shape, int batch, int p, const Jacobians* jacobians,
						  Point* point) {
	const double* rest = rest_at(group, batch, p);
	JN_UNROLL for (int k = 0; k < 6; k++) point->L[k] = wide_load(rest + k * JN_WIDE);
	point->weight = wide_load(rest + 6 * JN_WIDE);
	Wide J[3][3];
	jacobian_at(shape, jacobians, p, J);
	times_lower(J, point->L, point->F.at);
}

JN_INLINE double* point_frozen(const JnGroup* group, const JnElement* element, int batch, int p, int frozen_reals) {
	if (frozen_reals == 0) return NULL;
	return group->frozen + ((ptrdiff_t)batch * element->points + p) * frozen_reals * JN_WIDE;
}

/// The longer parts of an element's loops, each compiled once and called directly where the call is lost in the work.
typedef struct ElementCode {
	void (*gather)(const JnGroup* group, int batch, const double* x, Jacobians* jacobians);
	void (*nodes)(const Jacobians* jacobians, double* out);
	void (*load)(const JnGroup* group, int batch, int p, const Jacobians* jacobians, Point* point);
	void (*add)(int p, const Point* point, const WideTangent* A, double* blocks);
	void (*complete)(double* blocks);
} ElementCode;

JN_INLINE void gather_jacobians(const JnGroup* group, const JnElement* element, JnShape shape, int batch,
								const double* x, Jacobians* jacobians) {
	Wide edges[JN_ELEMENT_NODES][3];
	gather_edges(group, element, batch, x, edges);
	jacobians_of(shape, edges, jacobians);
}

/// out[3 * nodes][lane] from the factors of the Jacobians.
JN_INLINE void store_nodes(const JnElement* element, JnShape shape, const Jacobians* jacobians, double* out) {
	Wide node[JN_ELEMENT_NODES][3];
	nodes_of(shape, jacobians, node);
	JN_UNROLL for (int i = 0; i < 3 * element->nodes; i++) wide_store(out + i * JN_WIDE, node[i / 3][i % 3]);
}

JN_INLINE void energy_loop(const JnGroup* group, int first, int last, const double* x, double* out,
						   const JnElement* element, const ElementCode* code, int frozen_reals, WideEnergy* energy) {
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians;
		Wide sum = wide_set(0);
		code->gather(group, batch, x, &jacobians);
		for (int p = 0; p < element->points; p++) {
			Point point;
			code->load(group, batch, p, &jacobians, &point);
			const double* frozen = point_frozen(group, element, batch, p, frozen_reals);
			sum = wide_fma(point.weight, energy(group->constants, frozen, &point.F), sum);
		}
		wide_store(out + (ptrdiff_t)(batch - first) * JN_WIDE, sum);
	}
}

/// sums += scale P L^T at a point.
JN_INLINE void add_stress(JnShape shape, int p, const Point* point, Wide scale, WideMat3* P, Jacobians* sums) {
	Wide G[3][3], L[6];
	JN_UNROLL for (int k = 0; k < 6; k++) L[k] = scale * point->L[k];
	times_upper(P->at, L, G);
	jacobian_add(shape, sums, p, G);
}

JN_INLINE void force_loop(const JnGroup* group, int first, int last, const double* x, double* out,
						  const JnElement* element, JnShape shape, const ElementCode* code, int frozen_reals,
						  WideStress* stress) {
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians, sums;
		code->gather(group, batch, x, &jacobians);
		jacobians_clear(shape, &sums);
		for (int p = 0; p < element->points; p++) {
			Point point;
			WideMat3 P;
			point_load(group, shape, batch, p, &jacobians, &point);
			stress(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, &P);
			add_stress(shape, p, &point, -point.weight, &P, &sums);
		}
		code->nodes(&sums, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

/// As law.h's linearize: all of dP/dF.
JN_INLINE void store_whole(const double* constants, const double* frozen, const WideMat3* F, Wide stored[],
						   WideTangentOf* tangent) {
	WideTangent A;
	tangent(constants, frozen, F, &A);
	JN_UNROLL for (int ac = 0; ac < 9; ac++) {
		JN_UNROLL for (int bd = 0; bd < 9; bd++) {
			if (bd <= ac) stored[ac * (ac + 1) / 2 + bd] = A.at[ac][bd];
		}
	}
}

JN_INLINE void product_loop(const JnGroup* group, int first, int last, const double* x, const double* direction,
							double* out, const JnElement* element, JnShape shape, const ElementCode* code,
							int frozen_reals, WideLinearize* linearize, RealDifferential* differential) {
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians, change, sums;
		code->gather(group, batch, x, &jacobians);
		code->gather(group, batch, direction, &change);
		jacobians_clear(shape, &sums);
		for (int p = 0; p < element->points; p++) {
			Point point;
			Wide stored[WHOLE_REALS], dJ[3][3], D[3][3];
			WideMat3 dP;
			point_load(group, shape, batch, p, &jacobians, &point);
			linearize(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, stored);
			jacobian_at(shape, &change, p, dJ);
			times_lower(dJ, point.L, D);
			differential(group->constants, stored, D, dP.at);
			add_stress(shape, p, &point, point.weight, &dP, &sums);
		}
		code->nodes(&sums, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

/// JnKernel.store.
JN_INLINE void store_loop(const JnGroup* group, int first, int last, const double* x, float* stored,
						  const JnElement* element, JnShape shape, const ElementCode* code, int frozen_reals,
						  int stored_reals, WideLinearize* linearize) {
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians;
		code->gather(group, batch, x, &jacobians);
		for (int p = 0; p < element->points; p++) {
			Point point;
			Wide numbers[WHOLE_REALS];
			point_load(group, shape, batch, p, &jacobians, &point);
			linearize(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, numbers);
			float* to = stored + ((ptrdiff_t)(batch / 2) * element->points + p) * stored_reals * JN_WIDE_FLOATS +
						batch % 2 * JN_WIDE;
			JN_UNROLL for (int k = 0; k < stored_reals; k++) wide_store_rounded(to + k * JN_WIDE_FLOATS, numbers[k]);
		}
	}
}

/// Column j of the point's K, times the weight: T[ac][b] = w sum_d A[ac][bd] g_j[d].
JN_INLINE void tangent_column(const WideTangent* A, const Wide g[3], Wide T[9][3]) {
	JN_UNROLL for (int ac = 0; ac < 9; ac++) {
		JN_UNROLL for (int b = 0; b < 3; b++) {
			Wide entry[3];
			JN_UNROLL for (int d = 0; d < 3; d++) {
				const int bd = 3 * b + d;
				entry[d] = bd > ac ? A->at[bd][ac] : A->at[ac][bd];
			}
			T[ac][b] = wide_dot3(entry[0], g[0], entry[1], g[1], entry[2], g[2]);
		}
	}
}

/// dN_i/dX = L^T dN_i/dxi of all nodes but the last.
JN_INLINE void point_gradients(const JnElement* element, int p, const Wide L[6], Wide g[][3]) {
	JN_UNROLL for (int node = 0; node < element->nodes - 1; node++) {
		const double* dN = element->gradient[p][node];
		g[node][0] = wide_dot3(L[0], wide_set(dN[0]), L[1], wide_set(dN[1]), L[3], wide_set(dN[2]));
		g[node][1] = wide_fma(L[2], wide_set(dN[1]), L[4] * wide_set(dN[2]));
		g[node][2] = L[5] * wide_set(dN[2]);
	}
}

/// Add the point's share to the blocks of all pairs without the last node.
JN_INLINE void add_tangent(const JnElement* element, int p, const Point* point, const WideTangent* A, double* blocks) {
	Wide g[JN_ELEMENT_NODES][3];
	point_gradients(element, p, point->L, g);
	for (int j = 0; j < element->nodes - 1; j++) {
		Wide T[9][3], weighted[3];
		JN_UNROLL for (int d = 0; d < 3; d++) weighted[d] = point->weight * g[j][d];
		tangent_column(A, weighted, T);
		for (int i = j; i < element->nodes - 1; i++) {
			double* block = blocks + (ptrdiff_t)pair_index(i, j) * 9 * JN_WIDE;
			JN_UNROLL for (int ab = 0; ab < 9; ab++) {
				const int a = ab / 3, b = ab % 3;
				Wide sum = wide_load(block + ab * JN_WIDE);
				JN_UNROLL for (int c = 0; c < 3; c++) sum = wide_fma(g[i][c], T[3 * a + c][b], sum);
				wide_store(block + ab * JN_WIDE, sum);
			}
		}
	}
}

/// `tangent` gives dP/dF at a point and is compiled once too.
JN_INLINE void tangent_loop(const JnGroup* group, int first, int last, const double* x, double* out,
							const JnElement* element, const ElementCode* code, int frozen_reals,
							WideTangentOf* tangent) {
	const ptrdiff_t reals = (ptrdiff_t)element->nodes * (element->nodes + 1) / 2 * 9 * JN_WIDE;
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians;
		code->gather(group, batch, x, &jacobians);
		double* blocks = out + (batch - first) * reals;
		for (ptrdiff_t i = 0; i < reals; i += JN_WIDE) wide_store(blocks + i, wide_set(0));
		for (int p = 0; p < element->points; p++) {
			Point point;
			WideTangent A;
			code->load(group, batch, p, &jacobians, &point);
			tangent(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, &A);
			code->add(p, &point, &A, blocks);
		}
		code->complete(blocks);
	}
}

/// JnKernel.diagonal.
JN_INLINE void diagonal_loop(const JnGroup* group, int first, int last, const double* x, double* out,
							 const JnElement* element, JnShape shape, const ElementCode* code, int frozen_reals,
							 WideLinearize* linearize, WideDiagonal* diagonal) {
	const int end = element->nodes - 1;
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians;
		Wide blocks[JN_ELEMENT_NODES][6];
		code->gather(group, batch, x, &jacobians);
		for (int i = 0; i <= end; i++) JN_UNROLL for (int k = 0; k < 6; k++) blocks[i][k] = wide_set(0);
		for (int p = 0; p < element->points; p++) {
			Point point;
			Wide stored[WHOLE_REALS], g[JN_ELEMENT_NODES][3];
			point_load(group, shape, batch, p, &jacobians, &point);
			linearize(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, stored);
			point_gradients(element, p, point.L, g);
			JN_UNROLL for (int c = 0; c < 3; c++) {
				g[end][c] = -g[0][c];
				JN_UNROLL for (int i = 1; i < end; i++) g[end][c] -= g[i][c];
			}
			for (int i = 0; i <= end; i++) diagonal(group->constants, stored, point.weight, g[i], blocks[i]);
		}
		for (int i = 0; i <= end; i++, out += 6 * JN_WIDE)
			JN_UNROLL for (int k = 0; k < 6; k++) wide_store(out + k * JN_WIDE, blocks[i][k]);
	}
}

JN_INLINE void freeze_loop(JnGroup* group, int first, int last, const double* x, const JnElement* element,
						   const ElementCode* code, int frozen_reals, WideFreeze* freeze) {
	for (int batch = first; batch < last; batch++) {
		Jacobians jacobians;
		code->gather(group, batch, x, &jacobians);
		for (int p = 0; p < element->points; p++) {
			Point point;
			code->load(group, batch, p, &jacobians, &point);
			freeze(point_frozen(group, element, batch, p, frozen_reals), &point.F);
		}
	}
}

#endif
