// How often a closed surface goes around a point: triangles that the ray in the direction of +x crosses from inside to
// outside, less those that it crosses the other way. Seen along the ray, a triangle is crossed when the point is inside
// its projection to the y-z plane:
//
//      z ^     b            From p, look towards +z. An edge passes there when one of its ends is below or at p in y and
//        |   / | \          the other above. One that goes down in y counts +1, one that goes up -1: here bc counts, or
//        |  / p|   \        cb when the triangle is seen from behind, and the sum over its edges is 1 or -1.
//        | a---+----c
//        +-------------> y
//
// Whether an edge passes at a higher z is computed from its lower end, and so is the same for both of its triangles:
// what rounding does to one it does to the other, and no ray slips through an edge or a corner.
#include <math.h>

#include "mesh/triangle_tree.h"

static const double* corner(const JnTriangleTree* tree, int triangle, int i) {
	return tree->surface.nodes + 3 * (ptrdiff_t)tree->surface.triangles[3 * (ptrdiff_t)triangle + i];
}

/// -1 or +1 when the edge passes the point's y at a higher z, upwards or downwards; else 0.
static int edge_crossing(const double* from, const double* to, const double p[3]) {
	const bool from_below = from[1] <= p[1], to_below = to[1] <= p[1];
	if (from_below == to_below) return 0;
	const double *low = from_below ? from : to, *high = from_below ? to : from;
	const double z = low[2] + (p[1] - low[1]) / (high[1] - low[1]) * (high[2] - low[2]);
	const double inside = fmin(fmax(z, fmin(low[2], high[2])), fmax(low[2], high[2]));
	if (!(inside > p[2])) return 0;
	return from_below ? -1 : 1;
}

/// The x at which the ray meets the plane of a triangle that it crosses.
static double crossing_x(const double* a, const double* b, const double* c, const double p[3]) {
	const double ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
	const double n[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
	const double x = n[0] != 0 ? a[0] - (n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2])) / n[0] : a[0];
	const double low = fmin(fmin(a[0], b[0]), c[0]), high = fmax(fmax(a[0], b[0]), c[0]);
	return fmin(fmax(x, low), high);
}

static int triangle_crossing(const JnTriangleTree* tree, int triangle, const double p[3]) {
	const double *a = corner(tree, triangle, 0), *b = corner(tree, triangle, 1), *c = corner(tree, triangle, 2);
	const int turns = edge_crossing(a, b, p) + edge_crossing(b, c, p) + edge_crossing(c, a, p);
	if (turns == 0 || !(crossing_x(a, b, c, p) > p[0])) return 0;
	return turns;
}

static bool ray_meets(const JnTreeBox* box, const double p[3]) {
	return box->high[0] > p[0] && box->low[1] <= p[1] && box->high[1] > p[1] && box->low[2] <= p[2] &&
		   box->high[2] > p[2];
}

static void visit_leaf(const JnTriangleTree* tree, int leaf, const double p[3], JnCrossingVisit visit, void* user) {
	for (int i = 0; i < JN_TREE_LEAF; i++) {
		const int place = leaf * JN_TREE_LEAF + i;
		if (place >= tree->surface.triangle_count) return;
		const int turns = triangle_crossing(tree, tree->order[place], p);
		if (turns != 0) visit(user, tree->order[place], turns);
	}
}

void jn_triangle_tree_crossings(const JnTriangleTree* tree, const double point[3], JnCrossingVisit visit, void* user) {
	int stack[64] = {1};
	for (int depth = 1; depth > 0;) {
		const int box = stack[--depth];
		if (!ray_meets(&tree->boxes[box], point)) continue;
		if (box >= tree->leaf_count) {
			visit_leaf(tree, box - tree->leaf_count, point, visit, user);
			continue;
		}
		stack[depth++] = 2 * box + 1;
		stack[depth++] = 2 * box;
	}
}

static void add_turns(void* user, int triangle, int turns) {
	(void)triangle;
	*(int*)user += turns;
}

int jn_triangle_tree_winding(const JnTriangleTree* tree, const double point[3]) {
	int sum = 0;
	jn_triangle_tree_crossings(tree, point, add_turns, &sum);
	return sum;
}

bool jn_triangle_tree_is_inside(const JnTriangleTree* tree, const double point[3]) {
	return jn_triangle_tree_winding(tree, point) != 0;
}
