// The kernels of constraints for JN_WIDE lanes, compiled once a vector width; exports the table
// jn_constraint_kernels_<width>. An element is known by the edges from its last node: its forces sum to zero, and the last
// node follows from the others.
#include "force/constraint/angle.h"
#include "force/constraint/area.h"
#include "force/constraint/bend.h"
#include "force/constraint/constraint.h"
#include "force/constraint/link.h"
#include "force/constraint/shear.h"
#include "force/constraint/spring.h"
#include "force/constraint/stretch.h"
#include "force/element_loops.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

enum { MOST_EDGES = JN_CONSTRAINT_MOST_NODES - 1 };

/// What a kernel is made of: compile-time constants of the loops below. Blocks are those without the last node.
typedef Wide ConstraintEnergy(const double* rest, Wide edges[][3]);
typedef void ConstraintForce(const double* rest, Wide edges[][3], Wide force[][3]);
typedef void ConstraintTangent(const double* rest, Wide edges[][3], bool definite, double* blocks);
typedef void ConstraintProduct(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]);

/// Edges from the last node. Elements of two frames have nodes n, n + 1, n + 2 in each (thread.h): nine numbers in a row.
JN_INLINE void edges_of(const JnGroup* group, const JnElement* element, int batch, const double* x, Wide edges[][3]) {
	if (element->nodes != LINK_NODES) {
		gather_edges(group, element, batch, x, edges);
		return;
	}
	const int* nodes = group->nodes + (ptrdiff_t)batch * LINK_NODES * JN_WIDE;
	Wide at[2][9];
	JN_UNROLL for (int frame = 0; frame < 2; frame++) {
		const double* rows[JN_WIDE];
		JN_UNROLL for (int lane = 0; lane < JN_WIDE; lane++) rows[lane] =
			x + 3 * (ptrdiff_t)nodes[3 * frame * JN_WIDE + lane];
		wide_gather_rows(rows, 9, at[frame]);
	}
	JN_UNROLL for (int k = 0; k < 15; k++) edges[k / 3][k % 3] = at[k / 9][k % 9] - at[1][6 + k % 3];
}

JN_INLINE const double* rest_of(const JnGroup* group, int batch, int reals) {
	return group->rest + (ptrdiff_t)batch * reals * JN_WIDE;
}

JN_INLINE void constraint_energy(const JnGroup* group, int first, int last, const double* x, double* out,
								 const JnElement* element, int reals, ConstraintEnergy* energy) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3];
		edges_of(group, element, batch, x, edges);
		wide_store(out + (ptrdiff_t)(batch - first) * JN_WIDE, energy(rest_of(group, batch, reals), edges));
	}
}

JN_INLINE void constraint_force(const JnGroup* group, int first, int last, const double* x, double* out,
								const JnElement* element, int reals, ConstraintForce* force) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3], f[MOST_EDGES][3];
		edges_of(group, element, batch, x, edges);
		force(rest_of(group, batch, reals), edges, f);
		store_forces(element, f, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

JN_INLINE void constraint_tangent(const JnGroup* group, int first, int last, const double* x, bool definite,
								  double* out, const JnElement* element, int reals, ConstraintTangent* tangent) {
	const ptrdiff_t size = (ptrdiff_t)element->nodes * (element->nodes + 1) / 2 * 9 * JN_WIDE;
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3];
		double* blocks = out + (batch - first) * size;
		edges_of(group, element, batch, x, edges);
		tangent(rest_of(group, batch, reals), edges, definite, blocks);
		complete_tangent(element, blocks);
	}
}

JN_INLINE void constraint_product(const JnGroup* group, int first, int last, const double* x, bool definite,
								  const double* p, double* out, const JnElement* element, int reals,
								  ConstraintProduct* product) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3], moved[MOST_EDGES][3], result[MOST_EDGES][3];
		edges_of(group, element, batch, x, edges);
		edges_of(group, element, batch, p, moved);
		product(rest_of(group, batch, reals), edges, definite, moved, result);
		store_forces(element, result, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

#define DEFINE(name, nodes_of, reals, weights)                                                                         \
	static const JnElement name##_element = {.nodes = (nodes_of), .points = 1};                                        \
	static void run_##name##_energy(const JnGroup* group, int first, int last, const double* x, double* out) {         \
		constraint_energy(group, first, last, x, out, &name##_element, reals, name##_energy);                          \
	}                                                                                                                  \
	static void run_##name##_force(const JnGroup* group, int first, int last, const double* x, double* out) {          \
		constraint_force(group, first, last, x, out, &name##_element, reals, name##_force);                            \
	}                                                                                                                  \
	static void run_##name##_tangent(const JnGroup* group, int first, int last, const double* x, bool definite,        \
									 double* out) {                                                                    \
		if (definite) {                                                                                                \
			constraint_tangent(group, first, last, x, true, out, &name##_element, reals, name##_tangent);              \
		} else {                                                                                                       \
			constraint_tangent(group, first, last, x, false, out, &name##_element, reals, name##_tangent);             \
		}                                                                                                              \
	}                                                                                                                  \
	static void run_##name##_product(const JnGroup* group, int first, int last, const double* x, bool definite,        \
									 const double* p, double* out) {                                                   \
		if (definite) {                                                                                                \
			constraint_product(group, first, last, x, true, p, out, &name##_element, reals, name##_product);           \
		} else {                                                                                                       \
			constraint_product(group, first, last, x, false, p, out, &name##_element, reals, name##_product);          \
		}                                                                                                              \
	}
JN_CONSTRAINT_KERNELS(DEFINE)

#define KERNEL(kernel_name, nodes_of, reals, weights)                                                                  \
	[JN_CONSTRAINT_##kernel_name] = {                                                                                  \
		.shape = JN_TRI3,                                                                                              \
		.name = #kernel_name,                                                                                          \
		.width = JN_WIDE,                                                                                              \
		.nodes = (nodes_of),                                                                                           \
		.points = 1,                                                                                                   \
		.rest_reals = (reals),                                                                                         \
		.energy = run_##kernel_name##_energy,                                                                          \
		.force = run_##kernel_name##_force,                                                                            \
		.tangent = run_##kernel_name##_tangent,                                                                        \
		.product = run_##kernel_name##_product,                                                                        \
	},

const JnConstraintKernels JOIN(jn_constraint_kernels_, JN_WIDE) = {JN_CONSTRAINT_KERNELS(KERNEL)};
