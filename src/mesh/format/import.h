/// @file import.h
/// Meshes from files: surfaces of triangles and volumes of tetrahedra or hexahedra, one row a format.
#ifndef JN_MESH_FORMAT_IMPORT_H
#define JN_MESH_FORMAT_IMPORT_H

#include "mesh/mesh.h"
#include "mesh/surface.h"

/// What a file holds: a surface, or a volume (then the surface stays empty).
typedef struct JnImport {
	bool is_volume;
	JnSurface surface;
	JnMesh volume;
} JnImport;

typedef struct JnImportFormat {
	const char* name;       ///< "Gmsh"
	const char* extensions; ///< "msh", in lower case, separated by spaces
	/// Read a file as it is. JN_IO_FAILED when it cannot be opened, JN_BAD_INPUT when its content is not what the
	/// format says; the message begins with `path`. Sizes that a file declares are checked before memory is taken.
	JnStatus (*read)(const char* path, JnArena* arena, JnImport* out);
} JnImportFormat;

extern const JnImportFormat* const jn_import_list[]; ///< NULL at the end

/// Read a mesh by its extension, then repair and check it: a surface by jn_surface_repair, a volume by jn_mesh_repair.
JnStatus jn_import(const char* path, JnArena* arena, JnImport* out);

#endif
