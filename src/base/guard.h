/// @file guard.h
/// A child process for a library that may crash on a damaged file: its crash becomes an error of ours. Costs a fork and
/// the start of whatever the child loads.
#ifndef JN_BASE_GUARD_H
#define JN_BASE_GUARD_H

#include <stdio.h>
#include <sys/types.h>

#include "jounce/base.h"

/// What a child may use beyond what it starts with.
typedef struct JnGuardLimits {
	size_t memory;      ///< address space [bytes]
	int seconds;        ///< processor time [s]
	const char* remedy; ///< what the message of a bad end advises; NULL: it asks whether the file is damaged
} JnGuardLimits;

/// Work for the child: all that it has found out goes into `result`.
typedef JnStatus (*JnGuardedWork)(void* user, FILE* result);

/// Run `work(user, result)` in a child process and wait. Its status and its messages become those of this call. On JN_OK
/// *result is what it wrote, from the beginning; the caller closes it. JN_BAD_INPUT, after a message that begins with
/// `what`, when the child crashed or passed its limits; JN_IO_FAILED when there can be no child.
JnStatus jn_guard_run(const char* what, JnGuardLimits limits, JnGuardedWork work, void* user, FILE** result);

/// A child that answers questions for as long as its parent asks them.
typedef struct JnGuardChild {
	pid_t id;
	int socket; ///< a stream to the other process
	JnGuardLimits limits;
	size_t address_space; ///< of the child when it began [bytes]; 0 in the parent
} JnGuardChild;

/// What the child does: it answers until its socket has ended. All other files of its parent are closed in it.
typedef void JnGuardService(const JnGuardChild* own, void* user);

/// Run `serve(own, user)` in a child process and go on. limits.seconds are those between two calls of jn_guard_wind. JN_IO_FAILED after a
/// message, which begins with `what`, when there can be no child; nothing is to be ended then.
JnStatus jn_guard_start(const char* what, JnGuardLimits limits, JnGuardService* serve, void* user, JnGuardChild* child);

/// In the child: the time of the next question begins.
void jn_guard_wind(const JnGuardChild* own, int more_seconds);

/// In the child: so many bytes more than limits.memory are in order, and no more.
void jn_guard_allow(const JnGuardChild* own, size_t more);

/// End the child. JN_BAD_INPUT, after a message that begins with `what`, when it has crashed or passed its limits.
JnStatus jn_guard_end(const char* what, const JnGuardChild* child);

#endif
