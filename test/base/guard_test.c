// Work in a child process: its result, its words, its crashes and its limits.
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/guard.h"
#include "base/log.h"
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
	assert_int_equal(
		jn_guard_run("work", (JnGuardLimits){.memory = limits.memory, .seconds = 1}, run_forever, NULL, &result),
		JN_BAD_INPUT);
	assert_string_equal(log_text(), "work: the library that works on it comes to no end\n");
	log_release();
}

static JnStatus chatter(void* user, FILE* result) {
	(void)user, (void)result;
	char text[5000];
	memset(text, 'a', sizeof text - 1);
	text[sizeof text - 1] = '\0';
	jn_info("for information");
	jn_warn("%s", text);
	return JN_OK;
}

static void long_words_of_a_child_are_cut_and_those_for_information_are_none_of_warnings(void** unused) {
	(void)unused;
	FILE* result;
	assert_int_equal(run(chatter, NULL, &result), JN_OK);
	assert_true(strlen(log_text()) > 1000 && strlen(log_text()) < 5000);
	assert_null(strstr(log_text(), "for information")); // the log of tests keeps errors and warnings
	fclose(result);
}

// Each child has two files in memory: for neither of them, or for one.
static void without_files_there_is_no_child(void** unused) {
	(void)unused;
	const int next = dup(0);
	struct rlimit before;
	int number = 3;
	assert_true(next > 0);
	close(next);
	getrlimit(RLIMIT_NOFILE, &before);
	for (int room = 0; room < 2; ++room) {
		FILE* result;
		setrlimit(RLIMIT_NOFILE, &(struct rlimit){(rlim_t)(next + room), before.rlim_max});
		const JnStatus status = run(square, &number, &result);
		setrlimit(RLIMIT_NOFILE, &before);
		assert_int_equal(status, JN_IO_FAILED);
		assert_null(result);
		assert_string_equal(log_text(), "work: cannot start a process for it: Too many open files\n");
	}
}

// ---- a child that answers ----

enum { TO_CRASH = -1, TO_RUN_ON = -2 };

/// Squares of numbers.
static void answer(const JnGuardChild* own, void* user) {
	(void)user;
	for (int number; read(own->socket, &number, sizeof number) == sizeof number;) {
		jn_guard_wind(own, 0);
		volatile int is_running = number == TO_RUN_ON;
		if (number == TO_CRASH) raise(SIGSEGV);
		while (is_running) continue;
		number *= number;
		if (write(own->socket, &number, sizeof number) != sizeof number) return;
	}
}

static bool ask(const JnGuardChild* child, int number, int* answer) {
	return write(child->socket, &number, sizeof number) == sizeof number &&
		   read(child->socket, answer, sizeof *answer) == sizeof *answer;
}

static void a_child_answers_until_it_is_ended(void** unused) {
	(void)unused;
	JnGuardChild child;
	int square = 0;
	assert_int_equal(jn_guard_start("work", limits, answer, NULL, &child), JN_OK);
	assert_true(ask(&child, 5, &square));
	assert_int_equal(square, 25);
	assert_true(ask(&child, 7, &square));
	assert_int_equal(square, 49);
	assert_int_equal(jn_guard_end("work", &child), JN_OK);
}

static void a_question_without_an_answer_is_told_when_the_child_is_ended(void** unused) {
	(void)unused;
	const JnGuardLimits short_limits = {.memory = limits.memory, .seconds = 1, .remedy = "mend it"};
	const int questions[] = {TO_CRASH, TO_RUN_ON};
	const char* const words[] = {
		"work: the library that works on it crashed (Segmentation fault); mend it\n",
		"work: the library that works on it comes to no end; mend it\n",
	};
	for (int i = 0; i < 2; ++i) {
		JnGuardChild child;
		int answer_to;
		assert_int_equal(jn_guard_start("work", short_limits, answer, NULL, &child), JN_OK);
		assert_false(ask(&child, questions[i], &answer_to));
		log_capture();
		assert_int_equal(jn_guard_end("work", &child), JN_BAD_INPUT);
		assert_string_equal(log_text(), words[i]);
		log_release();
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_child_gives_back_its_result_and_its_warnings),
		cmocka_unit_test(a_childs_status_and_words_are_those_of_the_call),
		cmocka_unit_test(a_crash_becomes_an_error),
		cmocka_unit_test(a_child_cannot_take_all_memory),
		cmocka_unit_test(a_child_without_end_is_ended),
		cmocka_unit_test(long_words_of_a_child_are_cut_and_those_for_information_are_none_of_warnings),
		cmocka_unit_test(without_files_there_is_no_child),
		cmocka_unit_test(a_child_answers_until_it_is_ended),
		cmocka_unit_test(a_question_without_an_answer_is_told_when_the_child_is_ended),
	};
	return cmocka_run_group_tests_name("guard", tests, NULL, NULL);
}
