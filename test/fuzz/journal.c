// The journal beside a recording that a killed run has left: its pages go into the recording when its check sum is right, so
// the input is the journal's numbers and pages, and the sum is made for it, unless the first byte is 0. HDF5 has no part in it.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "record/h5_driver.h"
#include "support/fuzz.h"

enum { PAGE = 4096, RECORDING_PAGES = 3 };

static char recording[96], journal[112];

static void write_file(const char* path, const void* data, size_t size) {
	FILE* file = fopen(path, "wb");
	if (file == NULL || fwrite(data, 1, size, file) != size || fclose(file) != 0) abort();
}

/// Head, then numbers of pages, then the pages: as many as the input has bytes for.
static void write_whole(const uint8_t* data, size_t size) {
	struct {
		char magic[8];
		uint64_t count, sum;
	} head = {.magic = "jounceJ1", .count = size / (PAGE + sizeof(uint64_t))};
	const size_t used = (size_t)head.count * (PAGE + sizeof(uint64_t));
	head.sum = crc32_z(0, data, used);
	unsigned char* bytes = malloc(sizeof head + used);
	if (bytes == NULL) abort();
	memcpy(bytes, &head, sizeof head);
	memcpy(bytes + sizeof head, data, used);
	write_file(journal, bytes, sizeof head + used);
	free(bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	static const char zeros[RECORDING_PAGES * PAGE];
	struct stat facts;
	if (size == 0) return 0;
	snprintf(recording, sizeof recording, "%s/run.h5", fuzz_folder("run.h5", (const uint8_t*)zeros, sizeof zeros));
	snprintf(journal, sizeof journal, "%s.journal", recording);
	if (data[0] == 0)
		write_file(journal, data + 1, size - 1);
	else
		write_whole(data + 1, size - 1);
	fuzz_listen();
	fuzz_judge(jn_h5_recover(recording));
	unlink(journal);
	if (stat(recording, &facts) != 0 || facts.st_size != sizeof zeros) abort(); // pages lie within the recording
	return 0;
}
