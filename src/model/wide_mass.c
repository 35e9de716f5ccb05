// Consistent mass of elements whose Jacobian is constant, in single precision: M p = density volume (a matrix of the shape)
// p, whose sums are taken as the shape has them. Adds to what JnKernel.product_single wrote; exports jn_mass_single_<width>.
#define JN_SINGLE

#include "model/mass_single.h"

#include "force/real.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

enum { REST_REALS = 7, WEIGHT = 6, MOST_NODES = 10 };

/// integral of N_i N_j: (1 + [i = j])/20.
JN_INLINE Real tet4_mass(Real p[][3], int a) {
	const Real sum = (p[0][a] + p[1][a]) + (p[2][a] + p[3][a]);
	JN_UNROLL for (int i = 0; i < 4; ++i) p[i][a] += sum;
	return real_set(1.0 / 20);
}

/// The entries of group.c times 420, with sums over corners, over edges and over the edges at a corner.
JN_INLINE Real tet10_mass(Real p[][3], int a) {
	static const int corner[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}, opposite[6] = {5, 3, 4, 1, 2, 0};
	Real x[10], at[4];
	JN_UNROLL for (int i = 0; i < 10; ++i) x[i] = p[i][a];
	JN_UNROLL for (int i = 0; i < 4; ++i) at[i] = real_set(0);
	JN_UNROLL for (int e = 0; e < 6; ++e) {
		at[corner[e][0]] += x[4 + e];
		at[corner[e][1]] += x[4 + e];
	}
	const Real corners = (x[0] + x[1]) + (x[2] + x[3]), edges = 0.5f * ((at[0] + at[1]) + (at[2] + at[3]));
	JN_UNROLL for (int i = 0; i < 4; ++i) p[i][a] = 5.0f * x[i] + corners + 2.0f * at[i] - 6.0f * edges;
	JN_UNROLL for (int e = 0; e < 6; ++e) {
		const Real ends = x[corner[e][0]] + x[corner[e][1]];
		p[4 + e][a] = 16.0f * (x[4 + e] + edges) - 8.0f * x[4 + opposite[e]] + 2.0f * ends - 6.0f * corners;
	}
	return real_set(1.0 / 420);
}

/// Along each axis (a, b) becomes (2 a + b, a + 2 b)/6.
JN_INLINE Real hex8_mass(Real p[][3], int a) {
	static const int line[12][2] = {{0, 1}, {3, 2}, {4, 5}, {7, 6}, {0, 3}, {1, 2},
									{4, 7}, {5, 6}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
	JN_UNROLL for (int k = 0; k < 12; ++k) {
		const Real x = p[line[k][0]][a], y = p[line[k][1]][a], sum = x + y;
		p[line[k][0]][a] = sum + x;
		p[line[k][1]][a] = sum + y;
	}
	return real_set(1.0 / 216);
}

/// Volumes of a pair of batches; 0 in padding.
JN_INLINE Real volumes(const JnGroup* group, int batch) {
	const double points = group->kernel->points;
	const double* weight = group->rest + ((ptrdiff_t)batch * REST_REALS + WEIGHT) * JN_WIDE;
	float lanes[JN_REALS] = {0};
	wide_store_rounded(lanes, points * wide_load(weight));
	if (batch + 1 < group->batches)
		wide_store_rounded(lanes + JN_WIDE, points * wide_load(weight + REST_REALS * JN_WIDE));
	return real_load(lanes);
}

JN_INLINE void add_mass(const JnGroup* group, int first, int last, double scale, const float* p, float* buffer,
						JnShape shape, int nodes) {
	for (int batch = first; batch < last; batch += 2) {
		const int *at = group->nodes + (ptrdiff_t)batch * nodes * JN_WIDE,
				  *second = batch + 1 < group->batches ? at + nodes * JN_WIDE : at;
		const Real volume = real_set(scale) * volumes(group, batch);
		Real x[MOST_NODES][3];
		JN_UNROLL for (int i = 0; i < nodes; ++i) wide_float_gather(p, at + i * JN_WIDE, second + i * JN_WIDE, x[i]);
		JN_UNROLL for (int a = 0; a < 3; ++a) {
			const Real unit = shape == JN_HEX8    ? hex8_mass(x, a)
							  : shape == JN_TET10 ? tet10_mass(x, a)
												  : tet4_mass(x, a);
			const Real factor = unit * volume;
			JN_UNROLL for (int i = 0; i < nodes; ++i) {
				float* to = buffer + (3 * i + a) * JN_REALS;
				real_store(to, real_fma(factor, x[i][a], real_load(to)));
			}
		}
		buffer += 3 * nodes * JN_REALS;
	}
}

void JOIN(jn_mass_single_, JN_WIDE)(const JnGroup* group, int first, int last, double scale, const float* p,
									float* buffer) {
	if (group->kernel->shape == JN_HEX8)
		add_mass(group, first, last, scale, p, buffer, JN_HEX8, 8);
	else if (group->kernel->shape == JN_TET10)
		add_mass(group, first, last, scale, p, buffer, JN_TET10, 10);
	else
		add_mass(group, first, last, scale, p, buffer, JN_TET4, 4);
}
