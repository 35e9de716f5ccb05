#include "detect/segment.h"

#include "math/vec3.h"

static const double parallel = 1e-8; // square of the sine of the angle between segments that count as such

static double clamp(double share) {
	return share < 0 ? 0 : share > 1 ? 1 : share;
}

// The share of a in the middle of where b lies beside it; b's ends seen along a are at `from` and `to`.
static double middle(double from, double to) {
	const double low = clamp(fmin(from, to)), high = clamp(fmax(from, to));
	return 0.5 * (low + high);
}

// |r + s u - t v|^2 is least where  s uu - t uv = -ur  and  s uv - t vv = -vr  (Ericson 2005, section 5.1.9), shares clamped.
double jn_segments_nearest(double a[2][3], double b[2][3], double share[2], double offset[3]) {
	double u[3], v[3], r[3];
	for (int k = 0; k < 3; ++k) {
		u[k] = a[1][k] - a[0][k];
		v[k] = b[1][k] - b[0][k];
		r[k] = a[0][k] - b[0][k];
	}
	const double uu = vec3_dot(u, u), vv = vec3_dot(v, v), uv = vec3_dot(u, v), ur = vec3_dot(u, r),
				 vr = vec3_dot(v, r);
	const double area = uu * vv - uv * uv;
	double s = 0, t = 0;
	if (area > parallel * uu * vv)
		s = clamp((uv * vr - ur * vv) / area);
	else if (uu > 0)
		s = middle(-ur / uu, (uv - ur) / uu);
	if (vv > 0) t = (uv * s + vr) / vv;
	if (t < 0 || t > 1) {
		t = clamp(t);
		if (uu > 0) s = clamp((uv * t - ur) / uu);
	}
	share[0] = s;
	share[1] = t;
	for (int k = 0; k < 3; ++k) offset[k] = r[k] + s * u[k] - t * v[k];
	return vec3_dot(offset, offset);
}
