/// @file shape.h
/// Where the mesh of a body comes from: one row a shape, generated from a few numbers or read from a file.
#ifndef JN_MESH_SHAPE_SHAPE_H
#define JN_MESH_SHAPE_SHAPE_H

#include "jounce/extend.h"
#include "mesh/mesh.h"

/// Keys of `shape: {type: box}`. Corner `origin`, edges along x, y, z.
typedef struct JnBoxDef {
	double origin[3]; ///< lowest corner [m]
	double size[3];   ///< edge lengths [m], each > 0
	int cells[3];     ///< hexahedra along each axis, each >= 1
	int element;      ///< JnShape
} JnBoxDef;

/// The row of a generated shape: its generator fills a mesh, allocated from the arena.
typedef struct JnShapeType {
	JnRow row;
	/// `what` is the key path of the shape, for messages.
	JnStatus (*generate)(const void* options, const char* what, JnArena* arena, JnMesh* mesh);
} JnShapeType;

extern const JnRowList jn_shape_list;

/// A box of size.cells hexahedra (node index fastest in x, then y, then z), or each hexahedron split into six
/// tetrahedra that match across faces (Kuhn), with mid-edge nodes for tet10, shared between cells.
JnStatus jn_generate_box(const JnBoxDef* def, JnArena* arena, JnMesh* mesh);

#endif
