// Cubic splines through equidistant places, second derivatives m as unknowns:
//   m_(i-1) + 4 m_i + m_(i+1) = 6 (y_(i-1) - 2 y_i + y_(i+1)) / h^2
// Between two places, with a = (s_(i+1) - s)/h and b = 1 - a,
//   y = a y_i + b y_(i+1) + h^2/6 ((a^3 - a) m_i + (b^3 - b) m_(i+1)).
// Ends of open curves have the slope of a difference of fourth order. A loop is tabulated a little more than once round, and
// what its ends lack falls by 2 - sqrt 3 a place: the margin makes it 1e-12.
#include "model/track.h"

#include <math.h>

enum { LEAST = 1000, A_PIECE = 100, MOST = 100000, MARGIN = 21 };

static void copy_station(const JnStation* s, double* value) {
	for (int a = 0; a < 3; ++a) {
		value[a] = s->X[a];
		value[3 + a] = s->across[0][a];
		value[6 + a] = s->across[1][a];
	}
}

// Slope at the end `at`, from the five places from there inward (sign 1: rising numbers).
static double end_slope(const JnTrack* track, int at, int sign, int k) {
	static const double weight[5] = {-25.0 / 12, 4, -3, 4.0 / 3, -0.25};
	double sum = 0;
	for (int i = 0; i < 5; ++i) sum += weight[i] * track->value[at + sign * i][k];
	return sign * sum / track->step;
}

// The right-hand sides: second differences, and at the ends of open curves what their slopes say, 2 m_0 + m_1 = ...
static double right_side(const JnTrack* track, int i, int k) {
	const double h = track->step;
	const int last = track->count - 1;
	if (i > 0 && i < last)
		return 6 * (track->value[i - 1][k] - 2 * track->value[i][k] + track->value[i + 1][k]) / (h * h);
	if (track->is_closed) return 0; // far from where the table is used
	const int sign = i == 0 ? 1 : -1;
	const double rise = (track->value[i + sign][k] - track->value[i][k]) / h;
	return 6 * (rise - sign * end_slope(track, i, sign, k)) / h;
}

// Elimination and substitution for all numbers at once; rows of the ends are 2 m_0 + m_1, or m_0 alone in loops.
static JnStatus solve_bends(JnTrack* track, JnArena* scratch) {
	const int last = track->count - 1;
	double* share; // of the next unknown, after elimination
	JN_NEW(scratch, share, track->count);
	for (int i = 0; i <= last; ++i) {
		const bool is_end = i == 0 || i == last;
		const double below = i == 0 || (is_end && track->is_closed) ? 0 : 1;
		const double above = i == last || (is_end && track->is_closed) ? 0 : 1;
		const double pivot = (is_end ? (track->is_closed ? 1 : 2) : 4) - (i > 0 ? below * share[i - 1] : 0);
		share[i] = above / pivot;
		for (int k = 0; k < JN_TRACK_REALS; ++k)
			track->bend[i][k] = (right_side(track, i, k) - (i > 0 ? below * track->bend[i - 1][k] : 0)) / pivot;
	}
	for (int i = last - 1; i >= 0; --i)
		for (int k = 0; k < JN_TRACK_REALS; ++k) track->bend[i][k] -= share[i] * track->bend[i + 1][k];
	return JN_OK;
}

JnStatus jn_track_create(const JnPath* path, JnArena* arena, JnArena* scratch, JnTrack* track) {
	const double wanted = fmin(fmax(LEAST, (double)A_PIECE * path->pieces), MOST);
	const int count = (int)wanted; // stations
	JnStation* stations;
	JN_NEW(scratch, stations, count);
	jn_path_stations(path, count, 0, stations);
	*track = (JnTrack){.step = path->length / (path->is_closed ? count : count - 1),
					   .length = path->length,
					   .is_closed = path->is_closed,
					   .margin = path->is_closed ? MARGIN : 0};
	track->count = count + (path->is_closed ? 2 * MARGIN + 1 : 0);
	JN_NEW(arena, track->value, track->count);
	JN_NEW(arena, track->bend, track->count);
	for (int i = 0; i < track->count; ++i)
		copy_station(&stations[(i - track->margin + count) % count], track->value[i]);
	return solve_bends(track, scratch);
}

// Beyond the end, `ahead` from it.
static void go_on(const JnTrack* track, double ahead, JnTrackPoint* out) {
	jn_track_at(track, ahead < 0 ? 0 : track->length, out);
	for (int k = 0; k < JN_TRACK_REALS; ++k) {
		if (k >= 3) out->slope[k] = 0;
		out->value[k] += ahead * out->slope[k];
		out->bend[k] = 0;
	}
}

void jn_track_at(const JnTrack* track, double s, JnTrackPoint* out) {
	if (track->is_closed)
		s -= track->length * floor(s / track->length);
	else if (s < 0 || s > track->length) {
		go_on(track, s < 0 ? s : s - track->length, out);
		return;
	}
	const double h = track->step, place = s / h + track->margin;
	int i = (int)place;
	i = i > track->count - 2 ? track->count - 2 : i;
	const double b = place - i, a = 1 - b;
	const double *y = track->value[i], *z = track->value[i + 1], *m = track->bend[i], *n = track->bend[i + 1];
	for (int k = 0; k < JN_TRACK_REALS; ++k) {
		out->value[k] = a * y[k] + b * z[k] + h * h / 6 * ((a * a * a - a) * m[k] + (b * b * b - b) * n[k]);
		out->slope[k] = (z[k] - y[k]) / h + h / 6 * ((3 * b * b - 1) * n[k] - (3 * a * a - 1) * m[k]);
		out->bend[k] = a * m[k] + b * n[k];
	}
}
