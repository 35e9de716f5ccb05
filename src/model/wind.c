#include "model/wind.h"

#include <math.h>

#include "base/parallel.h"
#include "mesh/boundary.h"

// Triangles that make another thread worth waking: a fork costs 50 to 100 us, a triangle some 10 ns.
enum { GRAIN = 16384, LANES = JN_WIND_LANES, CHUNK = 8 }; // CHUNK: blocks that stay in the cache until they are added

// Outer triangles of all bodies with drag, one behind the other, with the model's node numbers.
typedef struct Surfaces {
	int* count;      // one a body
	int** triangles; // with the bodies' node numbers
} Surfaces;

static JnStatus find_surfaces(JnModel* model, JnArena* scratch, Surfaces* out, int* total) {
	JN_NEW(scratch, out->count, model->body_count);
	JN_NEW(scratch, out->triangles, model->body_count);
	for (int b = 0; b < model->body_count; ++b) {
		if (model->bodies[b].drag == 0) continue;
		JN_TRY(jn_mesh_boundary(&model->bodies[b].mesh, scratch, &out->count[b], &out->triangles[b]));
		*total += out->count[b];
	}
	return JN_OK;
}

// Index of the first number of a triangle in [blocks][3][lanes].
static size_t place_of(int triangle) {
	return (size_t)(triangle / LANES) * 3 * LANES + (size_t)(triangle % LANES);
}

static JnStatus lay_out(const JnWindDef* def, JnModel* model, const Surfaces* surfaces, JnWind* wind) {
	int *nodes, next = 0;
	double* factor;
	wind->surface.blocks = (wind->triangles + LANES - 1) / LANES;
	JN_NEW(&model->arena, nodes, (size_t)wind->surface.blocks * 3 * LANES);
	JN_NEW(&model->arena, factor, (size_t)wind->surface.blocks * LANES);
	JN_NEW(&model->arena, wind->low, wind->surface.blocks);
	JN_NEW(&model->arena, wind->high, wind->surface.blocks);
	for (int b = 0; b < model->body_count; ++b)
		for (int i = 0; i < surfaces->count[b]; ++i, ++next) {
			for (int c = 0; c < 3; ++c)
				nodes[place_of(next) + (size_t)(c * LANES)] =
					surfaces->triangles[b][3 * i + c] + model->bodies[b].first_node;
			factor[next] = def->density * model->bodies[b].drag / 6;
		}
	wind->surface.nodes = nodes; // padding: triangles of node 0 alone, with the factor 0
	wind->surface.factor = factor;
	return JN_OK;
}

static int corner_of(const JnWind* wind, int triangle, int c) {
	return wind->surface.nodes[place_of(triangle) + (size_t)(c * LANES)];
}

static void bound_blocks(JnWind* wind) {
	for (int t = 0; t < wind->triangles; ++t)
		for (int c = 0; c < 3; ++c) {
			const int node = corner_of(wind, t, c), block = t / LANES;
			if (t % LANES == 0 && c == 0) wind->low[block] = wind->high[block] = node;
			wind->low[block] = node < wind->low[block] ? node : wind->low[block];
			wind->high[block] = node > wind->high[block] ? node : wind->high[block];
		}
}

// Place of (row, column), which are neighbours, in the full rows of the pattern.
static int full_place(const JnPattern* pattern, int row, int column) {
	int low = pattern->full_start[row], high = pattern->full_start[row + 1] - 1;
	while (low < high) {
		const int middle = low + (high - low) / 2;
		if (pattern->full_column[middle] < column)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

static JnStatus prepare_tangent(JnModel* model, JnWind* wind) {
	JN_NEW(&model->arena, wind->tangent, wind->triangles);
	JN_NEW(&model->arena, wind->target, 9 * (size_t)wind->triangles);
	JN_NEW(&model->arena, wind->tangent_v, 3 * (size_t)model->node_count);
	for (int t = 0; t < wind->triangles; ++t)
		for (int k = 0; k < 9; ++k)
			wind->target[9 * (size_t)t + (size_t)k] =
				full_place(&model->pattern, corner_of(wind, t, k / 3), corner_of(wind, t, k % 3));
	return JN_OK;
}

// Mean of |u|^2 over time.
static double mean_square_speed(const JnAir* air) {
	double sum = 0;
	for (int a = 0; a < 3; ++a) {
		sum += air->velocity[a] * air->velocity[a];
		for (int j = 0; j < air->waves; ++j) sum += 0.5 * air->amplitude[j][a] * air->amplitude[j][a];
	}
	return sum;
}

static double rest_area(const JnWind* wind, int triangle) {
	double e[2][3];
	for (int i = 0; i < 2; ++i)
		for (int a = 0; a < 3; ++a)
			e[i][a] = wind->model->rest[3 * (size_t)corner_of(wind, triangle, i + 1) + (size_t)a] -
					  wind->model->rest[3 * (size_t)corner_of(wind, triangle, 0) + (size_t)a];
	const double twice[3] = {e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
							 e[0][0] * e[1][1] - e[0][1] * e[1][0]};
	return 0.5 * sqrt(twice[0] * twice[0] + twice[1] * twice[1] + twice[2] * twice[2]);
}

static JnStatus find_typical_force(const JnModel* model, JnArena* scratch, JnWind* wind) {
	const double square = mean_square_speed(&wind->gusts.start);
	double *f, sum = 0;
	JN_NEW(scratch, f, 3 * (size_t)model->node_count);
	for (int t = 0; t < wind->triangles; ++t)
		for (int c = 0; c < 3; ++c)
			f[3 * (size_t)corner_of(wind, t, c)] += wind->surface.factor[t] * square * rest_area(wind, t);
	for (int k = 0; k < 3 * model->node_count; ++k) sum += f[k] * f[k];
	wind->typical_force = sqrt(sum);
	return JN_OK;
}

static JnStatus build(const JnWindDef* def, JnModel* model, JnArena* scratch, JnWind** out) {
	Surfaces surfaces;
	int total = 0;
	JN_TRY(find_surfaces(model, scratch, &surfaces, &total));
	if (total == 0) return JN_OK;
	JnWind* wind;
	JN_NEW(&model->arena, wind, 1);
	wind->model = model;
	wind->triangles = total;
	wind->forces = jn_wind_forces(0);
	jn_gusts_create(def, &wind->gusts);
	JN_TRY(lay_out(def, model, &surfaces, wind));
	bound_blocks(wind);
	JN_TRY(find_typical_force(model, scratch, wind));
	if (def->tangent == 1) JN_TRY(prepare_tangent(model, wind));
	*out = wind;
	return JN_OK;
}

JnStatus jn_wind_create(const JnWindDef* def, JnModel* model, JnWind** wind) {
	*wind = NULL;
	JnArena scratch = {0};
	const JnStatus status = build(def, model, &scratch, wind);
	jn_arena_free(&scratch);
	return status;
}

JnWindRange jn_wind_range(const JnWind* wind, int t, int team) {
	const long nodes = wind->model->node_count;
	return (JnWindRange){.low = (int)(nodes * t / team), .high = (int)(nodes * (t + 1) / team)};
}

bool jn_wind_touches(const JnWind* wind, int block, JnWindRange range) {
	return wind->low[block] < range.high && wind->high[block] >= range.low;
}

void jn_wind_scatter(const JnWind* wind, int block, const double* vectors, JnWindRange range, double* f) {
	const int *nodes = wind->surface.nodes + (ptrdiff_t)block * 3 * LANES, rest = wind->triangles - block * LANES;
	const int lanes = rest < LANES ? rest : LANES;
	for (int lane = 0; lane < lanes; ++lane)
		for (int c = 0; c < 3; ++c) {
			const int node = nodes[c * LANES + lane];
			if (node < range.low || node >= range.high) continue;
			double* to = f + 3 * (size_t)node;
			to[0] += vectors[4 * lane];
			to[1] += vectors[4 * lane + 1];
			to[2] += vectors[4 * lane + 2];
		}
}

static void add_forces(const JnWind* wind, const JnAir* air, const JnState* s, JnWindRange range, double* f) {
	double vectors[CHUNK * LANES * 4];
	for (int first = 0; first < wind->surface.blocks; first += CHUNK) {
		int from = first, to = first + CHUNK < wind->surface.blocks ? first + CHUNK : wind->surface.blocks;
		while (from < to && !jn_wind_touches(wind, from, range)) ++from;
		while (from < to && !jn_wind_touches(wind, to - 1, range)) --to;
		if (from == to) continue;
		wind->forces(&wind->surface, air, from, to, s->x, s->v, vectors);
		for (int block = from; block < to; ++block)
			jn_wind_scatter(wind, block, vectors + (ptrdiff_t)(block - from) * LANES * 4, range, f);
	}
}

void jn_wind_force(const JnWind* wind, const JnState* s, double* f) {
	JnAir air;
	jn_gusts_at(&wind->gusts, s->t, &air);
	const int team = jn_threads_for((size_t)wind->triangles, GRAIN, wind->model->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int t = 0; t < team; ++t) add_forces(wind, &air, s, jn_wind_range(wind, t, team), f);
}
