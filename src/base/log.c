// The log sink: the only mutable global of the library.
#include "base/log.h"

#include <stdarg.h>
#include <stdio.h>

static void write_to_stderr(void* user, JnLogLevel level, const char* message) {
	(void)user;
	if (level == JN_LOG_INFO) return;
	fprintf(stderr, "jounce: %s: %s\n", level == JN_LOG_ERROR ? "error" : "warning", message);
}

static JnLog current = {.sink = write_to_stderr};

void jn_log_set_sink(JnLogSink sink, void* user) {
	current = sink != NULL ? (JnLog){sink, user} : (JnLog){.sink = write_to_stderr};
}

JnLog jn_log_swap(JnLog log) {
	const JnLog before = current;
	current = log;
	return before;
}

static void send(JnLogLevel level, const char* format, va_list arguments) {
	char message[2048];
	vsnprintf(message, sizeof message, format, arguments);
	current.sink(current.user, level, message);
}

JnStatus(jn_error)(JnStatus status, const char* format, ...) { // the analyser's macro of log.h stays out
	va_list arguments;
	va_start(arguments, format);
	send(JN_LOG_ERROR, format, arguments);
	va_end(arguments);
	return status;
}

void jn_warn(const char* format, ...) {
	va_list arguments;
	va_start(arguments, format);
	send(JN_LOG_WARNING, format, arguments);
	va_end(arguments);
}

void jn_info(const char* format, ...) {
	va_list arguments;
	va_start(arguments, format);
	send(JN_LOG_INFO, format, arguments);
	va_end(arguments);
}

const char* jn_status_name(JnStatus status) {
	switch (status) {
	case JN_OK:
		return "ok";
	case JN_NOT_CONVERGED:
		return "not converged";
	case JN_INDEFINITE:
		return "indefinite matrix";
	case JN_NOT_FINITE:
		return "not finite";
	case JN_BAD_INPUT:
		return "bad input";
	case JN_IO_FAILED:
		return "input or output failed";
	case JN_OUT_OF_MEMORY:
		return "out of memory";
	case JN_RUN_FAILED:
		return "run failed";
	}
	return "unknown status";
}
