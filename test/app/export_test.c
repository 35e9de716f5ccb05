// jounce export: every format, compared with run.h5 number by number (check_export.py); what is refused.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "support/support.h"

static char folder[256];

static Outcome run(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("status %d, expected %d\nstdout: %s\nstderr: %s", outcome.status, expected, outcome.out, outcome.err);
	return outcome;
}

static void run_quietly(int expected, const char* const arguments[]) {
	Outcome outcome = run(expected, arguments);
	outcome_free(&outcome);
}

#define RUN(...) run_quietly(0, (const char* const[]){__VA_ARGS__, NULL})

static int set_up(void** state) {
	(void)state;
	if (folder_create(folder) != 0) return -1;
	RUN("run", JN_SOURCE_DIR "/test/app/export_solids.yaml", "-o", "solids", "-q");
	RUN("run", JN_SOURCE_DIR "/test/app/export_points.yaml", "-o", "points", "-q");
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

static void expect_part(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in: %s", part, text);
}

/// The script must be content; the test is skipped when it lacks its modules.
static void compare(const char* format, const char* recording, const char* output, const char* frames,
					const char* fps) {
	char command[1024];
	snprintf(command, sizeof command, "cd '%s' && '%s' '%s/test/app/check_export.py' %s %s %s %s %s >&2", folder,
			 JN_PYTHON, JN_SOURCE_DIR, format, recording, output, frames, fps);
	const int status = system(command);
	if (WIFEXITED(status) && WEXITSTATUS(status) == 77) skip();
	assert_int_equal(status, 0);
}

static void glb_holds_every_frame_as_a_morph_target(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "glb");
	compare("glb", "solids", "solids/run.glb", "0,1,2,3,4,5", "0");
	RUN("export", "points", "--as", "glb", "--frames", "1:4:2", "--fps", "12", "-o", "points.glb");
	compare("glb", "points", "points.glb", "1,3", "12");
}

static void obj_sequence_has_the_surfaces(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "obj", "--frames", "-2:");
	compare("obj", "solids", "solids/obj", "4,5", "0");
	RUN("export", "points", "--as", "obj", "-o", "points_obj/");
	compare("obj", "points", "points_obj", "0,1,2,3", "0");
}

static void ply_sequence_has_the_surfaces_and_colors(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "ply", "--frames", "::5", "-o", "solids_ply");
	compare("ply", "solids", "solids_ply", "0,5", "0");
	RUN("export", "points", "--as", "ply", "--color", "speed", "-o", "points_ply");
	compare("ply", "points", "points_ply", "0,1,2,3", "0");
	RUN("export", "points", "--as", "ply", "--color", "displacement", "-o", "points_moved");
}

static void vtu_series_has_nodes_cells_and_fields_bit_by_bit(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "vtu");
	compare("vtu", "solids", "solids/vtu", "0,1,2,3,4,5", "0");
	RUN("export", "points", "--as", "vtu", "--volume", "-o", "points_vtu", "--fps", "10");
	compare("vtu", "points", "points_vtu", "0,1,2,3", "10");
}

static void vtu_of_surfaces_has_threads_as_lines(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "vtu", "--surface", "-o", "solids_surface");
	compare("vtu_surface", "solids", "solids_surface", "0,1,2,3,4,5", "0");
	RUN("export", "points", "--as", "vtu", "--surface", "-o", "points_surface");
	compare("vtu_surface", "points", "points_surface", "0,1,2,3", "0");
}

static void pc2_has_a_mesh_and_its_points_over_time(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "pc2");
	compare("pc2", "solids", "solids/pc2", "0,1,2,3,4,5", "0");
	RUN("export", "points", "--as", "pc2", "--fps", "24", "-o", "points_pc2");
	compare("pc2", "points", "points_pc2", "0,1,2,3", "24");
}

static void usda_has_time_samples(void** state) {
	(void)state;
	RUN("export", "solids", "--as", "usda");
	compare("usda", "solids", "solids/run.usda", "0,1,2,3,4,5", "0");
	RUN("export", "points", "--as", "usda", "--fps", "30", "-o", "points.usda");
	compare("usda", "points", "points.usda", "0,1,2,3", "30");
}

// A run.h5 that was copied in part, and files that are something else.
static void write_bad_files(void) {
	struct stat facts;
	const char* whole = path_join(folder, "solids/run.h5");
	assert_int_equal(stat(whole, &facts), 0);
	char command[1024];
	snprintf(command, sizeof command, "cd '%s' && head -c %ld solids/run.h5 >cut.h5", folder, (long)facts.st_size / 2);
	assert_int_equal(system(command), 0);
	file_write(path_join(folder, "text.h5"), "no recording\n");
	snprintf(command, sizeof command, "cd '%s' && mkdir empty full && touch full/file", folder);
	assert_int_equal(system(command), 0);
}

static void bad_input_is_refused_with_status_2(void** state) {
	(void)state;
	static const struct {
		const char* words[8];
		const char* says;
	} cases[] = {
		{{"export", "--as", "obj"}, "no folder of a recording is given"},
		{{"export", "solids"}, "no format is given"},
		{{"export", "solids", "--as", "plz"}, "did you mean 'ply'"},
		{{"export", "solids", "points", "--as", "obj"}, "one too many"},
		{{"export", "absent", "--as", "obj"}, "there is no such folder"},
		{{"export", "empty", "--as", "obj"}, "there is no run.h5 in this folder"},
		{{"export", "text.h5", "--as", "obj"}, "this is no HDF5 file"},
		{{"export", "cut.h5", "--as", "obj"}, "cut short"},
		{{"export", "solids", "--as", "obj", "-o", "full"}, "this folder is not empty"},
		{{"export", "solids", "--as", "glb", "-o", "empty"}, "this is a folder"},
		{{"export", "solids", "--as", "obj", "--frames", "6"}, "the frames 0 to 5"},
		{{"export", "solids", "--as", "obj", "--frames", "3:2"}, "chooses none"},
		{{"export", "solids", "--as", "obj", "--frames", "0:2:0"}, "A:B:STEP"},
		{{"export", "solids", "--as", "obj", "--frames", "1x"}, "A:B:STEP"},
		{{"export", "solids", "--as", "obj", "--fps", "25"}, "obj files have no times"},
		{{"export", "solids", "--as", "glb", "--fps", "fast"}, "no number"},
		{{"export", "solids", "--as", "glb", "--volume"}, "cells go into vtu"},
		{{"export", "solids", "--as", "vtu", "--volume", "--surface"}, "give one of"},
		{{"export", "solids", "--as", "glb", "--color", "speed"}, "holds no colours"},
		{{"export", "solids", "--as", "ply", "--color", "sped"}, "did you mean speed"},
		{{"export", "solids", "--az", "obj"}, "there is no option"},
	};
	write_bad_files();
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
		Outcome outcome = run(2, cases[i].words);
		expect_part(outcome.err, cases[i].says);
		outcome_free(&outcome);
	}
}

/// Nothing but what was there before is in the folder.
static void expect_no_traces(const char* name) {
	char command[1024];
	snprintf(command, sizeof command, "ls -A '%s' | grep -F '%s' >&2", folder, name);
	assert_int_not_equal(system(command), 0);
}

static void a_file_that_cannot_be_written_leaves_no_traces(void** state) {
	(void)state;
	run_quietly(3, (const char* const[]){"export", "solids", "--as", "glb", "-o", "nowhere/run.glb", NULL});
	run_quietly(3, (const char* const[]){"export", "solids", "--as", "obj", "-o", "nowhere/obj", NULL});
	run_quietly(2, (const char* const[]){"export", "solids", "--as", "ply", "--color", "heat", "-o", "heat", NULL});
	expect_no_traces("nowhere");
	expect_no_traces("heat");
	expect_no_traces(".tmp");
}

// A limit on the size of files stands for a full disk; each format meets it in another place.
static void a_full_disk_leaves_no_traces(void** state) {
	(void)state;
	static const char* const formats[] = {"glb", "obj", "ply", "vtu", "pc2", "usda"};
	for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
		char command[1024];
		snprintf(command, sizeof command,
				 "cd '%s' && trap '' XFSZ && ulimit -S -f 1 && '%s' export solids --as %s -o overflow 2>overflow.txt",
				 folder, JN_COMMAND, formats[i]);
		const int status = system(command);
		assert_int_equal(WEXITSTATUS(status), 3);
		char* text = file_read(path_join(folder, "overflow.txt"));
		expect_part(text, "cannot write");
		free(text);
		unlink(path_join(folder, "overflow.txt"));
		expect_no_traces("overflow");
	}
}

static void help_names_all_formats(void** state) {
	(void)state;
	static const char* const formats[] = {"glb", "obj", "ply", "vtu", "pc2", "usda"};
	Outcome outcome = run(0, (const char* const[]){"export", "--help", NULL});
	for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) expect_part(outcome.out, formats[i]);
	outcome_free(&outcome);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(glb_holds_every_frame_as_a_morph_target),
		cmocka_unit_test(obj_sequence_has_the_surfaces),
		cmocka_unit_test(ply_sequence_has_the_surfaces_and_colors),
		cmocka_unit_test(vtu_series_has_nodes_cells_and_fields_bit_by_bit),
		cmocka_unit_test(vtu_of_surfaces_has_threads_as_lines),
		cmocka_unit_test(pc2_has_a_mesh_and_its_points_over_time),
		cmocka_unit_test(usda_has_time_samples),
		cmocka_unit_test(bad_input_is_refused_with_status_2),
		cmocka_unit_test(a_file_that_cannot_be_written_leaves_no_traces),
		cmocka_unit_test(a_full_disk_leaves_no_traces),
		cmocka_unit_test(help_names_all_formats),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
