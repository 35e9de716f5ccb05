// Files that are read as a whole.
#define _GNU_SOURCE // memmem
#include "mesh/format/content.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/log.h"

static JnStatus read_stream(FILE* stream, const char* path, JnArena* arena, JnContent* content) {
	struct stat info;
	if (fstat(fileno(stream), &info) != 0 || !S_ISREG(info.st_mode))
		return jn_error(JN_IO_FAILED, "%s: is not a file", path);
	if (info.st_size == 0) return jn_error(JN_BAD_INPUT, "%s: the file is empty", path);
	if (info.st_size >= INT_MAX) return jn_error(JN_BAD_INPUT, "%s: is larger than 2 GiB", path);
	char* data;
	JN_NEW(arena, data, (size_t)info.st_size + 1);
	const size_t size = fread(data, 1, (size_t)info.st_size, stream);
	if (size != (size_t)info.st_size) return jn_error(JN_IO_FAILED, "%s: cannot be read to its end", path);
	*content = (JnContent){size, data};
	return JN_OK;
}

JnStatus jn_content_read(const char* path, JnArena* arena, JnContent* content) {
	*content = (JnContent){0};
	FILE* stream = fopen(path, "rb");
	if (stream == NULL) return jn_error(JN_IO_FAILED, "%s: cannot open the file: %s", path, strerror(errno));
	const JnStatus status = read_stream(stream, path, arena, content);
	fclose(stream);
	return status;
}

const char* jn_content_find(const char* from, const char* end, const char* text) {
	return memmem(from, (size_t)(end - from), text, strlen(text));
}
