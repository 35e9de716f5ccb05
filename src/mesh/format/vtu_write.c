#include "mesh/format/vtu_write.h"

#include <string.h>
#include <zlib.h>

enum { BLOCK = 1 << 20 }; // bytes; a multiple of 3 is not needed: blocks are encoded as one stream

static void encode(JnVtuWriter* writer, const unsigned char* data, size_t size) {
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

enum { BYTES, HEADER, PACKED };

/// Room for `size` bytes, which holds until the next call for this buffer.
static JnStatus reserve(JnVtuWriter* writer, int buffer, size_t size, unsigned char** out) {
	if (writer->sizes[buffer] < size + 1) {
		writer->sizes[buffer] = 0;
		JN_NEW(writer->arena, writer->buffers[buffer], size + 1);
		writer->sizes[buffer] = size + 1;
	}
	*out = writer->buffers[buffer];
	return JN_OK;
}

/// Compressed bytes behind a header: blocks, size of a block, size of the last, compressed sizes.
static JnStatus write_bytes(JnVtuWriter* writer, const unsigned char* data, size_t size) {
	const size_t blocks = (size + BLOCK - 1) / BLOCK;
	unsigned char *header, *packed;
	size_t total = 0;
	JN_TRY(reserve(writer, HEADER, 8 * (3 + blocks), &header));
	JN_TRY(reserve(writer, PACKED, blocks * compressBound(size < BLOCK ? size : BLOCK), &packed));
	store(header, blocks, 8);
	store(header + 8, BLOCK, 8);
	store(header + 16, size % BLOCK, 8);
	for (size_t i = 0; i < blocks; ++i) {
		const size_t length = i + 1 < blocks || size % BLOCK == 0 ? BLOCK : size % BLOCK;
		uLongf written = compressBound(length);
		if (compress2(packed + total, &written, data + i * BLOCK, length, Z_BEST_SPEED) != Z_OK)
			return JN_OUT_OF_MEMORY;
		store(header + 24 + 8 * i, written, 8);
		total += written;
	}
	encode(writer, header, 8 * (3 + blocks));
	encode(writer, packed, total);
	return JN_OK;
}

JnStatus jn_vtu_array(JnVtuWriter* writer, const JnVtuArray* array, uint64_t (*value)(const void* data, size_t i),
					  const void* data) {
	unsigned char* bytes;
	JN_TRY(reserve(writer, BYTES, array->count * (size_t)array->size, &bytes));
	for (size_t i = 0; i < array->count; ++i) store(bytes + i * (size_t)array->size, value(data, i), array->size);
	fprintf(writer->stream, "<DataArray type=\"%s\" Name=\"", array->type);
	for (const char* c = array->name; *c != '\0'; ++c) {
		const char* escaped = *c == '&' ? "&amp;" : *c == '<' ? "&lt;" : *c == '"' ? "&quot;" : NULL;
		if (escaped != NULL)
			fputs(escaped, writer->stream);
		else
			fputc(*c, writer->stream);
	}
	fputc('"', writer->stream);
	if (array->components > 1) fprintf(writer->stream, " NumberOfComponents=\"%d\"", array->components);
	fputs(" format=\"binary\">\n", writer->stream);
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

static uint64_t byte_at(const void* data, size_t i) {
	return ((const unsigned char*)data)[i];
}

JnStatus jn_vtu_reals(JnVtuWriter* writer, const char* name, int components, size_t count, const double* reals) {
	return jn_vtu_array(writer, &(JnVtuArray){"Float64", name, components, 8, count}, double_bits, reals);
}

JnStatus jn_vtu_integers(JnVtuWriter* writer, const char* name, size_t count, const int* integers) {
	return jn_vtu_array(writer, &(JnVtuArray){"Int32", name, 1, 4, count}, int_bits, integers);
}

JnStatus jn_vtu_bytes(JnVtuWriter* writer, const char* name, size_t count, const unsigned char* bytes) {
	return jn_vtu_array(writer, &(JnVtuArray){"UInt8", name, 1, 1, count}, byte_at, bytes);
}

void jn_vtu_begin(JnVtuWriter* writer, int point_count, long cell_count) {
	fprintf(writer->stream,
			"<?xml version=\"1.0\"?>\n"
			"<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
			"compressor=\"vtkZLibDataCompressor\">\n"
			"<UnstructuredGrid>\n<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%ld\">\n",
			point_count, cell_count);
}

void jn_vtu_end(JnVtuWriter* writer) {
	fputs("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", writer->stream);
}
