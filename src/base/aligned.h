/// @file aligned.h
/// Memory that begins at a cache line.
///
/// Not C's `aligned_alloc`: that of the C library of Debian 12 cannot take again what was freed with the very size that is
/// asked for (glibc's bug 14581, mended in 2.38), so that a program which frees and takes the same pieces all the time grows.
#ifndef JN_BASE_ALIGNED_H
#define JN_BASE_ALIGNED_H

#include <stddef.h>

enum { JN_ALIGNMENT = 64 };

/// `bytes`, and the rest of their last cache line, zeroed and at a multiple of JN_ALIGNMENT; NULL without a message when
/// there are none.
void* jn_aligned_take(size_t bytes);

/// Give back what jn_aligned_take gave; NULL does nothing.
void jn_aligned_free(void* memory);

#endif
