// Rigid motions of aggregates, by the modified Gram-Schmidt process, twice. A motion about the aggregate's centre c of a node
// with centre x is, in the node's own motions, the same rotation w and the translation w x (x - c). Motions that an aggregate
// does not have, such as the rotation of a line of nodes about itself, leave columns of zeros.
#include <math.h>
#include <string.h>

#include "solve/multigrid.h"

enum { MODES = JN_GRID_MODES };

// A motion of which less than this is left by the others counts as none; rotations are scaled to the aggregate's size.
static const double least = 1e-3;

static bool is_held(const JnGridLevel* level, int node, int unknown) {
	return level->held != NULL && level->held[3 * (size_t)node + (size_t)unknown];
}

// What moves with the motions of its own centre: [unknowns][6].
static void own_modes(const JnGridLevel* level, int node, double out[MODES][MODES]) {
	memset(out, 0, MODES * sizeof *out);
	if (level->modes != NULL)
		memcpy(out, level->modes + MODES * MODES * (size_t)node, MODES * sizeof *out);
	else
		for (int a = 0; a < level->size; ++a) out[a][a] = is_held(level, node, a) ? 0 : 1;
}

static void move_center(const double from[3], const double to[3], int size, double modes[MODES][MODES]) {
	const double x = from[0] - to[0], y = from[1] - to[1], z = from[2] - to[2];
	for (int a = 0; a < size; ++a) {
		double* row = modes[a];
		row[3] += row[2] * y - row[1] * z;
		row[4] += row[0] * z - row[2] * x;
		row[5] += row[1] * x - row[0] * y;
	}
}

static void find_center(const JnGridLevel* level, int j, double center[3]) {
	const int first = level->member_start[j], last = level->member_start[j + 1];
	memset(center, 0, 3 * sizeof *center);
	for (int m = first; m < last; ++m)
		for (int a = 0; a < 3; ++a)
			center[a] += level->center[3 * (size_t)level->member[m] + (size_t)a] / (last - first);
}

static float* row_of(const JnGridLevel* level, int m, int a) {
	return level->tentative + JN_GRID_LANES * ((size_t)level->size * (size_t)level->member[m] + (size_t)a);
}

static double dot(const JnGridLevel* level, int j, int p, int q) {
	double sum = 0;
	for (int m = level->member_start[j]; m < level->member_start[j + 1]; ++m)
		for (int a = 0; a < level->size; ++a) {
			const float* row = row_of(level, m, a);
			sum += (double)row[p] * (double)row[q];
		}
	return sum;
}

static void combine(const JnGridLevel* level, int j, int p, double scale, int q, double more) {
	for (int m = level->member_start[j]; m < level->member_start[j + 1]; ++m)
		for (int a = 0; a < level->size; ++a) {
			float* row = row_of(level, m, a);
			row[p] = (float)(scale * (double)row[p] + more * (double)row[q]);
		}
}

// Columns of `tentative` become orthonormal; R is what they were made of.
static void orthonormalize(const JnGridLevel* level, int j, double R[MODES][MODES]) {
	double largest = 0;
	for (int p = 0; p < MODES; ++p) largest = fmax(largest, dot(level, j, p, p));
	for (int p = 0; p < MODES; ++p) {
		for (int pass = 0; pass < 2; ++pass)
			for (int q = 0; q < p; ++q) {
				const double part = dot(level, j, p, q);
				R[q][p] += part;
				combine(level, j, p, 1, q, -part);
			}
		const double norm = sqrt(dot(level, j, p, p));
		const bool is_there = norm > least * sqrt(largest);
		R[p][p] = is_there ? norm : 0;
		combine(level, j, p, is_there ? 1 / norm : 0, p, 0);
	}
}

// Rotations become as large as translations. Returns what they were divided by.
static double scale_rotations(const JnGridLevel* level, int j) {
	double translation = 0, rotation = 0;
	for (int p = 0; p < 3; ++p) {
		translation = fmax(translation, dot(level, j, p, p));
		rotation = fmax(rotation, dot(level, j, p + 3, p + 3));
	}
	if (!(rotation > 0 && translation > 0)) return 1;
	const double length = sqrt(rotation / translation);
	for (int p = 3; p < MODES; ++p) combine(level, j, p, 1 / length, p, 0);
	return length;
}

static void span_one(const JnGridLevel* level, JnGridLevel* coarse, int j) {
	double* center = coarse->center + 3 * (size_t)j;
	find_center(level, j, center);
	for (int m = level->member_start[j]; m < level->member_start[j + 1]; ++m) {
		double modes[MODES][MODES];
		own_modes(level, level->member[m], modes);
		move_center(level->center + 3 * (size_t)level->member[m], center, level->size, modes);
		for (int a = 0; a < level->size; ++a)
			for (int p = 0; p < MODES; ++p) row_of(level, m, a)[p] = (float)modes[a][p];
	}
	const double length = scale_rotations(level, j);
	double R[MODES][MODES] = {{0}};
	orthonormalize(level, j, R);
	double* out = coarse->modes + MODES * MODES * (size_t)j;
	for (int q = 0; q < MODES; ++q)
		for (int p = 0; p < MODES; ++p) out[MODES * q + p] = p < 3 ? R[q][p] : R[q][p] * length;
}

void jn_grid_span(JnGridLevel* level, JnGridLevel* coarse) {
	for (int j = 0; j < coarse->nodes; ++j) span_one(level, coarse, j);
}
