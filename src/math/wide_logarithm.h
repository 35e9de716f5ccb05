/// @file wide_logarithm.h
/// The natural logarithm, lane by lane without leaving the wide registers, for forces that need it in every step.
#ifndef JN_MATH_WIDE_LOGARITHM_H
#define JN_MATH_WIDE_LOGARITHM_H

#include "math/wide_angle.h"

/// log a for normal numbers a > 0, by the rational approximation of Cephes (Moshier 1989) on [sqrt 1/2, sqrt 2] and the
/// exponent times ln 2 in two parts: to 2 units in the last place.
JN_INLINE Wide wide_logarithm(Wide a) {
	static const double P[] = {1.01875663804580931796e-4, 4.97494994976747001425e-1, 4.70579119878881725854e0,
							   1.44989225341610930846e1,  1.79368678507819816313e1,  7.70838733755885391666e0};
	static const double Q[] = {1,
							   1.12873587189167450590e1,
							   4.52279145837532221105e1,
							   8.29875266912776603211e1,
							   7.11544750618563894466e1,
							   2.31251620126765340583e1};
	const WideMask bits = (WideMask)a;
	const Wide fraction = (Wide)((bits & 0x000fffffffffffff) | 0x3fe0000000000000); // in [1/2, 1)
	const Wide biased =
		(Wide)((bits >> 52) | 0x4330000000000000) - 4503599627370496.0; // an integer in a double: 2^52 + it
	const WideMask is_low = fraction < 0.70710678118654752440;
	const Wide exponent = wide_select(is_low, biased - 1023.0, biased - 1022.0);
	const Wide x = wide_select(is_low, fraction + fraction, fraction) - 1.0, z = x * x;
	const Wide ratio = wide_polynomial(P, 6, x) / wide_polynomial(Q, 6, x);
	const Wide tail = wide_fma(exponent, wide_set(-2.121944400546905827679e-4), x * z * ratio);
	return wide_fma(exponent, wide_set(0.693359375), x + wide_fma(wide_set(-0.5), z, tail));
}

/// The same for normal numbers of either sign: NAN below and at 0.
JN_INLINE Wide wide_log(Wide a) {
	return wide_select(a > 0.0, wide_logarithm(a), wide_set(NAN));
}

#endif
