// Recordings in which objects are not what they should be: each input is a list of edits of the run.h5 of a small run. HDF5
// itself is not under test: the file stays one that it can read, and what its objects are called, how large they say they are,
// of which type, and what they hold, is up to the input. All readers of the command read the result. As always, HDF5 reads in a
// child process, whose crash or limits are one more refusal here; what the readers make of its answers is done in this process,
// where sanitizers see it. The edits are made in this process too, without limits. Bytes: tools/damage_recordings.
//
//   sample, then edits: kind, object, and what the kind asks for
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <hdf5.h>

#include "compare_recording.h"
#include "recording.h"
#include "recording_surface.h"
#include "support/fuzz.h"
#include "support/sample_recordings.h"
#include "view_field.h"
#include "view_run.h"

enum { MOST_OBJECTS = 200, NAME_BYTES = 120, MOST_EDITS = 12 };

typedef struct Edit {
	hid_t file;
	char objects[MOST_OBJECTS][NAME_BYTES];
	int object_count;
	FuzzBytes bytes;
} Edit;

static herr_t keep_name(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	(void)group, (void)info;
	Edit* edit = user;
	if (edit->object_count < MOST_OBJECTS && strlen(name) < NAME_BYTES)
		strcpy(edit->objects[edit->object_count++], name);
	return 0;
}

static const char* choose_object(Edit* edit) {
	return edit->object_count > 0 ? edit->objects[(int)fuzz_byte(&edit->bytes) % edit->object_count] : "/";
}

static hid_t choose_type(Edit* edit) {
	const hid_t types[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_INT, H5T_NATIVE_FLOAT, H5T_NATIVE_LLONG, H5T_NATIVE_UCHAR};
	const int number = fuzz_byte(&edit->bytes) % 7;
	if (number < 5) return H5Tcopy(types[number]);
	const hid_t text = H5Tcopy(H5T_C_S1);
	H5Tset_size(text, number == 5 ? H5T_VARIABLE : 1 + (size_t)fuzz_byte(&edit->bytes));
	return text;
}

// Small numbers as they are, large ones as powers of two.
static hsize_t choose_size(Edit* edit) {
	const int number = fuzz_byte(&edit->bytes);
	return number < 200 ? (hsize_t)number : (hsize_t)1 << (number - 194);
}

static hid_t choose_space(Edit* edit) {
	hsize_t sizes[3];
	const int rank = fuzz_byte(&edit->bytes) % 4;
	for (int i = 0; i < rank; ++i) sizes[i] = choose_size(edit);
	return rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, sizes, NULL);
}

static void remove_object(Edit* edit) {
	H5Ldelete(edit->file, choose_object(edit), H5P_DEFAULT);
}

// Chunks are not written until there is something in them: such a dataset may be as large as it likes.
static void replace_object(Edit* edit) {
	const char* name = choose_object(edit);
	const hid_t type = choose_type(edit), space = choose_space(edit), layout = H5Pcreate(H5P_DATASET_CREATE);
	const hsize_t chunk[3] = {16, 1, 1};
	const int rank = H5Sget_simple_extent_ndims(space);
	if (rank > 0) H5Pset_chunk(layout, rank, chunk);
	H5Ldelete(edit->file, name, H5P_DEFAULT);
	const hid_t dataset = H5Dcreate2(edit->file, name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
	if (dataset >= 0) H5Dclose(dataset);
	H5Pclose(layout);
	H5Sclose(space);
	H5Tclose(type);
}

static void replace_by_link(Edit* edit) {
	const char *name = choose_object(edit), *to = choose_object(edit);
	H5Ldelete(edit->file, name, H5P_DEFAULT);
	H5Lcreate_soft(fuzz_byte(&edit->bytes) % 2 == 0 ? to : "/", edit->file, name, H5P_DEFAULT, H5P_DEFAULT);
}

static void rename_object(Edit* edit) {
	const char* name = choose_object(edit);
	char to[NAME_BYTES];
	fuzz_word(&edit->bytes, sizeof to, to);
	H5Lmove(edit->file, name, edit->file, to, H5P_DEFAULT, H5P_DEFAULT);
}

static void change_number(Edit* edit) {
	const hid_t dataset = H5Dopen2(edit->file, choose_object(edit), H5P_DEFAULT);
	if (dataset < 0) return;
	const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
	const hssize_t count = H5Sget_simple_extent_npoints(space);
	const H5T_class_t kind = H5Tget_class(type);
	if (count > 0 && count < 100000 && (kind == H5T_INTEGER || kind == H5T_FLOAT)) {
		uint64_t* values = calloc((size_t)count, sizeof *values);
		const hid_t memory = kind == H5T_FLOAT ? H5T_NATIVE_DOUBLE : H5T_NATIVE_LLONG;
		if (values == NULL || H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) abort();
		values[fuzz_number(&edit->bytes, 2) % (uint64_t)count] = fuzz_number(&edit->bytes, 8);
		H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
		free(values);
	}
	H5Sclose(space);
	H5Tclose(type);
	H5Dclose(dataset);
}

static void write_attribute(Edit* edit, hid_t attribute, hid_t type) {
	enum { ROOM = 4096 };
	const hid_t space = H5Aget_space(attribute);
	char values[ROOM] = "", word[NAME_BYTES];
	const char* text = word;
	const bool is_variable = H5Tis_variable_str(type) > 0;
	fuzz_word(&edit->bytes, sizeof word, word);
	memcpy(values, word, sizeof word);
	if (H5Sget_simple_extent_npoints(space) == 1 || (!is_variable && H5Aget_storage_size(attribute) <= ROOM))
		H5Awrite(attribute, type, is_variable ? (const void*)&text : values);
	H5Sclose(space);
}

static void replace_attribute(Edit* edit) {
	static const char* const names[] = {
		"count",  "time",        "shape",       "first_node", "node_count", "kind",       "is_closed",
		"radius", "first_point", "point_count", "unit",       "scene_name", "scene_path", "method",
		"host",   "created",     "outcome",     "message",    "total_mass", "components", "version"};
	const hid_t object = H5Oopen(edit->file, choose_object(edit), H5P_DEFAULT);
	const char* name = names[fuzz_byte(&edit->bytes) % (sizeof names / sizeof names[0])];
	if (object < 0) return;
	const hid_t type = choose_type(edit), space = choose_space(edit);
	H5Adelete(object, name);
	const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
	if (attribute >= 0) {
		write_attribute(edit, attribute, type);
		H5Aclose(attribute);
	}
	H5Sclose(space);
	H5Tclose(type);
	H5Oclose(object);
}

static void (*const edits[])(Edit*) = {remove_object, replace_object, replace_by_link,
									   rename_object, change_number,  replace_attribute};

static void edit_file(Edit* edit, const char* path) {
	edit->file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
	if (edit->file < 0) abort();
	edit->object_count = 0;
	H5Lvisit(edit->file, H5_INDEX_NAME, H5_ITER_INC, keep_name, edit);
	for (int i = 0; i < MOST_EDITS && edit->bytes.left > 0; ++i)
		edits[fuzz_byte(&edit->bytes) % (sizeof edits / sizeof edits[0])](edit);
	if (H5Fclose(edit->file) < 0) abort();
}

static JnStatus read_frames(const Recording* recording, double* numbers) {
	for (int frame = 0; frame < recording->frame_count && frame < 3; ++frame) {
		JN_TRY(recording_positions(recording, frame, numbers));
		JN_TRY(recording_velocities(recording, frame, numbers));
		JN_TRY(recording_points(recording, frame, numbers));
		for (int field = 0; field < recording->field_count; ++field)
			JN_TRY(recording_field(recording, frame, field, numbers));
	}
	for (int column = 0; column < recording->column_count; ++column)
		JN_TRY(recording_series(recording, column, numbers));
	return JN_OK;
}

static JnStatus read_recording(const char* path) {
	Recording recording;
	JnStatus status = recording_open(path, &recording);
	double* numbers = NULL;
	if (status == JN_OK) {
		const size_t nodes = (size_t)recording.node_count + (size_t)recording.point_count;
		numbers = malloc((3 * nodes + (size_t)recording.step_count + 1) * sizeof *numbers);
		if (numbers == NULL) abort();
		status = read_frames(&recording, numbers);
		JnArena arena = {0};
		for (int i = 0; status == JN_OK && i < recording.body_count; ++i) {
			RecordingSurface surface;
			status = recording_surface(&recording.bodies[i], &arena, &surface);
		}
		jn_arena_free(&arena);
	}
	free(numbers);
	recording_close(&recording);
	return status;
}

// Frames may be missing in silence: the page then asks again.
static void read_view(ViewRun* run) {
	double room[3];
	ViewSeries series = {0};
	float* numbers = malloc((3 * (size_t)run->points.count + 1) * sizeof *numbers);
	if (numbers == NULL) abort();
	for (long frame = 0; frame < run->frame_count && frame < 3; ++frame) {
		view_run_positions(run, frame, numbers);
		for (int i = 0; i < run->field_count; ++i) view_field_read(run, run->fields[i].name, frame, numbers);
		view_run_read(run, frame, "position", 1, 3, room);
	}
	view_run_series(run, &series);
	jn_arena_free(&series.arena);
	view_run_refresh(run);
	free(numbers);
}

static JnStatus read_run(const char* folder) {
	ViewRun run;
	const JnStatus status = view_run_open(&run, folder);
	if (status == JN_OK) read_view(&run);
	view_run_close(&run);
	return status;
}

static JnStatus read_compared(const char* folder) {
	CompareRecording recording;
	const JnStatus status = compare_recording_open(folder, &recording);
	compare_recording_close(&recording);
	return status;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	static JnStatus (*const readers[])(const char*) = {read_recording, read_run, read_compared};
	static Edit edit;
	edit.bytes = (FuzzBytes){data, size};
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
	const Sample* sample = &sample_recordings()[fuzz_byte(&edit.bytes) % SAMPLE_COUNT];
	const char* folder = fuzz_folder("run.h5", sample->image, sample->size);
	char path[128];
	snprintf(path, sizeof path, "%s/run.h5", folder);
	edit_file(&edit, path);
	for (size_t i = 0; i < sizeof readers / sizeof readers[0]; ++i) {
		fuzz_listen();
		fuzz_judge(readers[i](folder));
	}
	return 0;
}
