// The Stanford triangle format: a header in words that lists elements, each so many times, and their properties: numbers,
// or lists of a count and so many numbers; then the numbers, as text or binary (Turk, "The PLY Polygon File Format", 1994).
#include "mesh/format/ply_check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"

enum { MOST_ELEMENTS = 16, MOST_PROPERTIES = 64 };

typedef struct Type {
	const char* name;
	int size; // bytes
	bool is_signed;
} Type;

static const Type types[] = {
	{"char", 1, true},  {"uchar", 1, false},  {"short", 2, true},   {"ushort", 2, false},
	{"int", 4, true},   {"uint", 4, false},   {"float", 4, true},   {"double", 8, true},
	{"int8", 1, true},  {"uint8", 1, false},  {"int16", 2, true},   {"uint16", 2, false},
	{"int32", 4, true}, {"uint32", 4, false}, {"float32", 4, true}, {"float64", 8, true},
};

typedef struct Property {
	const Type *count, *value; // count is NULL unless it is a list
	bool is_nodes;             // numbers of vertices
} Property;

typedef struct Element {
	char name[32];
	long long count;
	int property_count;
	Property properties[MOST_PROPERTIES];
} Element;

typedef struct Ply {
	const char* path;
	const char *at, *end; // what is left of the file
	bool is_text, is_big; // form of the numbers: text, or most significant byte first
	long long vertex_count;
	int element_count;
	Element elements[MOST_ELEMENTS];
} Ply;

static const Type* find_type(const char* name) {
	for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
		if (strcmp(types[i].name, name) == 0) return &types[i];
	return NULL;
}

static bool add_element(Ply* ply, const char* line) {
	if (ply->element_count == MOST_ELEMENTS) return false;
	Element* element = &ply->elements[ply->element_count++];
	if (sscanf(line, "element %31s %lld", element->name, &element->count) != 2 || element->count < 0) return false;
	if (strcmp(element->name, "vertex") == 0) ply->vertex_count = element->count;
	return true;
}

static bool add_property(Ply* ply, const char* line) {
	char first[16], second[16], name[64];
	Element* element = ply->element_count > 0 ? &ply->elements[ply->element_count - 1] : NULL;
	if (element == NULL || element->property_count == MOST_PROPERTIES) return false;
	Property* property = &element->properties[element->property_count++];
	if (sscanf(line, "property list %15s %15s %63s", first, second, name) == 3) {
		*property = (Property){find_type(first), find_type(second), .is_nodes = false};
		property->is_nodes = strcmp(name, "vertex_indices") == 0 || strcmp(name, "vertex_index") == 0;
		return property->count != NULL && property->value != NULL;
	}
	if (sscanf(line, "property %15s %63s", first, name) != 2) return false;
	*property = (Property){.value = find_type(first)};
	return property->value != NULL;
}

static bool set_format(Ply* ply, const char* line) {
	ply->is_text = strncmp(line, "format ascii", 12) == 0;
	ply->is_big = strncmp(line, "format binary_big_endian", 24) == 0;
	return ply->is_text || ply->is_big || strncmp(line, "format binary_little_endian", 27) == 0;
}

static bool starts_with(const char* line, const char* word) {
	return strncmp(line, word, strlen(word)) == 0;
}

/// The next line without its end; false when there is none, or it is very long.
static bool next_line(Ply* ply, size_t size, char* line) {
	const char* stop = memchr(ply->at, '\n', (size_t)(ply->end - ply->at));
	if (stop == NULL || (size_t)(stop - ply->at) >= size) return false;
	const size_t length = (size_t)(stop - ply->at);
	memcpy(line, ply->at, length);
	line[length > 0 && line[length - 1] == '\r' ? length - 1 : length] = '\0';
	ply->at = stop + 1;
	return true;
}

static JnStatus read_header(Ply* ply) {
	char line[1024] = "";
	if (!next_line(ply, sizeof line, line) || (strcmp(line, "ply") != 0 && strcmp(line, "PLY") != 0))
		return jn_error(JN_BAD_INPUT, "%s: does not begin with 'ply'; it is no PLY file", ply->path);
	bool has_format = false;
	for (int number = 2; next_line(ply, sizeof line, line); number++) {
		bool is_good = starts_with(line, "comment") || starts_with(line, "obj_info") || line[0] == '\0';
		if (starts_with(line, "format ")) has_format = is_good = set_format(ply, line);
		if (starts_with(line, "element ")) is_good = add_element(ply, line);
		if (starts_with(line, "property ")) is_good = add_property(ply, line);
		if (strcmp(line, "end_header") == 0 && has_format) return JN_OK;
		if (!is_good) return jn_error(JN_BAD_INPUT, "%s:%d: '%.60s' is not understood", ply->path, number, line);
	}
	return jn_error(JN_BAD_INPUT, "%s: the header does not end; the file is cut off or damaged", ply->path);
}

static bool is_space(char c) {
	return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static void skip(Ply* ply, const char* spaces) {
	while (ply->at < ply->end && *ply->at != '\0' && strchr(spaces, *ply->at) != NULL) ply->at++;
}

static bool next_word(Ply* ply, long long* value) {
	skip(ply, " \t\r");
	const char* start = ply->at;
	while (ply->at < ply->end && !is_space(*ply->at)) ply->at++;
	if (start == ply->at || strchr("+-.0123456789nNiI", *start) == NULL) return false;
	*value = strtoll(start, NULL, 10); // a zero stands behind the content
	return true;
}

static bool next_bytes(Ply* ply, const Type* type, long long* value) {
	if (ply->end - ply->at < type->size) return false;
	uint64_t bits = 0;
	for (int i = 0; i < type->size; i++) {
		const int place = ply->is_big ? i : type->size - 1 - i;
		bits = bits << 8 | (unsigned char)ply->at[place];
	}
	ply->at += type->size;
	const int rest = 64 - 8 * type->size;
	*value = type->is_signed ? (long long)(bits << rest) >> rest : (long long)bits;
	return true;
}

static bool next_number(Ply* ply, const Type* type, long long* value) {
	return ply->is_text ? next_word(ply, value) : next_bytes(ply, type, value);
}

/// "" or what is wrong with the end of an element: as text, each stands on a line of its own.
static const char* end_element(Ply* ply) {
	if (!ply->is_text) return "";
	skip(ply, " \t\r");
	return ply->at == ply->end || *ply->at == '\n' ? "" : "has more numbers than the header says";
}

/// "" or what is wrong with one property of one element.
static const char* walk_property(Ply* ply, const Property* property) {
	long long count = 1, value = 0;
	if (property->count != NULL && !next_number(ply, property->count, &count)) return "is cut off or has no numbers";
	if (count < 0 || count > ply->end - ply->at + 1) return "has a list longer than the file";
	for (long long i = 0; i < count; i++) {
		if (!next_number(ply, property->value, &value)) return "is cut off or has no numbers";
		if (property->is_nodes && (value < 0 || value >= ply->vertex_count)) return "names a vertex that is not there";
	}
	return "";
}

static JnStatus walk(Ply* ply, const Element* element) {
	if (element->count > ply->end - ply->at) {
		return jn_error(JN_BAD_INPUT, "%s: declares %lld of '%s', but has %td bytes for them; it is cut off or damaged",
						ply->path, element->count, element->name, ply->end - ply->at);
	}
	for (long long i = 0; i < element->count; i++) {
		const char* fault = "";
		if (ply->is_text) skip(ply, " \t\r\n");
		for (int p = 0; p < element->property_count && fault[0] == '\0'; p++)
			fault = walk_property(ply, &element->properties[p]);
		if (fault[0] == '\0') fault = end_element(ply);
		if (fault[0] == '\0') continue;
		return jn_error(JN_BAD_INPUT, "%s: %s %lld of %lld %s; export the file again", ply->path, element->name, i,
						element->count, fault);
	}
	return JN_OK;
}

JnStatus jn_ply_check(const char* path, const JnContent* content) {
	JnArena scratch = {0};
	Ply* ply;
	JN_NEW(&scratch, ply, 1);
	*ply = (Ply){.path = path, .at = content->data, .end = content->data + content->size};
	JnStatus status = read_header(ply);
	for (int i = 0; status == JN_OK && i < ply->element_count; i++) status = walk(ply, &ply->elements[i]);
	jn_arena_free(&scratch);
	return status;
}
