/// @file view_pack.h
/// What the page reads: a pack is "JNPK", the length of a JSON text (32 bits, little-endian), the text, filled with blanks
/// to a multiple of 8 bytes from the start, and arrays, each on a multiple of 8 bytes from the end of the text. The text's
/// last entry, "arrays", says where they are: {"name": {"type": "f32" | "f64" | "i32", "at": byte, "length": numbers}}.
#ifndef JN_APP_VIEW_PACK_H
#define JN_APP_VIEW_PACK_H

#include "view_run.h"

typedef struct ViewBytes {
	char* data; ///< malloc'ed
	size_t size;
} ViewBytes;

/// All that stays constant over a run, and the times of its frames.
JnStatus view_pack_run(const ViewRun* run, ViewBytes* out);

/// The columns of the series.
JnStatus view_pack_series(ViewRun* run, ViewBytes* out);

/// JSON without arrays: frames so far, their times from the number `known` on, outcome.
JnStatus view_pack_state(const ViewRun* run, long known, ViewBytes* out);

#endif
