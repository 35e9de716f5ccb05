// What the recorders refuse, and that every failure names its file.
#include "sample_run.h"

static void check_message(const Sample* sample, const char* words) {
	if (strstr(sample->messages, words) == NULL) fail_msg("\"%s\" is not in \"%s\"", words, sample->messages);
}

static void missing_directory_is_named(void** state) {
	Sample* sample = *state;
	char directory[128];
	snprintf(directory, sizeof directory, "%s/absent", sample->directory);
	sample->info.directory = directory;
	assert_int_equal(sample_open(sample), JN_IO_FAILED);
	check_message(sample, "/absent/run.h5");
	check_message(sample, "No such file or directory");
	assert_int_equal(sample->recorders.count, 0);
}

// Nothing can be created below /proc, not even by root.
static void unwritable_directory_is_named(void** state) {
	Sample* sample = *state;
	sample->info.directory = "/proc/self";
	assert_int_equal(sample_open(sample), JN_IO_FAILED);
	check_message(sample, "/proc/self/run.h5");
}

static void a_path_that_is_too_long_is_refused_with_a_remedy(void** state) {
	Sample* sample = *state;
	static char directory[5000];
	memset(directory, 'a', sizeof directory - 1);
	sample->info.directory = directory;
	assert_int_equal(sample_open(sample), JN_IO_FAILED);
	check_message(sample, "is longer than 4095 bytes; record into a directory nearer to the root");
}

// series.csv comes fourth: those before are open by then and have to be closed.
static void failed_open_closes_those_before(void** state) {
	Sample* sample = *state;
	assert_int_equal(symlink("/dev/full", sample_path(sample, "series.csv")), 0);
	assert_int_equal(sample_open(sample), JN_IO_FAILED);
	check_message(sample, "series.csv");
	check_message(sample, "No space left on device");
	assert_int_equal(sample->recorders.count, 0);
	assert_int_equal(access(sample_path(sample, "run.h5"), R_OK), 0);
	char* xml = sample_read(sample, "run.xdmf");
	assert_non_null(strstr(xml, "</Xdmf>\n"));
	free(xml);
}

// The file that takes the place of each output while it is written is full; the others must be closed all the same.
static void check_full(Sample* sample, const char* link, const char* named) {
	assert_int_equal(symlink("/dev/full", sample_path(sample, link)), 0);
	JnStatus status = sample_open(sample);
	for (long k = 0; k < SAMPLE_STEPS && status == JN_OK; k++) status = sample_write(sample, k);
	const JnStatus closed = sample_close(sample);
	assert_int_equal(status != JN_OK ? status : closed, JN_IO_FAILED);
	check_message(sample, named);
}

static void full_disk_under_hdf5_is_told(void** state) {
	check_full(*state, "run.h5", "run.h5");
}

static void full_disk_under_xdmf_is_told(void** state) {
	check_full(*state, "run.xdmf.tmp", "run.xdmf");
}

static void full_disk_under_surface_xdmf_is_told(void** state) {
	check_full(*state, "surface.xdmf.tmp", "surface.xdmf");
}

static void full_disk_under_obstacles_xdmf_is_told(void** state) {
	sample_add_obstacles(*state);
	check_full(*state, "obstacles.xdmf.tmp", "obstacles.xdmf");
}

static void full_disk_under_summary_is_told(void** state) {
	Sample* sample = *state;
	check_full(sample, "summary.json.tmp", "summary.json");
	check_message(sample, "No space left on device");
	assert_int_not_equal(access(sample_path(sample, "summary.json"), F_OK), 0);
	char* csv = sample_read(sample, "series.csv");
	assert_non_null(strstr(csv, "\n20,"));
	free(csv);
}

// Bad numbers of step 1 must leave the files as step 0 left them.
static void check_refused(Sample* sample, double* values, double* x, double* v, const char* named) {
	assert_int_equal(sample_open(sample), JN_OK);
	assert_int_equal(sample_write(sample, 0), JN_OK);
	const JnRecordStep step = {.step = 1, .t = 0.1, .is_frame = true, .x = x, .v = v, .values = values};
	assert_int_equal(jn_recorders_write(&sample->recorders, &step), JN_NOT_FINITE);
	check_message(sample, named);
	assert_int_equal(sample_close(sample), JN_OK);
	char* csv = sample_read(sample, "series.csv");
	assert_null(strstr(csv, "nan"));
	assert_null(strstr(csv, "\n1,"));
	free(csv);
	char* xml = sample_read(sample, "run.xdmf");
	assert_null(strstr(xml, "frame 1"));
	free(xml);
}

static void nan_in_a_column_is_refused_by_name(void** state) {
	double values[SAMPLE_COLUMNS], x[3 * SAMPLE_NODES] = {0}, v[3 * SAMPLE_NODES] = {0};
	sample_values(1, values);
	values[4] = NAN;
	check_refused(*state, values, x, v, "total");
}

static void nan_in_a_position_is_refused_by_node(void** state) {
	double values[SAMPLE_COLUMNS], x[3 * SAMPLE_NODES] = {0}, v[3 * SAMPLE_NODES] = {0};
	sample_values(1, values);
	x[3 * 7 + 1] = NAN;
	check_refused(*state, values, x, v, "position of node 7 is nan m along y");
}

static void infinite_velocity_is_refused_by_node(void** state) {
	double values[SAMPLE_COLUMNS], x[3 * SAMPLE_NODES] = {0}, v[3 * SAMPLE_NODES] = {0};
	sample_values(1, values);
	v[3 * 11 + 2] = INFINITY;
	check_refused(*state, values, x, v, "velocity of node 11 is inf m/s along z");
}

// Position and velocity are in order; the field is not.
static void check_refused_field(Sample* sample, int field, int entry, const char* named) {
	double values[SAMPLE_COLUMNS], x[3 * SAMPLE_NODES] = {0}, v[3 * SAMPLE_NODES] = {0};
	double push[3 * SAMPLE_NODES], depth[SAMPLE_NODES];
	const double* const fields[SAMPLE_FIELDS] = {push, depth};
	sample_add_fields(sample);
	sample_values(1, values);
	sample_field_values(1, push, depth);
	(field == 0 ? push : depth)[entry] = NAN;
	assert_int_equal(sample_open(sample), JN_OK);
	const JnRecordStep step = {
		.step = 1, .t = 0.1, .is_frame = true, .x = x, .v = v, .values = values, .fields = fields};
	assert_int_equal(jn_recorders_write(&sample->recorders, &step), JN_NOT_FINITE);
	check_message(sample, named);
	assert_int_equal(sample_close(sample), JN_OK);
}

static void nan_in_a_vector_field_is_refused_by_node(void** state) {
	check_refused_field(*state, 0, 3 * 4 + 2, "push of node 4 is nan N along z at");
}

static void nan_in_a_scalar_field_is_refused_by_node(void** state) {
	check_refused_field(*state, 1, 5, "depth of node 5 is nan m at");
}

static void field_called_as_another_is_refused(void** state) {
	Sample* sample = *state;
	const JnField fields[2][2] = {{{"push", "N", 3}, {"velocity", "m/s", 3}}, {{"push", "N", 3}, {"push", "N", 1}}};
	for (int i = 0; i < 2; i++) {
		sample->info.field_count = 2;
		sample->info.fields = fields[i];
		assert_int_equal(sample_open(sample), JN_BAD_INPUT);
		check_message(sample, fields[i][1].name);
	}
}

static void body_called_as_the_folder_itself_is_refused(void** state) {
	Sample* sample = *state;
	sample->bodies[1].name = ".";
	assert_int_equal(sample_open(sample), JN_BAD_INPUT);
	check_message(sample, "\".\"");
}

static void obstacle_without_a_name_is_refused(void** state) {
	Sample* sample = *state;
	JnRecordObstacle nameless = sample_obstacles[0];
	nameless.name = "";
	sample->info.obstacle_count = 1;
	sample->info.obstacles = &nameless;
	assert_int_equal(sample_open(sample), JN_BAD_INPUT);
	check_message(sample, "the obstacle cannot be recorded under the name \"\"");
}

static void field_with_a_slash_is_refused(void** state) {
	Sample* sample = *state;
	const JnField field = {"push/pull", "N", 3};
	sample->info.field_count = 1;
	sample->info.fields = &field;
	assert_int_equal(sample_open(sample), JN_BAD_INPUT);
	check_message(sample, "push/pull");
}

// A smaller step would not help.
static void nan_at_the_start_points_to_the_scene(void** state) {
	Sample* sample = *state;
	double values[SAMPLE_COLUMNS];
	sample_values(0, values);
	values[3] = NAN;
	assert_int_equal(sample_open(sample), JN_OK);
	const JnRecordStep step = {.values = values};
	assert_int_equal(jn_recorders_write(&sample->recorders, &step), JN_NOT_FINITE);
	check_message(sample, "Look at the sizes, velocities and materials of the scene");
	assert_int_equal(sample_close(sample), JN_OK);
}

static void body_called_nodes_is_refused(void** state) {
	Sample* sample = *state;
	sample->bodies[0].name = "nodes";
	assert_int_equal(sample_open(sample), JN_BAD_INPUT);
	check_message(sample, "\"nodes\"");
	assert_int_not_equal(access(sample_path(sample, "run.h5"), F_OK), 0);
}

static void column_with_a_comma_is_refused(void** state) {
	Sample* sample = *state;
	const JnColumn column = {"probe.a,b.x", "m", false};
	sample->info.columns = &column;
	sample->info.column_count = 1;
	assert_int_equal(sample_open(sample), JN_BAD_INPUT);
	check_message(sample, "probe.a,b.x");
}

static void second_close_does_nothing(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	assert_int_equal(sample_close(sample), JN_OK);
	assert_string_equal(sample->messages, "");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, sample_setup, sample_teardown)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(missing_directory_is_named),
		TEST(unwritable_directory_is_named),
		TEST(a_path_that_is_too_long_is_refused_with_a_remedy),
		TEST(failed_open_closes_those_before),
		TEST(full_disk_under_hdf5_is_told),
		TEST(full_disk_under_xdmf_is_told),
		TEST(full_disk_under_summary_is_told),
		TEST(nan_in_a_column_is_refused_by_name),
		TEST(nan_in_a_position_is_refused_by_node),
		TEST(infinite_velocity_is_refused_by_node),
		TEST(body_called_nodes_is_refused),
		TEST(body_called_as_the_folder_itself_is_refused),
		TEST(obstacle_without_a_name_is_refused),
		TEST(field_with_a_slash_is_refused),
		TEST(nan_at_the_start_points_to_the_scene),
		TEST(column_with_a_comma_is_refused),
		TEST(second_close_does_nothing),
		TEST(full_disk_under_surface_xdmf_is_told),
		TEST(full_disk_under_obstacles_xdmf_is_told),
		TEST(nan_in_a_vector_field_is_refused_by_node),
		TEST(nan_in_a_scalar_field_is_refused_by_node),
		TEST(field_called_as_another_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
