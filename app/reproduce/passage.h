/// @file passage.h
/// Did bodies pass through thin sheets? Counted from the frames of a recording.
#ifndef JN_APP_REPRODUCE_PASSAGE_H
#define JN_APP_REPRODUCE_PASSAGE_H

#include "reproduce/frames.h"

/// How often the middle of a body changed from one side of a sheet to the other between two frames. The first
/// `sheet_count` bodies are the sheets, the others fall. The side is that of the sheet's point nearest to the middle;
/// next to the rim there is none, so that who goes around it does not count. JN_OUT_OF_MEMORY, JN_IO_FAILED.
JnStatus passages_count(const Frames* frames, int sheet_count, int* passages);

#endif
