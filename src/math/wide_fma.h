/// @file wide_fma.h
/// a * b + c rounded once, lane by lane, where the processor need not know how: with it two lanes give the bits of four and
/// eight. By rounding to odd (Boldo and Melquiond 2008, "Emulation of a FMA and correctly rounded sums"): the errors of the
/// product and of the sums are exact numbers, of which the last sum keeps in its last bit that something was cut off.
/// Included by wide.h for two lanes.
#ifndef JN_MATH_WIDE_FMA_H
#define JN_MATH_WIDE_FMA_H

#include "math/wide.h"

/// The error of sum = a + b (Knuth's TwoSum).
JN_INLINE Wide wide_sum_error(Wide a, Wide b, Wide sum) {
	const Wide of_b = sum - a;
	return (a - (sum - of_b)) + (b - of_b);
}

/// a + b; when that is not exact, the one of its two neighbours whose last bit is 1.
JN_INLINE Wide wide_sum_to_odd(Wide a, Wide b) {
	const Wide sum = a + b, error = wide_sum_error(a, b, sum);
	const WideMask bits = (WideMask)sum, is_moved = (error != 0.0) & ((bits & 1) - 1);
	const WideMask is_outwards = (error > 0.0) == (sum > 0.0); // all bits set: -1
	return (Wide)(bits + (is_moved & (-is_outwards + ~is_outwards)));
}

/// The upper 26 bits of a (Veltkamp).
JN_INLINE Wide wide_upper_half(Wide a) {
	const Wide much = 134217729.0 * a;
	return much - (much - a);
}

/// The error of product = a * b (Dekker), where that is above 2^-969 and neither factor above 2^996.
JN_INLINE Wide wide_product_error(Wide a, Wide b, Wide product) {
	const Wide ah = wide_upper_half(a), al = a - ah, bh = wide_upper_half(b), bl = b - bh;
	return (((ah * bh - product) + ah * bl) + al * bh) + al * bl;
}

#if defined(__FP_FAST_FMA)
/// a * b + c, rounded once.
JN_INLINE Wide wide_fma(Wide a, Wide b, Wide c) {
	return (Wide){__builtin_fma(a[0], b[0], c[0]), __builtin_fma(a[1], b[1], c[1])};
}
#else
/// a * b + c, rounded once. Not inlined: some forty instructions at each of hundreds of places take compilers minutes.
JN_SHARED Wide wide_fma(Wide a, Wide b, Wide c) {
	const Wide product = a * b, low = wide_product_error(a, b, product);
	const Wide lower = c + low, high = product + lower;
	const Wide rest = wide_sum_to_odd(wide_sum_error(c, low, lower), wide_sum_error(product, lower, high));
	const Wide once = high + rest;
	// an exact product needs none of this, and keeps the sign of a zero; infinite numbers have no errors
	return wide_select((low != 0.0) & (once == once), once, product + c);
}
#endif

#endif
