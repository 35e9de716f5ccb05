#include "model/wind_gust.h"

#include <math.h>

#include "base/random.h"

static const double full_turn = 6.283185307179586;

static double dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// A random direction; short vectors are drawn again, as their own would be rounded.
static void draw_direction(JnRandom* random, double out[3]) {
	double square;
	do {
		jn_random_in_ball(random, out);
		square = dot(out, out);
	} while (square < 0.01);
	const double length = sqrt(square);
	for (int a = 0; a < 3; ++a) out[a] /= length;
}

// A random direction perpendicular to `to`.
static void draw_perpendicular(JnRandom* random, const double to[3], double out[3]) {
	double square;
	do {
		draw_direction(random, out);
		const double along = dot(out, to);
		for (int a = 0; a < 3; ++a) out[a] -= along * to[a];
		square = dot(out, out);
	} while (square < 0.01);
	const double length = sqrt(square);
	for (int a = 0; a < 3; ++a) out[a] /= length;
}

static void draw_wave(const JnGustDef* def, int j, JnRandom* random, JnGusts* gusts) {
	const int n = def->components;
	double along[3], across[3];
	const double relative = exp2(2 * (j + jn_random_uniform(random)) / n - 1); // of the frequency
	draw_direction(random, along);
	draw_perpendicular(random, along, across);
	gusts->frequency[j] = relative / def->period;
	gusts->turn[j] = jn_random_uniform(random);
	for (int a = 0; a < 3; ++a) {
		gusts->start.wave[j][a] = gusts->is_uniform ? 0 : full_turn * relative / def->wavelength * along[a];
		gusts->start.amplitude[j][a] = def->strength * sqrt(2.0 / n) * across[a];
	}
}

void jn_gusts_create(const JnWindDef* def, JnGusts* gusts) {
	*gusts = (JnGusts){.is_uniform = true};
	for (int a = 0; a < 3; ++a) gusts->start.velocity[a] = def->velocity[a];
	if (def->gusts == NULL || def->gusts->strength == 0) return;
	JnRandom random = {(uint64_t)def->gusts->seed};
	gusts->is_uniform = isnan(def->gusts->wavelength);
	gusts->start.waves = def->gusts->components;
	for (int j = 0; j < gusts->start.waves; ++j) draw_wave(def->gusts, j, &random, gusts);
	for (int j = 0; j < gusts->start.waves; ++j) gusts->start.phase[j] = full_turn * gusts->turn[j];
}

void jn_gusts_at(const JnGusts* gusts, double t, JnAir* air) {
	*air = gusts->start;
	for (int j = 0; j < air->waves; ++j) {
		const double turns = gusts->turn[j] - gusts->frequency[j] * t;
		air->phase[j] = full_turn * (turns - floor(turns));
	}
	if (!gusts->is_uniform) return;
	for (int j = 0; j < air->waves; ++j)
		for (int a = 0; a < 3; ++a) air->velocity[a] += air->amplitude[j][a] * sin(air->phase[j]);
	air->waves = 0;
}
