/// @file mass_single.h
/// Products with the consistent mass of elements, in single precision, compiled once a vector width.
#ifndef JN_MODEL_MASS_SINGLE_H
#define JN_MODEL_MASS_SINGLE_H

#include "force/kernel.h"

/// buffer += scale * (integral of N_i N_j) p of the batches first <= batch < last, as JnKernel.product_single lays them out;
/// `first` is even. For solids whose Jacobian at rest is constant in each element (group->rest_points is 1).
typedef void JnMassSingle(const JnGroup* group, int first, int last, double scale, const float* p, float* buffer);

extern JnMassSingle jn_mass_single_2, jn_mass_single_4, jn_mass_single_8;

static inline JnMassSingle* jn_mass_single(int width) {
#if defined(__x86_64__)
	if (width > 2) return width == 8 ? jn_mass_single_8 : jn_mass_single_4;
#endif
	(void)width;
	return jn_mass_single_2;
}

#endif
