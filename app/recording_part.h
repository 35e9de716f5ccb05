/// @file recording_part.h
/// The parts of opening a recording, one a file. Each returns JN_BAD_INPUT after a message.
#ifndef JN_APP_RECORDING_PART_H
#define JN_APP_RECORDING_PART_H

#include "recording.h"

JnStatus recording_read_facts(Recording* recording);     ///< who, where, how it ended; the scene
JnStatus recording_read_bodies(Recording* recording);    ///< nodes, bodies and their surfaces
JnStatus recording_read_obstacles(Recording* recording); ///< what never moves
JnStatus recording_read_frames(Recording* recording);    ///< times and fields of the frames, columns of the series
JnStatus recording_read_fields(Recording* recording);    ///< what the first frame has, of which there is one

/// Say that `object` is not in the file, or not as it should be, unless worse has been said.
JnStatus recording_damaged(const Recording* recording, const char* object);

/// An array of its own size, `columns` numbers a row. JN_BAD_INPUT after a message.
JnStatus recording_numbers(Recording* recording, const char* object, int columns, int** numbers, int* rows);
JnStatus recording_reals(Recording* recording, const char* object, int columns, double** reals, int* rows);

/// Are all of `count` numbers from `low` up to `end`, without `end`?
bool recording_are_within(const int* numbers, size_t count, long low, long end);

/// A text attribute in the arena, or a text dataset (`name` NULL); `otherwise` when there is none. NULL when memory is out.
const char* recording_attribute_text(Recording* recording, const char* object, const char* name, const char* otherwise);
/// An integer attribute. JN_BAD_INPUT after a message when there is none.
JnStatus recording_attribute_count(const Recording* recording, const char* object, const char* name, int* count);

/// Names of the links in a group, in alphabetical order, from the arena; a group that is not there has none.
JnStatus recording_names(Recording* recording, const char* group, const char* const** names, int* count);

/// Is there an object of this path, whose last group exists?
bool recording_has(const Recording* recording, const char* object);

#endif
