/// @file description_test.c
/// Kinds of keys that few tables have: pairs, half-open bounds, long lists of words, tables that hold themselves; how they are
/// filled, described and refused.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/document.h"
#include "base/key.h"
#include "base/key_reader.h"
#include "support/support.h"

typedef struct Grid Grid;
struct Grid {
	double size[2], shift[2];
	int cells[2], kind;
	bool is_closed;
	Grid* finer;
};

static const char* const kinds[] = {"triangles_of_the_first_sort", "triangles_of_the_second_sort", "quadrilaterals",
									"hexagons_of_all_sizes_or_so", "pentagons_and_other_figures",  NULL};
static const JnKey grid_keys[7];
static const JnKey grid_keys[7] = {
	{.name = "size", .kind = JN_REAL2, .field = offsetof(Grid, size), .value = {1, 0.5}, .unit = "m"},
	{.name = "shift", .kind = JN_REAL2, .field = offsetof(Grid, shift), .absent_allowed = true, .unit = "m"},
	{.name = "cells", .kind = JN_INTEGER2, .field = offsetof(Grid, cells), .value = {4, 2}, .low = 1, .high = 100},
	{.name = "kind", .kind = JN_CHOICE, .field = offsetof(Grid, kind), .names = kinds, .meaning = "cells"},
	{.name = "closed", .kind = JN_SWITCH, .field = offsetof(Grid, is_closed)},
	{.name = "finer",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(Grid, finer),
	 .keys = grid_keys,
	 .size = sizeof(Grid),
	 .meaning = "another one\nwithin"},
	{0},
};

static JnArena arena;

static JnStatus read_grid(const char* text, Grid* grid) {
	JnDocument document;
	log_capture();
	JN_TRY(jn_document_parse("grid.yaml", text, &arena, &document));
	return jn_keys_read(grid_keys, document.root, "", &arena, grid);
}

static void pairs_are_filled_or_take_their_defaults(void** state) {
	(void)state;
	Grid grid;
	assert_int_equal(read_grid("size: [2 m, 30 cm]\ncells: [7, 8]\n", &grid), JN_OK);
	assert_true(grid.size[0] == 2 && grid.size[1] == 0.3 && grid.cells[0] == 7 && grid.cells[1] == 8);
	assert_int_equal(read_grid("closed: no\n", &grid), JN_OK);
	assert_true(grid.size[0] == 1 && grid.size[1] == 0.5 && grid.cells[0] == 4 && grid.cells[1] == 2);
	assert_true(isnan(grid.shift[0]) && isnan(grid.shift[1]));
}

static void a_table_may_hold_itself(void** state) {
	(void)state;
	Grid grid;
	assert_int_equal(read_grid("finer: {cells: [8, 4], finer: {cells: [16, 8]}}\n", &grid), JN_OK);
	assert_true(grid.finer->cells[1] == 4 && grid.finer->finer->cells[1] == 8 && grid.finer->finer->finer == NULL);
}

static void expect_refusal(const char* text, const char* words) {
	Grid grid;
	assert_int_equal(read_grid(text, &grid), JN_BAD_INPUT);
	log_expect(words);
}

static void what_is_no_pair_is_refused_with_an_example(void** state) {
	(void)state;
	expect_refusal("size: [1, 2, 3]\n", "grid.yaml:1:1: size: is a list of 3, but two numbers are expected");
	expect_refusal("size: 1\n", "size: '1' is a single value, but a list of two numbers is expected, such as [1, 2]");
	expect_refusal("cells: [1, 200]\n", "200 is outside [1, 100]");
	expect_refusal("cells: [1, 1.5]\n", "1.5");
	expect_refusal("size: [1, .inf]\n", "size");
}

// The message has room for some of the words, and says that there are more.
static void long_lists_of_words_are_cut(void** state) {
	(void)state;
	char text[60];
	const JnNames names = {.words = kinds};
	jn_names_list(names, sizeof text, text);
	assert_string_equal(text, "triangles_of_the_first_sort, ...");
}

static void describe(const char* path, bool is_markdown, char text[4096]) {
	FILE* file = tmpfile();
	assert_non_null(file);
	assert_int_equal(jn_keys_describe(grid_keys, path, is_markdown, file), JN_OK);
	rewind(file);
	text[fread(text, 1, 4095, file)] = '\0';
	fclose(file);
}

static void expect_in(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in:\n%s", part, text);
}

static void pairs_and_switches_are_described(void** state) {
	(void)state;
	char text[4096];
	describe("", false, text);
	expect_in(text, "[1, 0.5]");
	expect_in(text, "[4, 2]");
	expect_in(text, "false");
	expect_in(text, "two whole numbers");
}

static void a_table_that_holds_itself_is_described_once(void** state) {
	(void)state;
	char text[4096];
	describe("finer", false, text);
	expect_in(text, "(as above)");
	describe("", true, text);
	expect_in(text, "| `finer` | optional mapping |  |  | another one within |"); // a row is one line
	assert_null(strstr(text, "finer.finer"));
}

static void halves_of_bounds_are_named(void** state) {
	(void)state;
	static const struct {
		double low, high;
		JnOpen open;
		const char* text;
	} samples[] = {{0, 0, JN_CLOSED, ""},
				   {-INFINITY, INFINITY, JN_CLOSED, ""},
				   {1, INFINITY, JN_CLOSED, "[1, infinity)"},
				   {1, INFINITY, JN_OPEN_LOW, "(1, infinity)"},
				   {-INFINITY, 2, JN_CLOSED, "(-infinity, 2]"},
				   {-INFINITY, 2, JN_OPEN_HIGH, "(-infinity, 2)"}};
	for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i) {
		const JnKey key = {.low = samples[i].low, .high = samples[i].high, .open = samples[i].open};
		char text[64];
		jn_bounds_text(&key, sizeof text, text);
		assert_string_equal(text, samples[i].text);
	}
}

static int set_up(void** state) {
	return log_set_up(state);
}

static int tear_down(void** state) {
	jn_arena_free(&arena);
	return log_tear_down(state);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(pairs_are_filled_or_take_their_defaults),
		TEST(a_table_may_hold_itself),
		TEST(what_is_no_pair_is_refused_with_an_example),
		TEST(long_lists_of_words_are_cut),
		TEST(pairs_and_switches_are_described),
		TEST(a_table_that_holds_itself_is_described_once),
		TEST(halves_of_bounds_are_named),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
