// Relaxation for JN_WIDE lanes, compiled once a vector width; exports the table jn_relax_kernels_<width>. Equations 17 and 18
// of Macklin, Mueller, Chentanez (XPBD, 2016); see pass/relax.c.
#include "force/element_loops.h"
#include "force/relax.h"
#include "force/relax_measure.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

enum { MOST_NODES = JN_RELAX_MOST_NODES };

typedef Wide Measure(const double* rest, Wide edges[][3], Wide gradient[][3], Wide* size);

JN_INLINE const double* rest_of(const JnGroup* group, int batch, int reals) {
	return group->rest + (ptrdiff_t)batch * reals * JN_WIDE;
}

JN_INLINE WideMask is_padding(const double* rest, int reals) {
	return wide_load(rest + (reals - 1) * JN_WIDE) == wide_set(0);
}

JN_INLINE void add_lanes(const int* nodes, int a, Wide step, double* x) {
	double lanes[JN_WIDE];
	wide_store(lanes, step);
	for (int lane = 0; lane < JN_WIDE; lane++) x[3 * (ptrdiff_t)nodes[lane] + a] += lanes[lane];
}

// step = w g of each node, and the sum of w |g|^2; the last gradient is minus the sum of the others.
JN_INLINE Wide weigh(const JnElement* element, const int* nodes, const double* inverse_mass, Wide g[][3],
					 Wide step[][3]) {
	const int last = element->nodes - 1;
	Wide sum = wide_set(0);
	JN_UNROLL for (int a = 0; a < 3; a++) {
		g[last][a] = wide_set(0);
		JN_UNROLL for (int i = 0; i < last; i++) g[last][a] -= g[i][a];
		JN_UNROLL for (int i = 0; i <= last; i++) {
			step[i][a] = g[i][a] * wide_gather(inverse_mass + a, 3, nodes + i * JN_WIDE);
			sum = wide_fma(step[i][a], g[i][a], sum);
		}
	}
	return sum;
}

// Elements of a batch share no node, so that all of them at once are as one behind the other: Gauss-Seidel.
JN_INLINE void relax(const JnGroup* group, int first, int last, const JnRelaxation* how, double* x, double* lambda,
					 const JnElement* element, int reals, Measure* measure) {
	const Wide compliance = wide_set(how->compliance), zero = wide_set(0);
	for (int batch = first; batch < last; batch++) {
		const int* nodes = group->nodes + (ptrdiff_t)batch * element->nodes * JN_WIDE;
		const double* rest = rest_of(group, batch, reals);
		double* sum = lambda + (ptrdiff_t)batch * JN_WIDE;
		Wide edges[MOST_NODES - 1][3], g[MOST_NODES][3], step[MOST_NODES][3], size;
		gather_edges(group, element, batch, x, edges);
		const Wide C = measure(rest, edges, g, &size), total = wide_load(sum);
		const Wide give = weigh(element, nodes, how->inverse_mass, g, step) + compliance;
		const WideMask moves = (give > zero) & ~is_padding(rest, reals);
		const Wide pull = how->factor * wide_fma(compliance, total, C) / wide_select(moves, give, zero + 1);
		const Wide d = wide_select(moves, -pull, zero);
		wide_store(sum, total + d);
		JN_UNROLL for (int i = 0; i < element->nodes; i++) {
			JN_UNROLL for (int a = 0; a < 3; a++) add_lanes(nodes + i * JN_WIDE, a, step[i][a] * d, x);
		}
	}
}

JN_INLINE void strain(const JnGroup* group, int first, int last, const double* x, double* out, const JnElement* element,
					  int reals, Measure* measure) {
	for (int batch = first; batch < last; batch++) {
		const double* rest = rest_of(group, batch, reals);
		Wide edges[MOST_NODES - 1][3], g[MOST_NODES][3], size;
		gather_edges(group, element, batch, x, edges);
		const Wide C = measure(rest, edges, g, &size) / size;
		wide_store(out + (ptrdiff_t)(batch - first) * JN_WIDE, wide_select(is_padding(rest, reals), wide_set(0), C));
	}
}

#define DEFINE(name, nodes_of, reals)                                                                                  \
	static const JnElement name##_element = {.nodes = (nodes_of), .points = 1};                                        \
	static void relax_##name(const JnGroup* group, int first, int last, const JnRelaxation* how, double* x,            \
							 double* lambda) {                                                                         \
		relax(group, first, last, how, x, lambda, &name##_element, reals, name##_measure);                             \
	}                                                                                                                  \
	static void strain_##name(const JnGroup* group, int first, int last, const double* x, double* out) {               \
		strain(group, first, last, x, out, &name##_element, reals, name##_measure);                                    \
	}
JN_RELAX_KERNELS(DEFINE)

#define KERNEL(kernel_name, nodes_of, reals)                                                                           \
	[JN_RELAX_##kernel_name] = {                                                                                       \
		.name = #kernel_name,                                                                                          \
		.width = JN_WIDE,                                                                                              \
		.nodes = (nodes_of),                                                                                           \
		.points = 1,                                                                                                   \
		.rest_reals = (reals),                                                                                         \
		.relax = relax_##kernel_name,                                                                                  \
		.strain = strain_##kernel_name,                                                                                \
	},

const JnRelaxKernels JOIN(jn_relax_kernels_, JN_WIDE) = {JN_RELAX_KERNELS(KERNEL)};
