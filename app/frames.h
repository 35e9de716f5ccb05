/// @file frames.h
/// A choice of frames, as options say it.
#ifndef JN_APP_FRAMES_H
#define JN_APP_FRAMES_H

/// Frames first, first + step, ... `count` of them.
typedef struct FrameRange {
	int first, step, count;
} FrameRange;

/// Read "A:B:STEP" as Python does: from A up to B without B, each may be left out, negative ones count from the end; "A"
/// alone is one frame. NULL: all. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message when it is no such text or chooses
/// none of the `frame_count` frames.
int app_read_frames(const char* command, const char* text, int frame_count, FrameRange* range);

#endif
