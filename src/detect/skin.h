/// @file skin.h
/// The surface of one body as contact sees it: triangles whose vertices are nodes of the model, or points that the nodes
/// of a cell carry along. Only numbers and weights; positions are computed from those of the nodes.
#ifndef JN_DETECT_SKIN_H
#define JN_DETECT_SKIN_H

#include "base/arena.h"
#include "mesh/embed.h"

typedef struct JnSkin {
	int body;              ///< number of the body in the model
	int vertex_count;      ///< vertices of the surface
	int carriers;          ///< nodes that carry a vertex: 1, or those of a cell for embedded surfaces
	const int* nodes;      ///< carriers * vertex_count numbers of the model's nodes
	const double* weights; ///< as many; those of a vertex sum to 1. NULL when carriers is 1
	int triangle_count;
	const int* triangles; ///< 3 * triangle_count vertex numbers, outward by the right-hand rule
	double offset;        ///< >= 0: distance from obstacles at which its vertices touch them [m]
} JnSkin;

/// A skin of `count` triangles of model nodes (3 * count numbers, outward): the nodes that are used become the vertices,
/// in ascending order. Everything is copied into the arena; body is 0, for the caller to set. JN_BAD_INPUT after a message
/// when a number is negative.
JnStatus jn_skin_from_triangles(int count, const int* triangles, JnArena* arena, JnSkin* skin);

/// A skin of an embedded surface whose mesh's node 0 is the model's `first_node`. Copied likewise.
JnStatus jn_skin_from_embedding(const JnEmbedding* embedding, int first_node, JnArena* arena, JnSkin* skin);

/// Position of one vertex [m] when the model's nodes are at x [m].
void jn_skin_position(const JnSkin* skin, int vertex, const double* x, double out[3]);

/// out[3 * vertex_count] = positions of the vertices [m] when the model's nodes are at x [m].
void jn_skin_positions(const JnSkin* skin, const double* x, double* out);

#endif
