/// @file grow.h
/// Arrays that grow and are used again: NULL with capacity 0 is empty, free() releases them.
#ifndef JN_BASE_GROW_H
#define JN_BASE_GROW_H

#include "jounce/base.h"

/// Room for `count` things of `size` bytes behind *at, half as many more when it must grow; what is there stays.
/// JN_OUT_OF_MEMORY after a message, nothing changed.
JnStatus jn_grow(void** at, size_t* capacity, size_t count, size_t size);

#endif
