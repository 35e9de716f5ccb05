/// @file compare_tables.h
/// The results of a comparison as comparison.csv, comparison.md and comparison.txt: one row a run.
#ifndef JN_APP_COMPARE_TABLES_H
#define JN_APP_COMPARE_TABLES_H

#include <stdio.h>

#include "compare_results.h"

/// Write the three files into the plan's directory. JN_IO_FAILED after a message.
JnStatus compare_tables_write(const CompareResults* results);

/// The text of comparison.txt.
void compare_table_print(const CompareResults* results, FILE* out);

#endif
