// Every (element, law) pair for JN_WIDE lanes. Compiled three times: -DJN_WIDE=8 with AVX-512, 4 with AVX2 and FMA, and
// 2 for any processor; exports the one table jn_solid_kernels_<width>.
#include "force/material/corotated.h"
#include "force/material/corotated_frozen.h"
#include "force/material/linear.h"
#include "force/material/neo_hookean.h"
#include "force/material/st_venant_kirchhoff.h"
#include "force/material/stable_neo_hookean.h"
#include "force/solid.h"
#include "force/solid_loops.h"

#if JN_WIDE > 2 && !JN_HAS_WIDE_KERNELS
	#error "8 and 4 lanes exist on x86-64 only: compile this file with JN_WIDE=2 alone"
#endif

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

/// X(shape, index of the shape, ...the law).
#define ON_ALL_SHAPES(X, law, frozen_reals, is_convex)                                                                 \
	X(tet4, JN_TET4, law, frozen_reals, is_convex)                                                                     \
	X(tet10, JN_TET10, law, frozen_reals, is_convex)                                                                   \
	X(hex8, JN_HEX8, law, frozen_reals, is_convex)

// ---- what is compiled once an element ----

#define DEFINE_ELEMENT(shape)                                                                                          \
	JN_SHARED void shape##_gather(const JnGroup* group, int batch, const double* x, Wide edges[][3]) {                 \
		gather_edges(group, &jn_element_##shape, batch, x, edges);                                                     \
	}                                                                                                                  \
	JN_SHARED void shape##_load(const JnGroup* group, int batch, int p, Wide edges[][3], Point* point) {               \
		point_load(group, &jn_element_##shape, batch, p, edges, point);                                                \
	}                                                                                                                  \
	JN_SHARED void shape##_add_tangent(int p, const Point* point, const WideTangent* A, double* blocks) {              \
		add_tangent(&jn_element_##shape, p, point, A, blocks);                                                         \
	}                                                                                                                  \
	JN_SHARED void shape##_complete_tangent(double* blocks) {                                                          \
		complete_tangent(&jn_element_##shape, blocks);                                                                 \
	}                                                                                                                  \
	static const ElementCode shape##_code = {shape##_gather, shape##_load, shape##_add_tangent,                        \
											 shape##_complete_tangent};
DEFINE_ELEMENT(tet4)
DEFINE_ELEMENT(tet10)
DEFINE_ELEMENT(hex8)

// ---- what is compiled once a law ----

#define DEFINE_LAW(law, frozen_reals, is_convex)                                                                       \
	JN_SHARED void law##_exact(const double* constants, const double* frozen, const WideMat3* F, WideTangent* A) {     \
		law##_tangent(constants, frozen, F, A);                                                                        \
	}                                                                                                                  \
	JN_SHARED void law##_definite(const double* constants, const double* frozen, const WideMat3* F, WideTangent* A) {  \
		if (is_convex) {                                                                                               \
			law##_exact(constants, frozen, F, A);                                                                      \
		} else {                                                                                                       \
			definite_tangent(constants, F, A, law##_exact);                                                            \
		}                                                                                                              \
	}
JN_SOLID_LAWS(DEFINE_LAW)

// ---- the pairs ----

#define DEFINE_PAIR(shape, index, law, frozen_reals, is_convex)                                                        \
	static void shape##_##law##_energy(const JnGroup* group, int first, int last, const double* x, double* out) {      \
		energy_loop(group, first, last, x, out, &jn_element_##shape, &shape##_code, frozen_reals, law##_energy);       \
	}                                                                                                                  \
	static void shape##_##law##_force(const JnGroup* group, int first, int last, const double* x, double* out) {       \
		force_loop(group, first, last, x, out, &jn_element_##shape, frozen_reals, law##_stress);                       \
	}                                                                                                                  \
	static void shape##_##law##_tangent(const JnGroup* group, int first, int last, const double* x, bool definite,     \
										double* out) {                                                                 \
		if (definite) {                                                                                                \
			tangent_loop(group, first, last, x, out, &jn_element_##shape, &shape##_code, frozen_reals,                 \
						 law##_definite);                                                                              \
		} else {                                                                                                       \
			tangent_loop(group, first, last, x, out, &jn_element_##shape, &shape##_code, frozen_reals, law##_exact);   \
		}                                                                                                              \
	}
#define DEFINE_PAIRS(law, frozen_reals, is_convex) ON_ALL_SHAPES(DEFINE_PAIR, law, frozen_reals, is_convex)
JN_SOLID_LAWS(DEFINE_PAIRS)

#define DEFINE_FREEZE(shape)                                                                                           \
	static void shape##_freeze(JnGroup* group, int first, int last, const double* x) {                                 \
		freeze_loop(group, first, last, x, &jn_element_##shape, &shape##_code, 9, corotated_frozen_freeze);            \
	}
DEFINE_FREEZE(tet4)
DEFINE_FREEZE(tet10)
DEFINE_FREEZE(hex8)

enum {
#define NAME_LAW(law, frozen_reals, is_convex) LAW_##law,
	JN_SOLID_LAWS(NAME_LAW)
};

#define KERNEL(shape_name, index, law_name, reals, is_convex)                                                          \
	[index][LAW_##law_name] = {                                                                                        \
		.law = &jn_law_##law_name,                                                                                     \
		.shape = index,                                                                                                \
		.width = JN_WIDE,                                                                                              \
		.nodes = shape_name##_NODES,                                                                                   \
		.points = shape_name##_POINTS,                                                                                 \
		.rest_reals = REST_REALS,                                                                                      \
		.frozen_reals = (reals),                                                                                       \
		.energy = shape_name##_##law_name##_energy,                                                                    \
		.force = shape_name##_##law_name##_force,                                                                      \
		.tangent = shape_name##_##law_name##_tangent,                                                                  \
		.freeze = (reals) > 0 ? shape_name##_freeze : NULL,                                                            \
	},
#define KERNELS(law, frozen_reals, is_convex) ON_ALL_SHAPES(KERNEL, law, frozen_reals, is_convex)

enum { tet4_NODES = 4, tet4_POINTS = 1, tet10_NODES = 10, tet10_POINTS = 4, hex8_NODES = 8, hex8_POINTS = 8 };

const JnSolidKernels JOIN(jn_solid_kernels_, JN_WIDE) = {JN_SOLID_LAWS(KERNELS)};
