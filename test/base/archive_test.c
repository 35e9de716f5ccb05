/// @file archive_test.c
/// Archives: what is written reads back, and what does not fit is refused by its name and leaves everything as it is.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/archive.h"
#include "support/support.h"

static void what_is_written_reads_back(void** state) {
	(void)state;
	JnArchive archive = {0};
	double real = 0.1, reals[2] = {1, -2};
	int integer = -3, indices[3] = {0, 1, 2}, count;
	long large = 1L << 40;
	bool is_on = true;
	jn_archive_real(&archive, "real", &real);
	jn_archive_reals(&archive, "reals", reals, 2);
	jn_archive_integer(&archive, "integer", &integer);
	jn_archive_long(&archive, "long", &large);
	jn_archive_switch(&archive, "switch", &is_on);
	assert_int_equal(jn_archive_count(&archive, "count", 3, sizeof(int)), 3);
	jn_archive_indices(&archive, "indices", indices, 3, 0, 3);
	assert_string_equal(jn_archive_text(&archive, "text", "words"), "words");
	assert_int_equal(jn_archive_end(&archive), JN_OK); // there is nothing to read

	JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
	double real_read, reals_read[2];
	int integer_read, indices_read[3];
	long large_read;
	bool is_on_read = false;
	jn_archive_real(&reader, "real", &real_read);
	jn_archive_reals(&reader, "reals", reals_read, 2);
	jn_archive_integer(&reader, "integer", &integer_read);
	jn_archive_long(&reader, "long", &large_read);
	jn_archive_switch(&reader, "switch", &is_on_read);
	count = jn_archive_count(&reader, "count", 0, sizeof(int));
	jn_archive_indices(&reader, "indices", indices_read, 3, 0, 3);
	assert_string_equal(jn_archive_text(&reader, "text", NULL), "words");
	assert_int_equal(jn_archive_end(&reader), JN_OK);
	assert_true(real_read == real && integer_read == integer && large_read == large && is_on_read && count == 3);
	assert_memory_equal(reals_read, reals, sizeof reals);
	assert_memory_equal(indices_read, indices, sizeof indices);
	jn_archive_free(&reader); // borrowed: the bytes stay
	jn_archive_free(&archive);
}

// An archive of one piece, four integers; what reads it says why not.
static JnArchive four_integers(JnArchive* archive, const int values[4]) {
	*archive = (JnArchive){0};
	jn_archive_bytes(archive, "four", (void*)values, 4 * sizeof *values);
	log_capture();
	return jn_archive_reader(archive->bytes, archive->size);
}

static void expect_refused(JnArchive* reader, JnArchive* archive, const char* words) {
	assert_int_equal(reader->status, JN_BAD_INPUT);
	log_expect("the saved state does not fit: '");
	log_expect(words);
	jn_archive_free(archive);
}

static void indices_out_of_range_are_refused(void** state) {
	(void)state;
	static const int sets[2][4] = {{0, 1, -1, 2}, {0, 1, 3, 2}};
	for (int i = 0; i < 2; ++i) {
		int values[4] = {7, 7, 7, 7};
		JnArchive archive, reader = four_integers(&archive, sets[i]);
		jn_archive_indices(&reader, "four", values, 4, 0, 3);
		for (int k = 0; k < 4; ++k) assert_int_equal(values[k], 7);
		expect_refused(&reader, &archive, "'four' has numbers that the scene does not have");
	}
}

static void another_number_of_indices_is_refused(void** state) {
	(void)state;
	static const int set[4] = {0, 1, 2, 0};
	for (size_t count = 0; count < 8; count += 3) {
		int values[6] = {7, 7, 7, 7, 7, 7};
		JnArchive archive, reader = four_integers(&archive, set);
		jn_archive_indices(&reader, "four", values, count, 0, 3);
		for (int k = 0; k < 6; ++k) assert_int_equal(values[k], 7);
		expect_refused(&reader, &archive, "'four' has numbers that the scene does not have");
	}
}

static void a_count_that_cannot_be_is_refused(void** state) {
	(void)state;
	static const int counts[2] = {-1, 1000};
	for (int i = 0; i < 2; ++i) {
		JnArchive archive = {0};
		jn_archive_integer(&archive, "count", &(int){counts[i]});
		log_capture();
		JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
		assert_int_equal(jn_archive_count(&reader, "count", 5, 1), 0);
		expect_refused(&reader, &archive, "'count' is more than the archive holds");
	}
}

static void a_text_without_end_is_refused(void** state) {
	(void)state;
	static const char* const texts[] = {"", "ab", "a\0b\0"};
	static const size_t sizes[] = {0, 2, 4};
	for (int i = 0; i < 3; ++i) {
		JnArchive archive = {0};
		jn_archive_bytes(&archive, "text", (void*)texts[i], sizes[i]);
		log_capture();
		JnArchive reader = jn_archive_reader(archive.bytes, archive.size);
		assert_null(jn_archive_text(&reader, "text", NULL));
		expect_refused(&reader, &archive, "'text' is no text");
	}
}

static void another_name_or_size_is_refused(void** state) {
	(void)state;
	static const int set[4] = {0};
	int value = 7;
	JnArchive archive, reader = four_integers(&archive, set);
	jn_archive_integer(&reader, "five", &value);
	expect_refused(&reader, &archive, "'five' is not what stands in its place");
	reader = four_integers(&archive, set);
	jn_archive_integer(&reader, "four", &value);
	expect_refused(&reader, &archive, "'four' is of another size");
	assert_int_equal(value, 7);
}

static void what_is_cut_off_is_refused(void** state) {
	(void)state;
	static const int set[4] = {0};
	for (size_t size = 0; size < 32; ++size) { // a head of 16 bytes and 16 more
		int values[4];
		JnArchive archive, reader = four_integers(&archive, set);
		reader.size = size;
		jn_archive_bytes(&reader, "four", values, sizeof values);
		expect_refused(&reader, &archive, "'four' is not what stands in its place");
	}
}

static void what_is_left_over_is_refused(void** state) {
	(void)state;
	static const int set[4] = {0};
	JnArchive archive, reader = four_integers(&archive, set);
	assert_int_equal(jn_archive_end(&reader), JN_BAD_INPUT);
	expect_refused(&reader, &archive, "'end' is followed by more");
}

// Only the first refusal is told; all that follows does nothing.
static void after_a_refusal_everything_stays_as_it_is(void** state) {
	(void)state;
	static const int set[4] = {0, 1, 2, 0};
	int value = 7;
	double real = 7;
	bool is_on = true;
	JnArchive archive, reader = four_integers(&archive, set);
	jn_archive_integer(&reader, "five", &value);
	log_capture();
	jn_archive_integer(&reader, "four", &value);
	jn_archive_real(&reader, "four", &real);
	jn_archive_switch(&reader, "four", &is_on);
	jn_archive_indices(&reader, "four", &value, 1, 0, 9);
	assert_int_equal(jn_archive_count(&reader, "four", 3, 1), 0);
	assert_null(jn_archive_text(&reader, "four", NULL));
	jn_archive_refuse(&reader, "four", "is told");
	assert_int_equal(jn_archive_end(&reader), JN_BAD_INPUT);
	assert_string_equal(log_text(), "");
	assert_true(value == 7 && real == 7 && is_on);
	jn_archive_free(&archive);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_is_written_reads_back),
		cmocka_unit_test(indices_out_of_range_are_refused),
		cmocka_unit_test(another_number_of_indices_is_refused),
		cmocka_unit_test(a_count_that_cannot_be_is_refused),
		cmocka_unit_test(a_text_without_end_is_refused),
		cmocka_unit_test(another_name_or_size_is_refused),
		cmocka_unit_test(what_is_cut_off_is_refused),
		cmocka_unit_test(what_is_left_over_is_refused),
		cmocka_unit_test(after_a_refusal_everything_stays_as_it_is),
	};
	return cmocka_run_group_tests(tests, log_set_up, log_tear_down);
}
