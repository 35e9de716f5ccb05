// Messages of the key reader: where it stands, what was found, which names there are.
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/key_reader.h"
#include "base/log.h"
#include "base/node.h"

size_t jn_key_enter(JnKeyReader* reader, const char* name, int index) {
	const size_t mark = strlen(reader->path);
	char* end = reader->path + mark;
	const size_t room = sizeof reader->path - mark;
	if (name == NULL)
		snprintf(end, room, "[%d]", index);
	else
		snprintf(end, room, "%s%s", mark > 0 ? "." : "", name);
	return mark;
}

void jn_key_leave(JnKeyReader* reader, size_t mark) {
	reader->path[mark] = '\0';
}

JnStatus jn_key_error(const JnKeyReader* reader, const JnNode* node, const char* format, ...) {
	char place[JN_NODE_PLACE_SIZE] = "", message[1024];
	if (node != NULL) jn_node_place(node, sizeof place, place);
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(message, sizeof message, format, arguments);
	va_end(arguments);
	return jn_error(JN_BAD_INPUT, "%s%s%s%s%s", place, place[0] != '\0' ? ": " : "", reader->path,
					reader->path[0] != '\0' ? ": " : "", message);
}

JnStatus jn_key_kind_error(const JnKeyReader* reader, const JnNode* node, const char* expected) {
	if (node->kind == JN_NODE_SEQUENCE) return jn_key_error(reader, node, "is a list, but %s", expected);
	if (node->kind == JN_NODE_MAPPING) return jn_key_error(reader, node, "is a mapping, but %s", expected);
	if (node->scalar[0] == '\0') return jn_key_error(reader, node, "is empty, but %s", expected);
	return jn_key_error(reader, node, "'%.200s' is a single value, but %s", node->scalar, expected);
}

const char* jn_names_next(void* context, int index) {
	const JnNames* names = context;
	if (names->tag != NULL && index-- == 0) return names->tag;
	const JnKey* key = names->keys;
	for (; key != NULL && key->name != NULL; key++) {
		if (index-- == 0) return key->name;
	}
	const int row_count = names->rows != NULL ? names->rows->count : 0;
	if (index < row_count) return names->rows->rows[index]->name;
	index -= row_count;
	const char* const* word = names->words;
	for (; word != NULL && *word != NULL; word++) {
		if (index-- == 0) return *word;
	}
	return NULL;
}

void jn_names_suggest(JnNames names, const char* word, size_t size, char* sentence) {
	const char* near = jn_suggest(word, jn_names_next, &names);
	sentence[0] = '\0';
	if (near != NULL) snprintf(sentence, size, "; did you mean '%s'?", near);
}

void jn_names_list(JnNames names, size_t size, char* text) {
	size_t used = 0;
	text[0] = '\0';
	const char* name;
	for (int i = 0; (name = jn_names_next(&names, i)) != NULL; i++) {
		const size_t needed = strlen(name) + 2;
		if (used + needed + sizeof ", ..." > size) {
			snprintf(text + used, size - used, ", ...");
			return;
		}
		used += (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : "", name);
	}
}

static bool is_bound(double value) {
	return fabs(value) < DBL_MAX; // neither infinite nor the largest number, which means the same
}

void jn_bounds_text(const JnKey* key, size_t size, char* text) {
	text[0] = '\0';
	if (key->low == 0 && key->high == 0) return;
	if (!is_bound(key->low) && !is_bound(key->high)) return;
	char low[32] = "-infinity", high[32] = "infinity";
	if (is_bound(key->low)) snprintf(low, sizeof low, "%.10g", key->low);
	if (is_bound(key->high)) snprintf(high, sizeof high, "%.10g", key->high);
	const bool low_is_open = (key->open & JN_OPEN_LOW) != 0 || !is_bound(key->low);
	const bool high_is_open = (key->open & JN_OPEN_HIGH) != 0 || !is_bound(key->high);
	snprintf(text, size, "%s%s, %s%s", low_is_open ? "(" : "[", low, high, high_is_open ? ")" : "]");
}
