// How the subcommands end.
#include "app.h"

#include <stdarg.h>
#include <stdio.h>

int app_exit_status(JnStatus status) {
	switch (status) {
	case JN_OK:
		return EXIT_DONE;
	case JN_BAD_INPUT:
		return EXIT_BAD_INPUT;
	case JN_IO_FAILED:
		return EXIT_FILE_FAILED;
	default:
		return EXIT_RUN_FAILED;
	}
}

int(app_usage_error)(const char* command, const char* format, ...) {
	va_list arguments;
	va_start(arguments, format);
	fputs("jounce: error: ", stderr);
	vfprintf(stderr, format, arguments);
	fprintf(stderr, "\n'jounce %s%s--help' explains\n", command, *command != '\0' ? " " : "");
	va_end(arguments);
	return EXIT_BAD_INPUT;
}
