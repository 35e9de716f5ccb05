/// @file solid_single.h
/// JnKernel.product_single of every (element, law) pair for JN_WIDE lanes.
#ifndef JN_FORCE_SOLID_SINGLE_H
#define JN_FORCE_SOLID_SINGLE_H

#include "force/solid.h"
#include "math/wide.h"

#define JN_SINGLE_NAME(shape, law, width) jn_##shape##_##law##_product_single_##width
#define JN_SINGLE_NAME_OF(shape, law, width) JN_SINGLE_NAME(shape, law, width)
#define JN_PRODUCT_SINGLE(shape, law) JN_SINGLE_NAME_OF(shape, law, JN_WIDE)

#define JN_DECLARE_SINGLE(shape, index, law, frozen_reals, is_convex)                                                  \
	void JN_PRODUCT_SINGLE(shape, law)(const JnGroup* group, int first, int last, bool definite, const float* stored,  \
									   const float* p, float* out);
#define JN_DECLARE_SINGLES(law, frozen_reals, is_convex)                                                               \
	JN_ON_SOLID_SHAPES(JN_DECLARE_SINGLE, law, frozen_reals, is_convex)
JN_SOLID_LAWS(JN_DECLARE_SINGLES)

#endif
