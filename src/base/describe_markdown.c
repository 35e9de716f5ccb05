// Key tables as Markdown: each mapping has a heading with its path and a table of its keys; the tables inside it follow.
#include <stdio.h>
#include <string.h>

#include "base/describe.h"

typedef struct Printer {
	FILE* out;
	JnOpenTables open;
	char path[256]; // of the mapping whose section is printed
} Printer;

// A bar would end the cell, a line break the table.
static void put_cell(FILE* out, const char* text) {
	for (; text != NULL && *text != '\0'; text++) {
		if (*text == '|')
			fputs("\\|", out);
		else
			fputc(*text == '\n' ? ' ' : *text, out);
	}
}

static void put_row(FILE* out, const JnKey* key) {
	JnKeyCells cells;
	jn_key_cells(key, &cells);
	fprintf(out, "| `%s` | ", key->name);
	put_cell(out, cells.kind);
	fputs(" | ", out);
	put_cell(out, cells.value);
	fputs(" | ", out);
	put_cell(out, cells.bounds);
	fputs(" | ", out);
	put_cell(out, key->meaning);
	if (cells.words[0] != '\0') fputs("; one of ", out);
	put_cell(out, cells.words);
	fputs(" |\n", out);
}

static void put_heading(const Printer* printer, const char* tag, const char* row) {
	const bool is_root = printer->path[0] == '\0';
	fprintf(printer->out, is_root ? "## Top level" : "## `%s`", printer->path);
	if (row != NULL) fprintf(printer->out, " with `%s: %s`", tag, row);
	fputs("\n\n", printer->out);
}

static size_t enter(Printer* printer, const JnKey* key) {
	const size_t mark = strlen(printer->path);
	snprintf(printer->path + mark, sizeof printer->path - mark, "%s%s%s", mark > 0 ? "." : "", key->name,
			 key->kind == JN_LIST ? "[]" : "");
	return mark;
}

static void put_nested(Printer* printer, const JnKey* keys, int count);

static void put_table(Printer* printer, const JnKey* keys, int count) {
	if (count > 0) fputs("| Key | Kind | Default | Bounds | Meaning |\n|---|---|---|---|---|\n", printer->out);
	for (int i = 0; i < count; i++) put_row(printer->out, &keys[i]);
	if (count > 0) fputc('\n', printer->out);
	put_nested(printer, keys, count);
}

static void put_row_list(Printer* printer, const JnKey* variant) {
	const JnRowList* list = variant->rows;
	put_heading(printer, NULL, NULL);
	put_cell(printer->out, variant->meaning);
	if (variant->meaning != NULL) fputs("\n\n", printer->out);
	fprintf(printer->out, "| `%s` | Meaning | Keys |\n|---|---|---|\n", variant->tag);
	for (int i = 0; i < list->count; i++) {
		const JnRow *row = list->rows[i], *same = jn_row_with_same_keys(list, i);
		fprintf(printer->out, "| `%s` | ", row->name);
		put_cell(printer->out, row->doc);
		if (same != NULL)
			fprintf(printer->out, " | as for `%s` |\n", same->name);
		else
			fprintf(printer->out, " | %s |\n", jn_keys_count(row->keys) > 0 ? "below" : "none");
	}
	fputc('\n', printer->out);
}

static void put_variant(Printer* printer, const JnKey* variant) {
	const JnRowList* list = variant->rows;
	if (!jn_open_tables_push(&printer->open, list)) return;
	put_row_list(printer, variant);
	for (int i = 0; i < list->count; i++) {
		const JnRow* row = list->rows[i];
		const int count = jn_keys_count(row->keys);
		if (count == 0 || jn_row_with_same_keys(list, i) != NULL) continue;
		put_heading(printer, variant->tag, row->name);
		put_table(printer, row->keys, count);
	}
	printer->open.count--;
}

static void put_nested(Printer* printer, const JnKey* keys, int count) {
	for (int i = 0; i < count; i++) {
		const size_t mark = enter(printer, &keys[i]);
		if (keys[i].rows != NULL)
			put_variant(printer, &keys[i]);
		else if (keys[i].keys != NULL && jn_open_tables_push(&printer->open, keys[i].keys)) {
			put_heading(printer, NULL, NULL);
			put_table(printer, keys[i].keys, jn_keys_count(keys[i].keys));
			printer->open.count--;
		}
		printer->path[mark] = '\0';
	}
}

void jn_describe_markdown(const JnKeyPart* part, FILE* out) {
	Printer printer = {.out = out};
	snprintf(printer.path, sizeof printer.path, "%s", part->path);
	put_heading(&printer, part->tag, part->row != NULL ? part->row->name : NULL);
	if (part->row != NULL) {
		put_cell(out, part->row->doc);
		fputs("\n\n", out);
	}
	put_table(&printer, part->keys, part->count);
}
