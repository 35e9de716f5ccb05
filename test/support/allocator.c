// Threads of a team may ask at once: counts are atomic.
#include "support/allocator.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

void* __real_malloc(size_t size);
void* __real_calloc(size_t count, size_t size);
void* __real_realloc(void* data, size_t size);
FILE* __real_open_memstream(char** data, size_t* size);
void* __wrap_malloc(size_t size);
void* __wrap_calloc(size_t count, size_t size);
void* __wrap_realloc(void* data, size_t size);
FILE* __wrap_open_memstream(char** data, size_t* size);

static atomic_size_t taken, limit;
static atomic_long count, refused;
static const void* _Atomic culprit;
static void (*_Atomic watcher)(const void* site, long number);
static _Thread_local const void* stand_in;

void allocator_limit(size_t bytes) {
	taken = 0;
	limit = bytes;
}

void allocator_fail_at(long number) {
	count = 0;
	culprit = NULL;
	refused = number;
}

long allocator_count(void) {
	return count;
}

const void* allocator_culprit(void) {
	return culprit;
}

void allocator_watch(void (*watch)(const void* site, long number)) {
	watcher = watch;
}

const void* allocator_stand_in(const void* site) {
	const void* before = stand_in;
	stand_in = site;
	return before;
}

bool allocator_refuses(size_t size, const void* site) {
	const long number = ++count;
	void (*const watch)(const void*, long) = watcher;
	if (stand_in != NULL) site = stand_in;
	if (watch != NULL) watch(site, number);
	bool refuses = number == refused;
	if (refuses) culprit = site;
	if (limit != 0) {
		refuses |= size > limit || taken > limit - size;
		if (!refuses) taken += size;
	}
	if (refuses) errno = ENOMEM;
	return refuses;
}

void* __wrap_malloc(size_t size) {
	return allocator_refuses(size, __builtin_return_address(0)) ? NULL : __real_malloc(size);
}

void* __wrap_calloc(size_t number, size_t size) {
	size_t bytes;
	if (__builtin_mul_overflow(number, size, &bytes)) bytes = (size_t)-1;
	return allocator_refuses(bytes, __builtin_return_address(0)) ? NULL : __real_calloc(number, size);
}

void* __wrap_realloc(void* data, size_t size) {
	return allocator_refuses(size, __builtin_return_address(0)) ? NULL : __real_realloc(data, size);
}

FILE* __wrap_open_memstream(char** data, size_t* size) {
	return allocator_refuses(0, __builtin_return_address(0)) ? NULL : __real_open_memstream(data, size);
}
