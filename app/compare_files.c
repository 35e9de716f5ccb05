// Folders, and text files read whole.
#include "compare_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/log.h"

JnStatus compare_folder_make(const char* path) {
	char part[JN_PATH_SIZE];
	const size_t length = strlen(path);
	if (length == 0 || length >= sizeof part)
		return jn_error(JN_IO_FAILED, "'%s' is no usable folder name; choose another output with -o", path);
	for (size_t i = 1; i <= length; ++i) {
		if (path[i] != '/' && path[i] != '\0') continue;
		memcpy(part, path, i);
		part[i] = '\0';
		if (mkdir(part, 0777) != 0 && errno != EEXIST)
			return jn_error(JN_IO_FAILED, "%s: cannot make this folder: %s", part, strerror(errno));
	}
	struct stat about;
	if (stat(path, &about) == 0 && S_ISDIR(about.st_mode)) return JN_OK;
	return jn_error(JN_IO_FAILED, "%s: is no folder; choose another output with -o", path);
}

static char* read_stream(FILE* stream) {
	size_t room = 1 << 14, length = 0;
	char* text = malloc(room);
	while (text != NULL) {
		length += fread(text + length, 1, room - 1 - length, stream);
		if (length < room - 1) break;
		char* larger = realloc(text, room *= 2);
		if (larger == NULL) free(text);
		text = larger;
	}
	if (text != NULL) text[length] = '\0';
	if (text == NULL || !ferror(stream)) return text;
	free(text);
	return NULL;
}

char* compare_file_read(const char* path) {
	FILE* stream = fopen(path, "r");
	if (stream == NULL) return NULL;
	char* text = read_stream(stream);
	const int reason = errno;
	fclose(stream);
	errno = reason;
	return text;
}

JnStatus compare_run_folder(const char* directory, const char* name, char path[JN_PATH_SIZE]) {
	char runs[JN_PATH_SIZE];
	JN_TRY(jn_path_join(directory, "runs", runs));
	return jn_path_join(runs, name, path);
}
