/// @file resume_test.c
/// Recorders that go on with files of another run say so; and what a writer holds back of run.h5, and what it has left.
#include "sample_run.h"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <zlib.h>

#include "record/h5_driver.h"
#include "record/h5_journal.h"
#include "support/support.h"

// A run up to before step `end`, noted there.
static JnArchive note_run(Sample* sample, long end) {
	JnArchive archive = {0};
	sample->info.wants_plots = false;
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k < end; k++) assert_int_equal(sample_write(sample, k), JN_OK);
	assert_int_equal(jn_recorders_sync(&sample->recorders), JN_OK);
	jn_recorders_archive(&sample->recorders, &archive);
	assert_int_equal(archive.status, JN_OK);
	assert_int_equal(sample_close(sample), JN_OK);
	return archive;
}

static JnStatus go_on(Sample* sample, const JnArchive* noted) {
	JnArchive archive = jn_archive_reader(noted->bytes, noted->size);
	return jn_recorders_open(&sample->recorders, &sample->arena, &sample->info, &archive);
}

static void expect_refusal(Sample* sample, JnArchive* noted, const char* words) {
	assert_int_equal(go_on(sample, noted), JN_BAD_INPUT);
	if (strstr(sample->messages, words) == NULL) fail_msg("\"%s\" is not in \"%s\"", words, sample->messages);
	assert_int_equal(H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
	jn_archive_free(noted);
}

static void fewer_frames_than_noted_are_of_another_run(void** state) {
	Sample* sample = *state;
	JnArchive noted = note_run(sample, SAMPLE_STEPS), other = note_run(sample, 3);
	jn_archive_free(&other);
	expect_refusal(sample, &noted, "run.h5: has fewer than the 5 frames that the checkpoint tells of");
}

// The other run has as many frames, but a step between two of them where this one has five.
static void fewer_rows_than_noted_are_of_another_run(void** state) {
	Sample* sample = *state;
	JnArchive noted = note_run(sample, SAMPLE_STEPS);
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k < SAMPLE_FRAMES; k++) assert_int_equal(sample_write(sample, k * SAMPLE_STEPS_A_FRAME), JN_OK);
	assert_int_equal(sample_close(sample), JN_OK);
	expect_refusal(sample, &noted, "run.h5: /series/step has fewer than the 21 rows that the checkpoint tells of");
}

static void a_shorter_series_is_of_another_run(void** state) {
	Sample* sample = *state;
	JnArchive noted = note_run(sample, SAMPLE_STEPS);
	assert_int_equal(truncate(sample_path(sample, "series.csv"), 100), 0);
	expect_refusal(sample, &noted, "series.csv: has fewer than the ");
}

// More than the 1024 that there is room for at first.
static void thousands_of_frames_are_gone_on_with(void** state) {
	enum { FRAMES = 1030 };
	Sample* sample = *state;
	JnArchive archive = {0};
	sample->info.wants_plots = false;
	sample->info.column_count = 2;
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k < FRAMES; k++) assert_int_equal(sample_write(sample, k * SAMPLE_STEPS_A_FRAME), JN_OK);
	jn_recorders_archive(&sample->recorders, &archive);
	assert_int_equal(sample_close(sample), JN_OK);
	assert_int_equal(go_on(sample, &archive), JN_OK);
	assert_int_equal(sample_close(sample), JN_OK);
	char* xml = sample_read(sample, "run.xdmf");
	assert_non_null(strstr(xml, "frame 1029"));
	assert_null(strstr(xml, "frame 1030"));
	free(xml);
	jn_archive_free(&archive);
}

// ---- pages ----

enum { PAGE = 4096, PAGES = 3 };

// A file of letters, whose pages wait in memory from now on when they are written again.
static void open_disk(const Sample* sample, JnH5Disk* disk) {
	unsigned char letters[PAGES * PAGE];
	memset(letters, 'a', sizeof letters);
	assert_true(jn_h5_disk_open(disk, sample_path(sample, "run.h5"), O_RDWR | O_CREAT | O_TRUNC));
	jn_h5_disk_write(disk, 0, sizeof letters, letters);
	jn_h5_commit(disk);
}

// Of the file's own bytes, read past the writer.
static char byte_of_file(const Sample* sample, long at) {
	FILE* file = fopen(sample_path(sample, "run.h5"), "rb");
	assert_non_null(file);
	assert_int_equal(fseek(file, at, SEEK_SET), 0);
	const int byte = fgetc(file);
	fclose(file);
	return (char)byte;
}

static void what_waits_reads_back_and_is_not_in_the_file(void** state) {
	Sample* sample = *state;
	JnH5Disk disk = {0};
	unsigned char read[PAGES * PAGE], new[PAGE];
	open_disk(sample, &disk);
	memset(new, 'b', sizeof new);
	jn_h5_disk_write(&disk, PAGE / 2, PAGE, new); // two halves of pages
	jn_h5_disk_read(&disk, 0, sizeof read, read);
	for (int i = 0; i < PAGES * PAGE; ++i) assert_int_equal(read[i], i < PAGE / 2 || i >= PAGE + PAGE / 2 ? 'a' : 'b');
	jn_h5_disk_read(&disk, PAGE, 10, read); // within a page that waits
	for (int i = 0; i < 10; ++i) assert_int_equal(read[i], 'b');
	jn_h5_disk_read(&disk, 2 * PAGE, 10, read); // behind them all
	for (int i = 0; i < 10; ++i) assert_int_equal(read[i], 'a');
	assert_int_equal(byte_of_file(sample, PAGE), 'a');
	jn_h5_commit(&disk);
	assert_int_equal(byte_of_file(sample, PAGE), 'b');
	jn_h5_disk_close(&disk);
	assert_int_equal(disk.error, 0);
}

static void what_is_behind_the_end_reads_as_zeros(void** state) {
	JnH5Disk disk = {0};
	unsigned char read[20];
	open_disk(*state, &disk);
	jn_h5_disk_read(&disk, PAGES * PAGE - 10, sizeof read, read);
	for (int i = 0; i < 20; ++i) assert_int_equal(read[i], i < 10 ? 'a' : 0);
	jn_h5_disk_close(&disk);
	assert_int_equal(disk.error, 0);
}

static void a_rehearsal_reads_what_it_has_written_and_leaves_the_file(void** state) {
	JnH5Disk disk = {0};
	unsigned char read[2], new[2] = {'b', 'b'};
	open_disk(*state, &disk);
	jn_h5_disk_close(&disk);
	disk = (JnH5Disk){.is_rehearsal = true};
	assert_true(jn_h5_disk_open(&disk, sample_path(*state, "run.h5"), O_RDWR));
	jn_h5_disk_write(&disk, PAGES * PAGE - 1, 2, new); // within the file and behind it
	jn_h5_sync_disk(&disk);
	jn_h5_disk_read(&disk, PAGES * PAGE - 1, 2, read);
	assert_memory_equal(read, new, 2);
	jn_h5_disk_close(&disk);
	assert_int_equal(disk.error, 0);
	assert_int_equal(byte_of_file(*state, PAGES * PAGE - 1), 'a');
	struct stat facts;
	assert_int_equal(stat(sample_path(*state, "run.h5"), &facts), 0);
	assert_int_equal(facts.st_size, PAGES * PAGE);
}

// A whole journal with one page of that number.
static void leave_a_journal(const Sample* sample, uint64_t number) {
	static unsigned char journal[24 + 8 + PAGE];
	uint64_t head[4] = {0, 1, 0, number}; // magic, count, sum; the number
	memcpy(head, "jounceJ1", 8);
	memset(journal + sizeof head, 'x', PAGE);
	memcpy(journal, head, sizeof head);
	head[2] = crc32_z(0, journal + 24, sizeof journal - 24);
	memcpy(journal, head, sizeof head);
	FILE* file = fopen(sample_path(sample, "run.h5.journal"), "wb");
	assert_non_null(file);
	assert_int_equal(fwrite(journal, 1, sizeof journal, file), sizeof journal);
	fclose(file);
}

static void expect_unusable_journal(Sample* sample, const char* why) {
	assert_int_equal(jn_h5_recover(sample_path(sample, "run.h5")), JN_IO_FAILED);
	if (strstr(sample->messages, "run.h5.journal: what a killed run has left here cannot be put into") == NULL ||
		strstr(sample->messages, why) == NULL)
		fail_msg("%s", sample->messages);
	assert_int_equal(access(sample_path(sample, "run.h5.journal"), F_OK), 0); // nothing is lost
}

static void a_journal_without_its_file_is_kept(void** state) {
	leave_a_journal(*state, 0);
	expect_unusable_journal(*state, "No such file or directory");
}

// Its writer makes the file long enough first: this is the journal of another file.
static void a_journal_that_goes_beyond_its_file_is_kept(void** state) {
	JnH5Disk disk = {0};
	open_disk(*state, &disk);
	jn_h5_disk_close(&disk);
	leave_a_journal(*state, PAGES);
	expect_unusable_journal(*state, "Invalid argument");
	assert_int_equal(byte_of_file(*state, 0), 'a');
}

// Cut while it was written, before anything of it went into the file.
static void the_beginning_of_a_journal_is_of_no_use(void** state) {
	Sample* sample = *state;
	for (long length = 0; length < 40; length += 13) {
		JnH5Disk disk = {0};
		open_disk(sample, &disk);
		jn_h5_disk_close(&disk);
		leave_a_journal(sample, 0);
		assert_int_equal(truncate(sample_path(sample, "run.h5.journal"), length), 0);
		assert_int_equal(jn_h5_recover(sample_path(sample, "run.h5")), JN_OK);
		assert_int_equal(byte_of_file(sample, 0), 'a');
		assert_int_equal(access(sample_path(sample, "run.h5.journal"), F_OK), -1);
	}
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, sample_setup, sample_teardown)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(fewer_frames_than_noted_are_of_another_run),
		TEST(fewer_rows_than_noted_are_of_another_run),
		TEST(a_shorter_series_is_of_another_run),
		TEST(thousands_of_frames_are_gone_on_with),
		TEST(what_waits_reads_back_and_is_not_in_the_file),
		TEST(what_is_behind_the_end_reads_as_zeros),
		TEST(a_rehearsal_reads_what_it_has_written_and_leaves_the_file),
		TEST(a_journal_without_its_file_is_kept),
		TEST(a_journal_that_goes_beyond_its_file_is_kept),
		TEST(the_beginning_of_a_journal_is_of_no_use),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
