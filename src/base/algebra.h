/// @file algebra.h
/// Loops over vectors, compiled once a vector width. Each gives the same bits for every width: entries are independent,
/// nothing is fused, and sums run in eight interleaved accumulators.
#ifndef JN_BASE_ALGEBRA_H
#define JN_BASE_ALGEBRA_H

#include <stdbool.h>

#include "jounce/base.h"

enum { JN_ALGEBRA_CHUNK = 4096 };

/// v_out = v + kick inverse_mass (force + load), x_out = x + drift v_out. load may be NULL; so may x and x_out, if drift is 0.
typedef struct JnAdvance {
	double kick, drift;
	const double *inverse_mass, *force, *load, *x, *v;
	double *x_out, *v_out; ///< may be x and v
} JnAdvance;

typedef struct JnAlgebra {
	/// out[0 .. n) = sum of scale * vec, in the order of the terms, of which `out` may be one. count >= 1; more than three
	/// terms: n <= JN_ALGEBRA_CHUNK.
	void (*combine)(size_t n, int count, const JnTerm terms[], double* out);
	double (*dot)(size_t n, const double* a, const double* b);
	double (*max)(size_t n, const double* a); ///< largest absolute entry; NAN if any is NAN
	/// out = a * b, entry by entry; out may be one of them.
	void (*multiply)(size_t n, const double* a, const double* b, double* out);
	/// out += scale * a * b, entry by entry; out is neither.
	void (*accumulate)(size_t n, double scale, const double* a, const double* b, double* out);
	/// Entries first .. last of it; whether all of v_out, and of x_out if drift is not 0, are finite.
	bool (*advance)(size_t first, size_t last, const JnAdvance* by);
} JnAlgebra;

extern const JnAlgebra jn_algebra_2, jn_algebra_4, jn_algebra_8;

/// That for the widest unit that this processor has.
const JnAlgebra* jn_algebra_best(void);

#endif
