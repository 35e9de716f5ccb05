/// @file tree.h
/// A tree of boxes over the triangles of a skin that moves: built once, then refitted every step. Flat arrays, laid out
/// like those of mesh/triangle_tree.h; the same for any number of threads.
#ifndef JN_DETECT_TREE_H
#define JN_DETECT_TREE_H

#include "detect/skin.h"
#include "mesh/triangle_tree.h"

/// Where a skin is during a step: between start and end its vertices move on straight lines.
typedef struct JnSkinMotion {
	double* start; ///< 3 * vertex_count [m]
	double* end;   ///< as many
	double margin; ///< [m]; boxes are larger by this much on all sides
} JnSkinMotion;

/// `tree` may be asked as any JnTriangleTree: its surface is the skin at the start of the step, its boxes are those swept
/// over the step and enlarged. Leaf k owns the vertices vertices[vertex_start[k]] up to vertices[vertex_start[k + 1] - 1]:
/// each vertex has one leaf, the first with a triangle of its.
typedef struct JnSkinTree {
	const JnSkin* skin;  ///< borrowed
	JnTriangleTree tree; ///< surface.nodes is borrowed from the motion that it was last fitted to
	int* vertex_start;   ///< tree.leaf_count + 1
	int* vertices;       ///< those that a triangle uses
	bool* is_taken;      ///< one a vertex, for building
	double* areas;       ///< tree.leaf_count: areas of the triangles' own boxes, summed over a leaf
	double* centers;     ///< 3 * triangle_count, for building
	double cost;         ///< area of all boxes over that of the triangles' boxes, now; 0 when those have none
	double cost_built;   ///< the same when the tree was built
	bool is_built;
} JnSkinTree;

/// Allocate the tree of a skin, all of it from the arena; no more memory is needed later. It is not built yet.
JnStatus jn_skin_tree_create(const JnSkin* skin, JnArena* arena, JnSkinTree* tree);

/// Sort the triangles by their centres at the start, and fit the boxes.
void jn_skin_tree_build(JnSkinTree* tree, const JnSkinMotion* motion, int threads);

/// Fit the boxes to where the skin is now; then cost tells how good the order still is.
void jn_skin_tree_refit(JnSkinTree* tree, const JnSkinMotion* motion, int threads);

/// Refit, and build if the tree never was, or if cost exceeds `degradation` times cost_built. Whether it was built.
bool jn_skin_tree_follow(JnSkinTree* tree, const JnSkinMotion* motion, double degradation, int threads);

/// The swept, enlarged box of a triangle; that of a vertex, not enlarged.
JnTreeBox jn_motion_triangle_box(const JnSkin* skin, const JnSkinMotion* motion, int triangle);
JnTreeBox jn_motion_vertex_box(const JnSkinMotion* motion, int vertex);

static inline bool jn_boxes_touch(const JnTreeBox* a, const JnTreeBox* b) {
	for (int i = 0; i < 3; i++)
		if (!(a->low[i] <= b->high[i] && b->low[i] <= a->high[i])) return false;
	return true;
}

#endif
