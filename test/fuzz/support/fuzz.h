/// @file fuzz.h
/// What fuzz targets share. A target is one file test/fuzz/<target>.c that defines LLVMFuzzerTestOneInput; it is linked with
/// libFuzzer (./dev fuzz), or with replay.c, which runs the files of test/fuzz/corpus/<target>/ (ctest -R fuzz).
///
/// What counts as a finding, beside what the sanitizers and asserts say: a failure without a message, a status that no reader
/// may return, and time or memory out of proportion.
#ifndef JN_TEST_FUZZ_SUPPORT_FUZZ_H
#define JN_TEST_FUZZ_SUPPORT_FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "jounce/base.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

/// A file in memory with these bytes. Its path holds until the next call, which replaces the bytes.
const char* fuzz_file(const uint8_t* data, size_t size);

/// A folder in which a file of this name holds these bytes, until the next call. One name a target.
const char* fuzz_folder(const char* name, const uint8_t* data, size_t size);

/// The bytes as text with a zero behind it; the caller frees it.
char* fuzz_text(const uint8_t* data, size_t size);

/// Between these two, messages are counted, and printed only when the variable FUZZ_TALK is set. fuzz_judge ends the process when `status` is a failure about
/// which nothing was said, or is no failure of a reader at all.
void fuzz_listen(void);
void fuzz_judge(JnStatus status);

/// All memory that the target may take for one input [bytes], from now on; what exceeds it is refused, as if memory were out.
/// 0: no limit. Only what jounce itself takes counts, not what libraries do.
void fuzz_limit_memory(size_t bytes);

/// Bytes of an input, one value after the other; zeros behind its end.
typedef struct FuzzBytes {
	const uint8_t* at;
	size_t left;
} FuzzBytes;

uint8_t fuzz_byte(FuzzBytes* bytes);
uint64_t fuzz_number(FuzzBytes* bytes, int size);

/// The next word, up to and without a zero or newline, cut to `size`.
void fuzz_word(FuzzBytes* bytes, size_t size, char* word);

#endif
