/// @file vec3.h
/// Points and directions in space: three doubles, for meshes and set-up.
#ifndef JN_MATH_VEC3_H
#define JN_MATH_VEC3_H

#include <math.h>

static inline double vec3_dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double vec3_length(const double a[3]) {
	return sqrt(vec3_dot(a, a));
}

static inline double vec3_distance(const double a[3], const double b[3]) {
	const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
	return vec3_length(d);
}

/// out = a x b; out may be neither.
static inline void vec3_cross(const double a[3], const double b[3], double out[3]) {
	for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/// Normal of a triangle, as long as twice its area [m^2].
static inline void vec3_triangle(const double a[3], const double b[3], const double c[3], double normal[3]) {
	const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
	vec3_cross(u, v, normal);
}

/// Make a vector as long as 1; zero stays zero.
static inline void vec3_normalize(double a[3]) {
	const double length = vec3_length(a);
	for (int i = 0; i < 3 && length > 0; i++) a[i] /= length;
}

#endif
