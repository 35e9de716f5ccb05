/// @file recording_reader.h
/// The child process that reads a recording with HDF5, which crashes on some damaged files, and what it is asked. A request goes to
/// it, a reply with its payload comes back.
/// Nothing of this leaves the machine, so both are structs as the compiler lays them out.
#ifndef JN_APP_RECORDING_READER_H
#define JN_APP_RECORDING_READER_H

#include "base/guard.h"
#include "recording_file.h"

typedef enum ReaderVerb {
	READER_OPENED,    ///< is the file open?
	READER_HAS,       ///< is there such an object?
	READER_SIZE,      ///< of a dataset, into `size`
	READER_LINKS,     ///< in a group, into `number.whole`
	READER_ATTRIBUTE, ///< one number, into `number`
	READER_TEXT,      ///< of an attribute, or of a dataset without `attribute`: the payload, without an end
	READER_NAMES,     ///< of the links in a group, in the order of the alphabet: the payload, each with its end
	READER_TIMES,     ///< of `count` frames from `first` on [s]: the payload
	READER_ARRAY,     ///< `count` numbers of a dataset: the payload
	READER_VERBS,
} ReaderVerb;

typedef struct ReaderRequest {
	ReaderVerb verb;
	RecordingNumber kind;
	int64_t first, count;
	char object[512], attribute[64];
} ReaderRequest;

typedef struct ReaderReply {
	bool is_good;
	RecordingSize size;
	union {
		double real;
		int integer;
		long whole;
	} number;
	size_t payload; ///< bytes that follow
} ReaderReply;

/// Bytes of a number.
size_t reader_number_size(RecordingNumber kind);

/// The work of the child; `path` is a const char*.
void reader_serve(const JnGuardChild* own, void* path);

/// Exactly `size` bytes through a socket; false when it has ended before.
bool reader_send(int socket, const void* data, size_t size);
bool reader_receive(int socket, void* data, size_t size);

#endif
