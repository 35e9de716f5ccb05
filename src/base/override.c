// Overrides "a.b[0].c=value" on a document. The walk makes what is missing as a null entry, and the next step turns
// null into a mapping or list; at the end the value takes the entry's place.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/document.h"
#include "base/log.h"
#include "base/node.h"

// One step of a path: a name, or an index where the name is NULL.
typedef struct Segment {
	const char* name;
	int index;
} Segment;

typedef struct Override {
	JnArena* arena;
	const char* source; // "--set path=value", for messages
	const char* path;   // ends before the "="
	const char* cursor; // where the walk stands in it
	const char* end;
	const char* value;
} Override;

static JnStatus broken_path(const Override* override) {
	return jn_error(JN_BAD_INPUT,
					"%s: the path is broken at '%.*s'; write names joined by dots and list entries as [0], such as "
					"bodies[0].name=value",
					override->source, (int)(override->end - override->cursor), override->cursor);
}

static JnStatus read_index(Override* override, Segment* segment) {
	const char* digits = override->cursor + 1;
	const size_t length = strspn(digits, "0123456789");
	if (length == 0 || length > 7 || digits[length] != ']') return broken_path(override);
	*segment = (Segment){.index = atoi(digits)};
	override->cursor = digits + length + 1;
	return JN_OK;
}

static JnStatus read_name(Override* override, Segment* segment) {
	const char* start = override->cursor + (override->cursor > override->path); // behind the dot
	size_t length = strcspn(start, ".[]= \t");
	if (length == 0 || start + length > override->end) return broken_path(override);
	char* name = jn_arena_take(override->arena, length + 1, 1);
	if (name == NULL) return JN_OUT_OF_MEMORY;
	memcpy(name, start, length);
	*segment = (Segment){.name = name};
	override->cursor = start + length;
	return JN_OK;
}

static JnStatus read_segment(Override* override, Segment* segment) {
	const bool is_first = override->cursor == override->path;
	if (!is_first && *override->cursor == '[') return read_index(override, segment);
	if (!is_first && *override->cursor != '.') return broken_path(override);
	return read_name(override, segment);
}

static JnNode* new_null(const Override* override, const char* name) {
	JnNode* node = jn_arena_take(override->arena, 1, sizeof *node);
	if (node != NULL)
		*node = (JnNode){.kind = JN_NODE_SCALAR, .source = override->source, .name = name, .scalar = "null"};
	return node;
}

// Make sure that `node` can have an entry of the segment's sort; `reached` is the path up to it.
static JnStatus open_node(const Override* override, JnNode* node, const Segment* segment, const char* reached) {
	const JnNodeKind wanted = segment->name != NULL ? JN_NODE_MAPPING : JN_NODE_SEQUENCE;
	const int length = (int)(reached - override->path);
	if (node->kind == wanted) return JN_OK;
	if (jn_node_is_null(node)) {
		*node = (JnNode){.kind = wanted, .source = override->source, .name = node->name};
		return JN_OK;
	}
	if (node->kind == JN_NODE_SEQUENCE) {
		return jn_error(JN_BAD_INPUT, "%s: '%.*s' is a list; choose an entry, such as %.*s[0]", override->source,
						length, override->path, length, override->path);
	}
	if (node->kind == JN_NODE_MAPPING) {
		return jn_error(JN_BAD_INPUT, "%s: '%.*s' is a mapping and no list, so it has no [%d]", override->source,
						length, override->path, segment->index);
	}
	char place[JN_NODE_PLACE_SIZE];
	jn_node_place(node, sizeof place, place);
	if (segment->name == NULL) {
		return jn_error(JN_BAD_INPUT, "%s: '%.*s' is the single value '%s' (%s) and no list, so it has no [%d]",
						override->source, length, override->path, node->scalar, place, segment->index);
	}
	return jn_error(JN_BAD_INPUT,
					"%s: '%.*s' is the single value '%s' (%s), which has no entry '%s'; replace it as a whole: "
					"--set '%.*s={%s: value}'",
					override->source, length, override->path, node->scalar, place, segment->name, length,
					override->path, segment->name);
}

static JnStatus find_slot(const Override* override, JnNode* node, const Segment* segment, JnNode*** slot) {
	int index = segment->index;
	if (segment->name != NULL) {
		index = 0;
		while (index < node->count && strcmp(node->children[index]->name, segment->name) != 0) index++;
	}
	if (index > node->count) {
		return jn_error(JN_BAD_INPUT, "%s: there is no entry [%d] in a list of %d; [%d] would add one",
						override->source, index, node->count, node->count);
	}
	if (index == node->count) {
		JnNode* made = new_null(override, segment->name);
		if (made == NULL) return JN_OUT_OF_MEMORY;
		JN_TRY(jn_node_append(node, made, override->arena));
	}
	*slot = &node->children[index];
	return JN_OK;
}

static JnStatus apply(Override* override, JnNode* root) {
	JnNode* value = NULL;
	JN_TRY(jn_node_parse(override->source, override->value, JN_PLACES_NONE, override->arena, &value));
	if (value == NULL) return jn_error(JN_BAD_INPUT, "%s: the value is missing behind '='", override->source);
	JnNode** slot = &root;
	while (override->cursor < override->end) {
		const char* reached = override->cursor;
		Segment segment = {0};
		JN_TRY(read_segment(override, &segment));
		JN_TRY(open_node(override, *slot, &segment, reached));
		JN_TRY(find_slot(override, *slot, &segment, &slot));
	}
	value->name = (*slot)->name;
	*slot = value;
	return JN_OK;
}

JnStatus jn_document_set(JnDocument* document, const char* assignment) {
	static const char prefix[] = "--set ";
	const char* equals = strchr(assignment, '=');
	if (equals == NULL || equals == assignment) {
		return jn_error(JN_BAD_INPUT, "--set %s: write path=value, such as step.dt=10ms", assignment);
	}
	const size_t size = strlen(prefix) + strlen(assignment) + 1;
	char* source = jn_arena_take(document->arena, size, 1);
	if (source == NULL) return JN_OUT_OF_MEMORY;
	snprintf(source, size, "%s%s", prefix, assignment);
	const char* path = source + strlen(prefix);
	Override override = {.arena = document->arena, .source = source, .path = path, .cursor = path};
	override.end = path + (equals - assignment);
	override.value = override.end + 1;
	return apply(&override, document->root);
}
