/// @file gmsh_model.h
/// The mesh that Gmsh holds, as a stream of bytes from the process that reads a file to the one that asked for it.
#ifndef JN_MESH_FORMAT_GMSH_MODEL_H
#define JN_MESH_FORMAT_GMSH_MODEL_H

#include <stdio.h>

#include "mesh/format/gmsh_library.h"
#include "mesh/format/import.h"
#include "mesh/format/msh_outline.h"

enum { JN_GMSH_TRIANGLE = 2, JN_GMSH_TET4 = 4, JN_GMSH_HEX8 = 5, JN_GMSH_TET10 = 11, JN_GMSH_POINT = 15 };

/// Gmsh's number of the element type of a shape.
int jn_gmsh_element_type(JnShape shape);

/// Nodes of a cell from Gmsh's order to VTK's or back: those of tet10 differ in their last two.
void jn_gmsh_reorder(JnShape shape, size_t cells, int* nodes);

/// Write Gmsh's current mesh: its volume cells, or its triangles when there are none, numbered from 0 in the order of
/// their tags, and its physical groups as node sets. JN_BAD_INPUT, after a message that begins with `what`, when it holds
/// other cells than jounce has, more nodes than stated, or not as many elements.
JnStatus jn_gmsh_model_write(const JnGmsh* gmsh, const char* what, const JnMshOutline* outline, FILE* stream);

/// Read what was written. JN_BAD_INPUT when it is not whole.
JnStatus jn_gmsh_model_read(FILE* stream, const char* what, JnArena* arena, JnImport* out);

#endif
