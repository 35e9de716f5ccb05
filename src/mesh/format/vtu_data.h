/// @file vtu_data.h
/// The arrays of VTK's XML files: text, base64 or raw bytes, beside their element or in one block at the end, plain or
/// compressed by zlib.
#ifndef JN_MESH_FORMAT_VTU_DATA_H
#define JN_MESH_FORMAT_VTU_DATA_H

#include <libxml/tree.h>

#include "mesh/format/vtk_numbers.h"

/// What holds for all arrays of a file.
typedef struct JnVtuFile {
	const char* path;
	bool is_big_endian, is_compressed;
	int header_size;                              ///< 4 or 8 bytes a number of a header
	const unsigned char *appended, *appended_end; ///< the block at the end, behind its underscore; NULL: none
	bool appended_is_raw;                         ///< else base64
} JnVtuFile;

/// Decode a DataArray; *numbers lives in `arena`. JN_BAD_INPUT, after a message that begins with the file's path, when it
/// is not what it says.
JnStatus jn_vtu_numbers(const JnVtuFile* file, xmlNode* array, JnVtkAs as, JnArena* arena, JnVtkNumbers* numbers);

#endif
