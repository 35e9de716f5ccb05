/// @file vtk_numbers.h
/// Numbers as VTK's files hold them, text or bytes of a stated type, as doubles or 64-bit integers.
#ifndef JN_MESH_FORMAT_VTK_NUMBERS_H
#define JN_MESH_FORMAT_VTK_NUMBERS_H

#include "base/arena.h"

typedef struct JnVtkType {
	const char* name;        ///< in XML: "Float64"
	const char* legacy_name; ///< in legacy files: "double"; NULL: none
	int size;                ///< [bytes]
	enum { JN_VTK_FLOAT, JN_VTK_SIGNED, JN_VTK_UNSIGNED } kind;
} JnVtkType;

extern const JnVtkType jn_vtk_types[]; ///< name is NULL at the end

/// Numbers of an array: one of the two, the other is NULL.
typedef struct JnVtkNumbers {
	size_t count;
	double* real;
	int64_t* whole;
} JnVtkNumbers;

typedef enum JnVtkAs { JN_VTK_REAL, JN_VTK_WHOLE } JnVtkAs; ///< what is wanted

/// `size` bytes of numbers of a type. JN_BAD_INPUT without a message when the
/// bytes are no multiple of the type's size, or floats are wanted as whole numbers and are not.
JnStatus jn_vtk_from_bytes(const unsigned char* bytes, size_t size, const JnVtkType* type, bool is_big_endian,
						   JnVtkAs as, JnArena* arena, JnVtkNumbers* out);

/// Up to `most` numbers of a text, which ends before `end`; *text moves behind them. JN_BAD_INPUT without a message when
/// something is no number.
JnStatus jn_vtk_from_text(const char** text, const char* end, size_t most, JnVtkAs as, JnArena* arena,
						  JnVtkNumbers* out);

#endif
