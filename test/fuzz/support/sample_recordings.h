/// @file sample_recordings.h
/// Recordings of three small runs, for targets that damage them: cells and threads; points and a rigid ball; an analytic system.
#ifndef JN_TEST_FUZZ_SUPPORT_SAMPLE_RECORDINGS_H
#define JN_TEST_FUZZ_SUPPORT_SAMPLE_RECORDINGS_H

#include <stddef.h>

enum { SAMPLE_COUNT = 3 };

/// The bytes of a run.h5.
typedef struct Sample {
	size_t size;
	void* image;
} Sample;

/// Made at the first call, kept until the process ends.
const Sample* sample_recordings(void);

#endif
