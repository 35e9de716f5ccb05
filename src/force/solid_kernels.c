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
#include "force/solid_single.h"

#if JN_WIDE > 2 && !JN_HAS_WIDE_KERNELS
	#error "8 and 4 lanes exist on x86-64 only: compile this file with JN_WIDE=2 alone"
#endif

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

// ---- what is compiled once an element ----

#define DEFINE_ELEMENT(shape, index)                                                                                   \
	JN_SHARED void shape##_gather(const JnGroup* group, int batch, const double* x, Jacobians* jacobians) {            \
		gather_jacobians(group, &jn_element_##shape, index, batch, x, jacobians);                                      \
	}                                                                                                                  \
	JN_SHARED void shape##_store_nodes(const Jacobians* jacobians, double* out) {                                      \
		store_nodes(&jn_element_##shape, index, jacobians, out);                                                       \
	}                                                                                                                  \
	JN_SHARED void shape##_load(const JnGroup* group, int batch, int p, const Jacobians* jacobians, Point* point) {    \
		point_load(group, index, batch, p, jacobians, point);                                                          \
	}                                                                                                                  \
	JN_SHARED void shape##_add_tangent(int p, const Point* point, const WideTangent* A, double* blocks) {              \
		add_tangent(&jn_element_##shape, p, point, A, blocks);                                                         \
	}                                                                                                                  \
	JN_SHARED void shape##_complete_tangent(double* blocks) {                                                          \
		complete_tangent(&jn_element_##shape, blocks);                                                                 \
	}                                                                                                                  \
	static const ElementCode shape##_code = {shape##_gather, shape##_store_nodes, shape##_load, shape##_add_tangent,   \
											 shape##_complete_tangent};
DEFINE_ELEMENT(tet4, JN_TET4)
DEFINE_ELEMENT(tet10, JN_TET10)
DEFINE_ELEMENT(hex8, JN_HEX8)

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

#define DEFINE_WHOLE(law, frozen_reals, is_convex)                                                                     \
	JN_SHARED void law##_whole(const double* constants, const double* frozen, const WideMat3* F, Wide stored[]) {      \
		store_whole(constants, frozen, F, stored, law##_definite);                                                     \
	}
JN_SOLID_LAWS(DEFINE_WHOLE)

JN_SHARED void shared_whole_diagonal(const double* constants, const Wide A[], Wide weight, const Wide g[3],
									 Wide block[6]) {
	whole_diagonal(constants, A, weight, g, block);
}

JN_SHARED void shared_whole_differential(const double* constants, const Wide A[], Wide D[3][3], Wide dP[3][3]) {
	whole_differential(constants, A, D, dP);
}

// ---- the pairs ----

#define DEFINE_PAIR(shape, index, law, frozen_reals, is_convex)                                                        \
	static void shape##_##law##_energy(const JnGroup* group, int first, int last, const double* x, double* out) {      \
		energy_loop(group, first, last, x, out, &jn_element_##shape, &shape##_code, frozen_reals, law##_energy);       \
	}                                                                                                                  \
	static void shape##_##law##_force(const JnGroup* group, int first, int last, const double* x, double* out) {       \
		force_loop(group, first, last, x, out, &jn_element_##shape, index, &shape##_code, frozen_reals, law##_stress); \
	}                                                                                                                  \
	static void shape##_##law##_product(const JnGroup* group, int first, int last, const double* x, bool definite,     \
										const double* p, double* out) {                                                \
		if (definite && !(is_convex)) {                                                                                \
			product_loop(group, first, last, x, p, out, &jn_element_##shape, index, &shape##_code, frozen_reals,       \
						 law##_whole, shared_whole_differential);                                                      \
		} else {                                                                                                       \
			product_loop(group, first, last, x, p, out, &jn_element_##shape, index, &shape##_code, frozen_reals,       \
						 law##_linearize, law##_differential);                                                         \
		}                                                                                                              \
	}                                                                                                                  \
	static void shape##_##law##_diagonal(const JnGroup* group, int first, int last, const double* x, bool definite,    \
										 double* out) {                                                                \
		if (definite && !(is_convex)) {                                                                                \
			diagonal_loop(group, first, last, x, out, &jn_element_##shape, index, &shape##_code, frozen_reals,         \
						  law##_whole, shared_whole_diagonal);                                                         \
		} else {                                                                                                       \
			diagonal_loop(group, first, last, x, out, &jn_element_##shape, index, &shape##_code, frozen_reals,         \
						  law##_linearize, law##_diagonal);                                                            \
		}                                                                                                              \
	}                                                                                                                  \
	static void shape##_##law##_store(const JnGroup* group, int first, int last, const double* x, bool definite,       \
									  float* stored) {                                                                 \
		if (definite && !(is_convex)) {                                                                                \
			store_loop(group, first, last, x, stored, &jn_element_##shape, index, &shape##_code, frozen_reals,         \
					   WHOLE_REALS, law##_whole);                                                                      \
		} else {                                                                                                       \
			store_loop(group, first, last, x, stored, &jn_element_##shape, index, &shape##_code, frozen_reals,         \
					   law##_STORED, law##_linearize);                                                                 \
		}                                                                                                              \
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
#define DEFINE_PAIRS(law, frozen_reals, is_convex) JN_ON_SOLID_SHAPES(DEFINE_PAIR, law, frozen_reals, is_convex)
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
		.shape = (index),                                                                                              \
		.width = JN_WIDE,                                                                                              \
		.nodes = shape_name##_NODES,                                                                                   \
		.points = shape_name##_POINTS,                                                                                 \
		.rest_reals = REST_REALS,                                                                                      \
		.frozen_reals = (reals),                                                                                       \
		.energy = shape_name##_##law_name##_energy,                                                                    \
		.force = shape_name##_##law_name##_force,                                                                      \
		.tangent = shape_name##_##law_name##_tangent,                                                                  \
		.freeze = LAW_##law_name == LAW_corotated_frozen ? shape_name##_freeze : NULL,                                 \
		.product = shape_name##_##law_name##_product,                                                                  \
		.diagonal = shape_name##_##law_name##_diagonal,                                                                \
		.store = shape_name##_##law_name##_store,                                                                      \
		.product_single = JN_PRODUCT_SINGLE(shape_name, law_name),                                                     \
		.stored_reals = {law_name##_STORED, (is_convex) ? law_name##_STORED : WHOLE_REALS},                            \
	},
#define KERNELS(law, frozen_reals, is_convex) JN_ON_SOLID_SHAPES(KERNEL, law, frozen_reals, is_convex)

enum { tet4_NODES = 4, tet4_POINTS = 1, tet10_NODES = 10, tet10_POINTS = 4, hex8_NODES = 8, hex8_POINTS = 8 };

const JnSolidKernels JOIN(jn_solid_kernels_, JN_WIDE) = {JN_SOLID_LAWS(KERNELS)};
