/// @file voxel_grid.h
/// The grid of cubes around a surface while it is being filled (voxels.h).
#ifndef JN_MESH_FILL_VOXEL_GRID_H
#define JN_MESH_FILL_VOXEL_GRID_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// What is known of a cube, in rising order.
typedef enum JnVoxel {
	JN_VOXEL_CLEAR,   ///< no triangle comes near
	JN_VOXEL_GRAZED,  ///< a triangle is at its faces, edges or corners, up to rounding, and not inside
	JN_VOXEL_INSIDE,  ///< does not touch the surface, lies inside
	JN_VOXEL_TOUCHED, ///< a triangle passes through
} JnVoxel;

/// Cube (i, j, k) is cubes[(k * counts[1] + j) * counts[0] + i], from low + size * (i, j, k) on.
typedef struct JnVoxelGrid {
	double low[3]; ///< [m]
	double size;   ///< [m]
	int counts[3];
	unsigned char* cubes; ///< JnVoxel
} JnVoxelGrid;

static inline bool jn_voxel_is_full(const JnVoxelGrid* grid, const int at[3]) {
	for (int a = 0; a < 3; ++a)
		if (at[a] < 0 || at[a] >= grid->counts[a]) return false;
	return grid->cubes[((ptrdiff_t)at[2] * grid->counts[1] + at[1]) * grid->counts[0] + at[0]] >= JN_VOXEL_INSIDE;
}

/// Half the edge of the smallest cube around `centre` that touches a triangle: their distance in the maximum norm [m].
double jn_voxel_distance(double corners[3][3], const double centre[3]);

/// Mark the cubes that the triangles touch or graze.
void jn_voxel_mark(JnVoxelGrid* grid, const JnSurface* surface);

/// Write one warning, which begins with `what`, when parts of a mesh of cubes hang together by edges or corners alone.
JnStatus jn_voxel_warn_hinges(const JnMesh* mesh, const char* what);

#endif
