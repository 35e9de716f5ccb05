/// @file wide_angle.h
/// The angle of a direction in the plane, lane by lane, for formulas that need it in the middle of wide code.
#ifndef JN_MATH_WIDE_ANGLE_H
#define JN_MATH_WIDE_ANGLE_H

#include "math/wide.h"

/// p(z) with the highest coefficient first.
JN_INLINE Wide wide_polynomial(const double* coefficients, int count, Wide z) {
	Wide sum = wide_set(coefficients[0]);
	JN_UNROLL for (int i = 1; i < count; i++) sum = wide_fma(sum, z, wide_set(coefficients[i]));
	return sum;
}

/// atan(q) for 0 <= q <= 1, by the rational approximation of Cephes (Moshier 1989) on [-0.2, 0.66], with
/// atan q = pi/4 + atan((q - 1)/(q + 1)) above: to 3 units in the last place.
JN_INLINE Wide wide_atan_unit(Wide q) {
	static const double P[] = {-8.750608600031904122785e-1, -1.615753718733365076637e1, -7.500855792314704667340e1,
							   -1.228866684490136173410e2, -6.485021904942025371773e1};
	static const double Q[] = {1,
							   2.485846490142306297962e1,
							   1.650270098316988542046e2,
							   4.328810604912902668951e2,
							   4.853903996359136964868e2,
							   1.945506571482613964425e2};
	const WideMask is_high = q > 0.66;
	const Wide t = wide_select(is_high, (q - 1.0) / (q + 1.0), q), z = t * t;
	const Wide low = wide_fma(t, z * wide_polynomial(P, 5, z) / wide_polynomial(Q, 6, z), t);
	return wide_select(is_high, low + 0.78539816339744830962, low);
}

/// Angle of (x, y) in [-pi, pi] [rad]; 0 for (0, 0).
JN_INLINE Wide wide_angle(Wide y, Wide x) {
	const Wide a = wide_abs(x), b = wide_abs(y);
	const Wide high = wide_max(wide_max(a, b), wide_set(1e-300)), low = wide_min(a, b);
	Wide angle = wide_atan_unit(low / high);
	angle = wide_select(b > a, 1.57079632679489661923 - angle, angle);
	angle = wide_select(x < 0.0, 3.14159265358979323846 - angle, angle);
	return wide_copy_sign(angle, y);
}

#endif
