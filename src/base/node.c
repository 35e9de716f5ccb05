// YAML text to nodes by recursive descent over libyaml's events. An entry of a mapping has the place of its key.
// Children grow by doubling; the room follows from their count, so that overrides can append as well.
#include "base/node.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "base/log.h"

typedef struct Reader {
	yaml_parser_t yaml;
	yaml_event_t event; // the current one
	const char *source, *text;
	JnPlaces places;
	JnArena* arena;
	int node_count;
} Reader;

static JnStatus complain(const Reader* reader, yaml_mark_t mark, const char* what) {
	if (reader->places == JN_PLACES_NONE) return jn_error(JN_BAD_INPUT, "%s: %s", reader->source, what);
	return jn_error(JN_BAD_INPUT, "%s:%zu:%zu: %s", reader->source, mark.line + 1, mark.column + 1, what);
}

// Bytes that are no UTF-8 are reported by libyaml with an offset alone.
static yaml_mark_t mark_of_offset(const char* text, size_t offset) {
	yaml_mark_t mark = {0};
	for (size_t i = 0; i < offset && text[i] != '\0'; i++) {
		mark.column = text[i] == '\n' ? 0 : mark.column + 1;
		mark.line += text[i] == '\n';
	}
	return mark;
}

static bool line_starts_with_tab(const char* text, size_t line) {
	for (; line > 0 && text != NULL; line--) {
		text = strchr(text, '\n');
		if (text != NULL) text++;
	}
	return text != NULL && text[strspn(text, " ")] == '\t';
}

static JnStatus complain_syntax(const Reader* reader) {
	const yaml_parser_t* yaml = &reader->yaml;
	if (yaml->error == YAML_MEMORY_ERROR) return jn_error(JN_OUT_OF_MEMORY, "%s: out of memory", reader->source);
	char message[512];
	if (yaml->error == YAML_READER_ERROR) {
		snprintf(message, sizeof message, "the text is no valid UTF-8: %s", yaml->problem);
		return complain(reader, mark_of_offset(reader->text, yaml->problem_offset), message);
	}
	const int length = snprintf(message, sizeof message, "the YAML is broken: %s", yaml->problem);
	if (yaml->context != NULL && length < (int)sizeof message) {
		snprintf(message + length, sizeof message - (size_t)length, ", %s that begins on line %zu", yaml->context,
				 yaml->context_mark.line + 1);
	}
	if (line_starts_with_tab(reader->text, yaml->problem_mark.line)) {
		strncat(message, "; indent with spaces, not with tabs", sizeof message - strlen(message) - 1);
	}
	return complain(reader, yaml->problem_mark, message);
}

static JnStatus advance(Reader* reader) {
	yaml_event_delete(&reader->event);
	return yaml_parser_parse(&reader->yaml, &reader->event) ? JN_OK : complain_syntax(reader);
}

static JnStatus refuse_decorations(const Reader* reader) {
	const yaml_event_t* event = &reader->event;
	const bool is_list = event->type == YAML_SEQUENCE_START_EVENT;
	const bool is_scalar = event->type == YAML_SCALAR_EVENT;
	const yaml_char_t* anchor = is_scalar ? event->data.scalar.anchor
								: is_list ? event->data.sequence_start.anchor
										  : event->data.mapping_start.anchor;
	const yaml_char_t* tag = is_scalar ? event->data.scalar.tag
							 : is_list ? event->data.sequence_start.tag
									   : event->data.mapping_start.tag;
	if (anchor != NULL) return complain(reader, event->start_mark, "anchors (&name) are not allowed; write it out");
	if (tag != NULL) return complain(reader, event->start_mark, "tags (!name) are not allowed; leave it out");
	return JN_OK;
}

static JnStatus copy_scalar(const Reader* reader, const char** text) {
	const char* value = (const char*)reader->event.data.scalar.value;
	if (strlen(value) != reader->event.data.scalar.length) {
		return complain(reader, reader->event.start_mark, "a zero character inside a value is not allowed");
	}
	*text = jn_arena_text(reader->arena, value);
	return *text != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static void set_place(const Reader* reader, yaml_mark_t mark, JnNode* node) {
	if (reader->places == JN_PLACES_NONE) return;
	node->line = (int)mark.line + 1;
	node->column = (int)mark.column + 1;
}

static int by_name_then_place(const void* left, const void* right) {
	const JnNode *a = *(JnNode*const*)left, *b = *(JnNode*const*)right;
	const int names = strcmp(a->name, b->name);
	if (names != 0) return names;
	return a->line != b->line ? (a->line > b->line) - (a->line < b->line) : a->column - b->column;
}

// Sorting keeps a mapping of a million entries from taking a trillion comparisons.
static JnStatus refuse_duplicates(const Reader* reader, const JnNode* mapping) {
	if (mapping->count < 2) return JN_OK;
	const size_t count = (size_t)mapping->count;
	const JnNode** sorted = malloc(count * sizeof *sorted);
	if (sorted == NULL) return jn_error(JN_OUT_OF_MEMORY, "%s: out of memory", reader->source);
	memcpy(sorted, mapping->children, count * sizeof *sorted);
	qsort(sorted, count, sizeof *sorted, by_name_then_place);
	size_t i = 1;
	while (i < count && strcmp(sorted[i - 1]->name, sorted[i]->name) != 0) i++;
	const JnNode *first = i < count ? sorted[i - 1] : NULL, *second = i < count ? sorted[i] : NULL;
	free(sorted);
	if (first == NULL) return JN_OK;
	char place[JN_NODE_PLACE_SIZE];
	jn_node_place(second, sizeof place, place);
	if (second->line == 0) return jn_error(JN_BAD_INPUT, "%s: the key '%s' is given twice", place, second->name);
	return jn_error(JN_BAD_INPUT, "%s: the key '%s' is given twice, first on line %d; remove one", place, second->name,
					first->line);
}

static JnStatus read_node(Reader* reader, int depth, JnNode** out);

static JnStatus read_entry(Reader* reader, int depth, JnNode** out) {
	const yaml_mark_t mark = reader->event.start_mark;
	const char* name = NULL;
	if (reader->event.type == YAML_ALIAS_EVENT) return complain(reader, mark, "aliases (*name) are not allowed");
	if (reader->event.type != YAML_SCALAR_EVENT) return complain(reader, mark, "a key must be a single word");
	JN_TRY(refuse_decorations(reader));
	JN_TRY(copy_scalar(reader, &name));
	if (name[0] == '\0') return complain(reader, mark, "a key is missing before ':'");
	JN_TRY(advance(reader));
	JN_TRY(read_node(reader, depth, out));
	(*out)->name = name;
	set_place(reader, mark, *out);
	return JN_OK;
}

static JnStatus read_children(Reader* reader, int depth, JnNode* parent) {
	const bool is_mapping = parent->kind == JN_NODE_MAPPING;
	const yaml_event_type_t end = is_mapping ? YAML_MAPPING_END_EVENT : YAML_SEQUENCE_END_EVENT;
	if (depth >= JN_NODE_DEPTH_LIMIT) {
		return complain(reader, reader->event.start_mark, "nested too deeply: 64 levels are allowed");
	}
	JN_TRY(advance(reader));
	while (reader->event.type != end) {
		JnNode* child = NULL;
		JN_TRY(is_mapping ? read_entry(reader, depth + 1, &child) : read_node(reader, depth + 1, &child));
		JN_TRY(jn_node_append(parent, child, reader->arena));
		JN_TRY(advance(reader));
	}
	return is_mapping ? refuse_duplicates(reader, parent) : JN_OK;
}

// On entry the current event is the node's first one, on exit its last one.
static JnStatus read_node(Reader* reader, int depth, JnNode** out) {
	const yaml_mark_t mark = reader->event.start_mark;
	if (reader->event.type == YAML_ALIAS_EVENT) {
		return complain(reader, mark, "aliases (*name) are not allowed; write the value out");
	}
	if (++reader->node_count > JN_NODE_COUNT_LIMIT) return complain(reader, mark, "more than 1000000 values");
	JN_TRY(refuse_decorations(reader));
	JnNode* node;
	JN_NEW(reader->arena, node, 1);
	node->source = reader->source;
	set_place(reader, mark, node);
	*out = node;
	if (reader->event.type == YAML_SCALAR_EVENT) {
		node->kind = JN_NODE_SCALAR;
		return copy_scalar(reader, &node->scalar);
	}
	node->kind = reader->event.type == YAML_MAPPING_START_EVENT ? JN_NODE_MAPPING : JN_NODE_SEQUENCE;
	return read_children(reader, depth, node);
}

static JnStatus read_stream(Reader* reader, JnNode** root) {
	*root = NULL;
	JN_TRY(advance(reader)); // stream start
	JN_TRY(advance(reader)); // document start
	if (reader->event.type == YAML_STREAM_END_EVENT) return JN_OK;
	JN_TRY(advance(reader));
	JN_TRY(read_node(reader, 0, root));
	JN_TRY(advance(reader)); // document end
	JN_TRY(advance(reader));
	if (reader->event.type == YAML_STREAM_END_EVENT) return JN_OK;
	return complain(reader, reader->event.start_mark, "a second document begins; one is allowed");
}

JnStatus jn_node_parse(const char* source, const char* text, JnPlaces places, JnArena* arena, JnNode** root) {
	Reader reader = {.source = source, .text = text, .places = places, .arena = arena};
	if (!yaml_parser_initialize(&reader.yaml)) return jn_error(JN_OUT_OF_MEMORY, "%s: out of memory", source);
	yaml_parser_set_encoding(&reader.yaml, YAML_UTF8_ENCODING);
	const size_t mark_length = strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; // a byte order mark
	yaml_parser_set_input_string(&reader.yaml, (const unsigned char*)text + mark_length, strlen(text) - mark_length);
	const JnStatus status = read_stream(&reader, root);
	yaml_event_delete(&reader.event);
	yaml_parser_delete(&reader.yaml);
	return status;
}

JnStatus jn_node_append(JnNode* parent, JnNode* child, JnArena* arena) {
	const int count = parent->count;
	const bool is_full = count == 0 || (count >= 4 && (count & (count - 1)) == 0);
	if (is_full) {
		JnNode** children;
		JN_NEW(arena, children, count == 0 ? 4 : 2 * count);
		if (count > 0) memcpy(children, parent->children, (size_t)count * sizeof *children);
		parent->children = children;
	}
	parent->children[parent->count++] = child;
	return JN_OK;
}

void jn_node_place(const JnNode* node, size_t size, char* place) {
	if (node->line == 0)
		snprintf(place, size, "%s", node->source);
	else
		snprintf(place, size, "%s:%d:%d", node->source, node->line, node->column);
}

bool jn_node_is_null(const JnNode* node) {
	if (node->kind != JN_NODE_SCALAR) return false;
	return node->scalar[0] == '\0' || strcmp(node->scalar, "null") == 0 || strcmp(node->scalar, "~") == 0;
}
