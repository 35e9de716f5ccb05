#include "export_gltf.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/log.h"

enum { FLOAT = 5126, UNSIGNED_INT = 5125, ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };
enum { HEADER_BYTES = 12, CHUNK_BYTES = 8 };

JnStatus gltf_create(const char* path, Gltf* gltf) {
	char name[JN_PATH_SIZE];
	*gltf = (Gltf){.views = json_array(), .accessors = json_array()};
	if (gltf->views == NULL || gltf->accessors == NULL) return JN_OUT_OF_MEMORY;
	if (snprintf(name, sizeof name, "%s.XXXXXX", path) >= (int)sizeof name)
		return jn_error(JN_IO_FAILED, "%s: the path is too long", path);
	const int file = mkstemp(name);
	if (file >= 0) unlink(name); // it goes when it is closed, whatever happens
	gltf->data.stream = file >= 0 ? fdopen(file, "w+b") : NULL;
	snprintf(gltf->data.path, sizeof gltf->data.path, "%s", path);
	return gltf->data.stream != NULL ? JN_OK
									 : jn_error(JN_IO_FAILED, "%s: cannot write here: %s", path, strerror(errno));
}

void gltf_destroy(Gltf* gltf) {
	if (gltf->data.stream != NULL) fclose(gltf->data.stream);
	json_decref(gltf->views);
	json_decref(gltf->accessors);
}

// ---- accessors ----

/// A view of the `bytes` that are about to be written; `target` 0: not of a mesh.
static json_t* add_view(Gltf* gltf, uint64_t bytes, int target) {
	json_t* view =
		json_pack("{si, sI, sI}", "buffer", 0, "byteOffset", (json_int_t)gltf->size, "byteLength", (json_int_t)bytes);
	if (target != 0) json_object_set_new(view, "target", json_integer(target));
	gltf->size += bytes;
	json_array_append_new(gltf->views, view);
	return json_integer((json_int_t)json_array_size(gltf->views) - 1);
}

static json_t* add_accessor(Gltf* gltf, json_t* accessor) {
	json_array_append_new(gltf->accessors, accessor);
	return json_integer((json_int_t)json_array_size(gltf->accessors) - 1);
}

/// Smallest and largest of each component, as they are in single precision.
static void set_bounds(json_t* accessor, size_t count, int components, const double* values) {
	json_t *low = json_array(), *high = json_array();
	for (int a = 0; a < components; ++a) {
		double least = INFINITY, most = -INFINITY;
		for (size_t i = 0; i < count; ++i) {
			least = fmin(least, (float)values[i * (size_t)components + (size_t)a]);
			most = fmax(most, (float)values[i * (size_t)components + (size_t)a]);
		}
		json_array_append_new(low, json_real(least));
		json_array_append_new(high, json_real(most));
	}
	json_object_set_new(accessor, "min", low);
	json_object_set_new(accessor, "max", high);
}

static bool is_zero(const double* vector) {
	return (float)vector[0] == 0 && (float)vector[1] == 0 && (float)vector[2] == 0;
}

/// Numbers and values of the vectors that are not 0; without any, an accessor is 0 by itself.
static void write_sparse(Gltf* gltf, int count, int used, const double* vectors, json_t* accessor) {
	if (used == 0) return;
	json_t* indices = add_view(gltf, 4 * (uint64_t)used, 0);
	for (int i = 0; i < count; ++i)
		if (!is_zero(vectors + 3 * (ptrdiff_t)i)) export_put_bits(&gltf->data, (uint32_t)i, 4);
	json_t* values = add_view(gltf, 12 * (uint64_t)used, 0);
	for (int i = 0; i < count; ++i)
		if (!is_zero(vectors + 3 * (ptrdiff_t)i)) export_put_floats(&gltf->data, 3, vectors + 3 * (ptrdiff_t)i);
	json_object_set_new(accessor, "sparse",
						json_pack("{si, s{so, si}, s{so}}", "count", used, "indices", "bufferView", indices,
								  "componentType", UNSIGNED_INT, "values", "bufferView", values));
}

json_t* gltf_vectors(Gltf* gltf, int count, const double* vectors) {
	int used = 0;
	for (int i = 0; i < count; ++i) used += !is_zero(vectors + 3 * (ptrdiff_t)i);
	json_t* accessor = json_pack("{si, si, ss}", "componentType", FLOAT, "count", count, "type", "VEC3");
	set_bounds(accessor, (size_t)count, 3, vectors);
	if (4 * (long)used < 2 * (long)count) { // 16 bytes each instead of 12; half as many are worth it
		write_sparse(gltf, count, used, vectors, accessor);
	} else {
		json_object_set_new(accessor, "bufferView", add_view(gltf, 12 * (uint64_t)count, ARRAY_BUFFER));
		export_put_floats(&gltf->data, 3 * (size_t)count, vectors);
	}
	return add_accessor(gltf, accessor);
}

json_t* gltf_indices(Gltf* gltf, int count, const int* indices) {
	json_t* view = add_view(gltf, 4 * (uint64_t)count, ELEMENT_ARRAY_BUFFER);
	for (int i = 0; i < count; ++i) export_put_bits(&gltf->data, (uint32_t)indices[i], 4);
	return add_accessor(gltf, json_pack("{so, si, si, ss}", "bufferView", view, "componentType", UNSIGNED_INT, "count",
										count, "type", "SCALAR"));
}

json_t* gltf_scalars(Gltf* gltf, long count, const double* scalars) {
	json_t* view = add_view(gltf, 4 * (uint64_t)count, 0);
	json_t* accessor = json_pack("{so, si, sI, ss}", "bufferView", view, "componentType", FLOAT, "count",
								 (json_int_t)count, "type", "SCALAR");
	set_bounds(accessor, (size_t)count, 1, scalars);
	export_put_floats(&gltf->data, (size_t)count, scalars);
	return add_accessor(gltf, accessor);
}

// ---- the file ----

static void put_header(JnTextFile* file, uint64_t json_bytes, uint64_t data_bytes) {
	jn_text_write(file, "glTF", 4);
	export_put_bits(file, 2, 4);
	export_put_bits(file, (uint32_t)(HEADER_BYTES + 2 * CHUNK_BYTES + json_bytes + data_bytes), 4);
}

static void copy_data(Gltf* gltf, JnTextFile* file) {
	char buffer[1 << 16];
	rewind(gltf->data.stream);
	for (size_t count; (count = fread(buffer, 1, sizeof buffer, gltf->data.stream)) > 0;)
		jn_text_write(file, buffer, count);
	if (ferror(gltf->data.stream) && file->error == 0) file->error = EIO;
}

static JnStatus write_chunks(Gltf* gltf, const char* json, const char* path) {
	JnTextFile file;
	const uint64_t length = strlen(json), padded = (length + 3) / 4 * 4; // all data are words of four bytes
	if (HEADER_BYTES + 2 * CHUNK_BYTES + padded + gltf->size > UINT32_MAX)
		return jn_error(JN_BAD_INPUT, "%s: %.3g GB are more than the 4 GiB of a glb; choose fewer frames with --frames",
						path, 1e-9 * (double)(padded + gltf->size));
	JN_TRY(jn_text_flush(&gltf->data));
	JN_TRY(export_open(path, &file));
	put_header(&file, padded, gltf->size);
	export_put_bits(&file, (uint32_t)padded, 4);
	jn_text_write(&file, "JSON", 4);
	jn_text_write(&file, json, length);
	jn_text_write(&file, "   ", padded - length);
	export_put_bits(&file, (uint32_t)gltf->size, 4);
	jn_text_write(&file, "BIN", 4); // with its 0
	copy_data(gltf, &file);
	return jn_text_close(&file);
}

JnStatus gltf_write(Gltf* gltf, json_t* root, const char* path) {
	json_object_set_new(root, "buffers", json_pack("[{sI}]", "byteLength", (json_int_t)gltf->size));
	json_object_set(root, "bufferViews", gltf->views);
	json_object_set(root, "accessors", gltf->accessors);
	char* text = json_dumps(root, JSON_COMPACT);
	if (text == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the JSON of %s", path);
	const JnStatus status = write_chunks(gltf, text, path);
	free(text);
	return status;
}
