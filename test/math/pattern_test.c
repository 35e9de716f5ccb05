/// @file pattern_test.c
/// Patterns hold exactly the pairs that share a cell, and products equal those of the dense matrix, with the same bits
/// for any number of threads.
#include <stdio.h>

#include "support/random_cells.h"

static const int sizes[][2] = {{5, 1}, {20, 6}, {60, 40}, {60, 0}};
enum { SIZE_COUNT = sizeof sizes / sizeof *sizes };

static void the_pattern_holds_exactly_the_pairs_that_share_a_cell(void** state) {
	(void)state;
	for (int s = 0; s < SIZE_COUNT; ++s) {
		RandomCells r;
		const int nodes = sizes[s][0];
		cells_create(&r, nodes, sizes[s][1], 5);
		int pairs = 0;
		for (int column = 0; column < nodes; ++column)
			for (int row = column; row < nodes; ++row) {
				const int block = jn_pattern_find(&r.pattern, row, column);
				const bool joined = r.joined[row * nodes + column];
				assert_true((block >= 0) == joined);
				if (joined) assert_int_equal(r.pattern.row[block], row);
				pairs += joined;
			}
		assert_int_equal(r.pattern.blocks, pairs);
		jn_arena_free(&r.arena);
	}
}

static void columns_ascend_from_the_diagonal_and_rows_ascend(void** state) {
	(void)state;
	RandomCells r;
	cells_create(&r, 60, 40, 6);
	const JnPattern* p = &r.pattern;
	for (int j = 0; j < p->nodes; ++j) {
		assert_int_equal(p->row[p->column_start[j]], j);
		for (int k = p->column_start[j] + 1; k < p->column_start[j + 1]; ++k) assert_true(p->row[k] > p->row[k - 1]);
		for (int k = p->full_start[j] + 1; k < p->full_start[j + 1]; ++k)
			assert_true(p->full_column[k] > p->full_column[k - 1]);
	}
	assert_int_equal(p->full_start[p->nodes], 2 * p->blocks - p->nodes);
	jn_arena_free(&r.arena);
}

static void products_equal_those_of_the_dense_matrix(void** state) {
	(void)state;
	for (int s = 0; s < SIZE_COUNT; ++s) {
		RandomCells r;
		cells_create(&r, sizes[s][0], sizes[s][1], 7);
		const int n = 3 * r.pattern.nodes;
		double* dense = cells_dense(&r);
		double x[180], y[180], expected[180];
		for (int k = 0; k < n; ++k) {
			x[k] = cells_random(&r);
			expected[k] = y[k] = cells_random(&r);
		}
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j) expected[i] += -0.7 * dense[i * n + j] * x[j];
		jn_blocks_apply(&r.pattern, r.blocks, -0.7, x, y, 1);
		for (int k = 0; k < n; ++k)
			if (!(fabs(y[k] - expected[k]) <= 1e-13)) // 180 terms of at most 1, rounded to 1e-16 each
				fail_msg("entry %d: %.17g, expected %.17g, tolerance 1e-13", k, y[k], expected[k]);
		free(dense);
		jn_arena_free(&r.arena);
	}
}

static void scalar_products_equal_those_of_blocks_on_the_diagonal(void** state) {
	(void)state;
	RandomCells r;
	cells_create(&r, 60, 40, 8);
	double x[180], y[180] = {0}, expected[180] = {0};
	double* scalars = calloc((size_t)r.pattern.blocks, sizeof *scalars);
	for (int k = 0; k < 180; ++k) x[k] = cells_random(&r);
	for (int k = 0; k < r.pattern.blocks; ++k) {
		scalars[k] = cells_random(&r);
		for (int e = 0; e < 9; ++e) r.blocks[9 * k + e] = e % 4 == 0 ? scalars[k] : 0;
	}
	jn_blocks_apply(&r.pattern, r.blocks, 0.3, x, expected, 1);
	jn_scalars_apply(&r.pattern, scalars, 0.3, x, y, 1);
	for (int k = 0; k < 180; ++k)
		if (!(fabs(y[k] - expected[k]) <= 1e-14)) // same terms, same order
			fail_msg("entry %d: %.17g, expected %.17g, tolerance 1e-14", k, y[k], expected[k]);
	free(scalars);
	jn_arena_free(&r.arena);
}

// A chain long enough that four threads are woken (4096 nodes each).
static void products_have_the_same_bits_for_any_number_of_threads(void** state) {
	(void)state;
	enum { NODES = 4 * 4096 + 100 };
	JnArena arena = {0};
	JnPattern pattern;
	int* cells = jn_arena_take(&arena, 4 * NODES, sizeof *cells);
	for (int c = 0; c < NODES; ++c)
		for (int i = 0; i < 4; ++i) cells[4 * c + i] = (c + i * i * 37) % NODES;
	const JnCellList list = {.count = NODES, .nodes = 4, .cells = cells};
	assert_int_equal(jn_pattern_create(NODES, 1, &list, &arena, &pattern), JN_OK);
	double* blocks = jn_arena_take(&arena, 9 * (size_t)pattern.blocks, sizeof *blocks);
	double *x = jn_arena_take(&arena, 3 * NODES, sizeof *x), *y = jn_arena_take(&arena, 6 * NODES, sizeof *y);
	for (int k = 0; k < 9 * pattern.blocks; ++k) blocks[k] = sin(1.3 * k);
	for (int k = 0; k < 3 * NODES; ++k) x[k] = cos(0.7 * k);
	for (int threads = 1; threads <= 4; ++threads) {
		double* out = threads == 1 ? y : y + 3 * NODES;
		memset(out, 0, 3 * NODES * sizeof *out);
		jn_blocks_apply(&pattern, blocks, 0.9, x, out, threads);
		jn_scalars_apply(&pattern, blocks, 0.4, x, out, threads);
		assert_memory_equal(out, y, 3 * NODES * sizeof *out);
	}
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_pattern_holds_exactly_the_pairs_that_share_a_cell),
		cmocka_unit_test(columns_ascend_from_the_diagonal_and_rows_ascend),
		cmocka_unit_test(products_equal_those_of_the_dense_matrix),
		cmocka_unit_test(scalar_products_equal_those_of_blocks_on_the_diagonal),
		cmocka_unit_test(products_have_the_same_bits_for_any_number_of_threads),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
