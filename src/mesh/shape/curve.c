// The curve is sampled finely; positions at equal arc length lie between two samples.
#include "mesh/shape/curve.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 64 }; // a segment between two points

static double dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const double a[3], const double b[3], double out[3]) {
	for (int axis = 0; axis < 3; ++axis) out[axis] = a[axis] - b[axis];
}

static double distance(const double a[3], const double b[3]) {
	double d[3];
	subtract(a, b, d);
	return sqrt(dot(d, d));
}

/// a + (b - a) (t - from) / (to - from).
static void blend(const double a[3], const double b[3], double from, double to, double t, double out[3]) {
	for (int axis = 0; axis < 3; ++axis) out[axis] = ((to - t) * a[axis] + (t - from) * b[axis]) / (to - from);
}

/// Point number `index`; one before the first and one behind the last continue the line, or a closed curve goes round.
static void point_at(int count, const double* points, bool is_closed, int index, double out[3]) {
	if (is_closed) index = (index + count) % count;
	const int inside = index < 0 ? 0 : index >= count ? count - 1 : index;
	const int inward = index < 0 ? 1 : count - 2;
	for (int axis = 0; axis < 3; ++axis) {
		out[axis] = points[3 * inside + axis];
		if (index != inside) out[axis] += points[3 * inside + axis] - points[3 * inward + axis];
	}
}

/// Barry, Goldman 1988: knots at square roots of distances keep the curve free of loops.
void jn_curve_point(int count, const double* points, bool is_closed, int segment, double share, double out[3]) {
	double p[4][3], knot[4] = {0}, a[3][3], b[2][3];
	for (int i = 0; i < 4; ++i) point_at(count, points, is_closed, segment - 1 + i, p[i]);
	for (int i = 1; i < 4; ++i) knot[i] = knot[i - 1] + sqrt(distance(p[i - 1], p[i]));
	const double t = knot[1] + share * (knot[2] - knot[1]);
	for (int i = 0; i < 3; ++i) blend(p[i], p[i + 1], knot[i], knot[i + 1], t, a[i]);
	for (int i = 0; i < 2; ++i) blend(a[i], a[i + 1], knot[i], knot[i + 2], t, b[i]);
	blend(b[0], b[1], knot[1], knot[2], t, out);
}

static void sample_curve(int point_count, const double* points, double (*samples)[3], double* lengths) {
	const int count = (point_count - 1) * SAMPLES;
	for (int i = 0; i <= count; ++i) {
		const int segment = i < count ? i / SAMPLES : point_count - 2;
		jn_curve_point(point_count, points, false, segment, (double)(i - segment * SAMPLES) / SAMPLES, samples[i]);
		lengths[i] = i == 0 ? 0 : lengths[i - 1] + distance(samples[i - 1], samples[i]);
	}
}

/// Any direction across a direction of length 1.
static void any_across(const double along[3], double out[3]) {
	int axis = 0;
	for (int k = 1; k < 3; ++k)
		if (fabs(along[k]) < fabs(along[axis])) axis = k;
	for (int k = 0; k < 3; ++k) out[k] = (k == axis) - along[axis] * along[k];
	const double length = sqrt(dot(out, out));
	for (int k = 0; k < 3; ++k) out[k] /= length;
}

static void reflect(const double normal[3], double v[3]) {
	const double square = dot(normal, normal);
	const double scale = square > 0 ? 2 * dot(normal, v) / square : 0;
	for (int axis = 0; axis < 3; ++axis) v[axis] -= scale * normal[axis];
}

static void complete_frame(JnStation* s) {
	for (int axis = 0; axis < 3; ++axis) {
		const int next = (axis + 1) % 3, last = (axis + 2) % 3;
		s->across[1][axis] = s->along[next] * s->across[0][last] - s->along[last] * s->across[0][next];
	}
}

void jn_station_begin(JnStation* s) {
	any_across(s->along, s->across[0]);
	complete_frame(s);
}

// Reflected at the plane between them, and at the one that turns `along` right. What rounding leaves along the curve goes.
void jn_station_carry(const JnStation* from, JnStation* to) {
	double chord[3], along[3], turn[3];
	memcpy(to->across[0], from->across[0], sizeof to->across[0]);
	memcpy(along, from->along, sizeof along);
	subtract(to->X, from->X, chord);
	reflect(chord, to->across[0]);
	reflect(chord, along);
	subtract(to->along, along, turn);
	reflect(turn, to->across[0]);
	const double slope = dot(to->across[0], to->along);
	for (int axis = 0; axis < 3; ++axis) to->across[0][axis] -= slope * to->along[axis];
	const double length = sqrt(dot(to->across[0], to->across[0]));
	for (int axis = 0; axis < 3; ++axis) to->across[0][axis] /= length;
	complete_frame(to);
}

void jn_station_turn(JnStation* s, double angle) {
	const double c = cos(angle), d = sin(angle);
	for (int axis = 0; axis < 3; ++axis) {
		const double a = s->across[0][axis], b = s->across[1][axis];
		s->across[0][axis] = c * a + d * b;
		s->across[1][axis] = c * b - d * a;
	}
}

static void direct(const double from[3], const double to[3], double along[3]) {
	subtract(to, from, along);
	const double length = sqrt(dot(along, along));
	for (int axis = 0; axis < 3; ++axis) along[axis] /= length;
}

JnStatus jn_curve_stations(int point_count, const double* points, int count, JnStation* stations, JnArena* scratch) {
	const int last = (point_count - 1) * SAMPLES;
	double(*samples)[3], *lengths;
	JN_NEW(scratch, samples, last + 1);
	JN_NEW(scratch, lengths, last + 1);
	sample_curve(point_count, points, samples, lengths);
	for (int i = 0, sample = 0; i < count; ++i) {
		const double length = lengths[last] * i / (count - 1);
		while (sample < last - 1 && lengths[sample + 1] < length) ++sample;
		blend(samples[sample], samples[sample + 1], lengths[sample], lengths[sample + 1], length, stations[i].X);
		const int before = sample > 0 ? sample - 1 : 0, behind = sample + 2 <= last ? sample + 2 : last;
		direct(i > 0 ? samples[before] : samples[0], i < count - 1 ? samples[behind] : samples[last],
			   stations[i].along);
		if (i == 0)
			jn_station_begin(&stations[0]);
		else
			jn_station_carry(&stations[i - 1], &stations[i]);
	}
	return JN_OK;
}
