// Bytes of an array:
//   plain        size | data
//   compressed   blocks, size of a block, size of the last (0: full), compressed size of each | block | block ...
// where `|` may be a new start of base64, or not: padding inside is passed over, so that both are read.
#include "mesh/format/vtu_data.h"

#include <libxml/parser.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "base/log.h"

/// Where bytes come from.
typedef struct Source {
	const unsigned char *at, *end;
	bool is_raw;
	unsigned char ready[3]; // decoded and not yet taken
	int ready_count;
} Source;

static int base64_value(unsigned char c) {
	if (c >= 'A' && c <= 'Z') return c - 'A';
	if (c >= 'a' && c <= 'z') return c - 'a' + 26;
	if (c >= '0' && c <= '9') return c - '0' + 52;
	return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Decode the next four letters, of which the last two may be '='. False at the end or when they are not base64.
static bool decode_four(Source* source) {
	uint32_t bits = 0;
	int letters = 0, padding = 0;
	for (; source->at < source->end && letters + padding < 4; ++source->at) {
		const unsigned char c = *source->at;
		if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
		const int value = c == '=' ? 0 : base64_value(c);
		if (value < 0 || (padding > 0 && c != '=')) return false;
		bits = bits << 6 | (uint32_t)value;
		if (c == '=')
			++padding;
		else
			++letters;
	}
	if (letters + padding != 4 || padding > 2) return false;
	for (int i = 0; i < 3; ++i) source->ready[i] = (unsigned char)(bits >> (16 - 8 * i));
	source->ready_count = 3 - padding;
	return true;
}

/// Most bytes that can still come.
static size_t bytes_left(const Source* source) {
	const size_t left = (size_t)(source->end - source->at);
	return source->is_raw ? left : left / 4 * 3 + (size_t)source->ready_count;
}

static bool take_bytes(Source* source, size_t count, unsigned char* out) {
	if (count > bytes_left(source)) return false;
	if (source->is_raw) {
		memcpy(out, source->at, count);
		source->at += count;
		return true;
	}
	while (count > 0) {
		if (source->ready_count == 0 && !decode_four(source)) return false;
		*out++ = source->ready[0];
		memmove(source->ready, source->ready + 1, 2);
		--source->ready_count;
		--count;
	}
	return true;
}

static bool take_number(const JnVtuFile* file, Source* source, uint64_t* out) {
	unsigned char bytes[8] = {0};
	if (!take_bytes(source, (size_t)file->header_size, bytes)) return false;
	*out = 0;
	for (int i = 0; i < file->header_size; ++i) {
		const int place = file->is_big_endian ? file->header_size - 1 - i : i;
		*out |= (uint64_t)bytes[place] << (8 * i);
	}
	return true;
}

typedef struct Bytes {
	unsigned char* data;
	size_t size;
} Bytes;

static JnStatus read_plain(const JnVtuFile* file, Source* source, JnArena* arena, Bytes* out) {
	uint64_t size;
	if (!take_number(file, source, &size) || size > bytes_left(source)) return JN_BAD_INPUT;
	*out = (Bytes){.size = (size_t)size};
	JN_NEW(arena, out->data, out->size + 1);
	return take_bytes(source, out->size, out->data) ? JN_OK : JN_BAD_INPUT;
}

typedef struct Blocks {
	uint64_t count, size, last; // size: of all but the last
	uint64_t* compressed;       // sizes
} Blocks;

/// zlib makes at most 1032 bytes of one, hence no block can claim more, and all of them not more than there is.
static bool are_plausible(const Blocks* blocks, size_t left) {
	uint64_t sum = 0;
	for (uint64_t i = 0; i < blocks->count; ++i) {
		const uint64_t packed = blocks->compressed[i];
		const uint64_t size = i + 1 < blocks->count ? blocks->size : blocks->last;
		if (packed > left - sum || size > 1032 * (packed + 1)) return false;
		sum += packed;
	}
	return true;
}

static JnStatus read_blocks(const JnVtuFile* file, Source* source, JnArena* arena, Blocks* blocks) {
	*blocks = (Blocks){0};
	if (!take_number(file, source, &blocks->count) || blocks->count > bytes_left(source)) return JN_BAD_INPUT;
	if (blocks->count == 0) return JN_OK;
	if (!take_number(file, source, &blocks->size) || !take_number(file, source, &blocks->last)) return JN_BAD_INPUT;
	if (blocks->last == 0) blocks->last = blocks->size;
	JN_NEW(arena, blocks->compressed, blocks->count);
	for (uint64_t i = 0; i < blocks->count; ++i)
		if (!take_number(file, source, &blocks->compressed[i])) return JN_BAD_INPUT;
	return are_plausible(blocks, bytes_left(source)) ? JN_OK : JN_BAD_INPUT;
}

static JnStatus read_compressed(const JnVtuFile* file, Source* source, JnArena* arena, Bytes* out) {
	Blocks blocks;
	JN_TRY(read_blocks(file, source, arena, &blocks));
	*out = (Bytes){.size = blocks.count > 0 ? (size_t)((blocks.count - 1) * blocks.size + blocks.last) : 0};
	JN_NEW(arena, out->data, out->size + 1);
	unsigned char* at = out->data;
	for (uint64_t i = 0; i < blocks.count; ++i) {
		const uint64_t size = i + 1 < blocks.count ? blocks.size : blocks.last;
		unsigned char* packed;
		uLongf length = (uLongf)size;
		JN_NEW(arena, packed, blocks.compressed[i] + 1);
		if (!take_bytes(source, (size_t)blocks.compressed[i], packed)) return JN_BAD_INPUT;
		if (uncompress(at, &length, packed, (uLong)blocks.compressed[i]) != Z_OK || length != size) return JN_BAD_INPUT;
		at += size;
	}
	return JN_OK;
}

static JnStatus decode(const JnVtuFile* file, Source* source, const JnVtkType* type, JnVtkAs as, JnArena* arena,
					   JnVtkNumbers* out) {
	Bytes bytes = {0};
	JN_TRY((file->is_compressed ? read_compressed : read_plain)(file, source, arena, &bytes));
	return jn_vtk_from_bytes(bytes.data, bytes.size, type, file->is_big_endian, as, arena, out);
}

static const JnVtkType* find_type(const xmlChar* name) {
	for (const JnVtkType* type = jn_vtk_types; type->name != NULL && name != NULL; ++type)
		if (strcmp(type->name, (const char*)name) == 0) return type;
	return NULL;
}

static JnStatus read_appended(const JnVtuFile* file, xmlNode* array, const JnVtkType* type, JnVtkAs as, JnArena* arena,
							  JnVtkNumbers* out) {
	xmlChar* text = xmlGetProp(array, BAD_CAST "offset");
	unsigned long long offset = 0;
	char rest;
	const bool is_number = text != NULL && sscanf((const char*)text, "%llu%c", &offset, &rest) == 1;
	xmlFree(text);
	const size_t size = file->appended != NULL ? (size_t)(file->appended_end - file->appended) : 0;
	if (!is_number || offset >= size) return JN_BAD_INPUT;
	Source source = {.at = file->appended + offset, .end = file->appended_end, .is_raw = file->appended_is_raw};
	return decode(file, &source, type, as, arena, out);
}

static JnStatus read_inline(const JnVtuFile* file, xmlNode* array, const JnVtkType* type, bool is_text, JnVtkAs as,
							JnArena* arena, JnVtkNumbers* out) {
	xmlChar* content = xmlNodeGetContent(array);
	if (content == NULL) return JN_OUT_OF_MEMORY;
	const char* text = (const char*)content;
	const char* end = text + strlen(text);
	Source source = {.at = content, .end = content + (end - text)};
	const JnStatus status =
		is_text ? jn_vtk_from_text(&text, end, SIZE_MAX, as, arena, out) : decode(file, &source, type, as, arena, out);
	xmlFree(content);
	return status;
}

JnStatus jn_vtu_numbers(const JnVtuFile* file, xmlNode* array, JnVtkAs as, JnArena* arena, JnVtkNumbers* numbers) {
	xmlChar *type_name = xmlGetProp(array, BAD_CAST "type"), *format = xmlGetProp(array, BAD_CAST "format");
	xmlChar* name = xmlGetProp(array, BAD_CAST "Name");
	const JnVtkType* type = find_type(type_name);
	JnStatus status = JN_BAD_INPUT;
	*numbers = (JnVtkNumbers){0};
	if (type != NULL && xmlStrEqual(format, BAD_CAST "appended"))
		status = read_appended(file, array, type, as, arena, numbers);
	else if (type != NULL && (xmlStrEqual(format, BAD_CAST "ascii") || xmlStrEqual(format, BAD_CAST "binary")))
		status = read_inline(file, array, type, format[0] == 'a', as, arena, numbers);
	if (status == JN_BAD_INPUT)
		jn_error(JN_BAD_INPUT, "%s: line %ld: the DataArray \"%s\" is not what its type \"%s\" and format \"%s\" say",
				 file->path, xmlGetLineNo(array), name != NULL ? (const char*)name : "",
				 type_name != NULL ? (const char*)type_name : "", format != NULL ? (const char*)format : "");
	xmlFree(type_name);
	xmlFree(format);
	xmlFree(name);
	return status;
}
