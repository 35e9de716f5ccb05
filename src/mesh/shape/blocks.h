/// @file blocks.h
/// Meshes from mapped blocks: each is a grid of hexahedra bent into place; where blocks meet, they share nodes.
///
///        z+ _______
///          /  y+  /|            (u, v, w) in [0, 1]^3, i along u fastest,
///         /______/ |            then v, then w
///     x-  |      | | x+
///         |  y-  | /            sides: u- u+ v- v+ w- w+, in this order
///         |______|/  z-
#ifndef JN_MESH_SHAPE_BLOCKS_H
#define JN_MESH_SHAPE_BLOCKS_H

#include "mesh/mesh.h"

enum { JN_BLOCK_WHOLE = 6, JN_BLOCK_PLACES = 7 };

typedef struct JnBlock JnBlock;

struct JnBlock {
	int cells[3]; ///< hexahedra along u, v, w, each >= 1
	/// Position X [m] of the point at[3] of the block's grid, at[a] = 0 .. cells[a]. Neighbours give common points within
	/// rounding. A block that comes out inside out is mirrored.
	void (*place)(const JnBlock* block, const int at[3], double X[3]);
	const void* options; ///< for `place`
	int part;            ///< for `place`: which part of a shape this block is
	const char* sets
		[JN_BLOCK_PLACES]; ///< sets that take the nodes of its sides (u- u+ v- v+ w- w+) and of the whole; NULL: none
};

/// Join blocks to one mesh of `element`; nodes closer than 1e-7 of the whole size become one. Tetrahedra are six a
/// hexahedron, and match across all faces: each face is cut from its lowest node. Node sets come in the order in which
/// blocks name them. JN_BAD_INPUT, with a message that begins with `what`, when there are too many cells, or flat ones, or
/// ones inside out.
JnStatus jn_blocks_join(int count, const JnBlock* blocks, JnShape element, const char* what, JnArena* arena,
						JnMesh* mesh);

/// Cut each hexahedron of a mesh into six tetrahedra that share its lowest node. Faces are cut through their lowest
/// node, so that neighbours agree (Dompierre, Labbe, Vallet, Camarero 1999). Nodes and sets stay as they are.
JnStatus jn_blocks_cut(const JnMesh* hexahedra, JnArena* arena, JnMesh* tetrahedra);

#endif
