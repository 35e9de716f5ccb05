/// @file log_test.c
/// Messages: where they go, with which level, and the names of statuses in them.
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/log.h"

typedef struct Kept {
	int count;
	JnLogLevel level;
	char message[64];
} Kept;

static void keep(void* user, JnLogLevel level, const char* message) {
	Kept* kept = user;
	++kept->count;
	kept->level = level;
	snprintf(kept->message, sizeof kept->message, "%s", message);
}

static void each_level_reaches_the_sink_as_such(void** state) {
	(void)state;
	Kept kept = {0};
	jn_log_set_sink(keep, &kept);
	assert_int_equal(jn_error(JN_IO_FAILED, "file %d", 7), JN_IO_FAILED);
	assert_true(kept.level == JN_LOG_ERROR && strcmp(kept.message, "file 7") == 0);
	jn_warn("slow by %g", 0.5);
	assert_true(kept.level == JN_LOG_WARNING && strcmp(kept.message, "slow by 0.5") == 0);
	jn_info("%s", "news");
	assert_true(kept.level == JN_LOG_INFO && strcmp(kept.message, "news") == 0);
	assert_int_equal(kept.count, 3);
	jn_log_set_sink(NULL, NULL);
}

static void a_sink_that_is_swapped_can_be_put_back(void** state) {
	(void)state;
	Kept outer = {0}, inner = {0};
	jn_log_set_sink(keep, &outer);
	const JnLog before = jn_log_swap((JnLog){keep, &inner});
	jn_warn("inside");
	jn_log_swap(before);
	jn_warn("outside");
	assert_true(inner.count == 1 && outer.count == 1);
	jn_log_set_sink(NULL, NULL);
}

static void without_a_sink_errors_and_warnings_go_to_stderr(void** state) {
	(void)state;
	char text[200] = "";
	FILE* file = tmpfile();
	assert_non_null(file);
	fflush(stderr);
	const int before = dup(2);
	dup2(fileno(file), 2);
	jn_error(JN_BAD_INPUT, "one");
	jn_warn("two");
	jn_info("three");
	fflush(stderr);
	dup2(before, 2);
	close(before);
	rewind(file);
	assert_true(fread(text, 1, sizeof text - 1, file) > 0);
	fclose(file);
	assert_string_equal(text, "jounce: error: one\njounce: warning: two\n");
}

static void every_status_has_a_name(void** state) {
	(void)state;
	const JnStatus all[] = {JN_OK,        JN_NOT_CONVERGED, JN_INDEFINITE,    JN_NOT_FINITE,
							JN_BAD_INPUT, JN_IO_FAILED,     JN_OUT_OF_MEMORY, JN_RUN_FAILED};
	enum { COUNT = sizeof all / sizeof *all };
	for (int i = 0; i < COUNT; ++i) {
		assert_string_not_equal(jn_status_name(all[i]), "unknown status");
		for (int k = 0; k < i; ++k) assert_string_not_equal(jn_status_name(all[i]), jn_status_name(all[k]));
	}
	assert_string_equal(jn_status_name((JnStatus)-99), "unknown status");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_level_reaches_the_sink_as_such),
		cmocka_unit_test(a_sink_that_is_swapped_can_be_put_back),
		cmocka_unit_test(without_a_sink_errors_and_warnings_go_to_stderr),
		cmocka_unit_test(every_status_has_a_name),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
