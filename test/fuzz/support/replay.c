// Runs a fuzz target on files, without libFuzzer: <program> FILE|FOLDER...
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "fuzz.h"

static int count;

static int run_file(const char* path, size_t size) {
	FILE* file = fopen(path, "rb");
	uint8_t* data = malloc(size + 1);
	const int is_read = file != NULL && data != NULL && fread(data, 1, size, file) == size;
	if (file != NULL) fclose(file);
	if (is_read) {
		printf("%s\n", path); // the last one, when the target crashes
		fflush(stdout);
		LLVMFuzzerTestOneInput(data, size);
		++count;
	}
	free(data);
	return is_read ? 0 : 1;
}

static int run(const char* path) {
	struct stat facts;
	if (stat(path, &facts) != 0) return perror(path), 1;
	if (!S_ISDIR(facts.st_mode)) return run_file(path, (size_t)facts.st_size);
	struct dirent** entries = NULL;
	const int entry_count = scandir(path, &entries, NULL, alphasort);
	int status = entry_count < 0;
	for (int i = 0; i < entry_count; ++i) {
		char name[4096];
		snprintf(name, sizeof name, "%s/%s", path, entries[i]->d_name);
		if (entries[i]->d_name[0] != '.') status |= run(name);
		free(entries[i]);
	}
	free(entries);
	return status;
}

int main(int argument_count, char** arguments) {
	int status = argument_count < 2;
	for (int i = 1; i < argument_count; ++i) status |= run(arguments[i]);
	printf("%d inputs\n", count);
	return status != 0 || count == 0;
}
