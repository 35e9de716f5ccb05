// Cells are separated by '|', which none of them contains.
#include "reproduce/table.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "record/text_file.h"

static void keep(Table* table, const char* text) {
	if (table->status != JN_OK) return;
	if (table->rows == table->room) {
		table->room = table->room > 0 ? 2 * table->room : 16;
		char** larger = jn_arena_take(table->arena, (size_t)table->room, sizeof *larger);
		if (larger == NULL) table->status = JN_OUT_OF_MEMORY;
		if (larger == NULL) return;
		if (table->rows > 0) memcpy(larger, table->texts, (size_t)table->rows * sizeof *larger);
		table->texts = larger;
	}
	table->texts[table->rows] = jn_arena_text(table->arena, text);
	if (table->texts[table->rows] == NULL)
		table->status = JN_OUT_OF_MEMORY;
	else
		++table->rows;
}

Table table_begin(JnArena* arena, const char* header) {
	Table table = {.arena = arena, .columns = 1};
	for (const char* at = header; *at != '\0'; ++at) table.columns += *at == '|';
	keep(&table, header);
	return table;
}

void table_row(Table* table, const char* format, ...) {
	char text[2048];
	va_list values;
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	keep(table, text);
}

static bool is_number(const char* cell, int length) {
	while (length > 0 && (*cell == ' ' || *cell == '-')) ++cell, --length;
	return !(length == 3 && strncmp(cell, "nan", 3) == 0);
}

const char* table_cell(const Table* table, int row, int column, int* length) {
	const char* at = table->texts[row];
	for (; column > 0 && *at != '\0'; ++at) column -= *at == '|';
	*length = column == 0 ? (int)strcspn(at, "|") : 0;
	if (!is_number(at, *length)) *length = 0;
	return at;
}

// Quoted where a reader of CSV needs it; quotes themselves do not occur.
static void print_cell(JnTextFile* file, const char* cell, int length) {
	const bool is_quoted = memchr(cell, ',', (size_t)length) != NULL;
	jn_text_print(file, "%s%.*s%s", is_quoted ? "\"" : "", length, cell, is_quoted ? "\"" : "");
}

JnStatus table_write(const Table* table, const char* folder, const char* name) {
	JnTextFile file;
	JN_TRY(table->status);
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	for (int row = 0; row < table->rows; ++row)
		for (int i = 0; i < table->columns; ++i) {
			int length = 0;
			const char* cell = table_cell(table, row, i, &length);
			print_cell(&file, cell, length);
			jn_text_print(&file, i + 1 < table->columns ? "," : "\n");
		}
	return jn_text_close(&file);
}
