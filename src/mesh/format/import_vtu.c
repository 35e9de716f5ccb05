// VTK's XML unstructured grids, by libxml2. XML cannot hold the raw bytes of an AppendedData element, so that the text is
// cut there first. No file is trusted with a document type: entities could ask for other files, or for all memory.
#include <libxml/parser.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "mesh/format/content.h"
#include "mesh/format/import.h"
#include "mesh/format/vtk_cells.h"
#include "mesh/format/vtu_data.h"

typedef struct Reader {
	JnVtuFile file;
	JnArena scratch;
	JnArena* arena; // of the mesh
	xmlDoc* document;
	JnVtkCells cells;
} Reader;

/// The first child element of that name, or NULL.
static xmlNode* child_of(xmlNode* parent, const char* name) {
	for (xmlNode* node = parent != NULL ? parent->children : NULL; node != NULL; node = node->next)
		if (node->type == XML_ELEMENT_NODE && xmlStrEqual(node->name, BAD_CAST name)) return node;
	return NULL;
}

static bool attribute_is(xmlNode* node, const char* name, const char* value) {
	xmlChar* text = xmlGetProp(node, BAD_CAST name);
	const bool is_equal = xmlStrEqual(text, BAD_CAST value);
	xmlFree(text);
	return is_equal;
}

static bool has_attribute(xmlNode* node, const char* name) {
	return xmlHasProp(node, BAD_CAST name) != NULL;
}

/// A count in an attribute; false when it is none.
static bool read_count(xmlNode* node, const char* name, size_t* out) {
	xmlChar* text = xmlGetProp(node, BAD_CAST name);
	unsigned long long value = 0;
	char rest;
	const bool is_count = text != NULL && strchr((const char*)text, '-') == NULL &&
						  sscanf((const char*)text, "%llu %c", &value, &rest) == 1;
	xmlFree(text);
	*out = (size_t)value;
	return is_count;
}

// ---- from bytes to a document ----

static const char* find_last(const char* from, const char* end, const char* text) {
	const size_t length = strlen(text);
	for (const char* at = end - length; at >= from; --at)
		if (memcmp(at, text, length) == 0) return at;
	return NULL;
}

/// Where the text of the document stops: at its end, or behind the opening tag of AppendedData, which is set.
static JnStatus cut_appended(Reader* reader, const JnContent* content, const char** stop) {
	const char* end = content->data + content->size;
	const char* tag = jn_content_find(content->data, end, "<AppendedData");
	*stop = end;
	if (tag == NULL) return JN_OK;
	const char* close = memchr(tag, '>', (size_t)(end - tag));
	const char* start = close != NULL ? memchr(close, '_', (size_t)(end - close)) : NULL;
	const char* last = start != NULL ? find_last(start, end, "</AppendedData") : NULL;
	if (last == NULL) return jn_error(JN_BAD_INPUT, "%s: AppendedData is cut off", reader->file.path);
	*stop = close + 1;
	reader->file.appended = (const unsigned char*)start + 1;
	reader->file.appended_end = (const unsigned char*)last;
	return JN_OK;
}

static JnStatus parse(Reader* reader, const char* text, size_t size) {
	const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_HUGE |
						XML_PARSE_IGNORE_ENC | XML_PARSE_BIG_LINES;
	xmlParserCtxt* parser = xmlNewParserCtxt();
	if (parser == NULL) return JN_OUT_OF_MEMORY;
	reader->document = xmlCtxtReadMemory(parser, text, (int)size, NULL, "UTF-8", options);
	const xmlError* error = reader->document == NULL ? xmlCtxtGetLastError(parser) : NULL;
	if (reader->document == NULL) {
		const char* words = error != NULL && error->message != NULL ? error->message : "not XML";
		jn_error(JN_BAD_INPUT, "%s: line %d: %.*s", reader->file.path, error != NULL ? error->line : 0,
				 (int)strcspn(words, "\n"), words);
	}
	xmlFreeParserCtxt(parser);
	return reader->document != NULL ? JN_OK : JN_BAD_INPUT;
}

static JnStatus read_document(Reader* reader) {
	static const char closing[] = "</AppendedData></VTKFile>";
	JnContent content;
	const char* stop;
	JN_TRY(jn_content_read(reader->file.path, &reader->scratch, &content));
	JN_TRY(cut_appended(reader, &content, &stop));
	if (jn_content_find(content.data, stop, "<!DOCTYPE") != NULL)
		return jn_error(JN_BAD_INPUT, "%s: has a document type, which .vtu files have not", reader->file.path);
	const size_t size = (size_t)(stop - content.data);
	if (reader->file.appended == NULL) return parse(reader, content.data, size);
	char* text;
	JN_NEW(&reader->scratch, text, size + sizeof closing);
	memcpy(text, content.data, size);
	memcpy(text + size, closing, sizeof closing);
	return parse(reader, text, size + sizeof closing - 1);
}

// ---- from a document to cells ----

static JnStatus read_head(Reader* reader, xmlNode* root) {
	JnVtuFile* file = &reader->file;
	if (!xmlStrEqual(root->name, BAD_CAST "VTKFile") || !attribute_is(root, "type", "UnstructuredGrid"))
		return jn_error(JN_BAD_INPUT, "%s: is not a VTKFile of type UnstructuredGrid", file->path);
	file->is_big_endian = attribute_is(root, "byte_order", "BigEndian");
	file->is_compressed = has_attribute(root, "compressor");
	file->header_size = attribute_is(root, "header_type", "UInt64") ? 8 : 4;
	if (has_attribute(root, "header_type") && file->header_size == 4 && !attribute_is(root, "header_type", "UInt32"))
		return jn_error(JN_BAD_INPUT, "%s: its header_type is neither UInt32 nor UInt64", file->path);
	if (file->is_compressed && !attribute_is(root, "compressor", "vtkZLibDataCompressor"))
		return jn_error(JN_BAD_INPUT, "%s: its compressor is not vtkZLibDataCompressor; save it with zlib", file->path);
	file->appended_is_raw = !attribute_is(child_of(root, "AppendedData"), "encoding", "base64");
	return JN_OK;
}

static xmlNode* array_named(xmlNode* parent, const char* name) {
	for (xmlNode* node = child_of(parent, "DataArray"); node != NULL; node = node->next)
		if (node->type == XML_ELEMENT_NODE && (name == NULL || attribute_is(node, "Name", name))) return node;
	return NULL;
}

static JnStatus read_array(Reader* reader, xmlNode* parent, const char* name, JnVtkAs as, JnVtkNumbers* out) {
	xmlNode* array = array_named(parent, name);
	if (array != NULL) return jn_vtu_numbers(&reader->file, array, as, &reader->scratch, out);
	return jn_error(JN_BAD_INPUT, "%s: has no DataArray of %s", reader->file.path, name != NULL ? name : "Points");
}

static JnStatus expect_count(const Reader* reader, const char* name, size_t count, size_t expected) {
	if (count == expected) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: %s has %zu numbers where %zu are declared", reader->file.path, name, count,
					expected);
}

static JnStatus read_points(Reader* reader, xmlNode* piece) {
	JnVtkNumbers points;
	JN_TRY(read_array(reader, child_of(piece, "Points"), NULL, JN_VTK_REAL, &points));
	JN_TRY(expect_count(reader, "Points", points.count / 3, reader->cells.point_count));
	JN_TRY(expect_count(reader, "Points", points.count % 3, 0));
	JN_NEW(reader->arena, reader->cells.points, points.count + 1);
	memcpy(reader->cells.points, points.real, points.count * sizeof(double));
	return JN_OK;
}

static JnStatus read_cells(Reader* reader, xmlNode* piece) {
	xmlNode* parent = child_of(piece, "Cells");
	JnVtkNumbers connectivity, offsets, types;
	JN_TRY(read_array(reader, parent, "connectivity", JN_VTK_WHOLE, &connectivity));
	JN_TRY(read_array(reader, parent, "offsets", JN_VTK_WHOLE, &offsets));
	JN_TRY(read_array(reader, parent, "types", JN_VTK_WHOLE, &types));
	JN_TRY(expect_count(reader, "offsets", offsets.count, reader->cells.cell_count));
	JN_TRY(expect_count(reader, "types", types.count, reader->cells.cell_count));
	reader->cells.connectivity_count = connectivity.count;
	reader->cells.connectivity = connectivity.whole;
	reader->cells.offsets = offsets.whole;
	reader->cells.types = types.whole;
	return JN_OK;
}

static JnStatus read_set(Reader* reader, xmlNode* array, const char* name) {
	const size_t prefix = strlen(JN_VTK_SET_PREFIX);
	JnVtkNumbers marks;
	if (strncmp(name, JN_VTK_SET_PREFIX, prefix) != 0) return JN_OK;
	JN_TRY(jn_vtu_numbers(&reader->file, array, JN_VTK_REAL, &reader->scratch, &marks));
	JN_TRY(expect_count(reader, name, marks.count, reader->cells.point_count));
	return jn_vtk_set(name + prefix, strlen(name) - prefix, marks.real, marks.count, reader->arena,
					  &reader->cells.sets[reader->cells.set_count++]);
}

static JnStatus read_sets(Reader* reader, xmlNode* piece) {
	xmlNode* parent = child_of(piece, "PointData");
	if (parent == NULL) return JN_OK;
	JN_NEW(reader->arena, reader->cells.sets, xmlChildElementCount(parent) + 1);
	for (xmlNode* node = child_of(parent, "DataArray"); node != NULL; node = node->next) {
		xmlChar* name = node->type == XML_ELEMENT_NODE ? xmlGetProp(node, BAD_CAST "Name") : NULL;
		const JnStatus status = name != NULL ? read_set(reader, node, (const char*)name) : JN_OK;
		xmlFree(name);
		JN_TRY(status);
	}
	return JN_OK;
}

/// The one piece; empty ones beside it are passed over.
static JnStatus find_piece(Reader* reader, xmlNode* grid, xmlNode** out) {
	*out = NULL;
	for (xmlNode* node = child_of(grid, "Piece"); node != NULL; node = node->next) {
		size_t points, cells;
		if (node->type != XML_ELEMENT_NODE || !xmlStrEqual(node->name, BAD_CAST "Piece")) continue;
		if (!read_count(node, "NumberOfPoints", &points) || !read_count(node, "NumberOfCells", &cells))
			return jn_error(JN_BAD_INPUT, "%s: a Piece has no NumberOfPoints or NumberOfCells", reader->file.path);
		if (points == 0 && cells == 0) continue;
		if (*out != NULL) return jn_error(JN_BAD_INPUT, "%s: has several pieces; save it as one", reader->file.path);
		*out = node;
		reader->cells.point_count = points;
		reader->cells.cell_count = cells;
	}
	return *out != NULL ? JN_OK : jn_error(JN_BAD_INPUT, "%s: has no Piece with points", reader->file.path);
}

static JnStatus read_file(Reader* reader, JnImport* out) {
	JN_TRY(read_document(reader));
	xmlNode *root = xmlDocGetRootElement(reader->document), *piece;
	JN_TRY(read_head(reader, root));
	JN_TRY(find_piece(reader, child_of(root, "UnstructuredGrid"), &piece));
	JN_TRY(read_points(reader, piece));
	JN_TRY(read_cells(reader, piece));
	JN_TRY(read_sets(reader, piece));
	return jn_vtk_cells_import(reader->file.path, &reader->cells, reader->arena, out);
}

static JnStatus read_vtu(const char* path, JnArena* arena, JnImport* out) {
	Reader reader = {.file = {.path = path}, .arena = arena};
	*out = (JnImport){0};
	const JnStatus status = read_file(&reader, out);
	if (reader.document != NULL) xmlFreeDoc(reader.document);
	jn_arena_free(&reader.scratch);
	return status;
}

extern const JnImportFormat jn_import_vtu;
const JnImportFormat jn_import_vtu = {"VTK XML", "vtu", read_vtu};
