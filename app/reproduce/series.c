// Our own files only: commas, no quotes, a header.
#include "reproduce/series.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "compare_files.h"

static JnStatus read_header(Series* series, char* line) {
	series->columns = 1;
	for (const char* at = line; *at != '\0'; ++at) series->columns += *at == ',';
	JN_NEW(&series->arena, series->names, series->columns);
	for (int i = 0; i < series->columns; ++i) {
		const size_t length = strcspn(line, ",");
		line[length] = '\0';
		series->names[i] = jn_arena_text(&series->arena, line);
		if (series->names[i] == NULL) return JN_OUT_OF_MEMORY;
		line += length + 1;
	}
	return JN_OK;
}

static JnStatus read_text(Series* series, char* text) {
	int lines = 0;
	for (const char* at = text; *at != '\0'; ++at) lines += *at == '\n';
	char* body = strchr(text, '\n');
	if (body == NULL) return JN_IO_FAILED;
	*body++ = '\0';
	JN_TRY(read_header(series, text));
	JN_NEW(&series->arena, series->values, (size_t)(lines > 0 ? lines : 1) * (size_t)series->columns);
	for (series->rows = 0; series->rows < lines - 1; ++series->rows)
		for (int i = 0; i < series->columns; ++i) {
			char* end = NULL;
			series->values[(size_t)series->rows * (size_t)series->columns + (size_t)i] = strtod(body, &end);
			if (*end != (i + 1 < series->columns ? ',' : '\n')) return JN_IO_FAILED;
			body = end + 1;
		}
	return JN_OK;
}

JnStatus series_read(const char* folder, const char* name, Series* series) {
	char path[JN_PATH_SIZE];
	*series = (Series){0};
	JN_TRY(jn_path_join(folder, name, path));
	char* text = compare_file_read(path);
	if (text == NULL) return jn_error(JN_IO_FAILED, "%s: cannot be read: %s", path, strerror(errno));
	const JnStatus status = read_text(series, text);
	free(text);
	if (status != JN_IO_FAILED) return status;
	return jn_error(status, "%s: is no table of numbers", path);
}

void series_free(Series* series) {
	jn_arena_free(&series->arena);
}

JnStatus series_column(const Series* series, const char* name, int* column) {
	for (*column = 0; *column < series->columns; ++*column)
		if (strcmp(series->names[*column], name) == 0) return JN_OK;
	return jn_error(JN_IO_FAILED, "a recording has no column '%s'", name);
}
