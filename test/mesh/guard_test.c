// Work in a child process: its result, its words, its crashes and its limits.
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/log.h"
#include "mesh/format/guard.h"
#include "support/support.h"

static const JnGuardLimits limits = {.memory = (size_t)256 << 20, .seconds = 10};

static JnStatus run(JnGuardedWork work, void* user, FILE** result) {
	log_capture();
	const JnStatus status = jn_guard_run("work", limits, work, user, result);
	log_release();
	return status;
}

static JnStatus square(void* user, FILE* result) {
	const int value = *(int*)user * *(int*)user;
	*(int*)user = 0; // in the child's memory alone
	jn_warn("a warning");
	return fwrite(&value, sizeof value, 1, result) == 1 ? JN_OK : JN_IO_FAILED;
}

static void a_child_gives_back_its_result_and_its_warnings(void** unused) {
	(void)unused;
	int number = 12, value = 0;
	FILE* result;
	assert_int_equal(run(square, &number, &result), JN_OK);
	assert_int_equal(fread(&value, sizeof value, 1, result), 1);
	assert_int_equal(value, 144);
	assert_int_equal(number, 12);
	assert_string_equal(log_text(), "a warning\n");
	fclose(result);
}

static JnStatus refuse(void* user, FILE* result) {
	(void)result;
	return jn_error(*(JnStatus*)user, "refused\nin two lines");
}

static void a_childs_status_and_words_are_those_of_the_call(void** unused) {
	(void)unused;
	JnStatus statuses[] = {JN_BAD_INPUT, JN_IO_FAILED, JN_OUT_OF_MEMORY, JN_RUN_FAILED, JN_NOT_CONVERGED};
	for (int i = 0; i < 5; ++i) {
		FILE* result;
		assert_int_equal(run(refuse, &statuses[i], &result), statuses[i]);
		assert_null(result);
		assert_string_equal(log_text(), "refused\nin two lines\n");
	}
}

static JnStatus die(void* user, FILE* result) {
	(void)result;
	raise(*(int*)user);
	return JN_OK;
}

static JnStatus leave(void* user, FILE* result) {
	(void)result;
	_exit(*(int*)user);
}

static void a_crash_becomes_an_error(void** unused) {
	(void)unused;
	int signals[] = {SIGSEGV, SIGABRT, SIGFPE, SIGKILL}, codes[] = {0, 1, 77};
	FILE* result;
	for (int i = 0; i < 4; ++i) {
		assert_int_equal(run(die, &signals[i], &result), JN_BAD_INPUT);
		assert_int_equal(strncmp(log_text(), "work: the library that works on it crashed", 42), 0);
		assert_null(result);
	}
	for (int i = 0; i < 3; ++i) assert_int_equal(run(leave, &codes[i], &result), JN_BAD_INPUT);
}

static JnStatus take_memory(void* user, FILE* result) {
	(void)user, (void)result;
	for (int i = 0; i < 64; ++i) {
		void* volatile block = malloc((size_t)16 << 20);
		if (block == NULL) return JN_OUT_OF_MEMORY;
	}
	return JN_OK;
}

/// 1 GiB where 256 MiB are allowed. A sanitizer's malloc ends the process instead of returning NULL.
static void a_child_cannot_take_all_memory(void** unused) {
	(void)unused;
	FILE* result;
	assert_true(run(take_memory, NULL, &result) < 0);
}

static JnStatus run_forever(void* user, FILE* result) {
	(void)user, (void)result;
	volatile int is_running = 1;
	while (is_running) continue;
	return JN_OK;
}

static void a_child_without_end_is_ended(void** unused) {
	(void)unused;
	FILE* result;
	log_capture();
	assert_int_equal(jn_guard_run("work", (JnGuardLimits){limits.memory, 1}, run_forever, NULL, &result), JN_BAD_INPUT);
	assert_string_equal(log_text(), "work: the library that works on it comes to no end\n");
	log_release();
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_child_gives_back_its_result_and_its_warnings),
		cmocka_unit_test(a_childs_status_and_words_are_those_of_the_call),
		cmocka_unit_test(a_crash_becomes_an_error),
		cmocka_unit_test(a_child_cannot_take_all_memory),
		cmocka_unit_test(a_child_without_end_is_ended),
	};
	return cmocka_run_group_tests_name("guard", tests, NULL, NULL);
}
