// Derivatives of the wind's forces, kept one a triangle: products are summed like forces, and only a factorisation spreads them
// over the rows of a matrix. K is not symmetric, as the force has no potential; D is.
#include <string.h>

#include "base/parallel.h"
#include "model/wind.h"

// Triangles that make another thread worth waking: a tangent costs some 100 ns.
enum { GRAIN = 2048, LANES = JN_WIND_LANES };

static const int* corners_of(const JnWind* wind, int triangle) {
	return wind->surface.nodes + (ptrdiff_t)(triangle / LANES) * 3 * LANES + triangle % LANES;
}

static void linearize_triangle(JnWind* wind, const JnAir* air, const JnState* s, int triangle) {
	const int* corners = corners_of(wind, triangle);
	const double* p[3];
	double centre[3] = {0, 0, 0}, speed[3] = {0, 0, 0}, w[3], gradient[9];
	for (int c = 0; c < 3; ++c) {
		const size_t node = 3 * (size_t)corners[c * LANES];
		p[c] = s->x + node;
		for (int a = 0; a < 3; ++a) centre[a] += p[c][a] / 3;
		for (int a = 0; a < 3; ++a) speed[a] += s->v[node + (size_t)a] / 3;
	}
	jn_air_at(air, centre, w, gradient);
	for (int a = 0; a < 3; ++a) w[a] -= speed[a];
	jn_wind_tangent(wind->surface.factor[triangle], p, w, gradient, &wind->tangent[triangle]);
}

bool jn_wind_linearize(JnWind* wind, const JnState* s) {
	const size_t bytes = 3 * (size_t)wind->model->node_count * sizeof *s->v;
	if (wind->stamp == s->stamp && memcmp(wind->tangent_v, s->v, bytes) == 0) return false;
	JnAir air;
	jn_gusts_at(&wind->gusts, s->t, &air);
	const int team = jn_threads_for((size_t)wind->triangles, GRAIN, wind->model->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int t = 0; t < wind->triangles; ++t) linearize_triangle(wind, &air, s, t);
	memcpy(wind->tangent_v, s->v, bytes);
	wind->stamp = s->stamp;
	return true;
}

// sum_j (d m m^T + k K_j) in_j, the same for the three corners.
static void apply_triangle(const JnWind* wind, JnShift shift, const double* in, int triangle, double* out) {
	const JnWindTangent* tangent = &wind->tangent[triangle];
	const int* corners = corners_of(wind, triangle);
	const double* m = tangent->damping;
	double sum[3] = {0, 0, 0}, along = 0;
	for (int j = 0; j < 3; ++j) {
		const double *part = in + 3 * (size_t)corners[j * LANES], *K = tangent->stiffness[j];
		along += m[0] * part[0] + m[1] * part[1] + m[2] * part[2];
		for (int a = 0; a < 3; ++a) sum[a] += K[3 * a] * part[0] + K[3 * a + 1] * part[1] + K[3 * a + 2] * part[2];
	}
	for (int a = 0; a < 3; ++a) out[a] = shift.damping * along * m[a] + shift.stiffness * sum[a];
}

static void add_products(const JnWind* wind, JnShift shift, const double* in, JnWindRange range, double* out) {
	double vectors[4 * LANES];
	for (int block = 0; block < wind->surface.blocks; ++block) {
		if (!jn_wind_touches(wind, block, range)) continue;
		for (int t = block * LANES; t < (block + 1) * LANES && t < wind->triangles; ++t)
			apply_triangle(wind, shift, in, t, vectors + (ptrdiff_t)(t - block * LANES) * 4);
		jn_wind_scatter(wind, block, vectors, range, out);
	}
}

void jn_wind_apply(const JnWind* wind, JnShift shift, const double* in, double* out) {
	if (shift.damping == 0 && shift.stiffness == 0) return;
	const int team = jn_threads_for((size_t)wind->triangles, GRAIN, wind->model->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int t = 0; t < team; ++t) add_products(wind, shift, in, jn_wind_range(wind, t, team), out);
}

void jn_wind_add_blocks(const JnWind* wind, JnShift shift, double* full) {
	for (int t = 0; t < wind->triangles; ++t) {
		const JnWindTangent* tangent = &wind->tangent[t];
		const double* m = tangent->damping;
		for (int k = 0; k < 9; ++k) {
			double* to = full + 9 * (size_t)wind->target[9 * (size_t)t + (size_t)k];
			const double* K = tangent->stiffness[k % 3];
			for (int e = 0; e < 9; ++e) to[e] += shift.damping * m[e / 3] * m[e % 3] + shift.stiffness * K[e];
		}
	}
}
