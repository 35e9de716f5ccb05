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
} JnEmbedding;

/// Find the cell and the weights of every vertex of a surface in a hex8 or tet4 mesh. A vertex outside all cells follows
/// the nearest one. JN_BAD_INPUT, after a message, when a vertex lies farther out than the size of that cell.
JnStatus jn_embedding_create(const JnSurface* surface, const JnMesh* mesh, const char* what, JnArena* arena,
							 JnEmbedding** embedding);

/// positions[3 * surface.node_count] of the surface when the mesh's nodes are at x[3 * node_count] [m].
void jn_embedding_positions(const JnEmbedding* embedding, const double* x, double* positions);

#endif
