#include "scene/place.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/node.h"

// Length of the key path at the start of a message, up to its colon; 0: there is none.
static size_t path_length(const char* message) {
	const size_t length = strspn(message, "abcdefghijklmnopqrstuvwxyz0123456789_.[]");
	return strncmp(message + length, ": ", 2) == 0 ? length : 0;
}

static const JnNode* child_by_name(const JnNode* node, const char* name, size_t length) {
	for (int i = 0; node->kind == JN_NODE_MAPPING && i < node->count; ++i)
		if (strncmp(node->children[i]->name, name, length) == 0 && node->children[i]->name[length] == '\0')
			return node->children[i];
	return NULL;
}

static const JnNode* child_by_index(const JnNode* node, long index) {
	const bool exists = node->kind == JN_NODE_SEQUENCE && index >= 0 && index < node->count;
	return exists ? node->children[index] : NULL;
}

// The entry at a path, or the last one on the way to it that is in the document: keys with defaults may be absent.
static const JnNode* find_nearest(const JnNode* root, const char* path, const char* end) {
	const JnNode *node = root, *next = root;
	while (path < end && next != NULL) {
		if (*path == '[') {
			char* behind;
			next = child_by_index(node, strtol(path + 1, &behind, 10));
			path = behind + (*behind == ']');
		} else {
			path += *path == '.';
			const size_t length = strcspn(path, ".[:");
			next = child_by_name(node, path, length);
			path += length;
		}
		if (next != NULL) node = next;
	}
	return node;
}

static void add_place(void* user, JnLogLevel level, const char* message) {
	const JnPlacing* placing = user;
	const size_t length = path_length(message);
	char place[JN_NODE_PLACE_SIZE], placed[2048 + JN_NODE_PLACE_SIZE];
	if (length > 0) {
		jn_node_place(find_nearest(placing->document->root, message, message + length), sizeof place, place);
		snprintf(placed, sizeof placed, "%s: %s", place, message);
	}
	placing->outer.sink(placing->outer.user, level, length > 0 ? placed : message);
}

void jn_placing_begin(JnPlacing* placing, const JnDocument* document) {
	placing->document = document;
	placing->outer = jn_log_swap((JnLog){add_place, placing});
}

void jn_placing_end(JnPlacing* placing) {
	jn_log_swap(placing->outer);
}
