#define _GNU_SOURCE // nftw, posix_spawn_file_actions_addchdir_np, environ
#include "support/support.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <setjmp.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "jounce/base.h"

int folder_create(char path[256]) {
	const char* base = getenv("TMPDIR");
	snprintf(path, 256, "%s/jounce_test_XXXXXX", base != NULL && *base != '\0' ? base : "/tmp");
	return mkdtemp(path) != NULL ? 0 : -1;
}

static int remove_entry(const char* path, const struct stat* about, int kind, struct FTW* walk) {
	(void)about, (void)kind, (void)walk;
	return remove(path);
}

void folder_remove(const char* path) {
	nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

const char* path_join(const char* folder, const char* name) {
	static char paths[8][1024];
	static int next;
	char* path = paths[next++ % 8];
	snprintf(path, sizeof paths[0], "%s/%s", folder, name);
	return path;
}

bool path_exists(const char* path) {
	return access(path, F_OK) == 0;
}

void file_write(const char* path, const char* text) {
	FILE* file = fopen(path, "w");
	assert_non_null(file);
	assert_true(fputs(text, file) >= 0);
	assert_int_equal(fclose(file), 0);
}

static char* read_stream(FILE* file) {
	char* text = NULL;
	size_t size = 0;
	if (getdelim(&text, &size, '\0', file) >= 0) return text;
	free(text);
	return strdup("");
}

char* file_read(const char* path) {
	FILE* file = fopen(path, "r");
	if (file == NULL) fail_msg("%s: %s", path, strerror(errno));
	char* text = read_stream(file);
	fclose(file);
	assert_non_null(text);
	return text;
}

static char captured[1 << 16];

static void keep_message(void* user, JnLogLevel level, const char* message) {
	(void)user;
	const size_t length = strlen(captured);
	if (level != JN_LOG_INFO) snprintf(captured + length, sizeof captured - length, "%s\n", message);
}

void log_capture(void) {
	captured[0] = '\0';
	jn_log_set_sink(keep_message, NULL);
}

const char* log_text(void) {
	return captured;
}

void log_release(void) {
	jn_log_set_sink(NULL, NULL);
}

int log_set_up(void** state) {
	(void)state;
	log_capture();
	return 0;
}

int log_tear_down(void** state) {
	(void)state;
	log_release();
	return 0;
}

void log_expect(const char* part) {
	if (strstr(log_text(), part) == NULL) fail_msg("'%s' is not in: %s", part, log_text());
}

static int open_nameless(void) {
	char path[] = "/tmp/jounce_words_XXXXXX";
	const int file = mkostemp(path, O_CLOEXEC);
	assert_true(file >= 0);
	unlink(path);
	return file;
}

Process command_start(const char* folder, const char* const arguments[]) {
	return command_start_into(open_nameless(), folder, arguments);
}

Process command_start_into(int out, const char* folder, const char* const arguments[]) {
	char* list[32] = {(char*)"jounce"};
	for (int i = 0; arguments[i] != NULL && i < 30; ++i) list[i + 1] = (char*)arguments[i];
	Process process = {.out = out, .err = open_nameless()};
	posix_spawn_file_actions_t actions;
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_addchdir_np(&actions, folder);
	posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
	posix_spawn_file_actions_adddup2(&actions, process.out, STDOUT_FILENO);
	posix_spawn_file_actions_adddup2(&actions, process.err, STDERR_FILENO);
	const int reason = posix_spawn(&process.id, JN_COMMAND, &actions, NULL, list, environ);
	posix_spawn_file_actions_destroy(&actions);
	assert_int_equal(reason, 0);
	return process;
}

static char* read_words(int file) {
	lseek(file, 0, SEEK_SET);
	const bool is_readable = (fcntl(file, F_GETFL) & O_ACCMODE) != O_WRONLY;
	FILE* stream = is_readable ? fdopen(file, "r") : fopen("/dev/null", "r");
	if (!is_readable) close(file);
	assert_non_null(stream);
	char* text = read_stream(stream);
	fclose(stream);
	assert_non_null(text);
	return text;
}

Outcome command_wait(Process process) {
	int status = 0;
	while (waitpid(process.id, &status, 0) < 0) assert_int_equal(errno, EINTR);
	return (Outcome){.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
					 .out = read_words(process.out),
					 .err = read_words(process.err)};
}

Outcome command_run(const char* folder, const char* const arguments[]) {
	return command_wait(command_start(folder, arguments));
}

void outcome_free(Outcome* outcome) {
	free(outcome->out);
	free(outcome->err);
	*outcome = (Outcome){0};
}

static int count_of(const char* text, char c) {
	int count = 0;
	for (; *text != '\0'; ++text) count += *text == c;
	return count;
}

static char** split_line(char* line, int columns) {
	char** cells = calloc((size_t)columns + 1, sizeof *cells);
	assert_non_null(cells);
	for (int i = 0; i < columns; ++i) cells[i] = strsep(&line, ",");
	return cells;
}

Table table_read(const char* path) {
	Table table = {.text = file_read(path)};
	char* rest = table.text;
	table.cells = calloc((size_t)count_of(rest, '\n') + 1, sizeof *table.cells);
	assert_non_null(table.cells);
	for (char* line; (line = strsep(&rest, "\n")) != NULL;) {
		if (*line == '\0') continue;
		const int columns = count_of(line, ',') + 1;
		if (table.rows == 0) table.columns = columns;
		assert_int_equal(columns, table.columns);
		table.cells[table.rows++] = split_line(line, columns);
	}
	return table;
}

int table_column(const Table* table, const char* name) {
	for (int i = 0; i < table->columns; ++i)
		if (strcmp(table->cells[0][i], name) == 0) return i;
	fail_msg("there is no column '%s'", name);
	return -1;
}

double table_number(const Table* table, int row, const char* column) {
	assert_in_range(row, 1, table->rows - 1);
	return strtod(table->cells[row][table_column(table, column)], NULL);
}

void table_free(Table* table) {
	for (int i = 0; i < table->rows; ++i) free(table->cells[i]);
	free(table->cells);
	free(table->text);
	*table = (Table){0};
}

int folder_create_with_run(char folder[256], const char* scene_text) {
	if (folder_create(folder) != 0) return -1;
	file_write(path_join(folder, "block.yaml"), scene_text);
	Outcome outcome = command_run(folder, (const char* const[]){"run", "block.yaml", "-o", "block", "--quiet", NULL});
	const int status = outcome.status;
	outcome_free(&outcome);
	return status;
}
