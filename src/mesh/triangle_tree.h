/// @file triangle_tree.h
/// A tree of boxes over the triangles of a surface: which triangles are near, and is a point inside. Flat arrays, the
/// same for the same surface; once made it is only read, so that many threads may ask at once.
#ifndef JN_MESH_TRIANGLE_TREE_H
#define JN_MESH_TRIANGLE_TREE_H

#include "base/arena.h"
#include "mesh/surface.h"

enum { JN_TREE_LEAF = 4 }; ///< triangles of a leaf, at most

/// Lowest and highest coordinates [m]; low > high when it is empty.
typedef struct JnTreeBox {
	double low[3], high[3];
} JnTreeBox;

/// Box 1 holds all, box i holds boxes 2i and 2i + 1, and leaf number k is box leaf_count + k. It holds the triangles
/// order[JN_TREE_LEAF * k] and behind, up to JN_TREE_LEAF of them.
typedef struct JnTriangleTree {
	JnSurface surface; ///< borrowed arrays: nodes may not move while the tree is used
	int leaf_count;    ///< a power of two
	JnTreeBox* boxes;  ///< 2 * leaf_count; box 0 is not used
	int* order;        ///< surface.triangle_count triangles, near ones beside each other
} JnTriangleTree;

/// A point on the surface.
typedef struct JnSurfacePoint {
	int triangle;      ///< -1: the surface has none
	double weights[3]; ///< of the triangle's nodes; none is negative, they sum to 1
	double at[3];      ///< [m]
	double distance;   ///< from the point asked for [m]; infinite when there is no triangle
} JnSurfacePoint;

/// Weights of the nodes of triangle a b c at its point nearest to p: none is negative, they sum to 1. One that is 0 says
/// that the point lies on the edge opposite.
void jn_triangle_nearest(const double a[3], const double b[3], const double c[3], const double p[3], double weights[3]);

/// Fill order[count] with the numbers of triangles whose centres are given (3 * count), near ones beside each other: the
/// order of a tree with `leaf_count` leaves, a power of two, enough for all.
void jn_tree_sort(int count, const double* centres, int leaf_count, int* order);

/// Build the tree of a surface, all of whose coordinates are finite; memory comes from the arena.
JnStatus jn_triangle_tree_create(const JnSurface* surface, JnArena* arena, JnTriangleTree* tree);

/// The point of the surface nearest to `point` [m]; the triangle with the lowest number when several are equally near.
JnSurfacePoint jn_triangle_tree_nearest(const JnTriangleTree* tree, const double point[3]);

/// How many times the surface goes around `point`: 0 outside, 1 inside a closed surface that faces outward, 0 in its
/// cavities that face inward. Rounding in edges and corners cannot make it count twice or not at all; a point nearer to
/// the surface than some 1e-15 of its extent may fall on either side. Without meaning for open surfaces.
int jn_triangle_tree_winding(const JnTriangleTree* tree, const double point[3]);

/// Whether a point is inside a closed surface: jn_triangle_tree_winding is not 0.
bool jn_triangle_tree_is_inside(const JnTriangleTree* tree, const double point[3]);

/// Call `visit` for the triangles that the ray from `point` towards +x crosses, with +1 where it leaves through the outer
/// side and -1 where it enters. Their sum is the winding.
typedef void (*JnCrossingVisit)(void* user, int triangle, int turns);
void jn_triangle_tree_crossings(const JnTriangleTree* tree, const double point[3], JnCrossingVisit visit, void* user);

/// Call `visit` for the triangles whose boxes touch the box from `low` to `high` [m], in the tree's order, until it
/// returns something other than JN_OK, which is returned.
typedef JnStatus (*JnTriangleVisit)(void* user, int triangle);
JnStatus jn_triangle_tree_in_box(const JnTriangleTree* tree, const double low[3], const double high[3],
								 JnTriangleVisit visit, void* user);

/// Call `visit` once for each pair of triangles whose boxes touch, first < second, ordered by `first`, in the same way.
typedef JnStatus (*JnTrianglePairVisit)(void* user, int first, int second);
JnStatus jn_triangle_tree_pairs(const JnTriangleTree* tree, JnTrianglePairVisit visit, void* user);

#endif
