/// @file checkpoint_test.c
/// Files of saved states: what is written reads back, old ones go, and each sort of damage is named.
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "record/checkpoint.h"
#include "support/support.h"

static const char content[] = "what a run remembers";
static char folder[256];

/// The head of a file: magic, version, order of bytes, size, check sum, zero.
enum { VERSION_AT = 8, ORDER_AT = 12, SIZE_AT = 16, SUM_AT = 24, HEAD = 32 };

static int set_up(void** state) {
	log_set_up(state);
	return folder_create(folder);
}

static int tear_down(void** state) {
	folder_remove(folder);
	return log_tear_down(state);
}

static void save(JnCheckpointKind kind, long step, int keep) {
	assert_int_equal(jn_checkpoint_write(folder, kind, step, content, sizeof content, keep), JN_OK);
}

static long newest(JnCheckpointKind kind, long before) {
	JnCheckpointFile file;
	return jn_checkpoint_find(folder, kind, before, &file) ? file.step : -1;
}

static void what_is_written_reads_back(void** state) {
	(void)state;
	JnCheckpointFile file;
	void* bytes = NULL;
	size_t size = 0;
	save(JN_CHECKPOINT_STEP, 12, 2);
	assert_true(jn_checkpoint_find(folder, JN_CHECKPOINT_STEP, LONG_MAX, &file));
	assert_int_equal(jn_checkpoint_read(file.path, &bytes, &size), JN_OK);
	assert_int_equal(size, sizeof content);
	assert_memory_equal(bytes, content, sizeof content);
	free(bytes);
}

static void the_newest_of_a_kind_stay(void** state) {
	(void)state;
	save(JN_CHECKPOINT_END, 3, 1);
	for (long step = 10; step < 15; ++step) save(JN_CHECKPOINT_STEP, step, 2);
	assert_int_equal(newest(JN_CHECKPOINT_STEP, LONG_MAX), 14);
	assert_int_equal(newest(JN_CHECKPOINT_STEP, 14), 13);
	assert_int_equal(newest(JN_CHECKPOINT_STEP, 13), -1);
	assert_int_equal(newest(JN_CHECKPOINT_END, LONG_MAX), 3);
}

static void other_files_are_neither_found_nor_removed(void** state) {
	(void)state;
	static const char* const names[] = {
		"step-.jnc", "step-x7.jnc", "step-9.jnc.tmp", "step-9", "step+9.jnc", "step-99999999999999999999.jnc", "notes"};
	save(JN_CHECKPOINT_STEP, 1, 1);
	const char* inside = path_join(folder, "checkpoints");
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i) file_write(path_join(inside, names[i]), "mine");
	assert_int_equal(newest(JN_CHECKPOINT_STEP, LONG_MAX), 1);
	jn_checkpoints_remove(folder);
	assert_int_equal(newest(JN_CHECKPOINT_STEP, LONG_MAX), -1);
	inside = path_join(folder, "checkpoints");
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i) assert_true(path_exists(path_join(inside, names[i])));
}

static void all_go_with_their_folder(void** state) {
	(void)state;
	save(JN_CHECKPOINT_STEP, 1, 3);
	save(JN_CHECKPOINT_STEP, 2, 3);
	save(JN_CHECKPOINT_END, 2, 1);
	jn_checkpoints_remove(folder);
	assert_false(path_exists(path_join(folder, "checkpoints")));
}

static void a_folder_that_cannot_be_made_is_named(void** state) {
	(void)state;
	file_write(path_join(folder, "checkpoints"), "a file is in the way");
	assert_int_equal(jn_checkpoint_write(folder, JN_CHECKPOINT_STEP, 1, content, sizeof content, 1), JN_IO_FAILED);
	log_expect(path_join(folder, "checkpoints"));
}

// A file with a changed byte, or cut to a length.
static void expect_damage(long at, long length, const char* words) {
	JnCheckpointFile file;
	unsigned char bytes[HEAD + sizeof content];
	void* read = NULL;
	size_t size = 0;
	save(JN_CHECKPOINT_STEP, 5, 1);
	assert_true(jn_checkpoint_find(folder, JN_CHECKPOINT_STEP, LONG_MAX, &file));
	FILE* stream = fopen(file.path, "r+b");
	assert_int_equal(fread(bytes, 1, sizeof bytes, stream), sizeof bytes);
	if (at >= 0) bytes[at] ^= 4;
	stream = freopen(file.path, "wb", stream);
	assert_int_equal(fwrite(bytes, 1, (size_t)length, stream), length);
	fclose(stream);
	log_capture();
	assert_int_equal(jn_checkpoint_read(file.path, &read, &size), JN_BAD_INPUT);
	log_expect(file.path);
	log_expect(words);
}

static void each_sort_of_damage_is_named(void** state) {
	(void)state;
	const long whole = HEAD + sizeof content;
	expect_damage(0, whole, "is no checkpoint of jounce");
	expect_damage(-1, 0, "is no checkpoint of jounce");
	expect_damage(-1, HEAD - 1, "has lost its beginning");
	expect_damage(VERSION_AT, whole, "is a checkpoint of version 5, but this program reads version 1");
	expect_damage(ORDER_AT, whole, "is a checkpoint of version 1 of another kind of processor");
	expect_damage(SIZE_AT, whole, "it has 21 bytes of 17");
	expect_damage(-1, whole - 1, "it has 20 bytes of 21");
	expect_damage(SUM_AT, whole, "its check sum is wrong");
	expect_damage(HEAD, whole, "its check sum is wrong");
}

static void what_is_no_file_is_told_as_such(void** state) {
	(void)state;
	void* bytes = NULL;
	size_t size = 0;
	assert_int_equal(jn_checkpoint_read(folder, &bytes, &size), JN_IO_FAILED);
	log_expect("cannot read the checkpoint: it is no file");
	assert_int_equal(jn_checkpoint_read(path_join(folder, "absent"), &bytes, &size), JN_IO_FAILED);
	log_expect("absent: cannot read the checkpoint: No such file or directory");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(what_is_written_reads_back),
		TEST(the_newest_of_a_kind_stay),
		TEST(other_files_are_neither_found_nor_removed),
		TEST(all_go_with_their_folder),
		TEST(a_folder_that_cannot_be_made_is_named),
		TEST(each_sort_of_damage_is_named),
		TEST(what_is_no_file_is_told_as_such),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
