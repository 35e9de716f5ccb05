// With c = factor, s = w.n and S = A n, the force on a corner is f = c s|s| S, so that
//   df = c (2 |s| A n (n.dw) + 2 |s| n ((w - s n).dS) + s|s| dS),
//   dS = d_j x dp_j / 2 with the edge d_j opposite to corner j,   dw = (G dp_j - dv_j) / 3.
#include "force/wind.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/processor.h"
#include "math/vec3.h"

JnWindForces jn_wind_forces_2, jn_wind_forces_4, jn_wind_forces_8;

JnWindForces* jn_wind_forces(int width) {
#if defined(__x86_64__)
	const int widest = jn_processor_width(), chosen = width != 0 ? width : widest;
	if (chosen > widest) return NULL;
	if (chosen == 8) return jn_wind_forces_8;
	if (chosen == 4) return jn_wind_forces_4;
	return chosen == 2 ? jn_wind_forces_2 : NULL;
#else
	return width == 0 || width == 2 ? jn_wind_forces_2 : NULL;
#endif
}

void jn_air_at(const JnAir* air, const double x[3], double velocity[3], double gradient[9]) {
	memcpy(velocity, air->velocity, sizeof air->velocity);
	memset(gradient, 0, 9 * sizeof *gradient);
	for (int i = 0; i < air->waves; ++i) {
		const double *k = air->wave[i], *amplitude = air->amplitude[i];
		const double angle = k[0] * x[0] + k[1] * x[1] + k[2] * x[2] + air->phase[i];
		const double sine = sin(angle), cosine = cos(angle);
		for (int r = 0; r < 3; ++r) {
			velocity[r] += amplitude[r] * sine;
			for (int c = 0; c < 3; ++c) gradient[3 * r + c] += amplitude[r] * cosine * k[c];
		}
	}
}

static void edge(const double a[3], const double b[3], double out[3]) {
	for (int i = 0; i < 3; ++i) out[i] = b[i] - a[i];
}

// n and the return value A of the triangle p.
static double normal_of(const double* const p[3], double n[3]) {
	double first[3], second[3], twice[3];
	edge(p[0], p[1], first);
	edge(p[0], p[2], second);
	vec3_cross(first, second, twice);
	const double length = sqrt(vec3_dot(twice, twice));
	for (int i = 0; i < 3; ++i) n[i] = length > 0 ? twice[i] / length : 0;
	return 0.5 * length;
}

// -df/dp_j = -c (n g^T + s|s| X), with X v = d x v / 2 and g = 2 |s| (A G^T n / 3 + (w - s n) x d / 2).
static void add_corner(double factor, double s, const double n[3], const double g[3], const double d[3],
					   double block[9]) {
	const double signed_square = s * fabs(s);
	const double half[9] = {0, -0.5 * d[2], 0.5 * d[1], 0.5 * d[2], 0, -0.5 * d[0], -0.5 * d[1], 0.5 * d[0], 0};
	for (int k = 0; k < 9; ++k) block[k] = -factor * (n[k / 3] * g[k % 3] + signed_square * half[k]);
}

void jn_wind_tangent(double factor, const double* const p[3], const double w[3], const double gradient[9],
					 JnWindTangent* out) {
	double n[3], along[3];
	memset(out, 0, sizeof *out);
	const double area = normal_of(p, n), s = vec3_dot(w, n);
	if (area == 0) return;
	for (int i = 0; i < 3; ++i) along[i] = w[i] - s * n[i];
	for (int j = 0; j < 3; ++j) {
		double d[3], g[3];
		edge(p[(j + 1) % 3], p[(j + 2) % 3], d);
		vec3_cross(along, d, g);
		for (int c = 0; c < 3; ++c) {
			const double slope = gradient[c] * n[0] + gradient[3 + c] * n[1] + gradient[6 + c] * n[2];
			g[c] = 2 * fabs(s) * (area / 3 * slope + 0.5 * g[c]);
		}
		add_corner(factor, s, n, g, d, out->stiffness[j]);
	}
	for (int i = 0; i < 3; ++i) out->damping[i] = sqrt(2.0 / 3 * factor * fabs(s) * area) * n[i];
}
