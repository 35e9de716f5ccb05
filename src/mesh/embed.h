/// @file embed.h
/// A fine surface carried along by coarse cells: each vertex follows the shape functions of the cell that holds it.
#ifndef JN_MESH_EMBED_H
#define JN_MESH_EMBED_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

typedef struct JnEmbedding {
	JnSurface surface;     ///< at rest
	int cell_nodes;        ///< nodes that carry a vertex: those of the cells
	const int* nodes;      ///< cell_nodes * surface.node_count numbers of the mesh's nodes
	const double* weights; ///< as many; of one vertex they sum to 1
	const double* offsets; ///< 3 * surface.node_count, added to the weighted sums: of rigid things; NULL: none
} JnEmbedding;

/// Find the cell and the weights of every vertex of a surface in a hex8 or tet4 mesh. A vertex outside all cells follows
/// the nearest one, along the slope of its shape functions at the nearest point: its weights may be negative. Any affine
/// motion of the nodes moves all vertices by the same. Everything, the surface too, is copied into the arena.
/// JN_BAD_INPUT, after a message that begins with `what`, when a vertex lies farther out than the longest side of that
/// cell's bounding box, when a cell has no volume, and for tet10.
JnStatus jn_embedding_create(const JnSurface* surface, const JnMesh* mesh, const char* what, JnArena* arena,
							 JnEmbedding** embedding);

/// positions[3 * surface.node_count] of the surface when the mesh's nodes are at x[3 * node_count] [m].
void jn_embedding_positions(const JnEmbedding* embedding, const double* x, double* positions);

#endif
