// Triangles are halved by their centres, along the longest axis each time, down to leaves of four; the boxes around the
// halves form a complete binary tree, as in a heap. Nearest points: Ericson, Real-Time Collision Detection (2005), 5.1.5.
#include "mesh/triangle_tree.h"

#include <math.h>

static const JnTreeBox empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static const double* corner(const JnSurface* surface, int triangle, int i) {
	return surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)triangle + i];
}

static void box_add(JnTreeBox* box, const double low[3], const double high[3]) {
	for (int a = 0; a < 3; a++) {
		if (low[a] < box->low[a]) box->low[a] = low[a]; // fmin and fmax would be calls
		if (high[a] > box->high[a]) box->high[a] = high[a];
	}
}

static JnTreeBox box_of(const JnSurface* surface, int triangle) {
	JnTreeBox box = empty_box;
	for (int i = 0; i < 3; i++) box_add(&box, corner(surface, triangle, i), corner(surface, triangle, i));
	return box;
}

static bool boxes_touch(const JnTreeBox* a, const JnTreeBox* b) {
	for (int i = 0; i < 3; i++)
		if (!(a->low[i] <= b->high[i] && b->low[i] <= a->high[i])) return false;
	return true;
}

/// Whether one triangle comes before another along an axis; those with the same centre in the order of their numbers.
static bool is_before(const double* centres, int axis, int one, int other) {
	const double a = centres[3 * (ptrdiff_t)one + axis], b = centres[3 * (ptrdiff_t)other + axis];
	return a != b ? a < b : one < other;
}

static void exchange(int* a, int* b) {
	const int old = *a;
	*a = *b;
	*b = old;
}

/// Hoare's selection: order[first] .. order[middle - 1] come before all from order[middle] to order[end - 1].
static void select_middle(int* order, int first, int middle, int end, const double* centres, int axis) {
	while (end - first > 1) {
		const int pivot = order[first + (end - first) / 2];
		int low = first, high = end - 1;
		while (low <= high) {
			while (is_before(centres, axis, order[low], pivot)) low++;
			while (is_before(centres, axis, pivot, order[high])) high--;
			if (low <= high) exchange(&order[low++], &order[high--]);
		}
		if (middle > high && middle < low) return;
		if (middle <= high)
			end = high + 1;
		else
			first = low;
	}
}

static int longest_axis(const int* order, int first, int end, const double* centres) {
	JnTreeBox box = empty_box;
	for (int i = first; i < end; i++) {
		const double* at = centres + 3 * (ptrdiff_t)order[i];
		box_add(&box, at, at);
	}
	int axis = 0;
	for (int a = 1; a < 3; a++)
		if (box.high[a] - box.low[a] > box.high[axis] - box.low[axis]) axis = a;
	return axis;
}

/// Share order[first] .. order[end - 1] out to `leaves` leaves: the nearer half along the longest axis to the first half.
static void divide(int* order, int first, int end, int leaves, const double* centres) {
	const int middle = first + leaves / 2 * JN_TREE_LEAF;
	if (leaves == 1) return;
	if (middle >= end) {
		divide(order, first, end, leaves / 2, centres);
		return;
	}
	select_middle(order, first, middle, end, centres, longest_axis(order, first, end, centres));
	divide(order, first, middle, leaves / 2, centres);
	divide(order, middle, end, leaves / 2, centres);
}

void jn_tree_sort(int count, const double* centres, int leaf_count, int* order) {
	for (int i = 0; i < count; i++) order[i] = i;
	divide(order, 0, count, leaf_count, centres);
}

static JnStatus sort_triangles(JnTriangleTree* tree) {
	const int count = tree->surface.triangle_count;
	JnArena scratch = {0};
	double* centres = jn_arena_take(&scratch, 3 * (size_t)count + 1, sizeof *centres);
	if (centres == NULL) return JN_OUT_OF_MEMORY;
	for (int i = 0; i < count; i++) {
		const JnTreeBox box = box_of(&tree->surface, i);
		for (int a = 0; a < 3; a++) centres[3 * (ptrdiff_t)i + a] = 0.5 * box.low[a] + 0.5 * box.high[a];
	}
	jn_tree_sort(count, centres, tree->leaf_count, tree->order);
	jn_arena_free(&scratch);
	return JN_OK;
}

static void fill_boxes(JnTriangleTree* tree) {
	for (int box = 0; box < 2 * tree->leaf_count; box++) tree->boxes[box] = empty_box;
	for (int i = 0; i < tree->surface.triangle_count; i++) {
		const JnTreeBox box = box_of(&tree->surface, tree->order[i]);
		box_add(&tree->boxes[tree->leaf_count + i / JN_TREE_LEAF], box.low, box.high);
	}
	for (int box = 2 * tree->leaf_count - 1; box > 1; box--)
		box_add(&tree->boxes[box / 2], tree->boxes[box].low, tree->boxes[box].high);
}

JnStatus jn_triangle_tree_create(const JnSurface* surface, JnArena* arena, JnTriangleTree* tree) {
	*tree = (JnTriangleTree){.surface = *surface, .leaf_count = 1};
	while ((int64_t)tree->leaf_count * JN_TREE_LEAF < surface->triangle_count) tree->leaf_count *= 2;
	JN_NEW(arena, tree->boxes, 2 * (size_t)tree->leaf_count);
	JN_NEW(arena, tree->order, (size_t)surface->triangle_count + 1);
	JN_TRY(sort_triangles(tree));
	fill_boxes(tree);
	return JN_OK;
}

/// The triangles of a leaf are order[first] .. order[end - 1].
static int leaf_end(const JnTriangleTree* tree, int first) {
	const int count = tree->surface.triangle_count;
	return count - first < JN_TREE_LEAF ? count : first + JN_TREE_LEAF;
}

JnStatus jn_triangle_tree_in_box(const JnTriangleTree* tree, const double low[3], const double high[3],
								 JnTriangleVisit visit, void* user) {
	JnTreeBox wanted = empty_box;
	for (int a = 0; a < 3; a++) {
		wanted.low[a] = low[a];
		wanted.high[a] = high[a];
	}
	int stack[64] = {1};
	for (int depth = 1; depth > 0;) {
		const int box = stack[--depth];
		if (!boxes_touch(&tree->boxes[box], &wanted)) continue;
		if (box < tree->leaf_count) {
			stack[depth++] = 2 * box + 1;
			stack[depth++] = 2 * box;
			continue;
		}
		const int first = (box - tree->leaf_count) * JN_TREE_LEAF;
		for (int i = first; i < leaf_end(tree, first); i++) {
			const JnTreeBox own = box_of(&tree->surface, tree->order[i]);
			if (boxes_touch(&own, &wanted)) JN_TRY(visit(user, tree->order[i]));
		}
	}
	return JN_OK;
}

typedef struct PairSearch {
	int first;
	JnTrianglePairVisit visit;
	void* user;
} PairSearch;

static JnStatus visit_later(void* user, int triangle) {
	const PairSearch* search = user;
	return triangle > search->first ? search->visit(search->user, search->first, triangle) : JN_OK;
}

JnStatus jn_triangle_tree_pairs(const JnTriangleTree* tree, JnTrianglePairVisit visit, void* user) {
	PairSearch search = {.visit = visit, .user = user};
	for (; search.first < tree->surface.triangle_count; search.first++) {
		const JnTreeBox box = box_of(&tree->surface, search.first);
		JN_TRY(jn_triangle_tree_in_box(tree, box.low, box.high, visit_later, &search));
	}
	return JN_OK;
}

static double dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const double a[3], const double b[3], double out[3]) {
	for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

/// Weights of the second and third node of a triangle; that of the first makes the sum 1.
typedef struct Weights {
	double second, third;
} Weights;

/// Share of the way from one end of an edge, of the point nearest to where the products with both ends were taken.
static double share(double near, double far) {
	return near + far > 0 ? near / (near + far) : 0;
}

/// The point of triangle a b c nearest to p, by the region of the plane above which p lies.
static Weights nearest_weights(const double* a, const double* b, const double* c, const double p[3]) {
	double ab[3], ac[3], ap[3], bp[3], cp[3];
	subtract(b, a, ab);
	subtract(c, a, ac);
	subtract(p, a, ap);
	subtract(p, b, bp);
	subtract(p, c, cp);
	const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
				 d6 = dot(ac, cp);
	const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2, sum = va + vb + vc;
	if (d1 <= 0 && d2 <= 0) return (Weights){0, 0};
	if (d3 >= 0 && d4 <= d3) return (Weights){1, 0};
	if (vc <= 0 && d1 >= 0 && d3 <= 0) return (Weights){share(d1, -d3), 0};
	if (d6 >= 0 && d5 <= d6) return (Weights){0, 1};
	if (vb <= 0 && d2 >= 0 && d6 <= 0) return (Weights){0, share(d2, -d6)};
	const double along = share(d4 - d3, d5 - d6);
	if (va <= 0 && d4 >= d3 && d5 >= d6) return (Weights){1 - along, along};
	if (!(sum > 0)) return (Weights){0, 0};
	return (Weights){fmax(vb / sum, 0), fmax(vc / sum, 0)};
}

void jn_triangle_nearest(const double a[3], const double b[3], const double c[3], const double p[3],
						 double weights[3]) {
	const Weights found = nearest_weights(a, b, c, p);
	weights[0] = fmax(1 - found.second - found.third, 0);
	weights[1] = found.second;
	weights[2] = found.third;
}

static JnSurfacePoint nearest_on(const JnSurface* surface, int triangle, const double p[3]) {
	JnSurfacePoint out = {.triangle = triangle};
	const double *a = corner(surface, triangle, 0), *b = corner(surface, triangle, 1),
				 *c = corner(surface, triangle, 2);
	jn_triangle_nearest(a, b, c, p, out.weights);
	double away[3];
	for (int i = 0; i < 3; i++) {
		out.at[i] = out.weights[0] * a[i] + out.weights[1] * b[i] + out.weights[2] * c[i];
		away[i] = out.at[i] - p[i];
	}
	out.distance = sqrt(dot(away, away));
	return out;
}

static double box_distance(const JnTreeBox* box, const double p[3]) {
	double sum = 0;
	for (int a = 0; a < 3; a++) {
		const double below = box->low[a] - p[a], above = p[a] - box->high[a];
		const double away = below > above ? below : above;
		sum += away > 0 ? away * away : 0;
	}
	return sqrt(sum);
}

static void nearest_in_leaf(const JnTriangleTree* tree, int leaf, const double p[3], JnSurfacePoint* best) {
	const int first = leaf * JN_TREE_LEAF;
	for (int i = first; i < leaf_end(tree, first); i++) {
		const JnSurfacePoint found = nearest_on(&tree->surface, tree->order[i], p);
		const bool is_first = found.distance == best->distance && found.triangle < best->triangle;
		if (found.distance < best->distance || is_first) *best = found;
	}
}

JnSurfacePoint jn_triangle_tree_nearest(const JnTriangleTree* tree, const double point[3]) {
	JnSurfacePoint best = {.triangle = -1, .distance = INFINITY};
	const double rounding = 1 - 1e-12; // so that equal distances are not cut off by the last digits of a box's
	int stack[64] = {1};
	for (int depth = 1; depth > 0;) {
		const int box = stack[--depth];
		if (box_distance(&tree->boxes[box], point) * rounding > best.distance) continue;
		if (box >= tree->leaf_count) {
			nearest_in_leaf(tree, box - tree->leaf_count, point, &best);
			continue;
		}
		const double left = box_distance(&tree->boxes[2 * box], point);
		const double right = box_distance(&tree->boxes[2 * box + 1], point);
		stack[depth++] = left <= right ? 2 * box + 1 : 2 * box;
		stack[depth++] = left <= right ? 2 * box : 2 * box + 1;
	}
	return best;
}
