// Every type that VTK writes, widened.
#include "mesh/format/vtk_numbers.h"

#include <stdlib.h>
#include <string.h>

const JnVtkType jn_vtk_types[] = {
	{"Float64", "double", 8, JN_VTK_FLOAT},
	{"Float32", "float", 4, JN_VTK_FLOAT},
	{"Int64", "vtktypeint64", 8, JN_VTK_SIGNED},
	{"Int32", "int", 4, JN_VTK_SIGNED},
	{"Int16", "short", 2, JN_VTK_SIGNED},
	{"Int8", "char", 1, JN_VTK_SIGNED},
	{"UInt64", "vtktypeuint64", 8, JN_VTK_UNSIGNED},
	{"UInt32", "unsigned_int", 4, JN_VTK_UNSIGNED},
	{"UInt16", "unsigned_short", 2, JN_VTK_UNSIGNED},
	{"UInt8", "unsigned_char", 1, JN_VTK_UNSIGNED},
	{"Int64", "long", 8, JN_VTK_SIGNED},
	{"UInt64", "unsigned_long", 8, JN_VTK_UNSIGNED},
	{NULL, NULL, 0, JN_VTK_FLOAT},
};

static uint64_t load(const unsigned char* bytes, int size, bool is_big_endian) {
	uint64_t value = 0;
	for (int i = 0; i < size; ++i) {
		const int place = is_big_endian ? size - 1 - i : i;
		value |= (uint64_t)bytes[place] << (8 * i);
	}
	return value;
}

static double real_at(const unsigned char* bytes, const JnVtkType* type, bool is_big_endian) {
	const uint64_t bits = load(bytes, type->size, is_big_endian);
	if (type->kind == JN_VTK_UNSIGNED) return (double)bits;
	if (type->kind == JN_VTK_SIGNED) return (double)((int64_t)(bits << (64 - 8 * type->size)) >> (64 - 8 * type->size));
	double wide;
	float narrow;
	const uint32_t low = (uint32_t)bits;
	memcpy(&wide, &bits, sizeof wide);
	memcpy(&narrow, &low, sizeof narrow);
	return type->size == 8 ? wide : (double)narrow;
}

/// A number beyond the range of int64_t becomes -1, which no caller takes for a valid one.
static int64_t whole_at(const unsigned char* bytes, const JnVtkType* type, bool is_big_endian) {
	const uint64_t bits = load(bytes, type->size, is_big_endian);
	const int shift = 64 - 8 * type->size;
	if (type->kind == JN_VTK_SIGNED) return (int64_t)(bits << shift) >> shift;
	return bits > INT64_MAX ? -1 : (int64_t)bits;
}

static JnStatus take(size_t count, JnVtkAs as, JnArena* arena, JnVtkNumbers* out) {
	*out = (JnVtkNumbers){.count = count};
	if (as == JN_VTK_REAL)
		JN_NEW(arena, out->real, count + 1);
	else
		JN_NEW(arena, out->whole, count + 1);
	return JN_OK;
}

JnStatus jn_vtk_from_bytes(const unsigned char* bytes, size_t size, const JnVtkType* type, bool is_big_endian,
						   JnVtkAs as, JnArena* arena, JnVtkNumbers* out) {
	if (size % (size_t)type->size != 0 || (as == JN_VTK_WHOLE && type->kind == JN_VTK_FLOAT)) return JN_BAD_INPUT;
	JN_TRY(take(size / (size_t)type->size, as, arena, out));
	for (size_t i = 0; i < out->count; ++i) {
		const unsigned char* at = bytes + i * (size_t)type->size;
		if (as == JN_VTK_REAL)
			out->real[i] = real_at(at, type, is_big_endian);
		else
			out->whole[i] = whole_at(at, type, is_big_endian);
	}
	return JN_OK;
}

static const char* skip_space(const char* text, const char* end) {
	while (text < end && (*text == ' ' || *text == '\t' || *text == '\n' || *text == '\r')) ++text;
	return text;
}

static const char* skip_word(const char* text, const char* end) {
	while (text < end && *text != ' ' && *text != '\t' && *text != '\n' && *text != '\r') ++text;
	return text;
}

static size_t count_words(const char* text, const char* end, size_t most) {
	size_t count = 0;
	for (text = skip_space(text, end); text < end && count < most; text = skip_space(skip_word(text, end), end))
		++count;
	return count;
}

JnStatus jn_vtk_from_text(const char** text, const char* end, size_t most, JnVtkAs as, JnArena* arena,
						  JnVtkNumbers* out) {
	JN_TRY(take(count_words(*text, end, most), as, arena, out));
	for (size_t i = 0; i < out->count; ++i) {
		const char* start = skip_space(*text, end);
		char* stop = NULL;
		if (as == JN_VTK_REAL)
			out->real[i] = strtod(start, &stop);
		else
			out->whole[i] = strtoll(start, &stop, 10);
		*text = skip_word(start, end);
		if (stop != *text) return JN_BAD_INPUT;
	}
	return JN_OK;
}
