/// @file solid.h
/// The lists of solid elements and laws, from which kernels, rows and tables are all derived.
#ifndef JN_FORCE_SOLID_H
#define JN_FORCE_SOLID_H

#include "force/kernel.h"

/// X(law, frozen_reals, is_convex): numbers a point that a group keeps; whether dP/dF is semidefinite by itself.
#define JN_SOLID_LAWS(X)                                                                                               \
	X(linear, 9, 1)                                                                                                    \
	X(st_venant_kirchhoff, 0, 0)                                                                                       \
	X(neo_hookean, 0, 0)                                                                                               \
	X(stable_neo_hookean, 0, 0)                                                                                        \
	X(corotated_frozen, 9, 1)                                                                                          \
	X(corotated, 0, 0)

#define JN_COUNT_LAW(law, frozen_reals, is_convex) +1
enum { JN_SOLID_LAW_COUNT = 0 JN_SOLID_LAWS(JN_COUNT_LAW) };
#undef JN_COUNT_LAW

#define JN_DECLARE_LAW(law, frozen_reals, is_convex) extern const JnLaw jn_law_##law;
JN_SOLID_LAWS(JN_DECLARE_LAW)
#undef JN_DECLARE_LAW

/// X(shape, index of the shape, ...the law).
#define JN_ON_SOLID_SHAPES(X, law, frozen_reals, is_convex)                                                            \
	X(tet4, JN_TET4, law, frozen_reals, is_convex)                                                                     \
	X(tet10, JN_TET10, law, frozen_reals, is_convex)                                                                   \
	X(hex8, JN_HEX8, law, frozen_reals, is_convex)

#if defined(__x86_64__)
	#define JN_HAS_WIDE_KERNELS 1
#else
	#define JN_HAS_WIDE_KERNELS 0
#endif

/// Kernels of [shape][law] for 8, 4 and 2 lanes; 8 and 4 exist on x86-64 only.
typedef JnKernel JnSolidKernels[JN_SOLID_SHAPE_COUNT][JN_SOLID_LAW_COUNT];

extern const JnSolidKernels jn_solid_kernels_2;
#if JN_HAS_WIDE_KERNELS
extern const JnSolidKernels jn_solid_kernels_4, jn_solid_kernels_8;
#endif

#endif
