/// @file ply_check.h
/// Whether a PLY file holds what its header declares: assimp does not ask.
#ifndef JN_MESH_FORMAT_PLY_CHECK_H
#define JN_MESH_FORMAT_PLY_CHECK_H

#include "mesh/format/content.h"

/// JN_BAD_INPUT, after a message that begins with `path`, when the header is not understood, the file ends before the
/// last element, a value is no number, or a face names a vertex that is not there.
JnStatus jn_ply_check(const char* path, const JnContent* content);

#endif
