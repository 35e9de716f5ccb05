// Archives: pieces with the hash of their name and their size.
#include "jounce/archive.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/log.h"

enum { HEAD_BYTES = 16 };

JnArchive jn_archive_reader(const void* bytes, size_t size) {
	return (JnArchive){.is_reading = true, .bytes = (unsigned char*)bytes, .size = size};
}

void jn_archive_free(JnArchive* archive) {
	if (!archive->is_reading) free(archive->bytes);
	*archive = (JnArchive){0};
}

void jn_archive_refuse(JnArchive* archive, const char* name, const char* why) {
	if (archive->status != JN_OK) return;
	archive->status = jn_error(JN_BAD_INPUT, "the saved state does not fit: '%s' %s", name, why);
}

static bool grow(JnArchive* archive, size_t more) {
	if (archive->size + more <= archive->capacity) return true;
	size_t capacity = archive->capacity > 0 ? archive->capacity : 4096;
	while (capacity < archive->size + more) capacity *= 2;
	unsigned char* bytes = realloc(archive->bytes, capacity);
	if (bytes == NULL) {
		archive->status = jn_error(JN_OUT_OF_MEMORY, "out of memory: no room to save a state of %zu bytes", capacity);
		return false;
	}
	archive->bytes = bytes;
	archive->capacity = capacity;
	return true;
}

static uint64_t name_of(const char* name) {
	return (uint64_t)jn_hash_add(jn_hash_start(), name, strlen(name));
}

static void append(JnArchive* archive, const char* name, const void* data, size_t size) {
	const uint64_t head[2] = {name_of(name), size};
	if (!grow(archive, HEAD_BYTES + size)) return;
	memcpy(archive->bytes + archive->size, head, HEAD_BYTES);
	if (size > 0) memcpy(archive->bytes + archive->size + HEAD_BYTES, data, size);
	archive->size += HEAD_BYTES + size;
}

// The bytes of the next piece, which must have that name; NULL after a refusal.
static const unsigned char* take(JnArchive* archive, const char* name, size_t* size) {
	uint64_t head[2] = {0};
	const size_t left = archive->size - archive->at;
	if (left >= HEAD_BYTES) memcpy(head, archive->bytes + archive->at, HEAD_BYTES);
	if (left < HEAD_BYTES || head[0] != name_of(name) || head[1] > left - HEAD_BYTES) {
		jn_archive_refuse(archive, name, "is not what stands in its place; it is of another scene or version");
		return NULL;
	}
	*size = (size_t)head[1];
	archive->at += HEAD_BYTES + *size;
	return archive->bytes + archive->at - *size;
}

void jn_archive_bytes(JnArchive* archive, const char* name, void* data, size_t size) {
	if (archive->status != JN_OK) return;
	if (!archive->is_reading) {
		append(archive, name, data, size);
		return;
	}
	size_t found = 0;
	const unsigned char* bytes = take(archive, name, &found);
	if (bytes == NULL) return;
	if (found != size)
		jn_archive_refuse(archive, name, "is of another size; it is of another scene or version");
	else if (size > 0)
		memcpy(data, bytes, size);
}

void jn_archive_real(JnArchive* archive, const char* name, double* value) {
	jn_archive_bytes(archive, name, value, sizeof *value);
}

void jn_archive_integer(JnArchive* archive, const char* name, int* value) {
	jn_archive_bytes(archive, name, value, sizeof *value);
}

void jn_archive_long(JnArchive* archive, const char* name, long* value) {
	jn_archive_bytes(archive, name, value, sizeof *value);
}

void jn_archive_switch(JnArchive* archive, const char* name, bool* value) {
	unsigned char byte = *value;
	jn_archive_bytes(archive, name, &byte, 1);
	*value = byte != 0;
}

void jn_archive_reals(JnArchive* archive, const char* name, double* values, size_t count) {
	jn_archive_bytes(archive, name, values, count * sizeof *values);
}

int jn_archive_count(JnArchive* archive, const char* name, int count, size_t least) {
	jn_archive_integer(archive, name, &count);
	if (archive->status != JN_OK) return 0;
	if (archive->is_reading && (count < 0 || (size_t)count * least > archive->size - archive->at)) {
		jn_archive_refuse(archive, name, "is more than the archive holds");
		return 0;
	}
	return count;
}

void jn_archive_indices(JnArchive* archive, const char* name, int* values, size_t count, int low, int high) {
	size_t found = 0;
	if (archive->status != JN_OK) return;
	if (!archive->is_reading) {
		append(archive, name, values, count * sizeof *values);
		return;
	}
	const unsigned char* bytes = take(archive, name, &found);
	if (bytes == NULL) return;
	for (size_t i = 0; i < count && found == count * sizeof *values; ++i) {
		int value;
		memcpy(&value, bytes + i * sizeof value, sizeof value);
		if (value < low || value >= high) found = 0;
	}
	if (found != count * sizeof *values)
		jn_archive_refuse(archive, name, "has numbers that the scene does not have");
	else if (count > 0)
		memcpy(values, bytes, found);
}

const char* jn_archive_text(JnArchive* archive, const char* name, const char* text) {
	size_t size = 0;
	if (archive->status != JN_OK) return NULL;
	if (!archive->is_reading) {
		append(archive, name, text, strlen(text) + 1);
		return text;
	}
	const unsigned char* bytes = take(archive, name, &size);
	if (bytes == NULL) return NULL;
	if (size > 0 && memchr(bytes, '\0', size) == bytes + size - 1) return (const char*)bytes;
	jn_archive_refuse(archive, name, "is no text");
	return NULL;
}

JnStatus jn_archive_end(JnArchive* archive) {
	if (archive->status == JN_OK && archive->is_reading && archive->at != archive->size)
		jn_archive_refuse(archive, "end", "is followed by more; it is of another scene or version");
	return archive->status;
}
