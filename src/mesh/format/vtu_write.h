/// @file vtu_write.h
/// VTK XML 1.0, UnstructuredGrid: arrays inside the text, in base64 of zlib-compressed blocks (vtu_data.c tells the order),
/// little-endian, so that doubles come back bit by bit.
#ifndef JN_MESH_FORMAT_VTU_WRITE_H
#define JN_MESH_FORMAT_VTU_WRITE_H

#include <stdio.h>

#include "base/arena.h"
#include "jounce/base.h"

enum { JN_VTU_BUFFERS = 3 };

/// Begins as a stream and an arena; may go on with another stream. Failures to write stay in the stream.
typedef struct JnVtuWriter {
	FILE* stream;
	JnArena* arena;                         ///< for the buffers, which are kept and grow with the largest array
	unsigned char* buffers[JN_VTU_BUFFERS]; ///< numbers as bytes, header, compressed blocks
	size_t sizes[JN_VTU_BUFFERS];           ///< of the buffers
} JnVtuWriter;

typedef struct JnVtuArray {
	const char *type, *name; ///< "Float64", "velocity"
	int components, size;    ///< numbers of a point or cell; bytes of a number
	size_t count;            ///< numbers
} JnVtuArray;

/// What comes before and behind the one piece, whose sections are the caller's.
void jn_vtu_begin(JnVtuWriter* writer, int point_count, long cell_count);
void jn_vtu_end(JnVtuWriter* writer);

/// `value` gives the bits of number i. JN_OUT_OF_MEMORY.
JnStatus jn_vtu_array(JnVtuWriter* writer, const JnVtuArray* array, uint64_t (*value)(const void* data, size_t i),
					  const void* data);

/// Doubles, integers of four bytes, and bytes.
JnStatus jn_vtu_reals(JnVtuWriter* writer, const char* name, int components, size_t count, const double* reals);
JnStatus jn_vtu_integers(JnVtuWriter* writer, const char* name, size_t count, const int* integers);
JnStatus jn_vtu_bytes(JnVtuWriter* writer, const char* name, size_t count, const unsigned char* bytes);

#endif
