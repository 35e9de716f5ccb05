/// @file folder_test.c
/// Folders for outputs: made with those above them, or refused by name with a remedy.
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "base/folder.h"
#include "support/support.h"

static char folder[256];

static int set_up(void** state) {
	log_set_up(state);
	return folder_create(folder);
}

static int tear_down(void** state) {
	folder_remove(folder);
	return log_tear_down(state);
}

static void folders_above_are_made_too(void** state) {
	(void)state;
	const char* path = path_join(folder, "a/b/c");
	assert_int_equal(jn_folder_make(path), JN_OK);
	assert_true(path_exists(path));
	assert_int_equal(jn_folder_make(path), JN_OK); // it is there already
}

static void a_name_that_is_none_is_refused_with_a_remedy(void** state) {
	(void)state;
	char name[5000];
	memset(name, 'a', sizeof name - 1);
	name[sizeof name - 1] = '\0';
	assert_int_equal(jn_folder_make(""), JN_IO_FAILED);
	log_expect("'' is no usable folder name; choose another output with -o");
	log_capture();
	assert_int_equal(jn_folder_make(name), JN_IO_FAILED);
	log_expect("is no usable folder name; choose another output with -o");
}

static void a_file_in_the_way_is_named(void** state) {
	(void)state;
	file_write(path_join(folder, "file"), "x");
	assert_int_equal(jn_folder_make(path_join(folder, "file")), JN_IO_FAILED);
	log_expect(path_join(folder, "file: is no folder; choose another output with -o"));
	log_capture();
	assert_int_equal(jn_folder_make(path_join(folder, "file/inside")), JN_IO_FAILED);
	log_expect("file/inside: cannot make this folder: Not a directory");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(folders_above_are_made_too),
		TEST(a_name_that_is_none_is_refused_with_a_remedy),
		TEST(a_file_in_the_way_is_named),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
