/// @file knot.h
/// Which knot is a polygon? Its determinant |Alexander(-1)| tells: 1 unknotted, 3 trefoil and overhand knot, 5 figure
/// eight. (A few knots also have 1; none of them has fewer than ten crossings.)
///
/// The polygon is seen from a direction that is none of its own. Arcs run from one passage below to the next; each
/// crossing says 2 over = under + under' (Fox's colourings), and any minor of these rows is the determinant.
#ifndef JN_TEST_SUPPORT_KNOT_H
#define JN_TEST_SUPPORT_KNOT_H

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/// Where a polygon passes over itself: segment + share along it, above and below.
typedef struct KnotCrossing {
	double over, under;
} KnotCrossing;

static inline int knot_compare(const void* a, const void* b) {
	const double x = ((const KnotCrossing*)a)->under, y = ((const KnotCrossing*)b)->under;
	return (x > y) - (x < y);
}

/// Do the projections of a - b and c - d cross? Then s and t are where.
static inline bool knot_cross(const double* a, const double* b, const double* c, const double* d, double* s,
							  double* t) {
	const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {d[0] - c[0], d[1] - c[1]},
				 w[2] = {c[0] - a[0], c[1] - a[1]};
	const double area = u[0] * v[1] - u[1] * v[0];
	if (area == 0) return false;
	*s = (w[0] * v[1] - w[1] * v[0]) / area;
	*t = (w[0] * u[1] - w[1] * u[0]) / area;
	return *s >= 0 && *s < 1 && *t >= 0 && *t < 1;
}

/// Determinant of a square matrix of whole numbers, which is destroyed.
static inline double knot_eliminate(int n, double* A) {
	double determinant = 1;
	for (int k = 0; k < n; ++k) {
		int best = k;
		for (int r = k + 1; r < n; ++r)
			if (fabs(A[r * n + k]) > fabs(A[best * n + k])) best = r;
		if (A[best * n + k] == 0) return 0;
		for (int c = k; c < n; ++c) {
			const double swap = A[k * n + c];
			A[k * n + c] = A[best * n + c];
			A[best * n + c] = swap;
		}
		determinant *= A[k * n + k];
		for (int r = k + 1; r < n; ++r) {
			const double share = A[r * n + k] / A[k * n + k];
			for (int c = k; c < n && share != 0; ++c) A[r * n + c] -= share * A[k * n + c];
		}
	}
	return determinant;
}

static inline int knot_colour(int count, KnotCrossing* crossings) {
	const int n = count - 1;
	double* A = calloc((size_t)(n > 0 ? n * n : 1), sizeof *A);
	if (A == NULL) abort();
	qsort(crossings, (size_t)count, sizeof *crossings, knot_compare);
	for (int row = 0; row < n; ++row) {
		int over = 0;
		while (over < count && crossings[over].under < crossings[row].over) ++over;
		const int arcs[3] = {over % count, row, (row + 1) % count};
		for (int i = 0; i < 3; ++i)
			if (arcs[i] < n) A[row * n + arcs[i]] += i == 0 ? 2 : -1;
	}
	const double determinant = knot_eliminate(n, A);
	free(A);
	return (int)lround(fabs(determinant));
}

/// Points as they are seen: x, y in the picture, z towards the eye.
static inline void knot_project(int count, const double* points, double* out) {
	const double a = 0.77351, b = 0.61803; // turns about x and y, a direction that nothing has
	for (int i = 0; i < count; ++i) {
		const double* p = points + 3 * i;
		const double y = cos(a) * p[1] - sin(a) * p[2], z = sin(a) * p[1] + cos(a) * p[2];
		out[3 * i] = cos(b) * p[0] + sin(b) * z;
		out[3 * i + 1] = y;
		out[3 * i + 2] = cos(b) * z - sin(b) * p[0];
	}
}

static inline int knot_find(int count, const double* p, KnotCrossing* crossings) {
	int found = 0;
	for (int i = 0; i < count; ++i)
		for (int j = i + 2; j < count; ++j) {
			if (i == 0 && j == count - 1) continue; // neighbours
			const double *a = p + 3 * i, *b = p + 3 * (i + 1), *c = p + 3 * j, *d = p + 3 * ((j + 1) % count);
			double s, t;
			if (!knot_cross(a, b, c, d, &s, &t)) continue;
			const bool first_above = (1 - s) * a[2] + s * b[2] > (1 - t) * c[2] + t * d[2];
			crossings[found++] = first_above ? (KnotCrossing){i + s, j + t} : (KnotCrossing){j + t, i + s};
		}
	return found;
}

/// Three points beyond the ends of an open curve, through which it is closed far from all others.
static inline void knot_close(int count, const double* points, double* out) {
	double middle[3] = {0}, size = 0, away[2][3], across[3];
	for (int k = 0; k < 3 * count; ++k) middle[k % 3] += points[k] / count;
	for (int k = 0; k < 3 * count; ++k) size = fmax(size, fabs(points[k] - middle[k % 3]));
	for (int e = 0; e < 2; ++e) {
		const double* end = points + 3 * (e == 0 ? count - 1 : 0);
		double length = 0;
		for (int a = 0; a < 3; ++a) away[e][a] = end[a] - middle[a];
		for (int a = 0; a < 3; ++a) length += away[e][a] * away[e][a];
		for (int a = 0; a < 3; ++a) away[e][a] /= sqrt(length);
		for (int a = 0; a < 3; ++a) out[3 * (2 * e) + a] = end[a] + 100 * size * away[e][a];
	}
	for (int a = 0; a < 3; ++a)
		across[a] = away[0][(a + 1) % 3] * away[1][(a + 2) % 3] - away[0][(a + 2) % 3] * away[1][(a + 1) % 3];
	double length = sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
	if (length < 1e-6) { // opposite ends: any direction across
		const int least = fabs(away[0][0]) < 0.6 ? 0 : 1;
		for (int a = 0; a < 3; ++a) across[a] = (a == least) - away[0][least] * away[0][a];
		length = sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
	}
	for (int a = 0; a < 3; ++a) out[3 + a] = middle[a] + 1000 * size * across[a] / length;
}

/// Determinant of the knot that a polygon of `count` points (3 numbers each) makes. Open curves are closed far away, by
/// lines from their ends away from the middle. The polygon must not meet itself.
static inline int knot_determinant(int count, const double* points, bool closed) {
	const int all = closed ? count : count + 3;
	double* p = malloc(2 * 3 * (size_t)all * sizeof *p);
	KnotCrossing* crossings = malloc((size_t)all * (size_t)all / 2 * sizeof *crossings + sizeof *crossings);
	if (p == NULL || crossings == NULL) abort();
	double* raw = p + 3 * all;
	memcpy(raw, points, 3 * (size_t)count * sizeof *raw);
	if (!closed) knot_close(count, points, raw + 3 * count);
	knot_project(all, raw, p);
	const int found = knot_find(all, p, crossings);
	const int determinant = found > 0 ? knot_colour(found, crossings) : 1;
	free(crossings);
	free(p);
	return determinant;
}

#endif
