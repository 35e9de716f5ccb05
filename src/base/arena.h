/// @file arena.h
/// Memory that is freed at once: blocks from which pieces are cut. All zero is a valid, empty arena.
#ifndef JN_BASE_ARENA_H
#define JN_BASE_ARENA_H

#include "jounce/base.h"

typedef struct JnArenaBlock JnArenaBlock;

typedef struct JnArena {
	JnArenaBlock* blocks; ///< newest first
	size_t used;          ///< bytes handed out
} JnArena;

/// `count * size` zeroed bytes, 64-byte aligned, or NULL after an error message. Lives until jn_arena_free.
void* jn_arena_take(JnArena* arena, size_t count, size_t size);

/// A copy of a string in the arena, or NULL.
char* jn_arena_text(JnArena* arena, const char* text);

/// Free everything; the arena is empty and usable again.
void jn_arena_free(JnArena* arena);

/// Set `pointer` to `count` zeroed objects of its type, or return JN_OUT_OF_MEMORY from the calling function.
#define JN_NEW(arena, pointer, count)                                                                                  \
	do {                                                                                                               \
		(pointer) = jn_arena_take((arena), (size_t)(count), sizeof *(pointer));                                        \
		if ((pointer) == NULL) return JN_OUT_OF_MEMORY;                                                                \
	} while (0)

#endif
