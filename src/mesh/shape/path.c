// Arc length: chords of half and of whole samples, whose errors cancel to fourth order, L = (4 (c1 + c2) - c) / 3.
#include "mesh/shape/path.h"

#include <string.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/shape/placement.h"

enum {
	SAMPLES = 64,       // a piece
	FRAME_STEPS = 4096, // at least, over the whole curve: frames are carried in steps this fine
	REFINEMENTS = 6     // of the parameter at a length: each makes the error a tenth at most
};

static const double pi = 3.14159265358979323846;
static const double direction_step = 1e-5; // in u: of the central difference, whose error is its square

static void point_at(const JnPath* path, double u, double X[3]) {
	double x[3];
	path->at(path, u, x);
	for (int a = 0; a < 3; ++a)
		X[a] = path->map[0][a] + x[0] * path->map[1][a] + x[1] * path->map[2][a] + x[2] * path->map[3][a];
}

static double length_between(const JnPath* path, double from, double to) {
	double a[3], b[3], middle[3];
	point_at(path, from, a);
	point_at(path, 0.5 * (from + to), middle);
	point_at(path, to, b);
	return (4 * (vec3_distance(a, middle) + vec3_distance(middle, b)) - vec3_distance(a, b)) / 3;
}

static void direction_at(const JnPath* path, double u, double along[3]) {
	double before[3], behind[3];
	point_at(path, u - direction_step, before);
	point_at(path, u + direction_step, behind);
	for (int a = 0; a < 3; ++a) along[a] = behind[a] - before[a];
	vec3_normalize(along);
}

static double parameter_at(const JnPath* path, double s) {
	int low = 0, high = path->pieces * SAMPLES;
	while (high - low > 1) {
		const int middle = (low + high) / 2;
		*(path->lengths[middle] <= s ? &low : &high) = middle;
	}
	const double whole = path->lengths[low + 1] - path->lengths[low], wanted = s - path->lengths[low];
	const double begin = (double)low / SAMPLES, slope = 1.0 / (SAMPLES * whole);
	double u = begin + wanted * slope;
	if (wanted < 0 || wanted > whole) return u;
	for (int i = 0; i < REFINEMENTS; ++i) u += (wanted - length_between(path, begin, u)) * slope;
	return u;
}

void jn_path_place(const JnPath* path, double s, double X[3], double along[3]) {
	if (path->is_closed) s -= path->length * floor(s / path->length);
	const double u = parameter_at(path, s);
	point_at(path, u, X);
	direction_at(path, u, along);
}

static JnStatus place_in_scene(const JnPathDef* def, const char* what, JnPath* path) {
	JnPlacementDef placement = {.scale = 1};
	double points[4][3] = {{0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	memcpy(placement.rotate, def->rotate, sizeof placement.rotate);
	JN_TRY(jn_placement_apply(&placement, what, 4, points[0]));
	memcpy(path->map, points, sizeof path->map);
	memcpy(path->map[0], def->origin, sizeof path->map[0]);
	return JN_OK;
}

static JnStatus measure(const char* what, JnArena* arena, JnPath* path) {
	const int count = path->pieces * SAMPLES;
	JN_NEW(arena, path->lengths, count + 1);
	for (int i = 0; i < count; ++i) {
		const double step = length_between(path, (double)i / SAMPLES, (double)(i + 1) / SAMPLES);
		if (!(step > 0) || !isfinite(step))
			return jn_error(JN_BAD_INPUT,
							"%s: stands still after %g m of its length; take out points that lie at one place", what,
							path->lengths[i]);
		path->lengths[i + 1] = path->lengths[i] + step;
	}
	path->length = path->lengths[count];
	return JN_OK;
}

JnStatus jn_path_create(const JnPathDef* def, const char* what, JnArena* arena, JnPath* path) {
	const JnPathType* type = (const JnPathType*)def->curve.row;
	*path = (JnPath){0};
	JN_TRY(place_in_scene(def, what, path));
	JN_TRY(type->trace(def->curve.options, what, arena, path));
	return measure(what, arena, path);
}

static double station_length(const JnPath* path, int count, double k) {
	return path->length * k / (path->is_closed ? count : count - 1);
}

static JnStation station_at(const JnPath* path, double s) {
	JnStation station = {0};
	jn_path_place(path, s, station.X, station.along);
	return station;
}

// The frame of station k + 1 from that of station k, in steps.
static void carry(const JnPath* path, int count, int k, const JnStation* from, JnStation* to) {
	const int fine = path->pieces * SAMPLES > FRAME_STEPS ? path->pieces * SAMPLES : FRAME_STEPS;
	const int steps = 1 + fine / count;
	JnStation last = *from;
	for (int i = 1; i <= steps; ++i) {
		JnStation next = station_at(path, station_length(path, count, k + (double)i / steps));
		jn_station_carry(&last, &next);
		last = next;
	}
	*to = last;
}

void jn_path_stations(const JnPath* path, int count, double twist, JnStation* stations) {
	double missing = 0;
	stations[0] = station_at(path, 0);
	jn_station_begin(&stations[0]);
	for (int k = 1; k < count; ++k) carry(path, count, k - 1, &stations[k - 1], &stations[k]);
	if (path->is_closed) {
		JnStation round;
		carry(path, count, count - 1, &stations[count - 1], &round);
		missing =
			-atan2(vec3_dot(round.across[0], stations[0].across[1]), vec3_dot(round.across[0], stations[0].across[0]));
	}
	const int parts = path->is_closed ? count : count - 1;
	for (int k = 1; k < count; ++k) jn_station_turn(&stations[k], (missing + 2 * pi * twist) * k / parts);
}
