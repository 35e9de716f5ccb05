#define _GNU_SOURCE // memfd_create
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/log.h"
#include "support/allocator.h"

static int errors;

const char* fuzz_file(const uint8_t* data, size_t size) {
	static char path[64];
	static int file = -1;
	if (file < 0) file = memfd_create("input", MFD_CLOEXEC);
	snprintf(path, sizeof path, "/proc/self/fd/%d", file);
	if (file < 0 || ftruncate(file, 0) != 0 || pwrite(file, data, size, 0) != (ssize_t)size) abort();
	return path;
}

static char folder[64], entry[128];

static void remove_folder(void) {
	unlink(entry);
	rmdir(folder);
}

static void make_folder(const char* name) {
	snprintf(folder, sizeof folder, "%s/jounce_fuzz_XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
	if (mkdtemp(folder) == NULL) abort();
	snprintf(entry, sizeof entry, "%s/%s", folder, name);
	atexit(remove_folder);
}

const char* fuzz_folder(const char* name, const uint8_t* data, size_t size) {
	if (folder[0] == '\0') make_folder(name);
	FILE* file = fopen(entry, "wb"); // HDF5 resolves links, and files in memory have no path
	if (file == NULL || fwrite(data, 1, size, file) != size || fclose(file) != 0) abort();
	return folder;
}

char* fuzz_text(const uint8_t* data, size_t size) {
	char* text = malloc(size + 1);
	if (text == NULL) abort();
	if (size > 0) memcpy(text, data, size);
	text[size] = '\0';
	return text;
}

static void count_error(void* user, JnLogLevel level, const char* message) {
	(void)user;
	errors += level == JN_LOG_ERROR && message[0] != '\0';
	if (getenv("FUZZ_TALK") != NULL) fprintf(stderr, "%s\n", message);
}

void fuzz_listen(void) {
	errors = 0;
	jn_log_set_sink(count_error, NULL);
}

void fuzz_judge(JnStatus status) {
	jn_log_set_sink(NULL, NULL);
	if (status == JN_OK) return;
	if (status < 0 && errors > 0) return;
	fprintf(stderr, "fuzz: the status '%s' with %d messages\n", jn_status_name(status), errors);
	abort();
}

uint8_t fuzz_byte(FuzzBytes* bytes) {
	if (bytes->left == 0) return 0;
	--bytes->left;
	return *bytes->at++;
}

uint64_t fuzz_number(FuzzBytes* bytes, int size) {
	uint64_t number = 0;
	for (int i = 0; i < size; ++i) number |= (uint64_t)fuzz_byte(bytes) << (8 * i);
	return number;
}

void fuzz_word(FuzzBytes* bytes, size_t size, char* word) {
	size_t length = 0;
	for (uint8_t c; (c = fuzz_byte(bytes)) != '\0' && c != '\n';)
		if (length + 1 < size) word[length++] = (char)c;
	word[length] = '\0';
}

void fuzz_limit_memory(size_t bytes) {
	allocator_limit(bytes);
}
