// Keys that name a file: from where a relative path is taken.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/key.h"

typedef struct Picture {
	const char* path;
} Picture;

static const JnKey keys[] = {
	{.name = "path", .kind = JN_PATH, .field = offsetof(Picture, path), .required = true, .meaning = "the picture"},
	{0},
};

static void swallow(void* user, JnLogLevel level, const char* message) {
	(void)level;
	snprintf(user, 512, "%s", message);
}

static JnStatus read(const char* file, const char* text, const char* set, JnArena* arena, Picture* picture) {
	JnDocument document;
	JN_TRY(jn_document_parse(file, text, arena, &document));
	if (set != NULL) JN_TRY(jn_document_set(&document, set));
	return jn_keys_read(keys, document.root, "", arena, picture);
}

static void expect_path(const char* file, const char* text, const char* set, const char* expected) {
	JnArena arena = {0};
	Picture picture;
	assert_int_equal(read(file, text, set, &arena, &picture), JN_OK);
	assert_string_equal(picture.path, expected);
	jn_arena_free(&arena);
}

static void relative_paths_start_at_the_folder_of_the_file(void** unused) {
	(void)unused;
	expect_path("scenes/duck.yaml", "path: ../models/duck.obj", NULL, "scenes/../models/duck.obj");
	expect_path("duck.yaml", "path: duck.obj", NULL, "duck.obj");
}

static void absolute_paths_stay(void** unused) {
	(void)unused;
	expect_path("scenes/duck.yaml", "path: /data/duck.obj", NULL, "/data/duck.obj");
}

static void paths_of_overrides_start_at_the_current_folder(void** unused) {
	(void)unused;
	expect_path("scenes/duck.yaml", "path: duck.obj", "path=goose.obj", "goose.obj");
}

static void an_empty_path_is_refused(void** unused) {
	(void)unused;
	char message[512] = "";
	JnArena arena = {0};
	Picture picture;
	jn_log_set_sink(swallow, message);
	assert_int_equal(read("duck.yaml", "path: ''", NULL, &arena, &picture), JN_BAD_INPUT);
	jn_log_set_sink(NULL, NULL);
	assert_string_equal(message, "duck.yaml:1:1: path: is empty, but the path of a file is expected");
	jn_arena_free(&arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(relative_paths_start_at_the_folder_of_the_file),
		cmocka_unit_test(absolute_paths_stay),
		cmocka_unit_test(paths_of_overrides_start_at_the_current_folder),
		cmocka_unit_test(an_empty_path_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
