// Measures of a triangle surface, and its repair.
#include "mesh/surface.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "mesh/surface_edges.h"

/// Nodes nearer than this share of the bounding box's largest edge are one: far above rounding in double precision, far
/// below any detail. Files in single precision either repeat a position exactly or differ by more.
static const double WELD_SHARE = 1e-9;
static const double MOST_COORDINATE = 1e30; // powers of it stay finite

static const double* node_of(const JnSurface* surface, int triangle, int i) {
	return surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)triangle + i];
}

/// (b - a) x (c - a) of a triangle: twice its area along its normal.
static void area_vector(const JnSurface* surface, int triangle, double out[3]) {
	const double *a = node_of(surface, triangle, 0), *b = node_of(surface, triangle, 1),
				 *c = node_of(surface, triangle, 2);
	const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
	out[0] = u[1] * v[2] - u[2] * v[1];
	out[1] = u[2] * v[0] - u[0] * v[2];
	out[2] = u[0] * v[1] - u[1] * v[0];
}

double jn_surface_area(const JnSurface* surface) {
	double sum = 0;
	for (int i = 0; i < surface->triangle_count; i++) {
		double n[3];
		area_vector(surface, i, n);
		sum += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
	}
	return sum;
}

/// By the divergence theorem, V = sum of a . ((b - a) x (c - a)) / 6, with positions from the first node, so that a
/// surface far from the origin loses no digits.
double jn_surface_volume(const JnSurface* surface) {
	double sum = 0;
	for (int i = 0; i < surface->triangle_count; i++) {
		const double* a = node_of(surface, i, 0);
		double n[3];
		area_vector(surface, i, n);
		for (int k = 0; k < 3; k++) sum += (a[k] - surface->nodes[k]) * n[k];
	}
	return sum / 6;
}

JnStatus jn_surface_check_values(const JnSurface* surface, const char* what) {
	JnOffenders bad = {0};
	for (int i = 0; i < surface->node_count; i++) {
		const double* x = surface->nodes + 3 * (ptrdiff_t)i;
		bool is_good = true;
		for (int a = 0; a < 3; a++) is_good &= fabs(x[a]) <= MOST_COORDINATE;
		if (!is_good) jn_offenders_add(&bad, "node %d at (%g, %g, %g)", i, x[0], x[1], x[2]);
	}
	if (bad.count > 0) {
		return jn_error(JN_BAD_INPUT,
						"%s: coordinates that are no numbers below %g: %s%s (%d in all); export the file again", what,
						MOST_COORDINATE, bad.text, jn_offenders_rest(&bad), bad.count);
	}
	for (int i = 0; i < 3 * surface->triangle_count; i++) {
		const int node = surface->triangles[i];
		if (node < 0 || node >= surface->node_count) jn_offenders_add(&bad, "triangle %d names node %d", i / 3, node);
	}
	if (bad.count == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: node numbers outside 0 .. %d: %s%s (%d in all); export the file again", what,
					surface->node_count - 1, bad.text, jn_offenders_rest(&bad), bad.count);
}

/// Remove triangles that use a node twice. Returns how many.
static int drop_degenerate(JnSurface* surface) {
	int kept = 0;
	for (int i = 0; i < surface->triangle_count; i++) {
		const int* t = surface->triangles + 3 * (ptrdiff_t)i;
		if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
		memmove(surface->triangles + 3 * (ptrdiff_t)kept++, t, 3 * sizeof *t);
	}
	const int dropped = surface->triangle_count - kept;
	surface->triangle_count = kept;
	return dropped;
}

/// Add "12 nodes joined" to a list of changes.
static void add_change(char* text, size_t size, int count, const char* change) {
	const size_t used = strlen(text);
	if (count > 0) snprintf(text + used, size - used, "%s%d %s", used > 0 ? ", " : "", count, change);
}

JnStatus jn_surface_repair(JnSurface* surface, const char* what) {
	JN_TRY(jn_surface_check_values(surface, what));
	const double distance = WELD_SHARE * jn_surface_extent(surface);
	const int joined = jn_surface_weld(surface, distance);
	if (joined < 0) return (JnStatus)joined;
	const int degenerate = drop_degenerate(surface);
	const int flipped = jn_surface_flip_flat(surface, distance);
	if (flipped < 0) return (JnStatus)flipped;
	const int unused = jn_surface_drop_unused(surface);
	if (unused < 0) return (JnStatus)unused;
	if (surface->triangle_count == 0) return jn_error(JN_BAD_INPUT, "%s: no triangle has an area", what);
	int turned = 0;
	JN_TRY(jn_surface_turn(surface, what, &turned));
	char changes[300] = "";
	add_change(changes, sizeof changes, joined, "nodes joined with one at the same place");
	add_change(changes, sizeof changes, degenerate, "triangles without area dropped");
	add_change(changes, sizeof changes, flipped, "triangles without area joined with their neighbours");
	add_change(changes, sizeof changes, unused, "unused nodes dropped");
	add_change(changes, sizeof changes, turned, "triangles turned to face outward");
	if (changes[0] != '\0') jn_warn("%s: repaired: %s", what, changes);
	return JN_OK;
}
