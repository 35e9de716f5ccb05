// VTK's legacy files, versions 2 to 5, text and binary (big-endian): DATASET UNSTRUCTURED_GRID with POINTS, CELLS and
// CELL_TYPES; the data of points and cells is not read. Up to version 4, CELLS is a list of (count, points...); from 5 on
// it is two arrays, OFFSETS (the first is 0) and CONNECTIVITY. (Gmsh 4.8 aborts on version 5 and reads no text.)
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "mesh/format/content.h"
#include "mesh/format/import.h"
#include "mesh/format/vtk_cells.h"
#include "mesh/format/vtk_numbers.h"

typedef struct Reader {
	const char *path, *at, *end;
	bool is_binary;
	JnArena scratch;
	JnArena* arena; // of the mesh
	JnVtkCells cells;
} Reader;

enum { WORD_SIZE = 64 };

static bool is_space(char c) {
	return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The next word, cut to WORD_SIZE; empty at the end.
static void read_word(Reader* reader, char word[WORD_SIZE]) {
	int length = 0;
	while (reader->at < reader->end && is_space(*reader->at)) ++reader->at;
	for (; reader->at < reader->end && !is_space(*reader->at); ++reader->at)
		if (length < WORD_SIZE - 1) word[length++] = *reader->at;
	word[length] = '\0';
}

static void skip_line(Reader* reader) {
	const char* newline = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
	reader->at = newline != NULL ? newline + 1 : reader->end;
}

/// A count, against the rest of the file: every number takes a byte at least.
static JnStatus read_count(Reader* reader, const char* noun, size_t* count) {
	char word[WORD_SIZE], rest;
	unsigned long long value = 0;
	const size_t left = (size_t)(reader->end - reader->at);
	read_word(reader, word);
	if (word[0] == '-' || sscanf(word, "%llu%c", &value, &rest) != 1)
		return jn_error(JN_BAD_INPUT, "%s: the number of %s is \"%s\"", reader->path, noun, word);
	if (value > left)
		return jn_error(JN_BAD_INPUT, "%s: declares %llu %s, more than its %zu bytes can hold", reader->path, value,
						noun, left);
	*count = (size_t)value;
	return JN_OK;
}

static const JnVtkType* find_type(const char* name) {
	for (const JnVtkType* type = jn_vtk_types; type->name != NULL; ++type)
		if (strcmp(type->legacy_name, name) == 0) return type;
	return NULL;
}

static JnStatus read_array(Reader* reader, const char* noun, const char* type_name, size_t count, JnVtkAs as,
						   JnArena* arena, JnVtkNumbers* out) {
	const JnVtkType* type = find_type(type_name);
	if (type == NULL) return jn_error(JN_BAD_INPUT, "%s: the type of %s is \"%s\"", reader->path, noun, type_name);
	JnStatus status = JN_BAD_INPUT;
	skip_line(reader);
	if (!reader->is_binary)
		status = jn_vtk_from_text(&reader->at, reader->end, count, as, arena, out);
	else if (count <= (size_t)(reader->end - reader->at) / (size_t)type->size) {
		const size_t size = count * (size_t)type->size;
		status = jn_vtk_from_bytes((const unsigned char*)reader->at, size, type, true, as, arena, out);
		reader->at += size;
	}
	if (status == JN_OUT_OF_MEMORY) return status;
	if (status != JN_OK || out->count != count)
		return jn_error(JN_BAD_INPUT, "%s: %s are not %zu numbers of type %s", reader->path, noun, count, type_name);
	return JN_OK;
}

static JnStatus read_points(Reader* reader) {
	char type[WORD_SIZE];
	JnVtkNumbers numbers;
	JN_TRY(read_count(reader, "POINTS", &reader->cells.point_count));
	read_word(reader, type);
	JN_TRY(read_array(reader, "POINTS", type, 3 * reader->cells.point_count, JN_VTK_REAL, reader->arena, &numbers));
	reader->cells.points = numbers.real;
	return JN_OK;
}

/// (count, points...) for each cell.
static JnStatus split_list(Reader* reader, size_t cells, const JnVtkNumbers* list) {
	JN_NEW(&reader->scratch, reader->cells.offsets, cells + 1);
	JN_NEW(&reader->scratch, reader->cells.connectivity, list->count + 1);
	size_t at = 0, length = 0;
	for (size_t i = 0; i < cells; ++i) {
		const int64_t nodes = at < list->count ? list->whole[at] : -1;
		if (nodes < 0 || (uint64_t)nodes > list->count - at - 1)
			return jn_error(JN_BAD_INPUT, "%s: cell %zu does not fit in CELLS", reader->path, i);
		memcpy(reader->cells.connectivity + length, list->whole + at + 1, (size_t)nodes * sizeof *list->whole);
		length += (size_t)nodes;
		at += (size_t)nodes + 1;
		reader->cells.offsets[i] = (int64_t)length;
	}
	if (at != list->count) return jn_error(JN_BAD_INPUT, "%s: CELLS is longer than its cells", reader->path);
	reader->cells.cell_count = cells;
	reader->cells.connectivity_count = length;
	return JN_OK;
}

static JnStatus read_named_array(Reader* reader, const char* name, size_t count, JnVtkNumbers* out) {
	char word[WORD_SIZE], type[WORD_SIZE];
	read_word(reader, word);
	if (strcmp(word, name) != 0)
		return jn_error(JN_BAD_INPUT, "%s: has \"%s\" where %s should be", reader->path, word, name);
	read_word(reader, type);
	return read_array(reader, name, type, count, JN_VTK_WHOLE, &reader->scratch, out);
}

static JnStatus read_cells(Reader* reader) {
	size_t cells, size;
	JnVtkNumbers list;
	char word[WORD_SIZE];
	JN_TRY(read_count(reader, "CELLS", &cells));
	JN_TRY(read_count(reader, "numbers of CELLS", &size));
	const char* before = reader->at;
	read_word(reader, word);
	reader->at = before;
	if (strcmp(word, "OFFSETS") != 0) {
		JN_TRY(read_array(reader, "CELLS", "int", size, JN_VTK_WHOLE, &reader->scratch, &list));
		return split_list(reader, cells, &list);
	}
	JN_TRY(read_named_array(reader, "OFFSETS", cells, &list));
	if (cells == 0 || list.whole[0] != 0)
		return jn_error(JN_BAD_INPUT, "%s: OFFSETS does not begin with 0", reader->path);
	reader->cells.offsets = list.whole + 1;
	reader->cells.cell_count = cells - 1;
	JN_TRY(read_named_array(reader, "CONNECTIVITY", size, &list));
	reader->cells.connectivity = list.whole;
	reader->cells.connectivity_count = size;
	return JN_OK;
}

static JnStatus read_types(Reader* reader) {
	size_t count;
	JnVtkNumbers numbers;
	JN_TRY(read_count(reader, "CELL_TYPES", &count));
	JN_TRY(read_array(reader, "CELL_TYPES", "int", count, JN_VTK_WHOLE, &reader->scratch, &numbers));
	if (reader->cells.offsets == NULL || count != reader->cells.cell_count)
		return jn_error(JN_BAD_INPUT, "%s: has %zu cells and %zu CELL_TYPES", reader->path, reader->cells.cell_count,
						count);
	reader->cells.types = numbers.whole;
	return JN_OK;
}

/// FIELD name arrays, each: name components tuples type, numbers.
static JnStatus skip_field(Reader* reader) {
	char word[WORD_SIZE];
	size_t arrays, components, tuples;
	JnVtkNumbers numbers;
	read_word(reader, word);
	JN_TRY(read_count(reader, "arrays of FIELD", &arrays));
	for (size_t i = 0; i < arrays; ++i) {
		read_word(reader, word);
		JN_TRY(read_count(reader, "components", &components));
		JN_TRY(read_count(reader, "tuples", &tuples));
		read_word(reader, word);
		if (components > 0 && tuples > (size_t)(reader->end - reader->at) / components)
			return jn_error(JN_BAD_INPUT, "%s: an array of FIELD is longer than the file", reader->path);
		JN_TRY(read_array(reader, "FIELD", word, components * tuples, JN_VTK_REAL, &reader->scratch, &numbers));
	}
	return JN_OK;
}

/// METADATA goes on to the next empty line.
static JnStatus skip_metadata(Reader* reader) {
	skip_line(reader);
	while (reader->at < reader->end && *reader->at != '\n' && *reader->at != '\r') skip_line(reader);
	return JN_OK;
}

static JnStatus read_sections(Reader* reader) {
	static const struct {
		const char* name;
		JnStatus (*read)(Reader*);
	} sections[] = {{"POINTS", read_points},
					{"CELLS", read_cells},
					{"CELL_TYPES", read_types},
					{"METADATA", skip_metadata},
					{"FIELD", skip_field}};
	while (reader->cells.points == NULL || reader->cells.types == NULL) {
		char word[WORD_SIZE];
		size_t i = 0;
		read_word(reader, word);
		while (i < sizeof sections / sizeof sections[0] && strcmp(word, sections[i].name) != 0) ++i;
		if (i == sizeof sections / sizeof sections[0])
			return jn_error(JN_BAD_INPUT, "%s: has \"%s\" where POINTS, CELLS or CELL_TYPES should be", reader->path,
							word);
		JN_TRY(sections[i].read(reader));
	}
	return JN_OK;
}

static JnStatus read_head(Reader* reader) {
	char word[WORD_SIZE];
	if (strncmp(reader->at, "# vtk DataFile Version ", 23) != 0)
		return jn_error(JN_BAD_INPUT, "%s: does not begin with \"# vtk DataFile Version\", as .vtk files do",
						reader->path);
	skip_line(reader);
	skip_line(reader); // title
	read_word(reader, word);
	reader->is_binary = strcmp(word, "BINARY") == 0;
	if (!reader->is_binary && strcmp(word, "ASCII") != 0)
		return jn_error(JN_BAD_INPUT, "%s: is neither ASCII nor BINARY", reader->path);
	read_word(reader, word);
	if (strcmp(word, "DATASET") == 0) read_word(reader, word);
	if (strcmp(word, "UNSTRUCTURED_GRID") == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: its DATASET is \"%s\"; jounce reads UNSTRUCTURED_GRID", reader->path, word);
}

static JnStatus read_file(Reader* reader, JnImport* out) {
	JnContent content;
	JN_TRY(jn_content_read(reader->path, &reader->scratch, &content));
	reader->at = content.data;
	reader->end = content.data + content.size;
	JN_TRY(read_head(reader));
	JN_TRY(read_sections(reader));
	return jn_vtk_cells_import(reader->path, &reader->cells, reader->arena, out);
}

static JnStatus read_vtk(const char* path, JnArena* arena, JnImport* out) {
	Reader reader = {.path = path, .arena = arena};
	*out = (JnImport){0};
	const JnStatus status = read_file(&reader, out);
	jn_arena_free(&reader.scratch);
	return status;
}

extern const JnImportFormat jn_import_vtk;
const JnImportFormat jn_import_vtk = {"VTK", "vtk", read_vtk};
