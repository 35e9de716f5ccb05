/// @file view_code.h
/// How numbers are put into a saved page: 16 bits each, deflated, as base64.
///
/// A chunk is a head of `parts` pairs (low, step) of f32 and the codes of `parts` columns one after the other, each code
/// minus the one before it, modulo 65536: first all low bytes, then all high ones. value = low + step * (code - 1); code 0:
/// there is none.
#ifndef JN_APP_VIEW_CODE_H
#define JN_APP_VIEW_CODE_H

#include "view_pack.h"

/// The chunk of numbers[count][parts], deflated (RFC 1950). JN_OUT_OF_MEMORY.
JnStatus view_code_numbers(const float* numbers, int count, int parts, ViewBytes* out);

/// Any bytes, deflated. JN_OUT_OF_MEMORY.
JnStatus view_code_bytes(const void* bytes, size_t size, ViewBytes* out);

/// Write as base64.
void view_code_print(FILE* file, const ViewBytes* bytes);

#endif
