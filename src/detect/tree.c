// Sorting is that of mesh/triangle_tree.c. Leaves are fitted in parallel and then each level of boxes above them; areas are
// summed in the order of their numbers.
#include "detect/tree.h"

#include <math.h>

#include "base/parallel.h"

enum { GRAIN = 256 }; // boxes of a level that are worth another thread

static const JnTreeBox empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void box_add(JnTreeBox* box, const double low[3], const double high[3]) {
	for (int a = 0; a < 3; a++) {
		if (low[a] < box->low[a]) box->low[a] = low[a];
		if (high[a] > box->high[a]) box->high[a] = high[a];
	}
}

JnTreeBox jn_motion_triangle_box(const JnSkin* skin, const JnSkinMotion* motion, int triangle) {
	JnTreeBox box = empty_box;
	for (int i = 0; i < 3; i++) {
		const ptrdiff_t at = 3 * (ptrdiff_t)skin->triangles[3 * (ptrdiff_t)triangle + i];
		box_add(&box, motion->start + at, motion->start + at);
		box_add(&box, motion->end + at, motion->end + at);
	}
	for (int a = 0; a < 3; a++) {
		box.low[a] -= motion->margin;
		box.high[a] += motion->margin;
	}
	return box;
}

JnTreeBox jn_motion_vertex_box(const JnSkinMotion* motion, int vertex) {
	const ptrdiff_t at = 3 * (ptrdiff_t)vertex;
	JnTreeBox box = empty_box;
	box_add(&box, motion->start + at, motion->start + at);
	box_add(&box, motion->end + at, motion->end + at);
	return box;
}

/// Area of a box's sides; 0 when it is empty.
static double box_area(const JnTreeBox* box) {
	const double x = box->high[0] - box->low[0], y = box->high[1] - box->low[1], z = box->high[2] - box->low[2];
	return x >= 0 ? 2 * (x * y + y * z + z * x) : 0;
}

static void fit_leaf(JnSkinTree* tree, const JnSkinMotion* motion, int leaf) {
	const int first = JN_TREE_LEAF * leaf, last = first + JN_TREE_LEAF;
	JnTreeBox whole = empty_box;
	double area = 0;
	for (int i = first; i < last && i < tree->skin->triangle_count; i++) {
		const JnTreeBox own = jn_motion_triangle_box(tree->skin, motion, tree->tree.order[i]);
		box_add(&whole, own.low, own.high);
		area += box_area(&own);
	}
	tree->tree.boxes[tree->tree.leaf_count + leaf] = whole;
	tree->areas[leaf] = area;
}

static void fit_box(JnTriangleTree* tree, int box) {
	JnTreeBox whole = tree->boxes[2 * box];
	box_add(&whole, tree->boxes[2 * box + 1].low, tree->boxes[2 * box + 1].high);
	tree->boxes[box] = whole;
}

static double cost_of(const JnSkinTree* tree) {
	double boxes = 0, triangles = 0;
	for (int box = 1; box < 2 * tree->tree.leaf_count; box++) boxes += box_area(&tree->tree.boxes[box]);
	for (int leaf = 0; leaf < tree->tree.leaf_count; leaf++) triangles += tree->areas[leaf];
	return triangles > 0 ? boxes / triangles : 0;
}

void jn_skin_tree_refit(JnSkinTree* tree, const JnSkinMotion* motion, int threads) {
	const int leaves = tree->tree.leaf_count;
	const int team = jn_threads_for((size_t)leaves, GRAIN, threads);
	tree->tree.surface.nodes = motion->start;
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int leaf = 0; leaf < leaves; leaf++) fit_leaf(tree, motion, leaf);
	for (int level = leaves / 2; level >= 1; level /= 2) {
		const int part = jn_threads_for((size_t)level, 8 * GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(part) if (part > 1)
		for (int box = level; box < 2 * level; box++) fit_box(&tree->tree, box);
	}
	tree->cost = cost_of(tree);
}

static void find_centers(const JnSkinTree* tree, const JnSkinMotion* motion) {
	const JnSkin* skin = tree->skin;
	for (int i = 0; i < skin->triangle_count; i++)
		for (int a = 0; a < 3; a++) {
			double sum = 0;
			for (int k = 0; k < 3; k++) sum += motion->start[3 * (ptrdiff_t)skin->triangles[3 * (ptrdiff_t)i + k] + a];
			tree->centers[3 * (ptrdiff_t)i + a] = sum / 3;
		}
}

/// Give each vertex to the first leaf with a triangle of its.
static void share_vertices(JnSkinTree* tree) {
	const JnSkin* skin = tree->skin;
	int count = 0;
	for (int i = 0; i < skin->vertex_count; i++) tree->is_taken[i] = false;
	for (int leaf = 0; leaf < tree->tree.leaf_count; leaf++) {
		const int first = JN_TREE_LEAF * leaf, last = first + JN_TREE_LEAF;
		tree->vertex_start[leaf] = count;
		for (int i = 3 * first; i < 3 * last && i < 3 * skin->triangle_count; i++) {
			const int vertex = skin->triangles[3 * (ptrdiff_t)tree->tree.order[i / 3] + i % 3];
			if (!tree->is_taken[vertex]) tree->vertices[count++] = vertex;
			tree->is_taken[vertex] = true;
		}
	}
	tree->vertex_start[tree->tree.leaf_count] = count;
}

void jn_skin_tree_build(JnSkinTree* tree, const JnSkinMotion* motion, int threads) {
	find_centers(tree, motion);
	jn_tree_sort(tree->skin->triangle_count, tree->centers, tree->tree.leaf_count, tree->tree.order);
	share_vertices(tree);
	jn_skin_tree_refit(tree, motion, threads);
	tree->cost_built = tree->cost;
	tree->is_built = true;
}

bool jn_skin_tree_follow(JnSkinTree* tree, const JnSkinMotion* motion, double degradation, int threads) {
	if (tree->is_built) jn_skin_tree_refit(tree, motion, threads);
	if (tree->is_built && tree->cost <= degradation * tree->cost_built) return false;
	jn_skin_tree_build(tree, motion, threads);
	return true;
}

JnStatus jn_skin_tree_create(const JnSkin* skin, JnArena* arena, JnSkinTree* tree) {
	*tree = (JnSkinTree){.skin = skin, .tree.leaf_count = 1};
	JN_NEW(arena, tree->tree.surface.triangles, 3 * (size_t)skin->triangle_count);
	for (int i = 0; i < 3 * skin->triangle_count; i++) tree->tree.surface.triangles[i] = skin->triangles[i];
	tree->tree.surface.node_count = skin->vertex_count;
	tree->tree.surface.triangle_count = skin->triangle_count;
	while ((int64_t)tree->tree.leaf_count * JN_TREE_LEAF < skin->triangle_count) tree->tree.leaf_count *= 2;
	JN_NEW(arena, tree->tree.boxes, 2 * (size_t)tree->tree.leaf_count);
	JN_NEW(arena, tree->tree.order, skin->triangle_count);
	JN_NEW(arena, tree->vertex_start, (size_t)tree->tree.leaf_count + 1);
	JN_NEW(arena, tree->vertices, skin->vertex_count);
	JN_NEW(arena, tree->is_taken, skin->vertex_count);
	JN_NEW(arena, tree->areas, tree->tree.leaf_count);
	JN_NEW(arena, tree->centers, 3 * (size_t)skin->triangle_count);
	return JN_OK;
}
