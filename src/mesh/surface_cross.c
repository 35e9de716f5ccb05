// Two triangles cross when no plane keeps them apart. For convex bodies it is enough to try the normals of both and the
// products of their edges (the separating axes of Gottschalk, Lin and Manocha, 1996); within one plane, the normals of
// the edges. A plane that both touch separates them, so neighbours need no care.
#include <math.h>

#include "mesh/surface_edges.h"

typedef struct Pair {
	const double* const* p;
	const double* const* q;
	double p_edge[3][3], q_edge[3][3], p_normal[3], q_normal[3];
	double rounding; // overlaps up to this do not count [m]
} Pair;

static void cross(const double a[3], const double b[3], double out[3]) {
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether the shadows of the triangles on a line along `axis` overlap by no more than rounding.
static bool separates(const Pair* pair, const double axis[3]) {
	const double length = sqrt(dot(axis, axis));
	if (!(length > 0)) return false;
	double p_low = INFINITY, p_high = -INFINITY, q_low = INFINITY, q_high = -INFINITY;
	for (int i = 0; i < 3; i++) {
		double p_at = 0, q_at = 0; // from a common corner, to lose no digits
		for (int a = 0; a < 3; a++) {
			p_at += axis[a] / length * (pair->p[i][a] - pair->p[0][a]);
			q_at += axis[a] / length * (pair->q[i][a] - pair->p[0][a]);
		}
		p_low = p_at < p_low ? p_at : p_low; // fmin and fmax would be calls
		p_high = p_at > p_high ? p_at : p_high;
		q_low = q_at < q_low ? q_at : q_low;
		q_high = q_at > q_high ? q_at : q_high;
	}
	return fmin(p_high - q_low, q_high - p_low) <= pair->rounding;
}

static bool space_separates(const Pair* pair) {
	if (separates(pair, pair->p_normal) || separates(pair, pair->q_normal)) return true;
	for (int i = 0; i < 9; i++) {
		double axis[3];
		cross(pair->p_edge[i / 3], pair->q_edge[i % 3], axis);
		if (separates(pair, axis)) return true;
	}
	return false;
}

/// Farthest that a corner of `corners` is from the plane through `origin` [m]; infinite when it has no normal.
static double most_above(const double* const corners[3], const double* origin, const double normal[3]) {
	const double length = sqrt(dot(normal, normal));
	double most = length > 0 ? 0 : INFINITY;
	for (int i = 0; i < 3; i++) {
		const double away[3] = {corners[i][0] - origin[0], corners[i][1] - origin[1], corners[i][2] - origin[2]};
		most = fmax(most, fabs(dot(away, normal)) / length);
	}
	return most;
}

static bool share_plane(const Pair* pair) {
	return most_above(pair->q, pair->p[0], pair->p_normal) <= pair->rounding &&
		   most_above(pair->p, pair->q[0], pair->q_normal) <= pair->rounding;
}

static bool plane_separates(const Pair* pair) {
	for (int i = 0; i < 3; i++) {
		double p_axis[3], q_axis[3];
		cross(pair->p_edge[i], pair->p_normal, p_axis);
		cross(pair->q_edge[i], pair->q_normal, q_axis);
		if (separates(pair, p_axis) || separates(pair, q_axis)) return true;
	}
	return false;
}

bool jn_triangles_cross(const double* const p[3], const double* const q[3]) {
	Pair pair = {.p = p, .q = q};
	double longest = 0, farthest = 0;
	for (int i = 0; i < 3; i++) {
		for (int a = 0; a < 3; a++) {
			pair.p_edge[i][a] = p[(i + 1) % 3][a] - p[i][a];
			pair.q_edge[i][a] = q[(i + 1) % 3][a] - q[i][a];
			longest = fmax(longest, fmax(fabs(pair.p_edge[i][a]), fabs(pair.q_edge[i][a])));
			farthest = fmax(farthest, fmax(fabs(p[i][a]), fabs(q[i][a])));
		}
	}
	cross(pair.p_edge[0], pair.p_edge[1], pair.p_normal);
	cross(pair.q_edge[0], pair.q_edge[1], pair.q_normal);
	pair.rounding = 1e-9 * longest + 1e-14 * farthest;
	return share_plane(&pair) ? !plane_separates(&pair) : !space_separates(&pair);
}
