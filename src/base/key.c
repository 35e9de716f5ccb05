// Structs from documents by key tables: unknown and missing keys, and the kinds that hold a table of their own.
// The message path grows and shrinks with the descent; an error leaves it where it arose.
#include "base/key.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "base/key_reader.h"
#include "base/node.h"

// A table at work: its keys and, where they are those of a variant's row, that row and the entry that names it.
typedef struct Table {
	const JnKey* keys; // NULL: none
	const JnRowList* rows;
	const JnRow* row;
	const char* tag;
} Table;

typedef JnStatus (*ReadField)(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);

static JnStatus read_table(JnKeyReader* reader, const Table* table, const JnNode* mapping, void* out);

static const JnKey* find_key(const JnKey* keys, const char* name) {
	for (const JnKey* key = keys; key != NULL && key->name != NULL; key++) {
		if (strcmp(key->name, name) == 0) return key;
	}
	return NULL;
}

const JnRow* jn_row_find(const JnRowList* list, const char* name) {
	for (int i = 0; i < list->count; i++) {
		if (strcmp(list->rows[i]->name, name) == 0) return list->rows[i];
	}
	return NULL;
}

static JnStatus refuse_unknown(JnKeyReader* reader, const Table* table, const JnNode* mapping) {
	for (int i = 0; i < mapping->count; i++) {
		const JnNode* entry = mapping->children[i];
		if (find_key(table->keys, entry->name) != NULL) continue;
		if (table->tag != NULL && strcmp(table->tag, entry->name) == 0) continue;
		const JnNames names = {.tag = table->tag, .keys = table->keys};
		char near[128], list[600], owner[128] = "";
		jn_names_suggest(names, entry->name, sizeof near, near);
		jn_names_list(names, sizeof list, list);
		if (table->row != NULL) {
			snprintf(owner, sizeof owner, " of the %s '%s'", table->rows->noun, table->row->name);
		}
		jn_key_enter(reader, entry->name, 0);
		return jn_key_error(reader, entry, "unknown key%s%s Keys here%s: %s", near, near[0] != '\0' ? "" : ".", owner,
							list[0] != '\0' ? list : "none");
	}
	return JN_OK;
}

static JnStatus complain_missing(const JnKeyReader* reader, const char* name, const char* meaning) {
	const bool is_known = meaning != NULL && meaning[0] != '\0';
	return jn_key_error(reader, reader->where, "the required key '%s' is missing%s%s%s", name, is_known ? " (" : "",
						is_known ? meaning : "", is_known ? ")" : "");
}

static JnStatus expect_mapping(JnKeyReader* reader, const JnNode* node) {
	if (node->kind == JN_NODE_MAPPING) return JN_OK;
	const bool is_null = jn_node_is_null(node);
	return jn_key_kind_error(reader, node,
							 is_null ? "'key: value' lines are expected; write {} for the defaults"
									 : "'key: value' lines are expected");
}

static JnStatus read_object(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	if (node != NULL) JN_TRY(expect_mapping(reader, node));
	return read_table(reader, &(Table){.keys = key->keys}, node, field);
}

static JnStatus read_optional(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	*(void**)field = NULL;
	if (node == NULL) return JN_OK;
	JN_TRY(expect_mapping(reader, node));
	void* data = jn_arena_take(reader->arena, 1, key->size);
	if (data == NULL) return JN_OUT_OF_MEMORY;
	*(void**)field = data;
	return read_table(reader, &(Table){.keys = key->keys}, node, data);
}

static JnStatus complain_row(const JnKeyReader* reader, const JnKey* key, const JnNode* node) {
	const JnNames names = {.rows = key->rows};
	char near[128], list[64];
	jn_names_suggest(names, node->scalar, sizeof near, near);
	snprintf(list, sizeof list, "%s", key->rows->noun);
	for (char* c = list; *c != '\0'; c++)
		if (*c == ' ') *c = '_';
	return jn_key_error(reader, node, "there is no %s '%.100s'%s%s 'jounce list %ss' shows all", key->rows->noun,
						node->scalar, near, near[0] != '\0' ? "" : ".", list);
}

// The row that the node names: by itself as a single word, by its tag entry, or by default. NULL: none is named.
static JnStatus find_row(JnKeyReader* reader, const JnKey* key, const JnNode* node, const JnRow** row) {
	*row = key->text != NULL && !key->required ? jn_row_find(key->rows, key->text) : NULL;
	if (node == NULL) return JN_OK;
	const bool is_word = node->kind == JN_NODE_SCALAR;
	if (node->kind == JN_NODE_SEQUENCE || (is_word && node->scalar[0] == '\0')) {
		char expected[200];
		snprintf(expected, sizeof expected, "the name of one %s, or 'key: value' lines with '%s:', is expected",
				 key->rows->noun, key->tag);
		return jn_key_kind_error(reader, node, expected);
	}
	const JnNode* name = is_word ? node : jn_node_find(node, key->tag);
	if (name == NULL) return JN_OK;
	const size_t mark = is_word ? strlen(reader->path) : jn_key_enter(reader, key->tag, 0);
	if (name->kind != JN_NODE_SCALAR) return jn_key_kind_error(reader, name, "one word is expected");
	*row = jn_row_find(key->rows, name->scalar);
	if (*row == NULL) return complain_row(reader, key, name);
	jn_key_leave(reader, mark);
	return JN_OK;
}

static JnStatus read_variant(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	assert(key->rows != NULL && key->tag != NULL);
	assert(key->text == NULL || jn_row_find(key->rows, key->text) != NULL);
	JnVariant* variant = field;
	*variant = (JnVariant){0};
	JN_TRY(find_row(reader, key, node, &variant->row));
	const JnRow* row = variant->row;
	if (row == NULL) {
		if (node == NULL) return JN_OK;
		char meaning[600] = "one of: ";
		jn_names_list((JnNames){.rows = key->rows}, sizeof meaning - 8, meaning + 8);
		reader->where = node;
		return complain_missing(reader, key->tag, meaning);
	}
	if (row->options_size > 0) variant->options = jn_arena_take(reader->arena, 1, row->options_size);
	if (row->options_size > 0 && variant->options == NULL) return JN_OUT_OF_MEMORY;
	const Table table = {.keys = row->keys, .rows = key->rows, .row = row, .tag = key->tag};
	const JnNode* mapping = node != NULL && node->kind == JN_NODE_MAPPING ? node : NULL;
	return read_table(reader, &table, mapping, variant->options);
}

static JnStatus read_list(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	JnItems* items = field;
	*items = (JnItems){0};
	if (node == NULL) return JN_OK;
	if (node->kind != JN_NODE_SEQUENCE) return jn_key_kind_error(reader, node, "a list is expected: lines with '- '");
	items->data = jn_arena_take(reader->arena, (size_t)node->count, key->size);
	if (items->data == NULL) return JN_OUT_OF_MEMORY;
	items->count = node->count;
	const ReadField read_item = key->rows != NULL ? read_variant : read_object;
	for (int i = 0; i < node->count; i++) {
		const size_t mark = jn_key_enter(reader, NULL, i);
		JN_TRY(read_item(reader, key, node->children[i], (char*)items->data + (size_t)i * key->size));
		jn_key_leave(reader, mark);
	}
	return JN_OK;
}

// The kinds by what reads them: `read` takes a node that exists, `nest` takes NULL for the default as well.
static const struct {
	ReadField read, nest;
} kinds[] = {
	[JN_REAL] = {.read = jn_read_real},         [JN_INTEGER] = {.read = jn_read_integer},
	[JN_SWITCH] = {.read = jn_read_switch},     [JN_TEXT] = {.read = jn_read_text},
	[JN_PATH] = {.read = jn_read_path},         [JN_REAL3] = {.read = jn_read_real3},
	[JN_INTEGER3] = {.read = jn_read_integer3}, [JN_POINTS] = {.read = jn_read_points},
	[JN_REAL2] = {.read = jn_read_real2},       [JN_INTEGER2] = {.read = jn_read_integer2},
	[JN_CHOICE] = {.read = jn_read_choice},     [JN_OBJECT] = {.nest = read_object},
	[JN_OPTIONAL] = {.nest = read_optional},    [JN_LIST] = {.nest = read_list},
	[JN_VARIANT] = {.nest = read_variant},
};

// `null` leaves an optional part out: the way to switch it off from the command line.
static bool leaves_out(const JnKey* key, const JnNode* node) {
	return key->kind == JN_OPTIONAL && jn_node_is_null(node) && node->scalar[0] != '\0';
}

static JnStatus read_key(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	if (node != NULL && leaves_out(key, node)) node = NULL;
	if (node == NULL && key->required && reader->requires) return complain_missing(reader, key->name, key->meaning);
	const size_t mark = jn_key_enter(reader, key->name, 0);
	const ReadField nest = kinds[key->kind].nest;
	if (nest != NULL)
		JN_TRY(nest(reader, key, node, field));
	else if (node != NULL)
		JN_TRY(kinds[key->kind].read(reader, key, node, field));
	else
		JN_TRY(jn_default_value(reader, key, field));
	jn_key_leave(reader, mark);
	return JN_OK;
}

static JnStatus read_table(JnKeyReader* reader, const Table* table, const JnNode* mapping, void* out) {
	const JnNode* outer = reader->where;
	if (mapping != NULL) {
		reader->where = mapping;
		JN_TRY(refuse_unknown(reader, table, mapping));
	}
	for (const JnKey* key = table->keys; key != NULL && key->name != NULL; key++) {
		JN_TRY(read_key(reader, key, jn_node_find(mapping, key->name), (char*)out + key->field));
	}
	reader->where = outer;
	return JN_OK;
}

JnStatus jn_keys_read(const JnKey* keys, const JnNode* mapping, const char* path, JnArena* arena, void* out) {
	JnKeyReader reader = {.arena = arena, .requires = mapping != NULL};
	snprintf(reader.path, sizeof reader.path, "%s", path);
	if (mapping != NULL) JN_TRY(expect_mapping(&reader, mapping));
	return read_table(&reader, &(Table){.keys = keys}, mapping, out);
}
