// The forces of the wind, compiled once a vector width; see wind.h.
#include "force/wind.h"
#include "math/mat3.h"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

enum { LANES = JN_WIND_LANES };

// sin a = (-1)^n sin r with n = a / pi rounded and |r| <= pi/2, by the Taylor polynomial up to r^19: its remainder is below
// 3e-16. pi stands in three parts, of which n times the first two is exact up to |n| = 2^22.
JN_INLINE Wide sine(Wide a) {
	static const double coefficient[] = {-1.0 / 6,
										 1.0 / 120,
										 -1.0 / 5040,
										 1.0 / 362880,
										 -1.0 / 39916800,
										 1.0 / 6227020800,
										 -1.0 / 1307674368000,
										 1.0 / 355687428096000,
										 -1.0 / 121645100408832000};
	const Wide round = wide_set(0x1.8p52), shifted = a * wide_set(0x1.45f306dc9c883p-2) + round, n = shifted - round;
	Wide r = wide_fma(n, wide_set(-0x1.921fb54p+1), a);
	r = wide_fma(n, wide_set(-0x1.10b46118p-29), r);
	r = wide_fma(n, wide_set(-0x1.313198a2e037p-60), r);
	const Wide square = r * r;
	Wide sum = wide_set(coefficient[8]);
	JN_UNROLL for (int k = 7; k >= 0; k--) sum = wide_fma(sum, square, wide_set(coefficient[k]));
	// cppcheck-suppress shiftTooManyBitsSigned // lanes of GNU C are shifted as bits
	return (Wide)((WideMask)wide_fma(r * square, sum, r) ^ ((WideMask)shifted << 63));
}

// w += the waves of the air at x.
JN_INLINE void add_waves(const JnAir* air, const Wide x[3], Wide w[3]) {
	for (int i = 0; i < air->waves; ++i) {
		const double *k = air->wave[i], *amplitude = air->amplitude[i];
		Wide angle = wide_set(air->phase[i]);
		JN_UNROLL for (int a = 0; a < 3; a++) angle = wide_fma(wide_set(k[a]), x[a], angle);
		const Wide height = sine(angle);
		JN_UNROLL for (int a = 0; a < 3; a++) w[a] = wide_fma(wide_set(amplitude[a]), height, w[a]);
	}
}

typedef struct Corners {
	Wide at[3][3]; // [corner][axis]
} Corners;

JN_INLINE Corners corners_of(const double* from, const int* nodes) {
	Corners out;
	// cppcheck-suppress uninitvar // is written here
	JN_UNROLL for (int c = 0; c < 3; c++) wide_gather_points(from, nodes + c * LANES, out.at[c]);
	return out;
}

// Sum of the corners' numbers over three.
JN_INLINE Wide mean(const Corners* corners, int axis) {
	return (corners->at[0][axis] + corners->at[1][axis] + corners->at[2][axis]) * wide_set(1.0 / 3);
}

JN_INLINE void relative_wind(const JnAir* air, const Corners* x, const Corners* v, Wide w[3]) {
	JN_UNROLL for (int a = 0; a < 3; a++) w[a] = wide_set(air->velocity[a]) - mean(v, a);
	if (air->waves == 0) return;
	Wide centre[3];
	JN_UNROLL for (int a = 0; a < 3; a++) centre[a] = mean(x, a);
	add_waves(air, centre, w);
}

JN_INLINE void area_vector(const Corners* x, Wide S[3]) {
	Wide e[3], d[3];
	JN_UNROLL for (int a = 0; a < 3; a++) {
		e[a] = x->at[1][a] - x->at[0][a];
		d[a] = x->at[2][a] - x->at[0][a];
	}
	const Wide half = wide_set(0.5);
	S[0] = half * wide_minor(e[1], d[2], e[2], d[1]);
	S[1] = half * wide_minor(e[2], d[0], e[0], d[2]);
	S[2] = half * wide_minor(e[0], d[1], e[1], d[0]);
}

// Lane by lane, as they are added to nodes.
JN_INLINE void store_vectors(Wide x, Wide y, Wide z, double* out) {
	double lanes[3][JN_WIDE];
	memcpy(lanes[0], &x, sizeof lanes[0]);
	memcpy(lanes[1], &y, sizeof lanes[1]);
	memcpy(lanes[2], &z, sizeof lanes[2]);
	JN_UNROLL for (int lane = 0; lane < JN_WIDE; lane++) {
		JN_UNROLL for (int a = 0; a < 3; a++) out[4 * lane + a] = lanes[a][lane];
		out[4 * lane + 3] = 0;
	}
}

JnWindForces JOIN(jn_wind_forces_, JN_WIDE);

void JOIN(jn_wind_forces_, JN_WIDE)(const JnWindSurface* surface, const JnAir* air, int first, int last,
									const double* x, const double* v, double* out) {
	for (int place = first * LANES; place < last * LANES; place += JN_WIDE) {
		const int block = place / LANES, lane = place % LANES;
		const int* nodes = surface->nodes + (ptrdiff_t)block * 3 * LANES + lane;
		const Corners at = corners_of(x, nodes), rate = corners_of(v, nodes);
		Wide S[3], w[3];
		area_vector(&at, S);
		relative_wind(air, &at, &rate, w);
		const Wide through = wide_dot3(w[0], S[0], w[1], S[1], w[2], S[2]);
		const Wide square = wide_max(wide_dot3(S[0], S[0], S[1], S[1], S[2], S[2]), wide_set(1e-300));
		const Wide factor = wide_load(surface->factor + place) * through * wide_abs(through) / square;
		store_vectors(factor * S[0], factor * S[1], factor * S[2], out + (ptrdiff_t)(place - first * LANES) * 4);
	}
}
