// The columns, and comparison.csv.
#include "compare_columns.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "record/text_file.h"

const CompareColumn compare_columns[COMPARE_COLUMNS] = {
	{"steps", "steps", "%.0f", offsetof(CompareResult, steps), false},
	{"rejected", "rejected", "%.0f", offsetof(CompareResult, rejected), false},
	{"newton", NULL, "%.0f", offsetof(CompareResult, newton), false},
	{"factorizations", "factor.", "%.0f", offsetof(CompareResult, factorizations), false},
	{"solves", "solves", "%.0f", offsetof(CompareResult, solves), false},
	{"forces", NULL, "%.0f", offsetof(CompareResult, forces), false},
	{"wall_seconds", "wall [s]", "%.3g", offsetof(CompareResult, wall_seconds), false},
	{"energy_error", "energy [J/kg]", "%.2e", offsetof(CompareResult, energy_end), false},
	{"energy_error_max", "energy max", "%.2e", offsetof(CompareResult, energy_max), false},
	{"position_error_rms", "position [m]", "%.2e", offsetof(CompareResult, position_rms), true},
	{"position_error_max", "position max", "%.2e", offsetof(CompareResult, position_max), true},
	{"velocity_error_rms", "velocity [m/s]", "%.2e", offsetof(CompareResult, velocity_rms), true},
	{"velocity_error_max", "velocity max", "%.2e", offsetof(CompareResult, velocity_max), true},
	{"order", "order", "%.2f", offsetof(CompareResult, order), true},
};

const char* compare_outcome_word(const CompareJob* job) {
	static const char* const words[] = {"not run", "running", "done", "failed", "interrupted"};
	return words[job->state];
}

double compare_value(const CompareResults* results, int run, const CompareColumn* column) {
	double value;
	memcpy(&value, (const char*)&results->list[run] + column->field, sizeof value);
	return value;
}

static void print_quoted(JnTextFile* file, const char* text) {
	if (strpbrk(text, ",\"\n\r") == NULL) {
		jn_text_print(file, "%s", text);
		return;
	}
	jn_text_print(file, "\"");
	for (const char* c = text; *c != '\0'; ++c) jn_text_print(file, "%s%c", *c == '"' ? "\"" : "", *c);
	jn_text_print(file, "\"");
}

static void print_number(JnTextFile* file, double value) {
	char digits[32];
	snprintf(digits, sizeof digits, "%.15g", value);
	if (strtod(digits, NULL) != value) snprintf(digits, sizeof digits, "%.17g", value);
	jn_text_print(file, ",%s", isfinite(value) ? digits : "");
}

static void print_csv_header(JnTextFile* file, const CompareResults* results) {
	jn_text_print(file, "name");
	for (int k = 0; k < results->plan->key_count; ++k) {
		jn_text_print(file, ",");
		print_quoted(file, results->plan->keys[k].path);
	}
	jn_text_print(file, ",outcome");
	for (int c = 0; c < COMPARE_COLUMNS; ++c) jn_text_print(file, ",%s", compare_columns[c].name);
	for (int p = 0; p < results->probe_count; ++p)
		jn_text_print(file, ",probe.%s.error_rms,probe.%s.error_max", results->probes[p], results->probes[p]);
	jn_text_print(file, ",message\n");
}

static void print_csv_row(JnTextFile* file, const CompareResults* results, int run) {
	print_quoted(file, results->plan->runs[run].name);
	for (int k = 0; k < results->plan->key_count; ++k) {
		jn_text_print(file, ",");
		print_quoted(file, results->plan->runs[run].values[k]);
	}
	jn_text_print(file, ",%s", compare_outcome_word(&results->jobs->list[run]));
	for (int c = 0; c < COMPARE_COLUMNS; ++c) print_number(file, compare_value(results, run, &compare_columns[c]));
	for (int p = 0; p < results->probe_count; ++p) {
		print_number(file, results->list[run].paths[p].rms);
		print_number(file, results->list[run].paths[p].max);
	}
	jn_text_print(file, ",");
	print_quoted(file, results->jobs->list[run].message);
	jn_text_print(file, "\n");
}

JnStatus compare_csv_write(const CompareResults* results) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, results->plan->directory, "comparison.csv", JN_TEXT_REPLACE));
	print_csv_header(&file, results);
	for (int i = 0; i < results->plan->run_count; ++i) print_csv_row(&file, results, i);
	return jn_text_close(&file);
}
