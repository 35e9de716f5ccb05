/// @file msh_outline.h
/// What a .msh file says of itself, checked against its size before anyone takes memory for it.
#ifndef JN_MESH_FORMAT_MSH_OUTLINE_H
#define JN_MESH_FORMAT_MSH_OUTLINE_H

#include "mesh/format/content.h"

typedef struct JnMshOutline {
	size_t nodes, elements; ///< that the file declares
	bool is_version_2;      ///< of which Gmsh drops the nodes that no element uses
} JnMshOutline;

/// JN_BAD_INPUT, after a message that begins with `path`, when the text is not MSH 2.2 or 4.1, when a section has no end,
/// or when its counts do not agree with its length.
JnStatus jn_msh_outline(const char* path, const JnContent* content, JnMshOutline* outline);

#endif
