/// @file guard.h
/// A child process for a library that may crash on a damaged file: its crash becomes an error of ours. Costs a fork and
/// the start of whatever the child loads.
#ifndef JN_MESH_FORMAT_GUARD_H
#define JN_MESH_FORMAT_GUARD_H

#include <stdio.h>

#include "jounce/base.h"

/// What a child may use beyond what it starts with.
typedef struct JnGuardLimits {
	size_t memory; ///< address space [bytes]
	int seconds;   ///< processor time [s]
} JnGuardLimits;

/// Work for the child: all that it has found out goes into `result`.
typedef JnStatus (*JnGuardedWork)(void* user, FILE* result);

/// Run `work(user, result)` in a child process and wait. Its status and its messages become those of this call. On JN_OK
/// *result is what it wrote, from the beginning; the caller closes it. JN_BAD_INPUT, after a message that begins with
/// `what`, when the child crashed or passed its limits; JN_IO_FAILED when there can be no child.
JnStatus jn_guard_run(const char* what, JnGuardLimits limits, JnGuardedWork work, void* user, FILE** result);

#endif
