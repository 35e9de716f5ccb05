/// @file compare_columns.h
/// The numbers of a comparison's tables: one row a column.
#ifndef JN_APP_COMPARE_COLUMNS_H
#define JN_APP_COMPARE_COLUMNS_H

#include "compare_results.h"

typedef struct CompareColumn {
	const char* name;     ///< in the CSV
	const char* title;    ///< for people; NULL: in the CSV alone
	const char* format;   ///< for people
	size_t field;         ///< of CompareResult
	bool needs_reference; ///< left out of the tables for people when nothing is known
} CompareColumn;

enum { COMPARE_COLUMNS = 14 };
extern const CompareColumn compare_columns[COMPARE_COLUMNS];

/// "done", "failed", ...
const char* compare_outcome_word(const CompareJob* job);

/// A run's number in a column; NAN when unknown.
double compare_value(const CompareResults* results, int run, const CompareColumn* column);

/// Write comparison.csv into the plan's directory: every digit, and nothing for what is not known. JN_IO_FAILED.
JnStatus compare_csv_write(const CompareResults* results);

#endif
