/// @file support.h
/// What several tests need: folders that vanish, files, captured messages, running the command, reading a CSV.
#ifndef JN_TEST_SUPPORT_SUPPORT_H
#define JN_TEST_SUPPORT_SUPPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/// Make a folder under /tmp (or $TMPDIR) and keep its path in `path`. Returns 0, or -1.
int folder_create(char path[256]);
/// Remove a folder and all that is in it.
void folder_remove(const char* path);
/// "folder/name", in static storage that holds until the eighth call after this one.
const char* path_join(const char* folder, const char* name);
bool path_exists(const char* path);
/// Write or read a whole text file; the test fails when that is not possible. The caller frees what file_read returns.
void file_write(const char* path, const char* text);
char* file_read(const char* path);

/// All errors and warnings of the library since log_capture, one a line.
void log_capture(void);
const char* log_text(void);
void log_release(void);
/// log_capture and log_release for cmocka's groups.
int log_set_up(void** state);
int log_tear_down(void** state);
/// The test fails when `part` is not in what was captured.
void log_expect(const char* part);

/// What a process left behind. Free with outcome_free.
typedef struct Outcome {
	int status; ///< exit status; 128 + the signal that ended it
	char *out, *err;
} Outcome;

typedef struct Process {
	pid_t id;
	int out, err; ///< files that receive its words
} Process;

/// Start the command `jounce` in `folder` with arguments that end with NULL.
Process command_start(const char* folder, const char* const arguments[]);
/// The same with its stdout into the file `out`, which may be write-only; it is closed by command_wait.
Process command_start_into(int out, const char* folder, const char* const arguments[]);
/// Wait until it ends, and collect its words.
Outcome command_wait(Process process);
/// Start and wait.
Outcome command_run(const char* folder, const char* const arguments[]);
void outcome_free(Outcome* outcome);

/// Make a folder with the scene block.yaml and its recording, block. Returns 0, or what failed.
int folder_create_with_run(char folder[256], const char* scene_text);

/// A CSV file: a header and rows. Free with table_free.
typedef struct Table {
	int rows, columns;
	char*** cells; ///< [row][column]; row 0 is the header
	char* text;
} Table;

Table table_read(const char* path);
/// Column by name; the test fails when there is none.
int table_column(const Table* table, const char* name);
/// The number in row `row` (from 1) of a column.
double table_number(const Table* table, int row, const char* column);
void table_free(Table* table);

#endif
