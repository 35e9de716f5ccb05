// With d = p - a, e1 = b - a, e2 = c - a, all linear in time, the point is in the triangle's plane where the cubic
//
//   f(t) = d . (e1 x e2)        six times the volume of the tetrahedron, > 0 in front of the triangle
//
// has a root. Between its extrema f is monotone, and a bracketed Newton iteration finds the root to the last digits.
#include "detect/touch.h"

#include "math/vec3.h"
#include "mesh/triangle_tree.h"

static const double BESIDE = 1e-6; // of the longest edge: a point this far beside the triangle still touches it

typedef struct Cubic {
	double at[4]; // coefficients of 1, t, t^2, t^3
} Cubic;

static double value(const Cubic* f, double t) {
	return f->at[0] + t * (f->at[1] + t * (f->at[2] + t * f->at[3]));
}

static double slope(const Cubic* f, double t) {
	return f->at[1] + t * (2 * f->at[2] + t * 3 * f->at[3]);
}

/// Corner i of the path relative to the triangle's first, at the start and how it changes.
static void relative(const JnTouchPath* path, int i, double start[3], double change[3]) {
	for (int k = 0; k < 3; k++) {
		start[k] = path->start[i][k] - path->start[1][k];
		change[k] = path->end[i][k] - path->end[1][k] - start[k];
	}
}

static Cubic volume(const JnTouchPath* path) {
	double d0[3], d1[3], e0[3], e1[3], g0[3], g1[3], n0[3], n1[3], n2[3], other[3];
	relative(path, 0, d0, d1);
	relative(path, 2, e0, e1);
	relative(path, 3, g0, g1);
	vec3_cross(e0, g0, n0);
	vec3_cross(e0, g1, n1);
	vec3_cross(e1, g0, other);
	vec3_cross(e1, g1, n2);
	for (int k = 0; k < 3; k++) n1[k] += other[k];
	return (Cubic){
		{vec3_dot(d0, n0), vec3_dot(d0, n1) + vec3_dot(d1, n0), vec3_dot(d0, n2) + vec3_dot(d1, n1), vec3_dot(d1, n2)}};
}

/// Whether f cannot change its sign: all its Bernstein coefficients have the same.
static bool keeps_sign(const Cubic* f) {
	const double b0 = f->at[0], b1 = b0 + f->at[1] / 3, b2 = b0 + (2 * f->at[1] + f->at[2]) / 3, b3 = value(f, 1);
	return (b0 > 0 && b1 > 0 && b2 > 0 && b3 > 0) || (b0 < 0 && b1 < 0 && b2 < 0 && b3 < 0);
}

/// 0, the extrema of f between 0 and 1 in their order, and 1. Returns how many.
static int monotone_ends(const Cubic* f, double ends[4]) {
	const double a = 3 * f->at[3], b = f->at[2], c = f->at[1], discriminant = b * b - a * c; // a t^2 + 2 b t + c
	int count = 0;
	ends[count++] = 0;
	if (discriminant >= 0) {
		const double q = b >= 0 ? -b - sqrt(discriminant) : -b + sqrt(discriminant);
		const double one = q / a, two = c / q; // infinite or NAN when there is no such root: not taken
		const double first = one < two ? one : two, second = one < two ? two : one;
		if (first > 0 && first < 1) ends[count++] = first;
		if (second > ends[count - 1] && second < 1) ends[count++] = second;
	}
	ends[count++] = 1;
	return count;
}

/// The root between `low` and `high`, whose values differ in sign or are 0, f being monotone between.
static double root_between(const Cubic* f, double low, double high) {
	const double at_low = value(f, low);
	if (at_low == 0) return low;
	if (value(f, high) == 0) return high;
	double t = 0.5 * (low + high);
	for (int i = 0; i < 100 && high - low > 0; i++) {
		const double now = value(f, t);
		if (now == 0) return t;
		if ((now > 0) == (at_low > 0))
			low = t;
		else
			high = t;
		const double next = t - now / slope(f, t), old = t;
		t = next > low && next < high ? next : 0.5 * (low + high);
		if (fabs(t - old) <= 1e-16) return t;
	}
	return t;
}

/// Fill in the moment `out->when`; false when the point is beside the triangle then.
static bool meets(const JnTouchPath* path, JnTouch* out) {
	double at[4][3], beside[3], longest = 0;
	for (int i = 0; i < 4; i++)
		for (int k = 0; k < 3; k++) at[i][k] = (1 - out->when) * path->start[i][k] + out->when * path->end[i][k];
	for (int i = 1; i <= 3; i++) longest = fmax(longest, vec3_distance(at[i], at[i % 3 + 1]));
	jn_triangle_nearest(at[1], at[2], at[3], at[0], out->weights);
	for (int k = 0; k < 3; k++)
		beside[k] = at[0][k] - out->weights[0] * at[1][k] - out->weights[1] * at[2][k] - out->weights[2] * at[3][k];
	vec3_triangle(at[1], at[2], at[3], out->normal);
	vec3_normalize(out->normal);
	return vec3_length(beside) <= BESIDE * longest && vec3_dot(out->normal, out->normal) > 0;
}

bool jn_touch_first(const JnTouchPath* path, JnTouchSides sides, JnTouch* out) {
	const Cubic f = volume(path);
	double ends[4];
	if (keeps_sign(&f)) return false;
	const int count = monotone_ends(&f, ends);
	for (int i = 0; i + 1 < count; i++) {
		const double low = value(&f, ends[i]), high = value(&f, ends[i + 1]);
		const bool goes_back = low >= 0 && high <= 0 && low > high, comes_out = low < 0 && high >= 0;
		if (!goes_back && !(comes_out && sides == JN_TOUCH_BOTH)) continue;
		out->when = root_between(&f, ends[i], ends[i + 1]);
		if (!meets(path, out)) continue;
		for (int k = 0; k < 3 && comes_out; k++) out->normal[k] = -out->normal[k];
		return true;
	}
	return false;
}
