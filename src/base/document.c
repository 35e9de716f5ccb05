// A YAML file as a document: reading the file, and the conditions on its root. The parsing itself is in node.c.
#include "base/document.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "base/node.h"

enum { FILE_LIMIT = 64 << 20 }; // bytes

// Read to the end in growing pieces, so that pipes work as well. `text` is malloc'ed, also on failure; it has room for
// a zero at the end.
static JnStatus read_all(FILE* file, const char* path, char** text, size_t* length) {
	size_t room = 1 << 16;
	*text = NULL;
	*length = 0;
	for (;;) {
		char* grown = realloc(*text, room + 1);
		if (grown == NULL) return jn_error(JN_OUT_OF_MEMORY, "%s: out of memory", path);
		*text = grown;
		*length += fread(grown + *length, 1, room - *length, file);
		if (ferror(file)) return jn_error(JN_IO_FAILED, "%s: cannot be read: %s", path, strerror(errno));
		if (*length > FILE_LIMIT) return jn_error(JN_BAD_INPUT, "%s: the file is larger than 64 MiB", path);
		if (*length < room) return JN_OK;
		room *= 2;
	}
}

static JnStatus parse_bytes(const char* path, char* text, size_t length, JnArena* arena, JnDocument* document) {
	if (memchr(text, '\0', length) != NULL) {
		return jn_error(JN_BAD_INPUT, "%s:1:1: the file is no UTF-8 text: it contains zero bytes", path);
	}
	text[length] = '\0';
	return jn_document_parse(path, text, arena, document);
}

JnStatus jn_document_read(const char* path, JnArena* arena, JnDocument* document) {
	*document = (JnDocument){0};
	FILE* file = fopen(path, "rb");
	if (file == NULL) return jn_error(JN_IO_FAILED, "%s: cannot be opened: %s", path, strerror(errno));
	char* text;
	size_t length;
	JnStatus status = read_all(file, path, &text, &length);
	fclose(file);
	if (status == JN_OK) status = parse_bytes(path, text, length, arena, document);
	free(text);
	return status;
}

JnStatus jn_document_parse(const char* path, const char* text, JnArena* arena, JnDocument* document) {
	*document = (JnDocument){.arena = arena};
	document->path = jn_arena_text(arena, path);
	document->text = jn_arena_text(arena, text);
	if (document->path == NULL || document->text == NULL) return JN_OUT_OF_MEMORY;
	JN_TRY(jn_node_parse(document->path, document->text, JN_PLACES_KEPT, arena, &document->root));
	const JnNode* root = document->root;
	if (root == NULL) return jn_error(JN_BAD_INPUT, "%s:1:1: the file is empty; 'key: value' lines are expected", path);
	if (root->kind == JN_NODE_MAPPING) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s:%d:%d: the file is %s, but 'key: value' lines are expected", path, root->line,
					root->column, root->kind == JN_NODE_SEQUENCE ? "a list" : "a single value");
}

JnNode* jn_node_find(const JnNode* mapping, const char* name) {
	if (mapping == NULL || mapping->kind != JN_NODE_MAPPING) return NULL;
	for (int i = 0; i < mapping->count; i++) {
		if (strcmp(mapping->children[i]->name, name) == 0) return mapping->children[i];
	}
	return NULL;
}
