/// @file archive.h
/// Memory that outlives its owner: named pieces one behind the other, written and read by the same calls, so that what is
/// saved cannot differ from what is restored.
///
///   piece   name (hash, 8 bytes)   size (8 bytes)   bytes
///
/// The first piece that does not fit, or memory that is out, ends an archive: what follows leaves everything as it is, and
/// `status` says why. A message has then been given.
#ifndef JOUNCE_ARCHIVE_H
#define JOUNCE_ARCHIVE_H

#include "jounce/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct JnArchive {
	bool is_reading;
	JnStatus status;
	unsigned char* bytes; ///< written: its own, freed by jn_archive_free; read: borrowed, and not changed
	size_t size, capacity;
	size_t at; ///< where reading goes on
} JnArchive;

/// An archive to read from; `bytes` must outlive it. One that is all zero is empty, and to be written.
JnArchive jn_archive_reader(const void* bytes, size_t size);
void jn_archive_free(JnArchive* archive);

/// `size` bytes at `data`: appended, or overwritten with what stands in the archive under that name and with that size.
void jn_archive_bytes(JnArchive* archive, const char* name, void* data, size_t size);

void jn_archive_real(JnArchive* archive, const char* name, double* value);
void jn_archive_integer(JnArchive* archive, const char* name, int* value);
void jn_archive_long(JnArchive* archive, const char* name, long* value);
void jn_archive_switch(JnArchive* archive, const char* name, bool* value);
void jn_archive_reals(JnArchive* archive, const char* name, double* values, size_t count);

/// How many of something follow, at least `least` bytes each: `count`, or what the archive says, which is never more than it
/// has bytes for. 0 after a failure.
int jn_archive_count(JnArchive* archive, const char* name, int count, size_t least);

/// `count` integers from `low` to below `high`. Others in an archive are refused.
void jn_archive_indices(JnArchive* archive, const char* name, int* values, size_t count, int low, int high);

/// A text, as it is, or (reading) where it stands within the archive; NULL after a failure.
const char* jn_archive_text(JnArchive* archive, const char* name, const char* text);

/// Refuse the archive, with a message that says of what is wrong.
void jn_archive_refuse(JnArchive* archive, const char* name, const char* why);

/// JN_BAD_INPUT after a message when something is left to read.
JnStatus jn_archive_end(JnArchive* archive);

#ifdef __cplusplus
}
#endif
#endif
