// Gmsh's nodes and elements have tags: any positive numbers, in any order. Here they become 0, 1, 2, ... in rising order
// of tags. What Gmsh hands out is freed at once or ends with the process.
#include "mesh/format/gmsh_model.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "mesh/format/gmsh_stream.h"

int jn_gmsh_element_type(JnShape shape) {
	static const int types[JN_SHAPE_COUNT] = {
		[JN_TET4] = JN_GMSH_TET4, [JN_TET10] = JN_GMSH_TET10, [JN_HEX8] = JN_GMSH_HEX8};
	return types[shape];
}

void jn_gmsh_reorder(JnShape shape, size_t cells, int* nodes) {
	for (size_t cell = 0; cell < cells && shape == JN_TET10; ++cell) {
		int* last = nodes + 10 * cell + 8;
		const int swap = last[0];
		last[0] = last[1];
		last[1] = swap;
	}
}

#ifdef JN_GMSH_LIBRARY

typedef struct Tag {
	size_t tag;
	size_t place; // in Gmsh's list
} Tag;

typedef struct Writer {
	const JnGmsh* gmsh;
	const char* what;
	FILE* stream;
	JnArena arena;
	Tag* tags; // of nodes, ascending
	size_t node_count;
} Writer;

static int by_tag(const void* left, const void* right) {
	const Tag *a = left, *b = right;
	return (a->tag > b->tag) - (a->tag < b->tag);
}

/// Tags ascending, each once.
static JnStatus sort_tags(Writer* writer, const char* noun, const size_t* tags, size_t count, Tag** out) {
	JN_NEW(&writer->arena, *out, count + 1);
	for (size_t i = 0; i < count; ++i) (*out)[i] = (Tag){tags[i], i};
	qsort(*out, count, sizeof **out, by_tag);
	for (size_t i = 1; i < count; ++i)
		if ((*out)[i - 1].tag == (*out)[i].tag)
			return jn_error(JN_BAD_INPUT, "%s: two %ss have the number %zu", writer->what, noun, (*out)[i].tag);
	return JN_OK;
}

/// The new number of a node, or -1.
static int number_of(const Writer* writer, size_t tag) {
	const Tag* found = bsearch(&(Tag){tag, 0}, writer->tags, writer->node_count, sizeof(Tag), by_tag);
	return found != NULL ? (int)(found - writer->tags) : -1;
}

static JnStatus write_bytes(Writer* writer, const void* data, size_t count, size_t size) {
	if (fwrite(data, size, count, writer->stream) == count) return JN_OK;
	return jn_error(JN_OUT_OF_MEMORY, "%s: no memory for its mesh", writer->what);
}

typedef struct Elements {
	size_t shape; // JnShape, or JN_GMSH_SURFACE
	int type;     // Gmsh's; 0: there are none
	size_t count; // elements
	size_t *tags, *nodes;
	size_t node_count; // of `nodes`
} Elements;

/// The one type of elements of that dimension, 0 when there are none.
static JnStatus find_type(const Writer* writer, int dimension, Elements* out) {
	static const Elements known[] = {{.shape = JN_TET4, .type = JN_GMSH_TET4},
									 {.shape = JN_TET10, .type = JN_GMSH_TET10},
									 {.shape = JN_HEX8, .type = JN_GMSH_HEX8},
									 {.shape = JN_GMSH_SURFACE, .type = JN_GMSH_TRIANGLE}};
	int *types = NULL, error = 0;
	size_t count = 0;
	*out = (Elements){0};
	writer->gmsh->ModelMeshGetElementTypes(&types, &count, dimension, -1, &error);
	JN_TRY(jn_gmsh_check(writer->gmsh, error, writer->what, "list its cells"));
	if (count == 0) return JN_OK;
	for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i)
		if (known[i].type == types[0]) *out = known[i];
	const char* wanted = dimension == 3 ? "tet4, tet10 or hex8" : "flat triangles";
	if (count > 1)
		return jn_error(JN_BAD_INPUT, "%s: has cells of several types (Gmsh's %d and %d); all must be of one: %s",
						writer->what, types[0], types[1], wanted);
	if (out->type == 0)
		return jn_error(JN_BAD_INPUT, "%s: has cells of Gmsh's type %d; jounce knows %s", writer->what, types[0],
						wanted);
	return JN_OK;
}

static JnStatus get_elements(const Writer* writer, int type, Elements* out) {
	int error = 0;
	writer->gmsh->ModelMeshGetElementsByType(type, &out->tags, &out->count, &out->nodes, &out->node_count, -1, 0, 1,
											 &error);
	return jn_gmsh_check(writer->gmsh, error, writer->what, "list its cells");
}

/// All elements of all dimensions must be there: Gmsh passes over some damage in silence.
static JnStatus check_total(const Writer* writer, size_t expected) {
	int *types = NULL, error = 0;
	size_t count = 0, total = 0;
	writer->gmsh->ModelMeshGetElementTypes(&types, &count, -1, -1, &error);
	JN_TRY(jn_gmsh_check(writer->gmsh, error, writer->what, "list its cells"));
	for (size_t i = 0; i < count; ++i) {
		Elements elements = {0};
		JN_TRY(get_elements(writer, types[i], &elements));
		total += elements.count;
		writer->gmsh->Free(elements.tags);
		writer->gmsh->Free(elements.nodes);
	}
	if (total == expected) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: declares %zu elements and holds %zu", writer->what, expected, total);
}

static JnStatus write_nodes(Writer* writer, const double* coordinates) {
	for (size_t i = 0; i < writer->node_count; ++i) {
		const double* X = coordinates + 3 * writer->tags[i].place;
		if (!isfinite(X[0]) || !isfinite(X[1]) || !isfinite(X[2]))
			return jn_error(JN_BAD_INPUT, "%s: node %zu has a coordinate that is not finite", writer->what,
							writer->tags[i].tag);
		JN_TRY(write_bytes(writer, X, 3, sizeof *X));
	}
	return JN_OK;
}

static JnStatus write_cells(Writer* writer, const Elements* elements) {
	const size_t each = elements->node_count / elements->count;
	Tag* order;
	int cell[10] = {0};
	JN_TRY(sort_tags(writer, "element", elements->tags, elements->count, &order));
	for (size_t i = 0; i < elements->count; ++i) {
		for (size_t k = 0; k < each; ++k) {
			const size_t tag = elements->nodes[order[i].place * each + k];
			cell[k] = number_of(writer, tag);
			if (cell[k] < 0)
				return jn_error(JN_BAD_INPUT, "%s: element %zu names node %zu, which is not there", writer->what,
								order[i].tag, tag);
		}
		if (elements->shape == JN_TET10) jn_gmsh_reorder(JN_TET10, 1, cell);
		JN_TRY(write_bytes(writer, cell, each, sizeof *cell));
	}
	return JN_OK;
}

/// The name of a physical group; one without gets "surface_7", from its dimension and tag, but a volume none: it is
/// there to have its cells saved.
static JnStatus name_group(const Writer* writer, int dimension, int tag, char name[128]) {
	static const char* const nouns[] = {"point", "curve", "surface"};
	char* given = NULL;
	int error = 0;
	writer->gmsh->ModelGetPhysicalName(dimension, tag, &given, &error);
	JN_TRY(jn_gmsh_check(writer->gmsh, error, writer->what, "name its physical groups"));
	if (given != NULL && given[0] != '\0')
		snprintf(name, 128, "%s", given);
	else if (dimension < 3)
		snprintf(name, 128, "%s_%d", nouns[dimension], tag);
	else
		name[0] = '\0';
	writer->gmsh->Free(given);
	return JN_OK;
}

static JnStatus write_group(Writer* writer, int dimension, int tag) {
	size_t *tags = NULL, count = 0, unused = 0;
	double* coordinates = NULL;
	char name[128];
	int error = 0;
	JN_TRY(name_group(writer, dimension, tag, name));
	writer->gmsh->ModelMeshGetNodesForPhysicalGroup(dimension, tag, &tags, &count, &coordinates, &unused, &error);
	JN_TRY(jn_gmsh_check(writer->gmsh, error, writer->what, "list the nodes of its physical groups"));
	Tag* sorted;
	JN_TRY(sort_tags(writer, "node", tags, count, &sorted));
	const JnGmshSetHeader header = {strlen(name), count};
	JN_TRY(write_bytes(writer, &header, 1, sizeof header));
	JN_TRY(write_bytes(writer, name, header.name_length, 1));
	for (size_t i = 0; i < count; ++i) {
		const int number = number_of(writer, sorted[i].tag);
		JN_TRY(write_bytes(writer, &number, 1, sizeof number));
	}
	return JN_OK;
}

static JnStatus write_all(Writer* writer, const Elements* elements, const double* coordinates) {
	int *groups = NULL, error = 0;
	size_t numbers = 0;
	writer->gmsh->ModelGetPhysicalGroups(&groups, &numbers, -1, &error);
	JN_TRY(jn_gmsh_check(writer->gmsh, error, writer->what, "list its physical groups"));
	const size_t sets = elements->shape == JN_GMSH_SURFACE ? 0 : numbers / 2;
	const JnGmshHeader header = {elements->shape, writer->node_count, elements->node_count, sets};
	JN_TRY(write_bytes(writer, &header, 1, sizeof header));
	JN_TRY(write_nodes(writer, coordinates));
	JN_TRY(write_cells(writer, elements));
	for (size_t i = 0; i < sets; ++i) JN_TRY(write_group(writer, groups[2 * i], groups[2 * i + 1]));
	return JN_OK;
}

JnStatus jn_gmsh_model_write(const JnGmsh* gmsh, const char* what, const JnMshOutline* outline, FILE* stream) {
	Writer writer = {.gmsh = gmsh, .what = what, .stream = stream};
	size_t *tags = NULL, size = 0, no_parameters = 0;
	double *coordinates = NULL, *parameters = NULL;
	int error = 0;
	gmsh->ModelMeshGetNodes(&tags, &writer.node_count, &coordinates, &size, &parameters, &no_parameters, -1, -1, 0, 0,
							&error);
	JN_TRY(jn_gmsh_check(gmsh, error, what, "list its nodes"));
	const bool is_fewer = writer.node_count < outline->nodes && !outline->is_version_2;
	if (is_fewer || writer.node_count > outline->nodes || size != 3 * writer.node_count)
		return jn_error(JN_BAD_INPUT, "%s: declares %zu nodes and holds %zu", what, outline->nodes, writer.node_count);
	Elements elements;
	JN_TRY(find_type(&writer, 3, &elements));
	if (elements.type == 0) JN_TRY(find_type(&writer, 2, &elements));
	if (elements.type == 0) return jn_error(JN_BAD_INPUT, "%s: holds neither volume cells nor triangles", what);
	JN_TRY(check_total(&writer, outline->elements));
	JN_TRY(get_elements(&writer, elements.type, &elements));
	if (elements.node_count > INT_MAX || writer.node_count > INT_MAX / 3)
		return jn_error(JN_BAD_INPUT, "%s: has more cells or nodes than jounce can number", what);
	JN_TRY(sort_tags(&writer, "node", tags, writer.node_count, &writer.tags));
	return write_all(&writer, &elements, coordinates);
}

#endif
