// The kernels of cloth for JN_WIDE lanes, compiled once a vector width; exports the table jn_cloth_kernels_<width>. An
// element is known by the edges from its last node: its forces sum to zero, and the last node follows from the others.
#include "force/cloth/bend.h"
#include "force/cloth/cloth.h"
#include "force/cloth/shear.h"
#include "force/cloth/spring.h"
#include "force/cloth/stretch.h"
#include "force/solid_loops.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

enum { MOST_EDGES = 3 };

/// What a kernel is made of: compile-time constants of the loops below. Blocks are those without the last node.
typedef Wide ClothEnergy(const double* rest, Wide edges[][3]);
typedef void ClothForce(const double* rest, Wide edges[][3], Wide force[][3]);
typedef void ClothTangent(const double* rest, Wide edges[][3], bool definite, double* blocks);
typedef void ClothProduct(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]);

JN_INLINE const double* rest_of(const JnGroup* group, int batch, int reals) {
	return group->rest + (ptrdiff_t)batch * reals * JN_WIDE;
}

JN_INLINE void cloth_energy(const JnGroup* group, int first, int last, const double* x, double* out,
							const JnElement* element, int reals, ClothEnergy* energy) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3];
		gather_edges(group, element, batch, x, edges);
		wide_store(out + (ptrdiff_t)(batch - first) * JN_WIDE, energy(rest_of(group, batch, reals), edges));
	}
}

JN_INLINE void cloth_force(const JnGroup* group, int first, int last, const double* x, double* out,
						   const JnElement* element, int reals, ClothForce* force) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3], f[MOST_EDGES][3];
		gather_edges(group, element, batch, x, edges);
		force(rest_of(group, batch, reals), edges, f);
		store_forces(element, f, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

JN_INLINE void cloth_tangent(const JnGroup* group, int first, int last, const double* x, bool definite, double* out,
							 const JnElement* element, int reals, ClothTangent* tangent) {
	const ptrdiff_t size = (ptrdiff_t)element->nodes * (element->nodes + 1) / 2 * 9 * JN_WIDE;
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3];
		double* blocks = out + (batch - first) * size;
		gather_edges(group, element, batch, x, edges);
		tangent(rest_of(group, batch, reals), edges, definite, blocks);
		complete_tangent(element, blocks);
	}
}

JN_INLINE void cloth_product(const JnGroup* group, int first, int last, const double* x, bool definite, const double* p,
							 double* out, const JnElement* element, int reals, ClothProduct* product) {
	for (int batch = first; batch < last; batch++) {
		Wide edges[MOST_EDGES][3], moved[MOST_EDGES][3], result[MOST_EDGES][3];
		gather_edges(group, element, batch, x, edges);
		gather_edges(group, element, batch, p, moved);
		product(rest_of(group, batch, reals), edges, definite, moved, result);
		store_forces(element, result, out + (ptrdiff_t)(batch - first) * 3 * element->nodes * JN_WIDE);
	}
}

#define DEFINE(name, nodes_of, reals, weights)                                                                         \
	static const JnElement name##_element = {.nodes = (nodes_of), .points = 1};                                        \
	static void run_##name##_energy(const JnGroup* group, int first, int last, const double* x, double* out) {         \
		cloth_energy(group, first, last, x, out, &name##_element, reals, name##_energy);                               \
	}                                                                                                                  \
	static void run_##name##_force(const JnGroup* group, int first, int last, const double* x, double* out) {          \
		cloth_force(group, first, last, x, out, &name##_element, reals, name##_force);                                 \
	}                                                                                                                  \
	static void run_##name##_tangent(const JnGroup* group, int first, int last, const double* x, bool definite,        \
									 double* out) {                                                                    \
		if (definite) {                                                                                                \
			cloth_tangent(group, first, last, x, true, out, &name##_element, reals, name##_tangent);                   \
		} else {                                                                                                       \
			cloth_tangent(group, first, last, x, false, out, &name##_element, reals, name##_tangent);                  \
		}                                                                                                              \
	}                                                                                                                  \
	static void run_##name##_product(const JnGroup* group, int first, int last, const double* x, bool definite,        \
									 const double* p, double* out) {                                                   \
		if (definite) {                                                                                                \
			cloth_product(group, first, last, x, true, p, out, &name##_element, reals, name##_product);                \
		} else {                                                                                                       \
			cloth_product(group, first, last, x, false, p, out, &name##_element, reals, name##_product);               \
		}                                                                                                              \
	}
JN_CLOTH_KERNELS(DEFINE)

#define KERNEL(kernel_name, nodes_of, reals, weights)                                                                  \
	[JN_CLOTH_##kernel_name] = {                                                                                       \
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

const JnClothKernels JOIN(jn_cloth_kernels_, JN_WIDE) = {JN_CLOTH_KERNELS(KERNEL)};
