/// @file refused_call_test.c
/// A run is recorded, noted in an archive and gone on with, while one call of HDF5 or of the system fails: each in turn.
/// Either that is told once, with the file and the reason, or the recording is whole all the same. Nothing stays open. (HDF5 1.10
/// cannot end properly after a header that could not be read, and says so as the program ends.)
#include "sample_run.h"

#include <dirent.h>
#include <errno.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "support/refused_calls.h"
#include "support/support.h"

enum { NOTED = 5, STEPS = 7 };

static const double sample_volumes[8] = {1, 2, 3, 4, 5, 6, 7, 8};
static const JnThread sample_thread = {.frame_count = 4, .radius = 0.25, .axis = {1, 0, 0}};

static int open_files(void) {
	int count = 0;
	DIR* folder = opendir("/proc/self/fd");
	while (readdir(folder) != NULL) ++count;
	closedir(folder);
	return count;
}

typedef void Prepare(Sample* sample);

static void prepare_plain(Sample* sample) {
	sample_add_obstacles(sample);
	sample->info.wants_plots = false;
	sample->info.column_count = 3;
}

// Bodies, obstacles, fields and surfaces of all sorts.
static void prepare_all(Sample* sample) {
	prepare_plain(sample);
	sample_embed(sample);
	sample_add_fields(sample);
	sample->bodies[0].volumes = sample_volumes;
	sample->bodies[1].thread = &sample_thread;
}

static JnStatus write_steps(Sample* sample, long first, long end) {
	for (long k = first; k < end; ++k) JN_TRY(sample_write(sample, k));
	return JN_OK;
}

// What a checkpoint does.
static JnStatus note(Sample* sample, JnArchive* archive) {
	JN_TRY(jn_recorders_sync(&sample->recorders));
	jn_recorders_archive(&sample->recorders, archive);
	return archive->status;
}

static JnStatus end_run(Sample* sample, JnStatus status) {
	const JnStatus closed = sample_close(sample);
	return status != JN_OK ? status : closed;
}

static JnStatus record(Sample* sample, JnArchive* archive) {
	JN_TRY(sample_open(sample));
	JnStatus status = write_steps(sample, 0, NOTED);
	if (status == JN_OK) status = note(sample, archive);
	if (status == JN_OK) status = write_steps(sample, NOTED, STEPS);
	return end_run(sample, status);
}

// After a run that was cut off: some of what it has written is written again.
static JnStatus go_on(Sample* sample, const JnArchive* noted) {
	JnArchive archive = jn_archive_reader(noted->bytes, noted->size);
	JN_TRY(jn_recorders_open(&sample->recorders, &sample->arena, &sample->info, &archive));
	return end_run(sample, write_steps(sample, NOTED, STEPS));
}

static JnStatus tell_story(Sample* sample) {
	JnArchive archive = {0};
	JnStatus status = record(sample, &archive);
	if (status == JN_OK) status = go_on(sample, &archive);
	jn_archive_free(&archive);
	return status;
}

// Frames of the steps 0 and 5, and all rows.
static bool is_whole(const Sample* sample) {
	hsize_t rows = 0;
	const hid_t file = H5Fopen(sample_path(sample, "run.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
	const bool has_frames = file >= 0 && H5Lexists(file, "/frames/00000001/velocity", H5P_DEFAULT) > 0 &&
							H5Lexists(file, "/frames/00000002", H5P_DEFAULT) == 0;
	const hid_t series = H5Dopen2(file, "/series/dt", H5P_DEFAULT), space = H5Dget_space(series);
	H5Sget_simple_extent_dims(space, &rows, NULL);
	H5Sclose(space);
	H5Dclose(series);
	H5Fclose(file);
	char* summary = sample_read(sample, "summary.json");
	const bool has_summary = strstr(summary, "\"outcome\": \"done\"") != NULL;
	free(summary);
	return has_frames && has_summary && rows == STEPS;
}

static const char* fault_of(const Sample* sample, int kinds, JnStatus status) {
	const char* words = sample->messages;
	if (H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) > 0) return "objects of HDF5 stay open";
	if (status == JN_OK) return is_whole(sample) ? NULL : "the recording is not whole";
	if (status != JN_IO_FAILED) return jn_status_name(status);
	if (strstr(words, sample->directory) == NULL) return "the message names no file";
	if (kinds != CALL_HDF5 && strstr(words, strerror(EIO)) == NULL) return "the message gives no reason";
	return strchr(words, '\n') == strrchr(words, '\n') ? NULL : "it is told more than once";
}

// Returns whether it ended badly.
static bool refuse(int kinds, long number, Prepare* prepare) {
	void* state;
	assert_int_equal(sample_setup(&state), 0);
	Sample* sample = state;
	prepare(sample);
	const int open = open_files();
	refused_call_set(kinds, number);
	const JnStatus status = tell_story(sample);
	const char* name = refused_call_name();
	refused_call_set(0, 0);
	const char* fault = open_files() != open ? "files stay open" : fault_of(sample, kinds, status);
	if (fault != NULL)
		print_message("call %ld, %s: %s; \"%s\"\n", number, name != NULL ? name : "none", fault, sample->messages);
	sample_teardown(&state);
	return fault != NULL || name == NULL;
}

static long count_calls(int kinds, Prepare* prepare) {
	void* state;
	assert_int_equal(sample_setup(&state), 0);
	prepare(state);
	refused_call_set(kinds, 0);
	assert_int_equal(tell_story(state), JN_OK);
	const long count = refused_call_count();
	refused_call_set(0, 0);
	assert_true(is_whole(state));
	sample_teardown(&state);
	return count;
}

static void sweep(int kinds, Prepare* prepare) {
	const long count = count_calls(kinds, prepare);
	int bad = 0;
	for (long number = 1; number <= count; ++number) bad += refuse(kinds, number, prepare);
	print_message("%ld calls\n", count);
	assert_int_equal(bad, 0);
}

static void a_call_of_hdf5_that_fails_is_told_with_the_file(void** state) {
	(void)state;
	sweep(CALL_HDF5, prepare_all);
}

static void a_call_of_the_system_that_fails_is_told_with_file_and_reason(void** state) {
	(void)state;
	sweep(CALL_SYSTEM | CALL_BYTES, prepare_plain);
}

// The recorder of plots alone, with a step size to draw over time.
static JnStatus draw(Sample* sample) {
	extern const JnRecorderType jn_recorder_plots;
	const JnRecorderType* type = &jn_recorder_plots;
	const JnRecordEnd end = sample_end();
	JnRecorder* recorder = calloc(1, type->size);
	sample->info.column_count = 3;
	*recorder = (JnRecorder){.type = type, .info = &sample->info};
	JnStatus status = type->open(recorder, &sample->info);
	for (long k = 0; k < STEPS && status == JN_OK; ++k) {
		double values[SAMPLE_COLUMNS];
		sample_values(k, values);
		status = type->write(recorder, &(JnRecordStep){.step = k, .t = values[1], .values = values});
	}
	const JnStatus closed = type->close(recorder, &end);
	free(recorder);
	return status != JN_OK ? status : closed;
}

// Returns whether that call was there.
static bool refuse_to_draw(long number) {
	void* state;
	assert_int_equal(sample_setup(&state), 0);
	Sample* sample = state;
	const int open = open_files();
	refused_call_set(CALL_SYSTEM | CALL_BYTES, number);
	const JnStatus status = draw(sample);
	const bool was_refused = refused_call_name() != NULL;
	refused_call_set(0, 0);
	assert_int_equal(open_files(), open);
	if (status == JN_OK)
		assert_int_equal(access(sample_path(sample, "plots/step_size.gnuplot"), R_OK), 0);
	else
		assert_int_equal(status, JN_IO_FAILED);
	if (status != JN_OK || sample->messages[0] != '\0') assert_non_null(strstr(sample->messages, sample->directory));
	sample_teardown(&state);
	return was_refused;
}

// Pictures are a courtesy; their scripts are not.
static void a_call_that_fails_while_plots_are_drawn_is_told_or_done_without(void** state) {
	char folder[256];
	(void)state;
	assert_int_equal(folder_create(folder), 0);
	file_write(path_join(folder, "gnuplot"), "#!/bin/sh\n");
	assert_int_equal(chmod(path_join(folder, "gnuplot"), 0700), 0);
	char* path = strdup(getenv("PATH"));
	setenv("PATH", folder, 1);
	long number = 1;
	while (refuse_to_draw(number)) ++number;
	setenv("PATH", path, 1);
	print_message("%ld calls\n", number - 1);
	assert_true(number > 5);
	free(path);
	folder_remove(folder);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_call_of_hdf5_that_fails_is_told_with_the_file),
		cmocka_unit_test(a_call_of_the_system_that_fails_is_told_with_file_and_reason),
		cmocka_unit_test(a_call_that_fails_while_plots_are_drawn_is_told_or_done_without),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
