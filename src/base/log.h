/// @file log.h
/// Messages. Only the place that knows what went wrong writes the words; callers pass the status up.
#ifndef JN_BASE_LOG_H
#define JN_BASE_LOG_H

#include "jounce/base.h"

/// Log an error and return `status`: `return jn_error(JN_BAD_INPUT, "...", ...)`.
JnStatus jn_error(JnStatus status, const char* format, ...) __attribute__((format(printf, 2, 3)));
void jn_warn(const char* format, ...) __attribute__((format(printf, 1, 2)));
void jn_info(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// Where messages go.
typedef struct JnLog {
	JnLogSink sink;
	void* user;
} JnLog;

/// Send messages elsewhere; returns where they went before, to be put back. For layers that add what they know.
JnLog jn_log_swap(JnLog log);

#ifdef __clang_analyzer__ // sees one file at a time, so that it has to be told what comes back
	#define jn_error(status, ...) (jn_error(status, __VA_ARGS__), (status))
#endif

#endif
