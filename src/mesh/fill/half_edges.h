/// @file half_edges.h
/// A closed triangle surface that can be edited: each triangle knows its neighbours through half-edges.
///
/// Half-edge 3 t + k runs along side k of triangle t, from corner k to the next; its twin runs back, in the neighbour.
///
///            c                  split a-b       flip a-b        collapse a into b
///          / ^ \                   c               c                  c
///        /   |   \               / | \           / | \                 \      a is gone, and
///      a --- h --> b            a--m--b         a  |  b                 b     two triangles
///        \  twin /               \ | /           \ | /                 /
///          \   /                   d               d                  d
///            d
#ifndef JN_MESH_FILL_HALF_EDGES_H
#define JN_MESH_FILL_HALF_EDGES_H

#include "mesh/surface.h"

/// Grown with malloc; free with jn_half_edges_free. All zero is valid and empty.
typedef struct JnHalfEdges {
	int node_count, node_room;
	double* nodes; ///< 3 * node_count coordinates [m]
	int* leaving;  ///< a half-edge that leaves each node; -1: the node is gone
	int count, room;
	int* from;    ///< count nodes where half-edges start; -1: their triangle is gone
	int* twin;    ///< count half-edges
	bool* crease; ///< count: the surface is bent sharply here, the edge must stay an edge
} JnHalfEdges;

static inline int jn_next(int h) {
	return h % 3 == 2 ? h - 2 : h + 1;
}

static inline int jn_before(int h) {
	return h % 3 == 0 ? h + 2 : h - 1;
}

static inline int jn_to(const JnHalfEdges* mesh, int h) {
	return mesh->from[jn_next(h)];
}

/// The half-edge that leaves the same node, one triangle further: walk until the first one comes again.
static inline int jn_turn(const JnHalfEdges* mesh, int h) {
	return mesh->twin[jn_before(h)];
}

/// Copy a surface. A node where parts touch in a point becomes several. JN_BAD_INPUT after a message, which begins with
/// `what`, when an edge does not have two triangles that agree.
JnStatus jn_half_edges_create(const JnSurface* surface, const char* what, JnHalfEdges* mesh);
void jn_half_edges_free(JnHalfEdges* mesh);

/// The surface as it is now, from the arena.
JnStatus jn_half_edges_surface(const JnHalfEdges* mesh, JnArena* arena, JnSurface* surface);

/// Mark the edges whose triangles' normals differ by more than `angle` [rad]; returns how many.
int jn_half_edges_crease(JnHalfEdges* mesh, double angle);

/// How many creases meet in a node: 0 is smooth, 2 on a line, others are corners.
int jn_crease_count(const JnHalfEdges* mesh, int node);

int jn_valence(const JnHalfEdges* mesh, int node);

/// A new node in the middle of an edge.
JnStatus jn_half_edges_split(JnHalfEdges* mesh, int h);

/// Turn an edge between the other two corners of its triangles. False, and unchanged, when that were no surface.
bool jn_half_edges_flip(JnHalfEdges* mesh, int h);

/// Can the edge be collapsed and leave a surface: exactly two nodes are neighbours of both ends (link condition)?
bool jn_half_edges_can_collapse(const JnHalfEdges* mesh, int h);

/// Move the start of a half-edge into its end, which keeps its place; ask can_collapse before.
void jn_half_edges_collapse(JnHalfEdges* mesh, int h);

#endif
