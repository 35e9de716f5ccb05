/// @file refused_calls.h
/// Calls of the C library and of HDF5 that write and read files, counted and refused on demand. Works in programs that are
/// linked with JN_REFUSED_CALLS_WRAP (cmake/jounceTests.cmake): the linker then hands the calls of objects that are linked
/// statically, which are ours, to this; those from inside shared libraries stay as they are.
#ifndef JN_TEST_SUPPORT_REFUSED_CALLS_H
#define JN_TEST_SUPPORT_REFUSED_CALLS_H

typedef enum CallKind {
	CALL_SYSTEM = 1, ///< errno is then EIO
	CALL_HDF5 = 2,
	CALL_BYTES = 4, ///< pread, pwrite, vfprintf: of those of a name that follow each other only the first counts
} CallKind;

/// Count calls of these kinds from now on, combined by |, and refuse the one of that number, from 1, and no other; 0: none.
/// Kinds 0: count nothing.
void refused_call_set(int kinds, long number);

/// Calls since then.
long refused_call_count(void);

/// The name of the one that was refused; NULL: none was.
const char* refused_call_name(void);

#endif
