/// @file export_volume.h
/// Writers of volumes, one a format. Each writes a file anew; export_volume.c gives it its name when it is whole.
#ifndef JN_MESH_FORMAT_EXPORT_VOLUME_H
#define JN_MESH_FORMAT_EXPORT_VOLUME_H

#include "mesh/mesh.h"

/// Write `mesh` to `temporary`; messages name `path`.
JnStatus jn_export_gmsh(const JnMesh* mesh, const char* temporary, const char* path);
JnStatus jn_export_vtu(const JnMesh* mesh, const char* temporary, const char* path);

#endif
