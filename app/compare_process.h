/// @file compare_process.h
/// Processes that work for a comparison or a film.
#ifndef JN_APP_COMPARE_PROCESS_H
#define JN_APP_COMPARE_PROCESS_H

#include <stdbool.h>
#include <sys/types.h>

/// Start `program` (found in PATH when it has no slash) with arguments that end with NULL, in `folder` (NULL: here), its
/// words into the file `log` there, which is emptied. The process has a group of its own, so that Ctrl-C reaches it only
/// through us, and gets SIGINT when this process dies. Returns its id, or -1 with errno.
pid_t compare_process_start(const char* program, const char* const arguments[], const char* folder, const char* log);

/// The same, here, with a pipe to its standard input, which the caller closes.
pid_t compare_process_feed(const char* program, const char* const arguments[], const char* log, int* input);

/// Exit status of an ended process; 128 + the signal that ended it.
int compare_process_status(int wait_status);

/// Wait for one process and return its exit status; -1 when there is none such.
int compare_process_wait(pid_t process);

#endif
