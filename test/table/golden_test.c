/// @file golden_test.c
/// The scenes give the bits that test/reference/golden.csv holds, and the same with any number of threads.
/// `table_golden --print` writes such rows; tools/determinism_check compares those of several builds, vector widths and
/// processors, and writes the file.
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "support/golden.h"
#include "support/support.h"

static const char reference[] = JN_SOURCE_DIR "/test/reference/golden.csv";

/// How the rows of the file are to a row of ours.
typedef enum Match { SAME, OTHER_BITS, OTHER_MACHINE, ABSENT } Match;

static bool cell_is(const Table* table, int row, const char* column, const char* text) {
	return strcmp(table->cells[row][table_column(table, column)], text) == 0;
}

static Match compare(const Table* table, const GoldenRow* ours) {
	Match found = ABSENT;
	for (int row = 1; row < table->rows; ++row) {
		if (!cell_is(table, row, "scene", ours->scene) || !cell_is(table, row, "solver", ours->solver)) continue;
		found = OTHER_MACHINE;
		if (!cell_is(table, row, "blas", "any") && !cell_is(table, row, "blas", ours->blas)) continue;
		if (!cell_is(table, row, "libm", "any") && !cell_is(table, row, "libm", ours->libm)) continue;
		const bool is_same = cell_is(table, row, "start", ours->start) && cell_is(table, row, "end", ours->end) &&
							 table_number(table, row, "steps") == (double)ours->steps;
		return is_same ? SAME : OTHER_BITS;
	}
	return found;
}

static void scenes_give_the_bits_of_the_file(void** state) {
	(void)state;
	Table table = table_read(reference);
	int counts[4] = {0};
	for (char** path = golden_scenes(JN_SOURCE_DIR "/scenes"); *path != NULL; ++path)
		for (int solver = 0; solver < GOLDEN_SOLVERS; ++solver) {
			GoldenRow row;
			if (!golden_run(*path, (GoldenSolver)solver, 1, 1, &row)) continue;
			const Match match = compare(&table, &row);
			++counts[match];
			if (match != OTHER_BITS && match != ABSENT) continue;
			print_error("%s, solver %s: %s\n", row.scene, row.solver, match == ABSENT ? "no row" : "other bits; now:");
			golden_print(stderr, &row);
		}
	table_free(&table);
	print_message(
		"%d runs have the bits of the file; %d depend on kernels of OpenBLAS or on a C library that it does not have\n",
		counts[SAME], counts[OTHER_MACHINE]);
	if (counts[OTHER_BITS] + counts[ABSENT] > 0)
		fail_msg(
			"%d runs have other bits, %d no row; tools/determinism_check --write makes the file anew when a change of "
			"results is meant",
			counts[OTHER_BITS], counts[ABSENT]);
}

// Every thread has a part in the smallest model, and is woken a thousand times a step: the long test does this at length.
static void scenes_give_the_same_bits_with_three_threads(void** state) {
	(void)state;
	golden_check_threads(3, 8);
}

int main(int count, char** arguments) {
	golden_prepare(arguments);
	if (count > 1 && strcmp(arguments[1], "--print") == 0) return golden_main(count, arguments);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(scenes_give_the_bits_of_the_file),
		cmocka_unit_test(scenes_give_the_same_bits_with_three_threads),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
