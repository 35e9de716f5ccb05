/// @file export_gltf.h
/// The binary part of a glTF file and the JSON that describes it: buffer views and accessors.
#ifndef JN_APP_EXPORT_GLTF_H
#define JN_APP_EXPORT_GLTF_H

#include <jansson.h>

#include "export.h"

typedef struct Gltf {
	JnTextFile data; ///< a nameless file
	uint64_t size;   ///< bytes in it
	json_t *views, *accessors;
} Gltf;

/// Begin, with a nameless file beside `path`. JN_IO_FAILED, JN_OUT_OF_MEMORY. gltf_destroy is due in any case.
JnStatus gltf_create(const char* path, Gltf* gltf);
void gltf_destroy(Gltf* gltf);

/// Write `count` vectors in single precision; returns the number of their accessor. Where most are 0, only the others
/// are written.
json_t* gltf_vectors(Gltf* gltf, int count, const double* vectors);
json_t* gltf_indices(Gltf* gltf, int count, const int* indices);
json_t* gltf_scalars(Gltf* gltf, long count, const double* scalars);

/// Write "glTF", the JSON of `root`, to which views, accessors and the buffer are added, and the binary part.
JnStatus gltf_write(Gltf* gltf, json_t* root, const char* path);

#endif
