/// @file solid_loops.h
/// The loops over batches, points and nodes. Element and law are compile-time constants of these always-inline
/// functions, so that each instance is straight vector code:
///
///   J = sum_i (x_i - x_last) (x) dN_i/dxi,  F = J J0^-1,  f_i = -w P J0^-T dN_i,  K_ij = w (g_i . dP/dF . g_j)
///
/// with g_i = J0^-T dN_i/dxi = dN_i/dX. The sum of all gradients is 0: the last node follows from the others.
#ifndef JN_FORCE_SOLID_LOOPS_H
#define JN_FORCE_SOLID_LOOPS_H

#include "force/element.h"
#include "force/kernel.h"
#include "force/material/definite.h"

typedef void WideFreeze(double* frozen, const WideMat3* F);

enum { REST_REALS = 10 };

/// A point of a batch: its rest data and the group's memory of it.
typedef struct Point {
	WideMat3 inverse; ///< J0^-1
	Wide weight;
	WideMat3 F;
} Point;

JN_INLINE void gather_edges(const JnGroup* group, const JnElement* element, int batch, const double* x,
							Wide edges[][3]) {
	const int* nodes = group->nodes + (ptrdiff_t)batch * element->nodes * JN_WIDE;
	const int* last = nodes + (element->nodes - 1) * JN_WIDE;
	const Wide origin[3] = {wide_gather(x, 3, last), wide_gather(x + 1, 3, last), wide_gather(x + 2, 3, last)};
	JN_UNROLL for (int i = 0; i < element->nodes - 1; i++) {
		JN_UNROLL for (int a = 0; a < 3; a++) edges[i][a] = wide_gather(x + a, 3, nodes + i * JN_WIDE) - origin[a];
	}
}

JN_INLINE void point_load(const JnGroup* group, const JnElement* element, int batch, int p, Wide edges[][3],
						  Point* point) {
	const double* rest = group->rest + ((ptrdiff_t)batch * element->points + p) * REST_REALS * JN_WIDE;
	JN_UNROLL for (int i = 0; i < 9; i++) point->inverse.at[i / 3][i % 3] = wide_load(rest + i * JN_WIDE);
	point->weight = wide_load(rest + 9 * JN_WIDE);
	WideMat3 J;
	JN_UNROLL for (int i = 0; i < 9; i++) J.at[i / 3][i % 3] = edges[0][i / 3] * element->gradient[p][0][i % 3];
	JN_UNROLL for (int node = 1; node < element->nodes - 1; node++) {
		JN_UNROLL for (int i = 0; i < 9; i++) {
			Wide* entry = &J.at[i / 3][i % 3];
			*entry = wide_fma(edges[node][i / 3], wide_set(element->gradient[p][node][i % 3]), *entry);
		}
	}
	point->F = wide_mat3_multiply(&J, &point->inverse);
}

JN_INLINE double* point_frozen(const JnGroup* group, const JnElement* element, int batch, int p, int frozen_reals) {
	if (frozen_reals == 0) return NULL;
	return group->frozen + ((ptrdiff_t)batch * element->points + p) * frozen_reals * JN_WIDE;
}

/// The longer parts of an element's loops, each compiled once and called directly where the call is lost in the work.
typedef struct ElementCode {
	void (*gather)(const JnGroup* group, int batch, const double* x, Wide edges[][3]);
	void (*load)(const JnGroup* group, int batch, int p, Wide edges[][3], Point* point);
	void (*add)(int p, const Point* point, const WideTangent* A, double* blocks);
	void (*complete)(double* blocks);
} ElementCode;

JN_INLINE void energy_loop(const JnGroup* group, int first, int last, const double* x, double* out,
						   const JnElement* element, const ElementCode* code, int frozen_reals, WideEnergy* energy) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[JN_ELEMENT_NODES][3], sum = wide_set(0);
		code->gather(group, batch, x, edges);
		for (int p = 0; p < element->points; p++) {
			Point point;
			code->load(group, batch, p, edges, &point);
			const double* frozen = point_frozen(group, element, batch, p, frozen_reals);
			sum = wide_fma(point.weight, energy(group->constants, frozen, &point.F), sum);
		}
		wide_store(out + (ptrdiff_t)(batch - first) * JN_WIDE, sum);
	}
}

JN_INLINE void store_forces(const JnElement* element, Wide force[][3], double* out) {
	JN_UNROLL for (int a = 0; a < 3; a++) {
		Wide sum = wide_set(0);
		JN_UNROLL for (int node = 0; node < element->nodes - 1; node++) {
			wide_store(out + (3 * node + a) * JN_WIDE, force[node][a]);
			sum -= force[node][a];
		}
		wide_store(out + (3 * (element->nodes - 1) + a) * JN_WIDE, sum);
	}
}

JN_INLINE void force_loop(const JnGroup* group, int first, int last, const double* x, double* out,
						  const JnElement* element, int frozen_reals, WideStress* stress) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[JN_ELEMENT_NODES][3], force[JN_ELEMENT_NODES][3];
		gather_edges(group, element, batch, x, edges);
		JN_UNROLL for (int node = 0; node < element->nodes - 1; node++) {
			JN_UNROLL for (int a = 0; a < 3; a++) force[node][a] = wide_set(0);
		}
		for (int p = 0; p < element->points; p++) {
			Point point;
			point_load(group, element, batch, p, edges, &point);
			WideMat3 P;
			stress(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, &P);
			JN_UNROLL for (int i = 0; i < 9; i++) P.at[i / 3][i % 3] *= -point.weight;
			const WideMat3 G = wide_mat3_multiply_transposed(&P, &point.inverse);
			JN_UNROLL for (int node = 0; node < element->nodes - 1; node++) {
				JN_UNROLL for (int i = 0; i < 9; i++) {
					Wide* entry = &force[node][i / 3];
					*entry = wide_fma(G.at[i / 3][i % 3], wide_set(element->gradient[p][node][i % 3]), *entry);
				}
			}
		}
		store_forces(element, force, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

JN_INLINE int pair_index(int i, int j) {
	return i * (i + 1) / 2 + j;
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

/// Add the point's share to the blocks of all pairs without the last node.
JN_INLINE void add_tangent(const JnElement* element, int p, const Point* point, const WideTangent* A, double* blocks) {
	Wide g[JN_ELEMENT_NODES][3];
	JN_UNROLL for (int node = 0; node < element->nodes - 1; node++) {
		const double* dN = element->gradient[p][node];
		JN_UNROLL for (int c = 0; c < 3; c++) {
			g[node][c] = wide_dot3(point->inverse.at[0][c], wide_set(dN[0]), point->inverse.at[1][c], wide_set(dN[1]),
								   point->inverse.at[2][c], wide_set(dN[2]));
		}
	}
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

/// The rows of the last node from those of the others: all columns of K sum to 0. Diagonal blocks made symmetric.
JN_INLINE void complete_tangent(const JnElement* element, double* blocks) {
	const int n = element->nodes, last = n - 1;
	for (int node = 0; node < last; node++) {
		double* block = blocks + (ptrdiff_t)pair_index(node, node) * 9 * JN_WIDE;
		JN_UNROLL for (int a = 0; a < 2; a++) {
			JN_UNROLL for (int b = a + 1; b < 3; b++) {
				wide_store(block + (3 * a + b) * JN_WIDE, wide_load(block + (3 * b + a) * JN_WIDE));
			}
		}
	}
	for (int j = 0; j < n; j++) {
		JN_UNROLL for (int ab = 0; ab < 9; ab++) {
			const int ba = ab % 3 * 3 + ab / 3;
			Wide sum = wide_set(0);
			for (int i = 0; i < last; i++) {
				const int pair = i >= j ? pair_index(i, j) : pair_index(j, i);
				sum -= wide_load(blocks + ((ptrdiff_t)pair * 9 + (i >= j ? ab : ba)) * JN_WIDE);
			}
			wide_store(blocks + ((ptrdiff_t)pair_index(last, j) * 9 + ab) * JN_WIDE, sum);
		}
	}
}

/// `tangent` gives dP/dF at a point and is compiled once too.
JN_INLINE void tangent_loop(const JnGroup* group, int first, int last, const double* x, double* out,
							const JnElement* element, const ElementCode* code, int frozen_reals,
							WideTangentOf* tangent) {
	const ptrdiff_t reals = (ptrdiff_t)element->nodes * (element->nodes + 1) / 2 * 9 * JN_WIDE;
	for (int batch = first; batch < last; batch++) {
		Wide edges[JN_ELEMENT_NODES][3];
		code->gather(group, batch, x, edges);
		double* blocks = out + (batch - first) * reals;
		for (ptrdiff_t i = 0; i < reals; i += JN_WIDE) wide_store(blocks + i, wide_set(0));
		for (int p = 0; p < element->points; p++) {
			Point point;
			WideTangent A;
			code->load(group, batch, p, edges, &point);
			tangent(group->constants, point_frozen(group, element, batch, p, frozen_reals), &point.F, &A);
			code->add(p, &point, &A, blocks);
		}
		code->complete(blocks);
	}
}

JN_INLINE void freeze_loop(JnGroup* group, int first, int last, const double* x, const JnElement* element,
						   const ElementCode* code, int frozen_reals, WideFreeze* freeze) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[JN_ELEMENT_NODES][3];
		code->gather(group, batch, x, edges);
		for (int p = 0; p < element->points; p++) {
			Point point;
			code->load(group, batch, p, edges, &point);
			freeze(point_frozen(group, element, batch, p, frozen_reals), &point.F);
		}
	}
}

#endif
