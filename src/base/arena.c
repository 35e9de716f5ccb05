// A chain of zeroed blocks; a request larger than a block gets a block of its own.
#include "base/arena.h"

#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"

enum { ALIGNMENT = JN_ALIGNMENT, BLOCK_BYTES = 1 << 16 };

struct JnArenaBlock {
	JnArenaBlock* next;
	size_t size, used; // bytes of data behind this header
};

static size_t round_up(size_t bytes) {
	return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

static JnArenaBlock* add_block(JnArena* arena, size_t bytes) {
	const size_t size = bytes > BLOCK_BYTES ? bytes : BLOCK_BYTES;
	JnArenaBlock* block = jn_aligned_take(ALIGNMENT + size);
	if (block == NULL) return NULL;
	*block = (JnArenaBlock){.next = arena->blocks, .size = size, .used = 0};
	arena->blocks = block;
	return block;
}

void* jn_arena_take(JnArena* arena, size_t count, size_t size) {
	const size_t limit = (size_t)1 << 46;
	const size_t bytes = size != 0 && count > limit / size ? limit : round_up(count * size);
	JnArenaBlock* block = arena->blocks;
	if (block == NULL || block->size - block->used < bytes) block = bytes < limit ? add_block(arena, bytes) : NULL;
	if (block == NULL) {
		jn_error(JN_OUT_OF_MEMORY, "out of memory: %zu objects of %zu bytes wanted, %zu bytes in use here", count, size,
				 arena->used);
		return NULL;
	}
	char* data = (char*)block + ALIGNMENT + block->used;
	block->used += bytes;
	arena->used += bytes;
	return data;
}

char* jn_arena_text(JnArena* arena, const char* text) {
	const size_t length = strlen(text) + 1;
	char* copy = jn_arena_take(arena, length, 1);
	return copy != NULL ? memcpy(copy, text, length) : NULL;
}

void jn_arena_free(JnArena* arena) {
	while (arena->blocks != NULL) {
		JnArenaBlock* next = arena->blocks->next;
		jn_aligned_free(arena->blocks);
		arena->blocks = next;
	}
	arena->used = 0;
}
