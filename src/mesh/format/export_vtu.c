// VTK XML 1.0, UnstructuredGrid: arrays inside the text, in base64 of zlib-compressed blocks (vtu_data.c tells the order),
// little-endian, so that doubles come back bit by bit. Node sets are UInt8 point data named "set:<name>", 1 for members.
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "base/log.h"
#include "mesh/format/export_volume.h"
#include "mesh/format/vtk_cells.h"

enum { BLOCK = 1 << 20 }; // bytes; a multiple of 3 is not needed: blocks are encoded as one stream

typedef struct Writer {
	FILE* stream;
	JnArena* arena;
} Writer;

static void encode(Writer* writer, const unsigned char* data, size_t size) {
	static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	for (size_t i = 0; i < size; i += 3) {
		const size_t have = size - i < 3 ? size - i : 3;
		uint32_t bits = 0;
		for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < have ? data[i + k] : 0u);
		char four[4];
		for (size_t k = 0; k < 4; ++k) four[k] = k <= have ? letters[bits >> (18 - 6 * k) & 63] : '=';
		fwrite(four, 1, sizeof four, writer->stream);
	}
}

static void store(unsigned char* out, uint64_t value, int size) {
	for (int i = 0; i < size; ++i) out[i] = (unsigned char)(value >> (8 * i));
}

/// Compressed bytes behind a header: blocks, size of a block, size of the last, compressed sizes.
static JnStatus write_bytes(Writer* writer, const unsigned char* data, size_t size) {
	const size_t blocks = (size + BLOCK - 1) / BLOCK;
	unsigned char *header, *packed;
	size_t total = 0;
	JN_NEW(writer->arena, header, 8 * (3 + blocks));
	JN_NEW(writer->arena, packed, blocks * compressBound(BLOCK) + 1);
	store(header, blocks, 8);
	store(header + 8, BLOCK, 8);
	store(header + 16, size % BLOCK, 8);
	for (size_t i = 0; i < blocks; ++i) {
		const size_t length = i + 1 < blocks || size % BLOCK == 0 ? BLOCK : size % BLOCK;
		uLongf written = compressBound(BLOCK);
		if (compress2(packed + total, &written, data + i * BLOCK, length, Z_BEST_SPEED) != Z_OK)
			return JN_OUT_OF_MEMORY;
		store(header + 24 + 8 * i, written, 8);
		total += written;
	}
	encode(writer, header, 8 * (3 + blocks));
	encode(writer, packed, total);
	return JN_OK;
}

typedef struct Array {
	const char *type, *name;
	int components, size; // bytes of a number
	size_t count;         // numbers
} Array;

/// `value` gives the bits of number i.
static JnStatus write_array(Writer* writer, const Array* array, uint64_t (*value)(const void* data, size_t i),
							const void* data) {
	unsigned char* bytes;
	JN_NEW(writer->arena, bytes, array->count * (size_t)array->size + 1);
	for (size_t i = 0; i < array->count; ++i) store(bytes + i * (size_t)array->size, value(data, i), array->size);
	fprintf(writer->stream, "<DataArray type=\"%s\" Name=\"", array->type);
	for (const char* c = array->name; *c != '\0'; ++c) {
		const char* escaped = *c == '&' ? "&amp;" : *c == '<' ? "&lt;" : *c == '"' ? "&quot;" : NULL;
		if (escaped != NULL)
			fputs(escaped, writer->stream);
		else
			fputc(*c, writer->stream);
	}
	fprintf(writer->stream, "\" NumberOfComponents=\"%d\" format=\"binary\">\n", array->components);
	JN_TRY(write_bytes(writer, bytes, array->count * (size_t)array->size));
	fputs("\n</DataArray>\n", writer->stream);
	return JN_OK;
}

static uint64_t double_bits(const void* data, size_t i) {
	uint64_t bits;
	memcpy(&bits, (const double*)data + i, sizeof bits);
	return bits;
}

static uint64_t int_bits(const void* data, size_t i) {
	return (uint64_t)(int64_t)((const int*)data)[i];
}

static uint64_t cell_end(const void* data, size_t i) {
	return (i + 1) * (uint64_t)jn_shape_info[((const JnMesh*)data)->shape].nodes;
}

static uint64_t cell_type(const void* data, size_t i) {
	(void)i;
	return (uint64_t)jn_shape_info[((const JnMesh*)data)->shape].vtk_type;
}

static uint64_t byte_at(const void* data, size_t i) {
	return ((const unsigned char*)data)[i];
}

static JnStatus write_set(Writer* writer, const JnMesh* mesh, const JnNodeSet* set) {
	unsigned char* marks;
	char* name;
	const size_t length = strlen(set->name) + sizeof JN_VTK_SET_PREFIX;
	JN_NEW(writer->arena, marks, mesh->node_count);
	JN_NEW(writer->arena, name, length);
	snprintf(name, length, "%s%s", JN_VTK_SET_PREFIX, set->name);
	for (int i = 0; i < set->count; ++i) marks[set->nodes[i]] = 1;
	return write_array(writer, &(Array){"UInt8", name, 1, 1, (size_t)mesh->node_count}, byte_at, marks);
}

static JnStatus write_piece(Writer* writer, const JnMesh* mesh) {
	const size_t nodes = (size_t)mesh->node_count, cells = (size_t)mesh->cell_count;
	const size_t entries = cells * (size_t)jn_shape_info[mesh->shape].nodes;
	fputs("<PointData>\n", writer->stream);
	for (int s = 0; s < mesh->set_count; ++s) JN_TRY(write_set(writer, mesh, &mesh->sets[s]));
	fputs("</PointData>\n<Points>\n", writer->stream);
	JN_TRY(write_array(writer, &(Array){"Float64", "Points", 3, 8, 3 * nodes}, double_bits, mesh->nodes));
	fputs("</Points>\n<Cells>\n", writer->stream);
	JN_TRY(write_array(writer, &(Array){"Int32", "connectivity", 1, 4, entries}, int_bits, mesh->cells));
	JN_TRY(write_array(writer, &(Array){"Int64", "offsets", 1, 8, cells}, cell_end, mesh));
	JN_TRY(write_array(writer, &(Array){"UInt8", "types", 1, 1, cells}, cell_type, mesh));
	fputs("</Cells>\n", writer->stream);
	return JN_OK;
}

static JnStatus write_file(Writer* writer, const JnMesh* mesh) {
	fprintf(writer->stream,
			"<?xml version=\"1.0\"?>\n"
			"<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
			"compressor=\"vtkZLibDataCompressor\">\n"
			"<UnstructuredGrid>\n<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n",
			mesh->node_count, mesh->cell_count);
	JN_TRY(write_piece(writer, mesh));
	fputs("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", writer->stream);
	return JN_OK;
}

JnStatus jn_export_vtu(const JnMesh* mesh, const char* temporary, const char* path) {
	JnArena scratch = {0};
	Writer writer = {.stream = fopen(temporary, "wb"), .arena = &scratch};
	if (writer.stream == NULL) return jn_error(JN_IO_FAILED, "%s: cannot create the file: %s", path, strerror(errno));
	const JnStatus status = write_file(&writer, mesh);
	const bool is_bad = ferror(writer.stream) != 0;
	jn_arena_free(&scratch);
	if ((fclose(writer.stream) != 0 || is_bad) && status == JN_OK)
		return jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", path, strerror(errno));
	return status;
}
