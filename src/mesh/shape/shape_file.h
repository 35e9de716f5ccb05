/// @file shape_file.h
/// A body from a file: a volume as it is, or a surface that is filled with cells.
#ifndef JN_MESH_SHAPE_SHAPE_FILE_H
#define JN_MESH_SHAPE_SHAPE_FILE_H

#include "mesh/shape/placement.h"
#include "mesh/shape/shape.h"
#include "mesh/surface.h"

typedef struct JnTetrahedraDef {
	double size; ///< edge length [m]
	int order;   ///< 0: tet4; 1: tet10
} JnTetrahedraDef;

typedef struct JnVoxelsDef {
	double size; ///< edge length [m]
} JnVoxelsDef;

/// Keys of `shape: {type: file}`.
typedef struct JnFileDef {
	const char* path;
	JnPlacementDef placement;
	JnTetrahedraDef* tetrahedra; ///< NULL: not asked for
	JnVoxelsDef* voxels;         ///< NULL: not asked for
	bool triangles;              ///< take the surface itself, for cloth
} JnFileDef;

extern const JnKey jn_file_keys[];

/// What a file and its keys give.
typedef struct JnFileMesh {
	bool has_volume;   ///< false: the file holds a surface, and nothing asked to fill it
	JnMesh volume;     ///< read or filled
	JnSurface surface; ///< as read and placed; empty when the file holds a volume
	bool was_kept;     ///< the tetrahedra come from the cache
} JnFileMesh;

/// Read, repair, place and fill. `what` is the key path of the shape; messages begin with it or with the file's path.
JnStatus jn_file_mesh(const JnFileDef* def, const char* what, JnArena* arena, JnFileMesh* out);

#endif
