// Text files read whole, and where runs lie.
#include "compare_files.h"

#include <errno.h>
#include <stdlib.h>

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
