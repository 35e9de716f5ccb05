// Key tables as aligned text. A first walk without a file measures the columns, a second one prints.
#include <stdio.h>
#include <string.h>

#include "base/describe.h"

enum { COLUMN_COUNT = 4, WIDEST = 36 };

typedef struct Printer {
	FILE* out; // NULL: measure
	int width[COLUMN_COUNT];
	JnOpenTables open;
} Printer;

static void print_line(Printer* printer, const char* const columns[COLUMN_COUNT], const char* meaning,
					   const char* words) {
	if (printer->out == NULL) {
		for (int i = 0; i < COLUMN_COUNT; i++) {
			const int width = (int)strlen(columns[i]);
			if (width > printer->width[i] && width <= WIDEST) printer->width[i] = width;
		}
		return;
	}
	char line[1600];
	int used = 0;
	for (int i = 0; i < COLUMN_COUNT; i++) {
		used += snprintf(line + used, sizeof line - (size_t)used, "%-*s  ", printer->width[i], columns[i]);
	}
	const bool has_words = words[0] != '\0';
	snprintf(line + used, sizeof line - (size_t)used, "%s%s%s", meaning != NULL ? meaning : "",
			 has_words ? "; one of " : "", words);
	size_t length = strlen(line);
	while (length > 0 && line[length - 1] == ' ') length--;
	fprintf(printer->out, "%.*s\n", (int)length, line);
}

// A line that has no more than a name and a sentence, such as a row of a catalogue.
static void print_title(Printer* printer, int depth, const char* tag, const char* name, const char* doc) {
	char title[200];
	snprintf(title, sizeof title, "%*s%s%s%s", 2 * depth, "", tag, tag[0] != '\0' ? ": " : "", name);
	print_line(printer, (const char* const[]){title, "", "", ""}, doc, "");
}

static void print_keys(Printer* printer, const JnKey* keys, int count, int depth);

static void print_rows(Printer* printer, const JnKey* variant, int depth) {
	const JnRowList* list = variant->rows;
	if (!jn_open_tables_push(&printer->open, list)) {
		print_title(printer, depth, variant->tag, "(as above)", "");
		return;
	}
	for (int i = 0; i < list->count; i++) {
		const JnRow *row = list->rows[i], *same = jn_row_with_same_keys(list, i);
		char note[128] = "";
		if (same != NULL) snprintf(note, sizeof note, "(keys as for %s)", same->name);
		print_title(printer, depth, variant->tag, row->name, row->doc);
		if (same != NULL)
			print_title(printer, depth + 1, "", note, "");
		else
			print_keys(printer, row->keys, jn_keys_count(row->keys), depth + 1);
	}
	printer->open.count--;
}

static void print_key(Printer* printer, const JnKey* key, int depth) {
	JnKeyCells cells;
	char name[200];
	jn_key_cells(key, &cells);
	snprintf(name, sizeof name, "%*s%s", 2 * depth, "", key->name);
	print_line(printer, (const char* const[]){name, cells.kind, cells.value, cells.bounds}, key->meaning, cells.words);
	if (key->rows != NULL)
		print_rows(printer, key, depth + 1);
	else if (key->keys != NULL && jn_open_tables_push(&printer->open, key->keys)) {
		print_keys(printer, key->keys, jn_keys_count(key->keys), depth + 1);
		printer->open.count--;
	} else if (key->keys != NULL)
		print_title(printer, depth + 1, "", "(as above)", "");
}

static void print_keys(Printer* printer, const JnKey* keys, int count, int depth) {
	for (int i = 0; i < count; i++) print_key(printer, &keys[i], depth);
}

static void print_part(Printer* printer, const JnKeyPart* part) {
	if (part->row != NULL) print_title(printer, 0, part->tag, part->row->name, part->row->doc);
	print_keys(printer, part->keys, part->count, part->row != NULL ? 1 : 0);
}

void jn_describe_text(const JnKeyPart* part, FILE* out) {
	Printer printer = {0};
	print_part(&printer, part);
	printer.out = out;
	print_part(&printer, part);
}
