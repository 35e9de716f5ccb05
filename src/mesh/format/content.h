/// @file content.h
/// A whole file in memory.
#ifndef JN_MESH_FORMAT_CONTENT_H
#define JN_MESH_FORMAT_CONTENT_H

#include "base/arena.h"

/// The bytes of a file, from an arena, with a zero behind them.
typedef struct JnContent {
	size_t size;
	const char* data;
} JnContent;

/// JN_IO_FAILED when it cannot be read or is no file; JN_BAD_INPUT when it is empty or larger than 2 GiB.
JnStatus jn_content_read(const char* path, JnArena* arena, JnContent* content);

/// First place of a text between `from` and `end`, or NULL.
const char* jn_content_find(const char* from, const char* end, const char* text);

#endif
