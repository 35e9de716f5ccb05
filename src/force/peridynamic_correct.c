// Surface corrections, as Le & Bobaru, Comput. Mech. 61 (2018) compare them. A point i near a surface has fewer
// neighbours than the theory counts on; its bonds are made stiffer, with the mean of what both ends ask for.
//
//   volume:  lambda = 2 V0 / (V_i + V_j),  V0 the volume of a full horizon, V_i that of the neighbours of i and itself
//   energy:  with a uniform strain eps along axis a, all s = n_a^2 eps, the density of energy must be C11 eps^2 / 2:
//              g_a(i) = (C11 / 2) / (1/4 sum_j c n_a^4 L V_j),   g_a = (g_a(i) + g_a(j)) / 2,
//              lambda = 1 / sqrt(sum_a (n_a / g_a)^2)       (Madenci & Oterkus, Peridynamic Theory, 2014, section 4.2)
//            This also takes out the error of the lattice for strains along its axes, inside the body too.
#include <math.h>

#include "force/peridynamic.h"

static const double PI = 3.14159265358979323846;

typedef struct Pair {
	int i, j;
	double length, share;
	double n[3];
} Pair;

static Pair pair_at(const JnPeridynamics* body, int i, int p) {
	Pair pair = {.i = i, .j = body->pairs.list[p]};
	const double *x = body->mesh->nodes + 3 * (ptrdiff_t)i, *y = body->mesh->nodes + 3 * (ptrdiff_t)pair.j;
	double square = 0;
	for (int a = 0; a < 3; a++) {
		pair.n[a] = y[a] - x[a];
		square += pair.n[a] * pair.n[a];
	}
	pair.length = sqrt(square);
	pair.share = jn_peridynamic_share(body, pair.length);
	for (int a = 0; a < 3; a++) pair.n[a] = pair.length > 0 ? pair.n[a] / pair.length : 0;
	return pair;
}

typedef void PairVisit(const JnPeridynamics*, const Pair*, int p, double* of_points, double* scale);

static void for_all_pairs(const JnPeridynamics* body, PairVisit* visit, double* of_points, double* scale) {
	for (int i = 0; i < body->mesh->node_count; i++)
		for (int p = body->pairs.starts[i]; p < body->pairs.starts[i + 1]; p++) {
			const Pair pair = pair_at(body, i, p);
			visit(body, &pair, p, of_points, scale);
		}
}

static void add_volumes(const JnPeridynamics* body, const Pair* pair, int p, double* volume, double* scale) {
	(void)p, (void)scale;
	volume[pair->i] += body->mesh->volumes[pair->j] * pair->share;
	volume[pair->j] += body->mesh->volumes[pair->i] * pair->share;
}

static void scale_by_volume(const JnPeridynamics* body, const Pair* pair, int p, double* volume, double* scale) {
	const double delta = body->horizon;
	const double full =
		body->dimensions == 2 ? PI * delta * delta * body->mesh->thickness : 4.0 / 3 * PI * pow(delta, 3);
	scale[p] = 2 * full / (volume[pair->i] + volume[pair->j]);
}

static JnStatus correct_by_volume(const JnPeridynamics* body, JnArena* scratch, double* scale) {
	double* volume;
	JN_NEW(scratch, volume, body->mesh->node_count);
	for (int i = 0; i < body->mesh->node_count; i++) volume[i] = body->mesh->volumes[i];
	for_all_pairs(body, add_volumes, volume, scale);
	for_all_pairs(body, scale_by_volume, volume, scale);
	return JN_OK;
}

static void add_energies(const JnPeridynamics* body, const Pair* pair, int p, double* energy, double* scale) {
	(void)p, (void)scale;
	for (int a = 0; a < 3; a++) {
		const double density = 0.25 * body->modulus * pow(pair->n[a], 4) * pair->length * pair->share;
		energy[3 * (ptrdiff_t)pair->i + a] += density * body->mesh->volumes[pair->j];
		energy[3 * (ptrdiff_t)pair->j + a] += density * body->mesh->volumes[pair->i];
	}
}

// Without a bond along an axis n_a is 0, and the factor of no account.
static double factor_of(double expected, double energy) {
	return energy > 1e-12 * expected ? expected / energy : 1;
}

static void scale_by_energy(const JnPeridynamics* body, const Pair* pair, int p, double* energy, double* scale) {
	// E (1 - nu) / ((1 + nu)(1 - 2 nu)) with nu = 1/4, and E / (1 - nu^2) with nu = 1/3
	const double expected = 0.5 * (body->dimensions == 2 ? 9.0 / 8 : 6.0 / 5) * body->def->young;
	double sum = 0;
	for (int a = 0; a < 3; a++) {
		const double g = 0.5 * (factor_of(expected, energy[3 * (ptrdiff_t)pair->i + a]) +
								factor_of(expected, energy[3 * (ptrdiff_t)pair->j + a]));
		sum += pair->n[a] / g * (pair->n[a] / g);
	}
	scale[p] = sum > 0 ? 1 / sqrt(sum) : 1;
}

static JnStatus correct_by_energy(const JnPeridynamics* body, JnArena* scratch, double* scale) {
	double* energy;
	JN_NEW(scratch, energy, 3 * (size_t)body->mesh->node_count);
	for_all_pairs(body, add_energies, energy, scale);
	for_all_pairs(body, scale_by_energy, energy, scale);
	return JN_OK;
}

static JnStatus leave_as_is(const JnPeridynamics* body, JnArena* scratch, double* scale) {
	(void)scratch;
	for (int p = 0; p < body->pairs.starts[body->mesh->node_count]; p++) scale[p] = 1;
	return JN_OK;
}

JnStatus jn_peridynamic_correct(const JnPeridynamics* body, JnArena* scratch, double* scale) {
	static JnStatus (*const correct[])(const JnPeridynamics*, JnArena*,
									   double*) = {[JN_SURFACE_NONE] = leave_as_is,
												   [JN_SURFACE_VOLUME] = correct_by_volume,
												   [JN_SURFACE_ENERGY] = correct_by_energy};
	return correct[body->def->surface](body, scratch, scale);
}
