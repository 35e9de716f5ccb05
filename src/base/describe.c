// Descriptions of key tables: finds the part that a dotted path names and says each key in words. A path goes through
// variants by the tag, by the name of a row, or by a key of any row.
#include "base/describe.h"

#include <stdio.h>
#include <string.h>

#include "base/key_reader.h"
#include "base/log.h"

typedef struct Lookup {
	const char* whole; // the path as asked for
	bool markdown;
	FILE* out;
	int match_count;
	char path[256]; // of the table where the lookup stands
	JnNames missed; // where it went no further
	char missed_name[64], missed_path[256];
} Lookup;

static const char* const kind_names[] = {
	[JN_REAL] = "number",
	[JN_INTEGER] = "whole number",
	[JN_SWITCH] = "true or false",
	[JN_TEXT] = "text",
	[JN_PATH] = "path of a file",
	[JN_REAL2] = "two numbers",
	[JN_INTEGER2] = "two whole numbers",
	[JN_REAL3] = "three numbers",
	[JN_INTEGER3] = "three whole numbers",
	[JN_POINTS] = "[time, value] pairs",
	[JN_CHOICE] = "word",
	[JN_OBJECT] = "mapping",
	[JN_OPTIONAL] = "optional mapping",
	[JN_LIST] = "list of mappings",
	[JN_VARIANT] = "variant",
};

// Numbers stand without a unit, which is shown beside the kind.
static void default_text(const JnKey* key, size_t size, char* text) {
	text[0] = '\0';
	if (key->required) {
		snprintf(text, size, "required");
		return;
	}
	if (key->absent_allowed) return;
	const double* value = key->value;
	switch (key->kind) {
	case JN_REAL:
	case JN_INTEGER:
		snprintf(text, size, "%.10g", value[0]);
		break;
	case JN_REAL2:
	case JN_INTEGER2:
		snprintf(text, size, "[%.10g, %.10g]", value[0], value[1]);
		break;
	case JN_REAL3:
	case JN_INTEGER3:
		snprintf(text, size, "[%.10g, %.10g, %.10g]", value[0], value[1], value[2]);
		break;
	case JN_SWITCH:
		snprintf(text, size, "%s", value[0] != 0 ? "true" : "false");
		break;
	case JN_CHOICE:
		snprintf(text, size, "%s", key->names[(int)value[0]]);
		break;
	case JN_TEXT:
	case JN_PATH:
	case JN_VARIANT:
		snprintf(text, size, "%s", key->text != NULL ? key->text : "");
		break;
	default:
		break;
	}
}

void jn_key_cells(const JnKey* key, JnKeyCells* cells) {
	const bool has_unit = key->unit != NULL && key->unit[0] != '\0';
	const char* kind = key->rows != NULL ? key->rows->noun : kind_names[key->kind];
	const bool is_list = key->rows != NULL && key->kind == JN_LIST;
	snprintf(cells->kind, sizeof cells->kind, "%s%s%s%s%s%s", is_list ? "list of " : "", kind, is_list ? "s" : "",
			 has_unit ? " [" : "", has_unit ? key->unit : "", has_unit ? "]" : "");
	default_text(key, sizeof cells->value, cells->value);
	jn_bounds_text(key, sizeof cells->bounds, cells->bounds);
	jn_names_list((JnNames){.words = key->kind == JN_CHOICE ? key->names : NULL}, sizeof cells->words, cells->words);
}

int jn_keys_count(const JnKey* keys) {
	int count = 0;
	while (keys != NULL && keys[count].name != NULL) count++;
	return count;
}

const JnRow* jn_row_with_same_keys(const JnRowList* list, int index) {
	const JnKey* keys = list->rows[index]->keys;
	for (int i = 0; i < index && keys != NULL; i++) {
		if (list->rows[i]->keys == keys) return list->rows[i];
	}
	return NULL;
}

bool jn_open_tables_push(JnOpenTables* open, const void* table) {
	for (int i = 0; i < open->count; i++) {
		if (open->tables[i] == table) return false;
	}
	if (open->count == JN_DESCRIBE_DEPTH) return false;
	open->tables[open->count++] = table;
	return true;
}

static void show(Lookup* lookup, const JnKeyPart* part) {
	if (!lookup->markdown && lookup->match_count > 0) fputc('\n', lookup->out);
	lookup->match_count++;
	if (lookup->markdown)
		jn_describe_markdown(part, lookup->out);
	else
		jn_describe_text(part, lookup->out);
}

static void miss(Lookup* lookup, const char* name, JnNames names) {
	if (lookup->missed_name[0] != '\0') return; // the first place is the most telling
	lookup->missed = names;
	snprintf(lookup->missed_name, sizeof lookup->missed_name, "%s", name);
	snprintf(lookup->missed_path, sizeof lookup->missed_path, "%s", lookup->path);
}

// Cut the first name from a path, and the indices behind it. Returns the rest.
static const char* cut_name(const char* path, size_t size, char* name) {
	const size_t length = strcspn(path, ".[");
	snprintf(name, size, "%.*s", (int)length, path);
	path += length;
	while (*path == '[') path += strcspn(path, "]") + (strchr(path, ']') != NULL);
	return path + (*path == '.');
}

static const JnKey* find_key(const JnKey* keys, const char* name) {
	for (const JnKey* key = keys; key != NULL && key->name != NULL; key++) {
		if (strcmp(key->name, name) == 0) return key;
	}
	return NULL;
}

static void find_in_table(Lookup* lookup, const JnKeyPart* table, const char* path);

static void find_in_rows(Lookup* lookup, const JnKey* key, const JnKeyPart* holder, const char* path) {
	char name[64];
	const char* rest = cut_name(path, sizeof name, name);
	const JnRow* named = jn_row_find(key->rows, name);
	const int before = lookup->match_count;
	if (strcmp(name, key->tag) == 0 && *rest == '\0') {
		show(lookup, &(JnKeyPart){.keys = key, .count = 1, .path = holder->path});
		return;
	}
	for (int i = 0; i < key->rows->count; i++) {
		const JnRow* row = key->rows->rows[i];
		if (named != NULL ? row != named : jn_row_with_same_keys(key->rows, i) != NULL) continue;
		const JnKeyPart part = {row->keys, jn_keys_count(row->keys), row, key->tag, lookup->path};
		if (named != NULL && *rest == '\0')
			show(lookup, &part);
		else if (named != NULL)
			find_in_table(lookup, &part, rest);
		else if (find_key(row->keys, name) != NULL)
			find_in_table(lookup, &part, path);
	}
	if (lookup->match_count == before) miss(lookup, name, (JnNames){.tag = key->tag, .rows = key->rows});
}

static void find_in_table(Lookup* lookup, const JnKeyPart* table, const char* path) {
	char name[64];
	const char* rest = cut_name(path, sizeof name, name);
	const JnKey* key = find_key(table->keys, name);
	if (key == NULL) {
		miss(lookup, name, (JnNames){.keys = table->keys});
		return;
	}
	if (*rest == '\0') {
		show(lookup, &(JnKeyPart){key, 1, table->row, table->tag, table->path});
		return;
	}
	char outer[sizeof lookup->path];
	memcpy(outer, lookup->path, sizeof outer);
	const size_t used = strlen(lookup->path);
	snprintf(lookup->path + used, sizeof lookup->path - used, "%s%s", used > 0 ? "." : "", name);
	const JnKeyPart holder = {.path = outer};
	const JnKeyPart nested = {.keys = key->keys, .path = lookup->path};
	if (key->rows != NULL)
		find_in_rows(lookup, key, &holder, rest);
	else if (key->keys != NULL)
		find_in_table(lookup, &nested, rest);
	else
		miss(lookup, rest, (JnNames){0});
	memcpy(lookup->path, outer, sizeof outer);
}

static JnStatus complain(const Lookup* lookup) {
	char near[128], list[600];
	jn_names_suggest(lookup->missed, lookup->missed_name, sizeof near, near);
	jn_names_list(lookup->missed, sizeof list, list);
	const char* path = lookup->missed_path;
	return jn_error(JN_BAD_INPUT, "%s: there is no key '%s'%s%s%s%s Keys there: %s", lookup->whole, lookup->missed_name,
					path[0] != '\0' ? " in " : "", path, near, near[0] != '\0' ? "" : ".",
					list[0] != '\0' ? list : "none");
}

JnStatus jn_keys_describe(const JnKey* keys, const char* path, bool markdown, FILE* out) {
	Lookup lookup = {.whole = path, .markdown = markdown, .out = out};
	const JnKeyPart all = {.keys = keys, .count = jn_keys_count(keys), .path = ""};
	if (path[0] == '\0')
		show(&lookup, &all);
	else
		find_in_table(&lookup, &all, path);
	return lookup.match_count > 0 ? JN_OK : complain(&lookup);
}
