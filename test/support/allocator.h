/// @file allocator.h
/// Allocations of jounce's own code, counted and refused on demand. Works in programs that are linked with
/// -Wl,--wrap=malloc and its like (cmake/jounceFuzz.cmake): the linker then hands the calls of objects that are linked
/// statically, which are ours, to this; those from inside shared libraries stay as they are. A site is the address behind a
/// call; one inside jn_grow is that behind the call of jn_grow.
#ifndef JN_TEST_SUPPORT_ALLOCATOR_H
#define JN_TEST_SUPPORT_ALLOCATOR_H

#include <stdbool.h>
#include <stddef.h>

/// Refuse all that goes beyond `bytes` in sum from now on, whatever is freed; 0: refuse nothing.
void allocator_limit(size_t bytes);

/// Begin to count, and refuse the allocation of that number, from 1, and no other; 0: none.
void allocator_fail_at(long number);

/// Allocations since then; the numbers go on until the next allocator_fail_at.
long allocator_count(void);

/// The site of the one that was refused; NULL: none was.
const void* allocator_culprit(void);

/// Call `watch` at each allocation with its site and number, from whichever thread; NULL: call nothing.
void allocator_watch(void (*watch)(const void* site, long number));

/// For those who stand between a caller and the allocator: count an allocation of `size` bytes, and tell whether to refuse it.
bool allocator_refuses(size_t size, const void* site);

/// From now on, in this thread, allocations count as those of `site`; NULL: as those of who calls. Returns the site until now.
const void* allocator_stand_in(const void* site);

#endif
