/// @file arena_test.c
/// Arenas: pieces are aligned, zero, apart from each other, and refused with a message when too large.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/arena.h"

static void count_message(void* user, JnLogLevel level, const char* message) {
	(void)message;
	*(int*)user += level == JN_LOG_ERROR;
}

static void pieces_are_aligned_zero_and_apart(void** state) {
	(void)state;
	static const size_t sizes[] = {1, 63, 64, 65, 4000, 65535, 65536, 65537, 200000, 3};
	enum { COUNT = sizeof sizes / sizeof *sizes };
	JnArena arena = {0};
	unsigned char* pieces[3 * COUNT];
	for (int i = 0; i < 3 * COUNT; ++i) {
		const size_t size = sizes[i % COUNT];
		pieces[i] = jn_arena_take(&arena, size, 1);
		assert_non_null(pieces[i]);
		assert_int_equal((uintptr_t)pieces[i] % 64, 0);
		for (size_t k = 0; k < size; ++k) assert_int_equal(pieces[i][k], 0);
		memset(pieces[i], i + 1, size);
	}
	for (int i = 0; i < 3 * COUNT; ++i) // nobody wrote into another's piece
		for (size_t k = 0; k < sizes[i % COUNT]; ++k) assert_int_equal(pieces[i][k], i + 1);
	jn_arena_free(&arena);
}

static void a_freed_arena_is_empty_and_usable(void** state) {
	(void)state;
	JnArena arena = {0};
	memset(jn_arena_take(&arena, 100, 8), 0xff, 800);
	assert_true(arena.used >= 800);
	jn_arena_free(&arena);
	assert_true(arena.used == 0 && arena.blocks == NULL);
	const unsigned char* again = jn_arena_take(&arena, 100, 8);
	for (int k = 0; k < 800; ++k) assert_int_equal(again[k], 0);
	jn_arena_free(&arena);
	jn_arena_free(&arena);
}

static void nothing_is_a_valid_size(void** state) {
	(void)state;
	JnArena arena = {0};
	assert_non_null(jn_arena_take(&arena, 0, 8));
	assert_non_null(jn_arena_take(&arena, 8, 0));
	jn_arena_free(&arena);
}

static void sizes_that_overflow_are_refused_with_a_message(void** state) {
	(void)state;
	static const size_t requests[][2] = {
		{SIZE_MAX, 1}, {SIZE_MAX, SIZE_MAX}, {SIZE_MAX / 8 + 2, 8}, {(size_t)1 << 63, 2}, {(size_t)1 << 46, 1}};
	JnArena arena = {0};
	assert_non_null(jn_arena_take(&arena, 10, 1));
	const size_t used = arena.used;
	int messages = 0;
	jn_log_set_sink(count_message, &messages);
	for (int i = 0; i < 5; ++i) assert_null(jn_arena_take(&arena, requests[i][0], requests[i][1]));
	jn_log_set_sink(NULL, NULL);
	assert_int_equal(messages, 5);
	assert_true(arena.used == used);
	jn_arena_free(&arena);
}

static void texts_are_copied_whole(void** state) {
	(void)state;
	JnArena arena = {0};
	char text[] = "beam";
	char* copy = jn_arena_text(&arena, text);
	text[0] = 'B';
	assert_string_equal(copy, "beam");
	assert_string_equal(jn_arena_text(&arena, ""), "");
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(pieces_are_aligned_zero_and_apart),
		cmocka_unit_test(a_freed_arena_is_empty_and_usable),
		cmocka_unit_test(nothing_is_a_valid_size),
		cmocka_unit_test(sizes_that_overflow_are_refused_with_a_message),
		cmocka_unit_test(texts_are_copied_whole),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
