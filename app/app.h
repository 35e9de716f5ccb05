/// @file app.h
/// The subcommands of the command `jounce`; each is one file and one row of the table in main.c.
#ifndef JN_APP_APP_H
#define JN_APP_APP_H

#include "jounce/base.h"

/// Exit statuses of the command.
enum { EXIT_DONE = 0, EXIT_RUN_FAILED = 1, EXIT_BAD_INPUT = 2, EXIT_FILE_FAILED = 3 };

int app_run(int count, char** arguments);
int app_resume(int count, char** arguments);
int app_check(int count, char** arguments);
int app_compare(int count, char** arguments);
int app_export(int count, char** arguments);
int app_score(int count, char** arguments);
int app_reproduce(int count, char** arguments);
int app_mesh(int count, char** arguments);
int app_view(int count, char** arguments);
int app_render(int count, char** arguments);
int app_report(int count, char** arguments);
int app_list(int count, char** arguments);
int app_describe(int count, char** arguments);

/// The exit status for a library status.
int app_exit_status(JnStatus status);

/// Print "jounce: error: ..." and where help is to stderr; returns EXIT_BAD_INPUT. `command` "": the whole command.
int app_usage_error(const char* command, const char* format, ...) __attribute__((format(printf, 2, 3)));

#ifdef __clang_analyzer__ // sees one file at a time, so that it has to be told what comes back
	#define app_usage_error(command, ...) (app_usage_error(command, __VA_ARGS__), EXIT_BAD_INPUT)
#endif

#endif
