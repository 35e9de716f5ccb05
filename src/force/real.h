/// @file real.h
/// The number that formulas of elements are written for: JN_WIDE doubles, or 2 * JN_WIDE floats where JN_SINGLE is set
/// before anything is included.
#ifndef JN_FORCE_REAL_H
#define JN_FORCE_REAL_H

#include "math/wide_float.h"

#ifdef JN_SINGLE
typedef WideFloat Real;
typedef float RealOne;
	#define real_set(number) wide_float_set((float)(number))
	#define real_load wide_float_load
	#define real_store wide_float_store
	#define real_fma wide_float_fma
enum { JN_REALS = JN_WIDE_FLOATS };
#else
typedef Wide Real;
typedef double RealOne;
	#define real_set wide_set
	#define real_load wide_load
	#define real_store wide_store
	#define real_fma wide_fma
enum { JN_REALS = JN_WIDE };
#endif

/// a0 b0 + a1 b1 + a2 b2.
JN_INLINE Real real_dot3(Real a0, Real b0, Real a1, Real b1, Real a2, Real b2) {
	return real_fma(a0, b0, real_fma(a1, b1, a2 * b2));
}

#endif
