/// @file table.h
/// A small table of texts, written as CSV here and into a page by page.h. Row 0 is the header.
#ifndef JN_APP_REPRODUCE_TABLE_H
#define JN_APP_REPRODUCE_TABLE_H

#include "base/arena.h"

typedef struct Table {
	JnArena* arena;
	int rows, columns, room;
	char** texts;    ///< the cells of each row, joined by '|'
	JnStatus status; ///< the first failure
} Table;

/// Begin with the header: "case|steps|s/s". The arena outlives the table.
Table table_begin(JnArena* arena, const char* header);
/// Add a row with as many cells: table_row(&t, "%s|%d|%.3g", ...). A number that is NAN becomes an empty cell.
void table_row(Table* table, const char* format, ...) __attribute__((format(printf, 2, 3)));
/// Cell text, not terminated; "" beyond the row's end.
const char* table_cell(const Table* table, int row, int column, int* length);
/// Write `name` into `folder`. JN_IO_FAILED, JN_OUT_OF_MEMORY.
JnStatus table_write(const Table* table, const char* folder, const char* name);

#endif
