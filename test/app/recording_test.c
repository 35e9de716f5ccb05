// Recordings that declare more than they hold are refused with a reason, before memory is taken for what they declare, and so
// are those on which HDF5 crashes.
#define _GNU_SOURCE // memmem
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <hdf5.h>
#include <cmocka.h>

#include "compare_recording.h"
#include "fuzz/support/sample_recordings.h"
#include "recording.h"
#include "support/support.h"
#include "view_run.h"

static char folder[256];

static int set_up(void** state) {
	(void)state;
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static void write_copy(const unsigned char* image, size_t size) {
	FILE* file = fopen(path_join(folder, "run.h5"), "wb");
	assert_non_null(file);
	assert_int_equal(fwrite(image, 1, size, file), size);
	assert_int_equal(fclose(file), 0);
}

/// A copy of the recording of cells and a thread, open for changes.
static hid_t open_copy(void) {
	write_copy(sample_recordings()->image, sample_recordings()->size);
	const hid_t copy = H5Fopen(path_join(folder, "run.h5"), H5F_ACC_RDWR, H5P_DEFAULT);
	assert_true(copy >= 0);
	return copy;
}

/// Chunks that are not written take no place: any size can be declared.
static void declare(hid_t file, const char* name, hid_t type, int rank, const hsize_t sizes[]) {
	const hsize_t chunk[2] = {1024, 3};
	const hid_t space = H5Screate_simple(rank, sizes, NULL), layout = H5Pcreate(H5P_DATASET_CREATE);
	H5Pset_chunk(layout, rank, chunk);
	assert_true(H5Ldelete(file, name, H5P_DEFAULT) >= 0);
	const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
	assert_true(dataset >= 0);
	H5Dclose(dataset);
	H5Pclose(layout);
	H5Sclose(space);
}

static void set_attribute(hid_t file, const char* object, const char* name, hsize_t length, int value) {
	int values[256];
	for (int i = 0; i < 256; ++i) values[i] = value;
	const hid_t space = length == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &length, NULL);
	assert_true(H5Adelete_by_name(file, object, name, H5P_DEFAULT) >= 0);
	const hid_t attribute =
		H5Acreate_by_name(file, object, name, H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
	assert_true(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT, values) >= 0);
	H5Aclose(attribute);
	H5Sclose(space);
}

/// All three readers refuse what is in the folder; the first one's words hold `part`.
static void expect_refusal(const char* part, bool is_compared_too) {
	Recording recording;
	ViewRun run;
	CompareRecording compared;
	log_capture();
	assert_int_equal(recording_open(folder, &recording), JN_BAD_INPUT);
	recording_close(&recording);
	log_expect(part);
	const JnStatus status = view_run_open(&run, folder);
	assert_true(status == JN_BAD_INPUT || status == JN_IO_FAILED);
	view_run_close(&run);
	if (is_compared_too) assert_int_equal(compare_recording_open(folder, &compared), JN_IO_FAILED);
	if (is_compared_too) compare_recording_close(&compared);
	log_release();
}

/// 2^31 - 1 rows of three doubles are 48 GiB.
static void nodes_that_are_not_in_the_file_are_refused(void** unused) {
	(void)unused;
	const hsize_t sizes[2] = {INT32_MAX / 3, 3};
	const hid_t file = open_copy();
	declare(file, "/mesh/nodes", H5T_NATIVE_DOUBLE, 2, sizes);
	H5Fclose(file);
	expect_refusal("/mesh/nodes declares 2147483646 numbers, but the file has bytes for 0 at most", true);
}

static void frames_that_are_not_in_the_file_are_refused(void** unused) {
	(void)unused;
	const hid_t file = open_copy();
	set_attribute(file, "/frames", "count", 1, INT32_MAX);
	H5Fclose(file);
	expect_refusal("/frames declares 2147483647 frames, but holds 3", true);
}

/// An array of 256 numbers would be written over what stands behind the one that is asked for.
static void an_attribute_with_many_values_is_refused(void** unused) {
	(void)unused;
	const hid_t file = open_copy();
	set_attribute(file, "/mesh/beam/cells", "first_node", 256, 0);
	set_attribute(file, "/mesh/beam/surface", "first_point", 256, 0);
	H5Fclose(file);
	expect_refusal("/mesh/beam/cells is missing or not as it should be", false);
}

/// The viewer keeps a row for each point: 2^29 of them would be 12 GiB.
static void points_beyond_those_of_the_bodies_are_refused(void** unused) {
	(void)unused;
	const hid_t file = open_copy();
	const char* embedded = "embedded";
	const hid_t surface = H5Oopen(file, "/mesh/beam/surface", H5P_DEFAULT); // stays open: see src/record/h5_file.c
	const hid_t attribute = H5Aopen(surface, "kind", H5P_DEFAULT);
	const hid_t type = H5Aget_type(attribute);
	assert_true(H5Awrite(attribute, type, &embedded) >= 0);
	H5Tclose(type);
	H5Aclose(attribute);
	H5Oclose(surface);
	set_attribute(file, "/mesh/beam/surface", "first_point", 1, 1 << 28);
	H5Fclose(file);
	expect_refusal("damaged", false);
}

/// Texts lie in heaps, which have no check sum: HDF5 1.10.8 follows the length of the first one out of its memory. Later
/// versions may see it; what they say of a text that is missing ends in the same status.
static void texts_on_which_hdf5_crashes_are_refused(void** unused) {
	(void)unused;
	enum { LENGTH_AT = 24 };
	const Sample* sample = sample_recordings();
	unsigned char* image = malloc(sample->size);
	assert_non_null(image);
	memcpy(image, sample->image, sample->size);
	unsigned char* heap = memmem(image, sample->size, "GCOL", 4);
	assert_non_null(heap);
	memset(heap + LENGTH_AT, 255, 8);
	write_copy(image, sample->size);
	free(image);
	expect_refusal("run.h5", false); // a comparison reads no texts
}

/// Opening it would wait for somebody to write into it.
static void a_pipe_in_place_of_a_recording_is_refused(void** unused) {
	(void)unused;
	assert_int_equal(mkfifo(path_join(folder, "run.h5"), 0600), 0);
	expect_refusal("this is no HDF5 file", true);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(nodes_that_are_not_in_the_file_are_refused, set_up, tear_down),
		cmocka_unit_test_setup_teardown(frames_that_are_not_in_the_file_are_refused, set_up, tear_down),
		cmocka_unit_test_setup_teardown(an_attribute_with_many_values_is_refused, set_up, tear_down),
		cmocka_unit_test_setup_teardown(texts_on_which_hdf5_crashes_are_refused, set_up, tear_down),
		cmocka_unit_test_setup_teardown(a_pipe_in_place_of_a_recording_is_refused, set_up, tear_down),
		cmocka_unit_test_setup_teardown(points_beyond_those_of_the_bodies_are_refused, set_up, tear_down),
	};
	return cmocka_run_group_tests_name("recording", tests, NULL, NULL);
}
