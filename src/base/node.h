/// @file node.h
/// How YAML text becomes nodes and how a node names its place: shared by documents, overrides and the key reader.
#ifndef JN_BASE_NODE_H
#define JN_BASE_NODE_H

#include "base/document.h"

/// Whether nodes know line and column (text of a file) or only their source (text of an override).
typedef enum JnPlaces { JN_PLACES_KEPT, JN_PLACES_NONE } JnPlaces;

enum {
	JN_NODE_DEPTH_LIMIT = 64,      ///< levels of nesting in a document
	JN_NODE_COUNT_LIMIT = 1000000, ///< nodes in a document
	JN_NODE_PLACE_SIZE = 512,      ///< bytes that hold any place
};

/// Parse one YAML document of any kind; `source` must live as long as the nodes. `*root` is NULL when the text is
/// empty. JN_BAD_INPUT, with a message, on whatever jn_document_read refuses, but for the kind of the root.
JnStatus jn_node_parse(const char* source, const char* text, JnPlaces places, JnArena* arena, JnNode** root);

/// Add a child at the end of a list or mapping.
JnStatus jn_node_append(JnNode* parent, JnNode* child, JnArena* arena);

/// Write "file:line:column", or the source alone where there is no line. Cut to `size`.
void jn_node_place(const JnNode* node, size_t size, char* place);

/// Whether a node is a scalar that stands for nothing: empty, "null" or "~".
bool jn_node_is_null(const JnNode* node);

#endif
