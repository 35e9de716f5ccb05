/// @file resume_test.c
/// The command `resume`: after an interrupt, a failure, a full disk; with damaged checkpoints; with other settings.
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

#include "support/support.h"

#define BEAM JN_SOURCE_DIR "/scenes/beam.yaml"

typedef struct Place {
	char folder[256];
} Place;

static int set_up(void** state) {
	Place* place = calloc(1, sizeof *place);
	*state = place;
	return place != NULL ? folder_create(place->folder) : -1;
}

static int tear_down(void** state) {
	Place* place = *state;
	folder_remove(place->folder);
	free(place);
	return 0;
}

enum { MOST_WORDS = 32 };

// jounce run beam.yaml, small and short, into `out`, with more words that end with NULL.
static Process start(const Place* place, const char* out, const char* const more[]) {
	const char* words[MOST_WORDS] = {"run",
									 BEAM,
									 "-q",
									 "-o",
									 out,
									 "--set",
									 "bodies[0].shape.cells=[2, 2, 8]",
									 "--set",
									 "record.plots=no",
									 "--set",
									 "duration=0.5 s"};
	int count = 11;
	for (; more != NULL && *more != NULL && count < MOST_WORDS - 1; ++more) words[count++] = *more;
	return command_start(place->folder, words);
}

static void expect_done(Outcome outcome) {
	if (outcome.status != 0) fail_msg("%s", outcome.err);
	outcome_free(&outcome);
}

static void expect_same_file(const Place* place, const char* name, const char* other) {
	char *a = file_read(path_join(place->folder, name)), *b = file_read(path_join(place->folder, other));
	if (strcmp(a, b) != 0) fail_msg("%s and %s differ", name, other);
	free(a);
	free(b);
}

// Newest file of checkpoints/ that begins so; false: there is none.
static bool find_checkpoint(const Place* place, const char* run, const char* prefix, char name[256]) {
	char folder[300];
	snprintf(folder, sizeof folder, "%s/%s/checkpoints", place->folder, run);
	DIR* stream = opendir(folder);
	name[0] = '\0';
	for (struct dirent* entry; stream != NULL && (entry = readdir(stream)) != NULL;)
		if (strncmp(entry->d_name, prefix, strlen(prefix)) == 0 && strcmp(entry->d_name, name) > 0)
			snprintf(name, 256, "%s", entry->d_name);
	if (stream != NULL) closedir(stream);
	return name[0] != '\0';
}

static void damage(const Place* place, const char* run, const char* name) {
	char path[700];
	snprintf(path, sizeof path, "%s/%s/checkpoints/%s", place->folder, run, name);
	FILE* file = fopen(path, "r+b");
	assert_non_null(file);
	assert_int_equal(fseek(file, 200, SEEK_SET), 0);
	const int byte = fgetc(file);
	assert_int_equal(fseek(file, 200, SEEK_SET), 0);
	assert_int_equal(fputc(byte ^ 1, file), byte ^ 1);
	assert_int_equal(fclose(file), 0);
}

static void wait_for_steps(const Place* place, const char* run) {
	char path[300];
	snprintf(path, sizeof path, "%s/%s/run.h5", place->folder, run);
	for (int i = 0; i < 1000 && !path_exists(path); ++i) usleep(10000);
	usleep(50000);
}

// Long enough to be interrupted before its end on any machine; what is compared are the first rows.
static void an_interrupted_run_goes_on_bit_for_bit(void** state) {
	const Place* place = *state;
	const char* const endless[] = {"--set", "duration=1e6 s", NULL};
	char name[256];
	Process process = start(place, "stopped", endless);
	wait_for_steps(place, "stopped");
	kill(process.id, SIGTERM);
	expect_done(command_wait(process));
	assert_true(find_checkpoint(place, "stopped", "step-", name)); // that of its start, if it got no further
	const char* const resume[] = {"resume", "stopped", "-q", "--from", name, "--set", "duration=0.5 s", NULL};
	expect_done(command_run(place->folder, resume));
	expect_done(command_wait(start(place, "whole", (const char* const[]){NULL})));
	expect_same_file(place, "stopped/series.csv", "whole/series.csv");
}

static void a_run_that_was_done_can_be_made_longer(void** state) {
	const Place* place = *state;
	const char* const save[] = {"--set", "checkpoint.every=0.1 s", NULL};
	const char* const save_longer[] = {"--set", "checkpoint.every=0.1 s", "--set", "duration=0.8 s", NULL};
	expect_done(command_wait(start(place, "short", save)));
	expect_done(
		command_run(place->folder, (const char* const[]){"resume", "short", "-q", "--set", "duration=0.8 s", NULL}));
	expect_done(command_wait(start(place, "long", save_longer)));
	expect_same_file(place, "short/series.csv", "long/series.csv");
}

static void of_a_damaged_checkpoint_the_one_before_is_offered_and_serves(void** state) {
	const Place* place = *state;
	const char* const save[] = {"--set", "checkpoint.every=0.1 s", NULL};
	char newest[256], offered[256];
	expect_done(command_wait(start(place, "run", save)));
	char* whole = file_read(path_join(place->folder, "run/series.csv"));
	assert_true(find_checkpoint(place, "run", "step-", newest));
	damage(place, "run", newest);
	Outcome outcome = command_run(place->folder, (const char* const[]){"resume", "run", NULL});
	assert_int_equal(outcome.status, 2);
	assert_non_null(strstr(outcome.err, newest));
	assert_non_null(strstr(outcome.err, "is damaged: its check sum is wrong"));
	const char* offer = strstr(outcome.err, "jounce resume run --from ");
	assert_non_null(offer);
	assert_int_equal(sscanf(offer, "jounce resume run --from %255s", offered), 1);
	outcome_free(&outcome);
	expect_done(command_run(place->folder, (const char* const[]){"resume", "run", "-q", "--from", offered, NULL}));
	char* again = file_read(path_join(place->folder, "run/series.csv"));
	assert_string_equal(whole, again);
	free(whole);
	free(again);
}

static void where_nothing_was_saved_the_message_says_so(void** state) {
	const Place* place = *state;
	Outcome outcome = command_run(place->folder, (const char* const[]){"resume", "nowhere", NULL});
	assert_int_equal(outcome.status, 2);
	assert_non_null(strstr(outcome.err, "nowhere: there are no checkpoints"));
	outcome_free(&outcome);
}

// Explicit steps far too large: the run fails, and with smaller steps goes on from its last good state.
static void a_run_that_failed_goes_on_with_smaller_steps(void** state) {
	const Place* place = *state;
	const char* const explicit_run[] = {"--set", "bodies[0].mass=lumped",     "--set", "integrator.method=verlet",
										"--set", "step={dt: 20 ms, cuts: 0}", NULL};
	const char* const resume[] = {"resume", "run", "-q", "--set", "step.dt=0.5 ms", "--from", NULL, NULL};
	const char* words[8];
	char first[256];
	Outcome outcome = command_wait(start(place, "run", explicit_run));
	assert_int_equal(outcome.status, 1);
	outcome_free(&outcome);
	assert_true(find_checkpoint(place, "run", "end-", first));  // where it failed
	assert_true(find_checkpoint(place, "run", "step-", first)); // the last before: its start
	memcpy(words, resume, sizeof resume);
	words[6] = first;
	expect_done(command_run(place->folder, words));
	char* summary = file_read(path_join(place->folder, "run/summary.json"));
	assert_non_null(strstr(summary, "\"outcome\": \"done\""));
	free(summary);
}

static void other_nodes_are_refused(void** state) {
	const Place* place = *state;
	const char* const save[] = {"--set", "checkpoint.every=0.1 s", NULL};
	expect_done(command_wait(start(place, "run", save)));
	char* summary = file_read(path_join(place->folder, "run/summary.json"));
	const char* const resume[] = {"resume", "run", "--set", "bodies[0].shape.cells=[2, 2, 9]", NULL};
	Outcome outcome = command_run(place->folder, resume);
	assert_int_equal(outcome.status, 2);
	assert_non_null(strstr(outcome.err, "of another scene"));
	outcome_free(&outcome);
	char* after = file_read(path_join(place->folder, "run/summary.json"));
	assert_string_equal(summary, after); // nothing was touched
	free(summary);
	free(after);
}

// A limit on the size of files stands for a full disk.
static void after_a_full_disk_the_run_goes_on(void** state) {
	const Place* place = *state;
	const char* const save[] = {"--set", "checkpoint.every=0.1 s", "--set", "record.interval=0", NULL};
	struct rlimit before, small = {.rlim_cur = 400000, .rlim_max = RLIM_INFINITY};
	assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
	signal(SIGXFSZ, SIG_IGN);
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
	Outcome outcome = command_wait(start(place, "run", save));
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
	assert_int_equal(outcome.status, 3);
	assert_non_null(strstr(outcome.err, "run.h5"));
	outcome_free(&outcome);
	expect_done(command_run(place->folder, (const char* const[]){"resume", "run", "-q", NULL}));
	expect_done(command_wait(start(place, "whole", save)));
	expect_same_file(place, "run/series.csv", "whole/series.csv");
}

static void two_runs_do_not_share_a_folder(void** state) {
	const Place* place = *state;
	const char* const endless[] = {"--set", "duration=1e6 s", NULL};
	Process first = start(place, "run", endless);
	wait_for_steps(place, "run");
	Outcome second = command_wait(start(place, "run", NULL));
	kill(first.id, SIGINT);
	expect_done(command_wait(first));
	assert_int_equal(second.status, 3);
	assert_non_null(strstr(second.err, "another run writes to it"));
	outcome_free(&second);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(an_interrupted_run_goes_on_bit_for_bit),
		TEST(a_run_that_was_done_can_be_made_longer),
		TEST(of_a_damaged_checkpoint_the_one_before_is_offered_and_serves),
		TEST(where_nothing_was_saved_the_message_says_so),
		TEST(a_run_that_failed_goes_on_with_smaller_steps),
		TEST(other_nodes_are_refused),
		TEST(after_a_full_disk_the_run_goes_on),
		TEST(two_runs_do_not_share_a_folder),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
