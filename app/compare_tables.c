// The tables for people: the keys, the outcome, and the columns that say something.
#include "compare_tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "compare_columns.h"
#include "record/text_file.h"

enum { CELL_SIZE = 256 };

// The compare_columns of the table for people: the keys, the outcome, newton a step, and those of compare_columns that are shown.
typedef struct Sheet {
	const CompareResults* results;
	int count;
	int shown[COMPARE_COLUMNS + 1]; // indices of compare_columns; NEWTON_PER_STEP is none of them
} Sheet;
enum { NEWTON_PER_STEP = -1 };

static bool is_known(const CompareResults* results, const CompareColumn* column) {
	for (int i = 0; i < results->plan->run_count; ++i)
		if (isfinite(compare_value(results, i, column))) return true;
	return false;
}

static Sheet open_sheet(const CompareResults* results) {
	Sheet sheet = {.results = results};
	for (int c = 0; c < COMPARE_COLUMNS; ++c) {
		if (strcmp(compare_columns[c].name, "newton") == 0) sheet.shown[sheet.count++] = NEWTON_PER_STEP;
		if (compare_columns[c].title == NULL ||
			(compare_columns[c].needs_reference && !is_known(results, &compare_columns[c])))
			continue;
		sheet.shown[sheet.count++] = c;
	}
	return sheet;
}

static int sheet_width(const Sheet* sheet) {
	return sheet->results->plan->key_count + 1 + sheet->count;
}

static bool is_text(const Sheet* sheet, int column) {
	return column <= sheet->results->plan->key_count;
}

static void format_title(const Sheet* sheet, int column, char out[CELL_SIZE]) {
	const ComparePlan* plan = sheet->results->plan;
	const int c = column - plan->key_count - 1;
	const char* title = column < plan->key_count ? plan->keys[column].word
						: c < 0                  ? "outcome"
						: sheet->shown[c] < 0    ? "newton/step"
												 : compare_columns[sheet->shown[c]].title;
	snprintf(out, CELL_SIZE, "%s", title);
}

static void format_key(const Sheet* sheet, int run, int column, char out[CELL_SIZE]) {
	const CompareRun* about = &sheet->results->plan->runs[run];
	const char* value = about->values[column];
	if (about->is_reference && column == 0)
		snprintf(out, CELL_SIZE, *value != '\0' ? "reference: %s" : "reference", value);
	else
		snprintf(out, CELL_SIZE, "%s", *value != '\0' ? value : "-");
}

static void format_cell(const Sheet* sheet, int run, int column, char out[CELL_SIZE]) {
	const CompareResults* results = sheet->results;
	const CompareResult* result = &results->list[run];
	const int c = column - results->plan->key_count - 1;
	if (column < results->plan->key_count) {
		format_key(sheet, run, column, out);
		return;
	}
	if (c < 0) {
		snprintf(out, CELL_SIZE, "%s", compare_outcome_word(&results->jobs->list[run]));
		return;
	}
	const CompareColumn* shown = sheet->shown[c] >= 0 ? &compare_columns[sheet->shown[c]] : NULL;
	const double value = shown != NULL ? compare_value(results, run, shown) : result->newton / result->steps;
	snprintf(out, CELL_SIZE, "-");
	if (!isfinite(value)) return;
	snprintf(out, CELL_SIZE, shown != NULL ? shown->format : "%.2f", value);
}

// Letters, not bytes: values may be UTF-8.
static int text_width(const char* text) {
	int width = 0;
	for (const char* c = text; *c != '\0'; ++c) width += ((unsigned char)*c & 0xC0) != 0x80;
	return width;
}

static int column_width(const Sheet* sheet, int column) {
	char cell[CELL_SIZE];
	format_title(sheet, column, cell);
	int width = text_width(cell);
	for (int i = 0; i < sheet->results->plan->run_count; ++i) {
		format_cell(sheet, i, column, cell);
		if (text_width(cell) > width) width = text_width(cell);
	}
	return width;
}

static void print_aligned(FILE* out, const Sheet* sheet, int column, int width, const char* cell) {
	const int gap = width - text_width(cell);
	if (column > 0) fputs("  ", out);
	if (is_text(sheet, column))
		fprintf(out, "%s%*s", cell, gap, "");
	else
		fprintf(out, "%*s%s", gap, "", cell);
}

static void print_line(FILE* out, const Sheet* sheet, const int widths[], int run) {
	char cell[CELL_SIZE];
	for (int k = 0; k < sheet_width(sheet); ++k) {
		if (run < 0)
			format_title(sheet, k, cell);
		else
			format_cell(sheet, run, k, cell);
		print_aligned(out, sheet, k, widths[k], cell);
	}
	fputc('\n', out);
}

static void print_failures(FILE* out, const CompareResults* results, const char* lead) {
	bool is_first = true;
	for (int i = 0; i < results->plan->run_count; ++i) {
		if (results->jobs->list[i].state != COMPARE_FAILED) continue;
		fprintf(out, "%s%s%s: %s\n", is_first ? "\n" : "", lead, results->plan->runs[i].label,
				results->jobs->list[i].message);
		is_first = false;
	}
}

void compare_table_print(const CompareResults* results, FILE* out) {
	const Sheet sheet = open_sheet(results);
	int* widths = calloc((size_t)sheet_width(&sheet), sizeof *widths);
	if (widths == NULL) return;
	for (int k = 0; k < sheet_width(&sheet); ++k) widths[k] = column_width(&sheet, k);
	for (int i = -1; i < results->plan->run_count; ++i) print_line(out, &sheet, widths, i);
	print_failures(out, results, "failed: ");
	free(widths);
}

static JnStatus write_text(const CompareResults* results) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, results->plan->directory, "comparison.txt", JN_TEXT_REPLACE));
	compare_table_print(results, file.stream);
	return jn_text_close(&file);
}

// ---- Markdown ----

static void print_markdown_row(JnTextFile* file, const Sheet* sheet, int run) {
	char cell[CELL_SIZE];
	jn_text_print(file, "|");
	for (int k = 0; k < sheet_width(sheet); ++k) {
		if (run < 0)
			format_title(sheet, k, cell);
		else
			format_cell(sheet, run, k, cell);
		jn_text_print(file, " ");
		for (const char* c = cell; *c != '\0'; ++c) jn_text_print(file, "%s%c", *c == '|' ? "\\" : "", *c);
		jn_text_print(file, " |");
	}
	jn_text_print(file, "\n");
}

static void print_notes(JnTextFile* file, const CompareResults* results) {
	const CompareOptions* options = results->jobs->options;
	jn_text_print(file,
				  "\nSteps, factorisations and solves are totals. The energy error is |e(t) - e(0)| at the end and "
				  "its largest.");
	if (results->has_errors)
		jn_text_print(file, " Position and velocity errors are the root mean square and the largest over all nodes at "
							"the final time, against the reference; the order is that of the position error, against "
							"the next coarser step.");
	jn_text_print(file,
				  "\n\nWall times were taken with up to %d runs at a time, %d thread%s each; use `--jobs 1` for "
				  "times that nothing disturbs.\n",
				  results->jobs->limit, options->threads, options->threads == 1 ? "" : "s");
}

static JnStatus write_markdown(const CompareResults* results) {
	JnTextFile file;
	const Sheet sheet = open_sheet(results);
	JN_TRY(jn_text_open(&file, results->plan->directory, "comparison.md", JN_TEXT_REPLACE));
	jn_text_print(&file, "# Comparison of %s\n\n", results->jobs->options->scene);
	print_markdown_row(&file, &sheet, -1);
	jn_text_print(&file, "|");
	for (int k = 0; k < sheet_width(&sheet); ++k) jn_text_print(&file, is_text(&sheet, k) ? " --- |" : " ---: |");
	jn_text_print(&file, "\n");
	for (int i = 0; i < results->plan->run_count; ++i) print_markdown_row(&file, &sheet, i);
	print_failures(file.stream, results, "- failed: ");
	print_notes(&file, results);
	return jn_text_close(&file);
}

JnStatus compare_tables_write(const CompareResults* results) {
	JN_TRY(compare_csv_write(results));
	JN_TRY(write_markdown(results));
	return write_text(results);
}
