// Prints the names of all keys, rows, choices and units of scene files as a dictionary for libFuzzer, from the key tables;
// words may come several times (./dev fuzz sorts them).
#include <stdio.h>

#include "base/describe.h"
#include "jounce/scene.h"

static void print_word(const char* word) {
	if (word != NULL && *word != '\0') printf("\"%s\"\n", word);
}

static void print_keys(const JnKey* keys, JnOpenTables* open);

static void print_rows(const JnRowList* list, JnOpenTables* open) {
	for (int i = 0; list != NULL && i < list->count; i++) {
		print_word(list->rows[i]->name);
		print_keys(list->rows[i]->keys, open);
	}
}

static void print_keys(const JnKey* keys, JnOpenTables* open) {
	if (keys == NULL || !jn_open_tables_push(open, keys)) return;
	for (const JnKey* key = keys; key->name != NULL; key++) {
		print_word(key->name);
		print_word(key->tag);
		print_word(key->unit);
		print_word(key->text);
		for (int i = 0; key->names != NULL && key->names[i] != NULL; i++) print_word(key->names[i]);
		print_keys(key->keys, open);
		print_rows(key->rows, open);
	}
	open->count--;
}

int main(void) {
	JnOpenTables open = {.count = 0};
	print_keys(jn_scene_keys, &open);
	return 0;
}
