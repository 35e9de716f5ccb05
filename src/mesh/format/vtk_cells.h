/// @file vtk_cells.h
/// Cells as VTK's unstructured grids hold them, in legacy files and in XML.
#ifndef JN_MESH_FORMAT_VTK_CELLS_H
#define JN_MESH_FORMAT_VTK_CELLS_H

#include "mesh/format/import.h"

/// Point data of that name and a set's marks its members.
#define JN_VTK_SET_PREFIX "set:"

typedef struct JnVtkCells {
	size_t point_count, cell_count, connectivity_count;
	double* points;        ///< 3 * point_count, taken over by the mesh
	int64_t* types;        ///< cell_count VTK cell types
	int64_t* offsets;      ///< cell_count ends of cells in connectivity, each the start of the next
	int64_t* connectivity; ///< point numbers
	size_t set_count;
	JnNodeSet* sets; ///< taken over by a volume
} JnVtkCells;

/// A volume of the tet4, tet10 or hex8 cells, or a surface of the triangles when there are no volume cells. Cells of
/// lower dimension are left out. JN_BAD_INPUT, after a message that begins with `path`, for other cells, several volume
/// types, numbers out of range, coordinates that are not finite.
JnStatus jn_vtk_cells_import(const char* path, const JnVtkCells* cells, JnArena* arena, JnImport* out);

/// A set from a mark per point: those that are not 0. JN_OUT_OF_MEMORY.
JnStatus jn_vtk_set(const char* name, size_t name_length, const double* marks, size_t count, JnArena* arena,
					JnNodeSet* set);

#endif
