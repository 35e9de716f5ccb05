/// @file aligned_test.c
/// Aligned memory: where it begins, that it is zeroed, and that taking it again and again takes no more.
#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/aligned.h"

enum { PIECES = 200, SMALL = 2000 };

static void begins_at_a_cache_line_and_is_zeroed_to_its_end(void** state) {
	(void)state;
	for (size_t bytes = 0; bytes < 200; bytes += 7) {
		unsigned char* memory = jn_aligned_take(bytes);
		assert_non_null(memory);
		assert_int_equal((uintptr_t)memory % JN_ALIGNMENT, 0);
		const size_t lines = (bytes + JN_ALIGNMENT - 1) / JN_ALIGNMENT * JN_ALIGNMENT;
		for (size_t i = 0; i < lines; ++i) assert_int_equal(memory[i], 0);
		memset(memory, 0xff, lines);
		jn_aligned_free(memory);
	}
	jn_aligned_free(NULL);
}

static void refuses_what_no_machine_has(void** state) {
	(void)state;
	assert_null(jn_aligned_take(SIZE_MAX));
	assert_null(jn_aligned_take(SIZE_MAX - 100));
}

// 4 to 60 KiB, as the arrays of models have: below what malloc maps by itself.
static size_t bytes_of(int piece) {
	return 4096 + 64 * (size_t)(piece * 37 % 880);
}

// Free all pieces and take them again, while small ones come and go between them.
static void renew(void* pieces[PIECES], void* small[SMALL], int round) {
	for (int i = 0; i < PIECES; ++i) jn_aligned_free(pieces[i]);
	for (int i = 0; i < PIECES; ++i) {
		pieces[i] = jn_aligned_take(bytes_of(i));
		for (int k = 0; k < 5; ++k) {
			void** const one = &small[(i * 7 + round * 11 + k * 391) % SMALL];
			free(*one);
			*one = malloc(24 + (size_t)(i * 13 + round * 5 + k * 29) % 100);
		}
	}
}

// glibc 2.36's aligned_alloc makes the heap 28 % larger in 50 rounds; the few kilobytes are the small ones.
static void renewing_pieces_leaves_the_heap_as_it_is(void** state) {
	(void)state;
	void *pieces[PIECES] = {NULL}, *small[SMALL] = {NULL};
	for (int round = 0; round < 3; ++round) renew(pieces, small, round);
	const size_t before = mallinfo2().arena;
	for (int round = 3; round < 50; ++round) renew(pieces, small, round);
	assert_in_range(mallinfo2().arena, 0, before + before / 50);
	for (int i = 0; i < PIECES; ++i) jn_aligned_free(pieces[i]);
	for (int i = 0; i < SMALL; ++i) free(small[i]);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(begins_at_a_cache_line_and_is_zeroed_to_its_end),
		cmocka_unit_test(refuses_what_no_machine_has),
		cmocka_unit_test(renewing_pieces_leaves_the_heap_as_it_is),
	};
	return cmocka_run_group_tests_name("base_aligned", tests, NULL, NULL);
}
