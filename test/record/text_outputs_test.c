// series.csv, summary.json, run.xdmf and plots/ as text, and through the Python libraries that users read them with.
#include "sample_run.h"

#include <sys/wait.h>

static void csv_has_the_columns_and_a_row_a_step(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	char* csv = sample_read(sample, "series.csv");
	const char* const start = "step,t,dt,kinetic,total,newton,specific_error,probe.tip.y\n"
							  "0,0,0,0,0.5,0,0,-0.14285714285714285\n"
							  "1,0.033333333333333333,0.033333333333333333,";
	assert_memory_equal(csv, start, strlen(start));
	int lines = 0;
	for (const char* at = csv; *at != '\0'; at++) lines += *at == '\n';
	assert_int_equal(lines, 1 + SAMPLE_STEPS);
	free(csv);
}

static void csv_numbers_read_back_to_the_same_bits(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	char* const csv = sample_read(sample, "series.csv");
	char* at = csv + strcspn(csv, "\n") + 1;
	for (long k = 0; k < SAMPLE_STEPS; k++) {
		double values[SAMPLE_COLUMNS];
		sample_values(k, values);
		for (int i = 0; i < SAMPLE_COLUMNS; i++) {
			const double read = strtod(at, &at);
			assert_memory_equal(&read, &values[i], sizeof read);
			assert_int_equal(*at++, i + 1 < SAMPLE_COLUMNS ? ',' : '\n');
		}
	}
	assert_int_equal(*at, '\0');
	free(csv);
}

static void rows_are_on_disk_a_second_later(void** state) {
	Sample* sample = *state;
	assert_int_equal(sample_open(sample), JN_OK);
	assert_int_equal(sample_write(sample, 0), JN_OK);
	usleep(1100000);
	assert_int_equal(sample_write(sample, 1), JN_OK);
	char* csv = sample_read(sample, "series.csv");
	assert_non_null(strstr(csv, "\n1,0.0333"));
	assert_int_equal(csv[strlen(csv) - 1], '\n');
	free(csv);
	assert_int_equal(sample_close(sample), JN_OK);
}

static void check_contains(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("%s is not in:\n%s", part, text);
}

static void summary_escapes_texts_and_has_no_infinity(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	char* json = sample_read(sample, "summary.json");
	check_contains(json, "\t\"outcome\": \"done\",\n");
	check_contains(json, "\t\"message\": \"tab\\u0009here, quote \\\", backslash \\\\\",\n");
	check_contains(json, "\t\"scene\": \"it's a \\\"beam\\\"\",\n");
	check_contains(json, "\t\"scene_path\": \"scenes/b\\ufffd.yaml\",\n");
	check_contains(json, "\t\"wall_seconds_per_simulated_second\": 2,\n"); // 4 s of work for 2 s
	check_contains(json, "\t\"seconds_predict\": 2.5,\n");
	check_contains(json, "\t\"specific_error_max\": null,\n");
	check_contains(json, "\t\"newton\": 30,\n");
	free(json);
}

// Characters of two, three and four bytes stay; bytes that are none become U+FFFD each: a continuation alone, overlong forms,
// surrogates, numbers above 10FFFF, and a character that ends too early.
static void summary_keeps_utf8_and_marks_what_is_none(void** state) {
	static const char text[] = "\xC3\xA9\xE2\x82\xAC\xF0\x9F\xA6\x86|\x80|\xC0\xAF|\xE0\x80\xAF|\xF0\x80\x80\xAF|"
							   "\xED\xA0\x80|\xF4\x90\x80\x80|\xF5|\xE2\x82|";
	static const char expected[] =
		"\xC3\xA9\xE2\x82\xAC\xF0\x9F\xA6\x86|\\ufffd|\\ufffd\\ufffd|\\ufffd\\ufffd\\ufffd|"
		"\\ufffd\\ufffd\\ufffd\\ufffd|\\ufffd\\ufffd\\ufffd|\\ufffd\\ufffd\\ufffd\\ufffd|\\ufffd|\\ufffd\\ufffd|\"";
	Sample* sample = *state;
	sample->info.scene_name = text;
	sample_record(sample);
	char* json = sample_read(sample, "summary.json");
	check_contains(json, expected);
	free(json);
}

static int count_parts(const char* text, const char* part) {
	int count = 0;
	for (const char* at = text; (at = strstr(at, part)) != NULL; at++) count++;
	return count;
}

static void xdmf_has_a_grid_a_frame(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	char* xml = sample_read(sample, "run.xdmf");
	assert_int_equal(count_parts(xml, "GridType=\"Uniform\""), SAMPLE_FRAMES);
	assert_int_equal(count_parts(xml, "CollectionType=\"Temporal\""), 1);
	assert_int_equal(count_parts(xml, "<Topology TopologyType=\"Mixed\" NumberOfElements=\"2\">"), SAMPLE_FRAMES);
	assert_int_equal(count_parts(xml, "run.h5:/frames/00000004/position"), 2); // geometry and point data
	check_contains(xml, "<Time Value=\"0.66666666666666663\"/>");              // step 20
	check_contains(xml, "</Grid>\n\t</Domain>\n</Xdmf>\n");
	free(xml);
}

static void xdmf_of_plain_surfaces_uses_the_nodes(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	char* xml = sample_read(sample, "surface.xdmf");
	assert_int_equal(count_parts(xml, "GridType=\"Uniform\""), SAMPLE_FRAMES);
	assert_int_equal(count_parts(xml, "<Topology TopologyType=\"Triangle\" NumberOfElements=\"3\">"), SAMPLE_FRAMES);
	assert_int_equal(count_parts(xml, "run.h5:/frames/00000004/position"), 2);
	check_contains(xml, "<Time Value=\"0.66666666666666663\"/>");
	check_contains(xml, "</Grid>\n\t</Domain>\n</Xdmf>\n");
	free(xml);
}

static void xdmf_of_an_embedded_surface_has_its_own_points(void** state) {
	Sample* sample = *state;
	sample_embed(sample);
	sample_record(sample);
	char* xml = sample_read(sample, "surface.xdmf");
	assert_int_equal(count_parts(xml, "run.h5:/frames/00000004/surface"), 2);
	assert_int_equal(count_parts(xml, "Dimensions=\"11 3\""), 2 * SAMPLE_FRAMES); // 8 nodes, 3 vertices
	free(xml);
}

static void check_complete(const Sample* sample, const char* name) {
	char* xml = sample_read(sample, name);
	assert_int_equal(count_parts(xml, "GridType=\"Uniform\""), 1);
	check_contains(xml, "</Xdmf>\n");
	free(xml);
}

static void xdmf_is_complete_during_the_run(void** state) {
	Sample* sample = *state;
	assert_int_equal(sample_open(sample), JN_OK);
	assert_int_equal(sample_write(sample, 0), JN_OK);
	check_complete(sample, "run.xdmf");
	check_complete(sample, "surface.xdmf");
	assert_int_equal(sample_close(sample), JN_OK);
}

static void scripts_name_their_columns_and_missing_ones_are_left_out(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	char* script = sample_read(sample, "plots/energy.gnuplot");
	check_contains(script, "set title 'it''s a \"beam\" — tr_bdf2' noenhanced");
	check_contains(script, "column('kinetic')");
	check_contains(script, "column('total')");
	assert_null(strstr(script, "column('gravity')"));
	free(script);
	script = sample_read(sample, "plots/energy_error.gnuplot");
	check_contains(script, "set logscale y");
	free(script);
}

static void plots_without_their_column_are_skipped(void** state) {
	Sample* sample = *state;
	sample->info.column_count = 2; // step and t
	sample_record(sample);
	assert_int_not_equal(access(sample_path(sample, "plots/energy.gnuplot"), F_OK), 0);
	assert_string_equal(sample->messages, "");
}

// gnuplot ends a string at a line break.
static void a_title_is_one_line(void** state) {
	Sample* sample = *state;
	sample->info.scene_name = "two\nlines";
	sample_record(sample);
	char* script = sample_read(sample, "plots/energy.gnuplot");
	check_contains(script, "set title 'two lines");
	free(script);
}

// As many as an SVG file bears.
static void long_series_are_thinned_out_in_pictures(void** state) {
	Sample* sample = *state;
	enum { ROWS = 8001 };
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k < ROWS; k++) {
		double values[SAMPLE_COLUMNS];
		sample_values(k, values);
		const JnRecordStep step = {.step = k, .t = values[1], .values = values};
		assert_int_equal(jn_recorders_write(&sample->recorders, &step), JN_OK);
	}
	assert_int_equal(sample_close(sample), JN_OK);
	char* script = sample_read(sample, "plots/step_size.gnuplot");
	check_contains(script, "every 3 using"); // 8001 rows, at most 4000
	free(script);
}

static void check_picture(const Sample* sample, const char* name, const char* start) {
	FILE* stream = fopen(sample_path(sample, name), "r");
	assert_non_null(stream);
	char head[16] = "";
	assert_int_equal(fread(head, 1, sizeof head, stream), sizeof head);
	fclose(stream);
	assert_memory_equal(head, start, strlen(start));
}

static void gnuplot_draws_all_pictures(void** state) {
	Sample* sample = *state;
	if (system("command -v gnuplot > /dev/null 2>&1") != 0) {
		print_message("gnuplot is missing: not checked\n");
		skip();
	}
	sample_record(sample);
	assert_string_equal(sample->messages, "");
	const char* const names[] = {"energy", "energy_error", "step_size", "newton"};
	for (int i = 0; i < 4; i++) {
		char name[64];
		snprintf(name, sizeof name, "plots/%s.svg", names[i]);
		check_picture(sample, name, "<?xml");
		snprintf(name, sizeof name, "plots/%s.png", names[i]);
		check_picture(sample, name, "\x89PNG");
	}
	assert_int_not_equal(access(sample_path(sample, "plots/gnuplot.log"), F_OK), 0);
}

// All errors 0, as of a body at rest, and no more than the start: neither a logarithm nor a range to draw.
static void run_without_a_step_is_drawn(void** state) {
	Sample* sample = *state;
	assert_int_equal(sample_open(sample), JN_OK);
	assert_int_equal(sample_write(sample, 0), JN_OK);
	assert_int_equal(sample_close(sample), JN_OK);
	char* script = sample_read(sample, "plots/energy_error.gnuplot");
	assert_null(strstr(script, "logscale"));
	free(script);
	if (strstr(sample->messages, "cannot be started") == NULL) assert_string_equal(sample->messages, "");
}

static void missing_gnuplot_is_one_warning(void** state) {
	Sample* sample = *state;
	char* path = strdup(getenv("PATH"));
	setenv("PATH", "/nonexistent", 1);
	sample_record(sample);
	setenv("PATH", path, 1);
	free(path);
	assert_int_equal(count_parts(sample->messages, "\n"), 1);
	check_contains(sample->messages, "gnuplot cannot be started: No such file or directory");
	assert_int_equal(access(sample_path(sample, "plots/energy.gnuplot"), F_OK), 0);
}

// check_recording.py exits with 77 when a module is missing.
static void a_gnuplot_that_fails_is_one_warning_with_its_log(void** state) {
	Sample* sample = *state;
	char* path = strdup(getenv("PATH"));
	FILE* file = fopen(sample_path(sample, "gnuplot"), "w");
	assert_non_null(file);
	fputs("#!/bin/sh\necho no terminal; exit 1\n", file);
	fclose(file);
	assert_int_equal(chmod(sample_path(sample, "gnuplot"), 0700), 0);
	setenv("PATH", sample->directory, 1);
	sample_record(sample);
	setenv("PATH", path, 1);
	free(path);
	assert_int_equal(count_parts(sample->messages, "\n"), 1);
	check_contains(sample->messages, sample_path(sample, "plots/gnuplot.log"));
	char* log = sample_read(sample, "plots/gnuplot.log");
	assert_int_equal(count_parts(log, "no terminal\n"), 4); // pictures
	free(log);
}

static void check_by_python(Sample* sample, const char* cell_types) {
	sample_record(sample);
	const char* script = JN_SOURCE_DIR "/test/record/check_recording.py";
	char command[1200];
	snprintf(command, sizeof command, "/usr/bin/python3 '%s' '%s' %s", script, sample->directory, cell_types);
	const int outcome = access("/usr/bin/python3", X_OK) == 0 ? system(command) : 77 << 8;
	if (WIFEXITED(outcome) && WEXITSTATUS(outcome) == 77) {
		print_message("python3 with h5py and meshio is missing: not checked\n");
		skip();
	}
	assert_int_equal(outcome, 0);
}

static void python_opens_a_run_of_one_body(void** state) {
	Sample* sample = *state;
	sample->info.body_count = 1;
	check_by_python(sample, "hexahedron");
}

static void python_opens_a_run_of_two_shapes(void** state) {
	check_by_python(*state, "hexahedron tetra");
}

static void python_opens_a_run_with_an_embedded_surface(void** state) {
	sample_embed(*state);
	check_by_python(*state, "hexahedron tetra");
}

static void python_opens_a_run_with_fields(void** state) {
	sample_add_fields(*state);
	check_by_python(*state, "hexahedron tetra");
}

static void python_opens_a_run_with_fields_and_an_embedded_surface(void** state) {
	sample_add_fields(*state);
	sample_embed(*state);
	check_by_python(*state, "hexahedron tetra");
}

static void python_opens_obstacles(void** state) {
	sample_add_obstacles(*state);
	check_by_python(*state, "hexahedron tetra");
}

static void xdmf_has_vector_and_scalar_fields(void** state) {
	Sample* sample = *state;
	sample_add_fields(sample);
	sample_record(sample);
	for (int i = 0; i < 2; i++) {
		char* xml = sample_read(sample, i == 0 ? "run.xdmf" : "surface.xdmf");
		check_contains(xml, "<Attribute Name=\"push\" AttributeType=\"Vector\" Center=\"Node\">");
		check_contains(xml, "<Attribute Name=\"depth\" AttributeType=\"Scalar\" Center=\"Node\">");
		assert_int_equal(count_parts(xml, "<DataItem Dimensions=\"12\" NumberType=\"Float\""), SAMPLE_FRAMES);
		check_contains(xml, "run.h5:/frames/00000004/depth");
		free(xml);
	}
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, sample_setup, sample_teardown)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(csv_has_the_columns_and_a_row_a_step),
		TEST(csv_numbers_read_back_to_the_same_bits),
		TEST(rows_are_on_disk_a_second_later),
		TEST(summary_escapes_texts_and_has_no_infinity),
		TEST(summary_keeps_utf8_and_marks_what_is_none),
		TEST(xdmf_has_a_grid_a_frame),
		TEST(xdmf_is_complete_during_the_run),
		TEST(scripts_name_their_columns_and_missing_ones_are_left_out),
		TEST(plots_without_their_column_are_skipped),
		TEST(gnuplot_draws_all_pictures),
		TEST(run_without_a_step_is_drawn),
		TEST(a_title_is_one_line),
		TEST(long_series_are_thinned_out_in_pictures),
		TEST(missing_gnuplot_is_one_warning),
		TEST(a_gnuplot_that_fails_is_one_warning_with_its_log),
		TEST(python_opens_a_run_of_one_body),
		TEST(python_opens_a_run_of_two_shapes),
		TEST(python_opens_a_run_with_an_embedded_surface),
		TEST(xdmf_of_plain_surfaces_uses_the_nodes),
		TEST(xdmf_of_an_embedded_surface_has_its_own_points),
		TEST(xdmf_has_vector_and_scalar_fields),
		TEST(python_opens_a_run_with_fields),
		TEST(python_opens_obstacles),
		TEST(python_opens_a_run_with_fields_and_an_embedded_surface),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
