/// @file mesh.h
/// A mesh of one element shape, of a volume, a surface or points: node positions and cells. Pure geometry.
#ifndef JN_MESH_MESH_H
#define JN_MESH_MESH_H

#include "base/arena.h"
#include "jounce/base.h"

/// Element shapes, solids first. Node order is that of VTK.
typedef enum JnShape {
	JN_TET4,
	JN_TET10,
	JN_HEX8,
	JN_SOLID_SHAPE_COUNT,
	JN_TRI3 = JN_SOLID_SHAPE_COUNT, ///< of a surface, such as cloth
	JN_POINT1,                      ///< a node alone, such as a peridynamic point
	JN_SHAPE_COUNT
} JnShape;

typedef struct JnShapeInfo {
	const char* name; ///< "tet4"
	int nodes;        ///< nodes of a cell
	int vtk_type;     ///< VTK cell type: 10, 24, 12, 5, 1
	const char* xdmf; ///< XDMF topology type: "Tetrahedron", "Tetrahedron_10", "Hexahedron", "Triangle", "Polyvertex"
	int faces;        ///< faces of a cell; a triangle is its own, a point has none
	int face_nodes;   ///< nodes of a face: 3, 6 or 4; 0: no faces
	const int* face;  ///< faces * face_nodes local node numbers, corners first, outward by the right-hand rule
} JnShapeInfo;

extern const JnShapeInfo jn_shape_info[JN_SHAPE_COUNT];

/// The corners of a hex8 in the unit cube, in VTK's order.
extern const int jn_hex_corner[8][3];

/// Nodes that a file or a generator gave a name, such as the "plate" under a jello.
typedef struct JnNodeSet {
	const char* name;
	int count;
	int* nodes; ///< count node numbers, ascending
} JnNodeSet;

typedef struct JnMesh {
	JnShape shape;
	int node_count;
	double* nodes; ///< 3 * node_count coordinates [m]
	int cell_count;
	int* cells; ///< cell_count * jn_shape_info[shape].nodes node numbers
	int set_count;
	JnNodeSet* sets;                     ///< set_count named sets; NULL: none
	const struct JnEmbedding* embedding; ///< a finer surface that the cells carry along (embed.h); NULL: none
	const double* volumes;               ///< of JN_POINT1: one a node [m^3], which make its mass; else NULL
	double thickness;                    ///< of JN_POINT1 in a single layer across z [m]; 0: not a layer
	const struct JnRigid* rigid;         ///< of a rigid ball or plate about the only node (rigid.h); NULL: deformable
	const struct JnThread* thread;       ///< the chain of frames that its nodes are (thread.h); NULL: none
} JnMesh;

/// Volume of a cell by its straight-sided corners [m^3]; negative when it is inside out. Area of a triangle [m^2].
double jn_mesh_cell_volume(const JnMesh* mesh, int cell);

#endif
