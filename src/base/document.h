/// @file document.h
/// A YAML file as a tree whose nodes know their line and column, and the overrides of `--set` applied to it.
#ifndef JN_BASE_DOCUMENT_H
#define JN_BASE_DOCUMENT_H

#include "base/arena.h"
#include "jounce/base.h"

typedef enum JnNodeKind { JN_NODE_SCALAR, JN_NODE_SEQUENCE, JN_NODE_MAPPING } JnNodeKind;

typedef struct JnNode {
	JnNodeKind kind;
	const char* source; ///< file name as given, or "--set path=value" for overrides
	int line, column;   ///< from 1; 0 for overrides
	const char* name;   ///< key of this entry in its mapping, or NULL
	const char* scalar; ///< text of a scalar
	int count;          ///< children
	struct JnNode** children;
} JnNode;

typedef struct JnDocument {
	JnArena* arena;   ///< owns every node and string
	const char* path; ///< as given
	const char* text; ///< the file's text
	JnNode* root;     ///< a mapping
} JnDocument;

/// Read and parse a file. JN_IO_FAILED when it cannot be read, JN_BAD_INPUT on a syntax error, a duplicate key, an
/// alias, several documents, a root that is no mapping, or more than 1e6 nodes: the message has file:line:column.
JnStatus jn_document_read(const char* path, JnArena* arena, JnDocument* document);

/// Parse text that has been read already; `path` names it in messages.
JnStatus jn_document_parse(const char* path, const char* text, JnArena* arena, JnDocument* document);

/// Apply "a.b[0].c=value": replace that entry, or add it (mappings on the way are made; a list index must exist or be
/// one past the end). The value is YAML (a scalar, [..] or {..}).
JnStatus jn_document_set(JnDocument* document, const char* assignment);

/// The entry of a mapping by name, or NULL.
JnNode* jn_node_find(const JnNode* mapping, const char* name);

#endif
