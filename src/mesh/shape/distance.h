/// @file distance.h
/// Signed distances of simple solids, negative inside, and how to blend them (Quilez, "Distance functions" and "Smooth
/// minimum"). That of the ellipsoid is exact at its surface to first order alone; a blend is a lower bound.
#ifndef JN_MESH_SHAPE_DISTANCE_H
#define JN_MESH_SHAPE_DISTANCE_H

#include "math/vec3.h"

static inline double jn_distance_sphere(const double p[3], const double centre[3], double radius) {
	return vec3_distance(p, centre) - radius;
}

/// Semi-axes along x, y and z.
static inline double jn_distance_ellipsoid(const double p[3], const double centre[3], const double radii[3]) {
	double q[3], g[3];
	for (int a = 0; a < 3; a++) {
		q[a] = (p[a] - centre[a]) / radii[a];
		g[a] = q[a] / radii[a];
	}
	const double k = vec3_length(q), slope = vec3_length(g);
	return slope > 0 ? k * (k - 1) / slope : -fmin(radii[0], fmin(radii[1], radii[2]));
}

/// The hull of two balls: a cone with round ends. `a` is not `b`, and neither ball holds the other.
static inline double jn_distance_round_cone(const double p[3], const double a[3], double radius_a, const double b[3],
											double radius_b) {
	const double axis[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, from[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
	const double length = vec3_length(axis), along = vec3_dot(from, axis) / length;
	const double across = sqrt(fmax(0, vec3_dot(from, from) - along * along));
	const double sine = (radius_a - radius_b) / length, cosine = sqrt(1 - sine * sine);
	const double foot = along * cosine - across * sine; // along the side, from where it leaves the first ball
	if (foot < 0) return vec3_length(from) - radius_a;
	if (foot > length * cosine) return vec3_distance(p, b) - radius_b;
	return across * cosine + along * sine - radius_a;
}

/// Union whose seam is filled with a fillet of about `width` [m].
static inline double jn_distance_blend(double a, double b, double width) {
	const double h = fmax(width - fabs(a - b), 0) / width;
	return fmin(a, b) - 0.25 * h * h * width;
}

/// What of `a` is outside `b`, its rim rounded likewise.
static inline double jn_distance_carve(double a, double b, double width) {
	return -jn_distance_blend(-a, b, width);
}

#endif
