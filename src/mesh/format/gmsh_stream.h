/// @file gmsh_stream.h
/// The bytes between gmsh_model.c and gmsh_model_read.c: a JnGmshHeader, nodes, cells, then each set as a JnGmshSetHeader,
/// its name and its nodes. Both ends are one program, so that numbers are as in memory.
#ifndef JN_MESH_FORMAT_GMSH_STREAM_H
#define JN_MESH_FORMAT_GMSH_STREAM_H

#include <stddef.h>

enum { JN_GMSH_SURFACE = 100 }; ///< in place of a shape

typedef struct JnGmshHeader {
	size_t shape;   ///< JnShape, or JN_GMSH_SURFACE
	size_t nodes;   ///< points, three doubles each
	size_t entries; ///< node numbers of all cells, an int each
	size_t sets;
} JnGmshHeader;

typedef struct JnGmshSetHeader {
	size_t name_length, count; ///< a set without name is left out
} JnGmshSetHeader;

#endif
