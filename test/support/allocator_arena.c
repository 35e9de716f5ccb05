// Arenas hand out pieces of larger blocks: here each piece counts as an allocation, so that every one of them can be refused.
#include <stdint.h>

#include "base/aligned.h"
#include "base/arena.h"
#include "base/grow.h"
#include "support/allocator.h"

void* __real_jn_aligned_take(size_t bytes);
void* __real_jn_arena_take(JnArena* arena, size_t count, size_t size);
char* __real_jn_arena_text(JnArena* arena, const char* text);
JnStatus __real_jn_grow(void** at, size_t* capacity, size_t count, size_t size);
void* __wrap_jn_aligned_take(size_t bytes);
void* __wrap_jn_arena_take(JnArena* arena, size_t count, size_t size);
char* __wrap_jn_arena_text(JnArena* arena, const char* text);
JnStatus __wrap_jn_grow(void** at, size_t* capacity, size_t count, size_t size);

/// What an arena does, with its message, when memory is out.
static void* refuse(JnArena* arena) {
	return __real_jn_arena_take(arena, SIZE_MAX, SIZE_MAX);
}

/// Who asks is the one who asked the arena, if one does.
void* __wrap_jn_aligned_take(size_t bytes) {
	const void* before = allocator_stand_in(NULL);
	allocator_stand_in(before != NULL ? before : __builtin_return_address(0));
	void* memory = __real_jn_aligned_take(bytes);
	allocator_stand_in(before);
	return memory;
}

void* __wrap_jn_arena_take(JnArena* arena, size_t count, size_t size) {
	if (allocator_refuses(0, __builtin_return_address(0))) return refuse(arena);
	allocator_stand_in(__builtin_return_address(0));
	void* data = __real_jn_arena_take(arena, count, size);
	allocator_stand_in(NULL);
	return data;
}

char* __wrap_jn_arena_text(JnArena* arena, const char* text) {
	if (allocator_refuses(0, __builtin_return_address(0))) return refuse(arena);
	allocator_stand_in(__builtin_return_address(0));
	char* copy = __real_jn_arena_text(arena, text);
	allocator_stand_in(NULL);
	return copy;
}

JnStatus __wrap_jn_grow(void** at, size_t* capacity, size_t count, size_t size) {
	allocator_stand_in(__builtin_return_address(0));
	const JnStatus status = __real_jn_grow(at, capacity, count, size);
	allocator_stand_in(NULL);
	return status;
}
