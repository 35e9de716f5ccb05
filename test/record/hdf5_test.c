// run.h5, read back by HDF5 itself.
#include "sample_run.h"

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include "record/h5_file.h"

static hid_t open_file(const Sample* sample) {
	const hid_t file = H5Fopen(sample_path(sample, "run.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
	assert_true(file >= 0);
	return file;
}

// Read a dataset that must hold `count` numbers.
static void read_numbers(hid_t file, const char* name, hid_t type, hssize_t count, void* out) {
	const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
	assert_true(dataset >= 0);
	const hid_t space = H5Dget_space(dataset);
	assert_int_equal(H5Sget_simple_extent_npoints(space), count);
	assert_true(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) >= 0);
	H5Sclose(space);
	H5Dclose(dataset);
}

static void read_attribute(hid_t file, const char* object, const char* name, hid_t type, void* out) {
	const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
	assert_true(attribute >= 0);
	assert_true(H5Aread(attribute, type, out) >= 0);
	H5Aclose(attribute);
}

static int64_t read_count(hid_t file, const char* object, const char* name) {
	int64_t count = -1;
	read_attribute(file, object, name, H5T_NATIVE_INT64, &count);
	return count;
}

static void check_text(hid_t file, const char* object, const char* name, const char* expected) {
	const hid_t type = H5Tcopy(H5T_C_S1);
	H5Tset_size(type, H5T_VARIABLE);
	H5Tset_cset(type, H5T_CSET_UTF8);
	char* text = NULL;
	read_attribute(file, object, name, type, &text);
	assert_string_equal(text, expected);
	H5free_memory(text);
	H5Tclose(type);
}

static void check_frames(const Sample* sample, hid_t file, long count) {
	assert_int_equal(read_count(file, "/frames", "count"), count);
	for (long i = 0; i < count; i++) {
		double x[3 * SAMPLE_NODES], v[3 * SAMPLE_NODES], read[3 * SAMPLE_NODES], values[SAMPLE_COLUMNS], time = NAN;
		sample_state(i * SAMPLE_STEPS_A_FRAME, sample, x, v);
		sample_values(i * SAMPLE_STEPS_A_FRAME, values);
		char group[64], name[96];
		snprintf(group, sizeof group, "/frames/%08ld", i);
		snprintf(name, sizeof name, "%s/position", group);
		read_numbers(file, name, H5T_NATIVE_DOUBLE, 3 * SAMPLE_NODES, read);
		assert_memory_equal(read, x, sizeof x);
		snprintf(name, sizeof name, "%s/velocity", group);
		read_numbers(file, name, H5T_NATIVE_DOUBLE, 3 * SAMPLE_NODES, read);
		assert_memory_equal(read, v, sizeof v);
		read_attribute(file, group, "time", H5T_NATIVE_DOUBLE, &time);
		assert_true(time == values[1]);
		assert_int_equal(read_count(file, group, "step"), i * SAMPLE_STEPS_A_FRAME);
	}
}

static void frames_read_back_bit_for_bit(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	check_frames(sample, file, SAMPLE_FRAMES);
	H5Fclose(file);
}

static void check_series(hid_t file, int steps) {
	for (int column = 0; column < SAMPLE_COLUMNS; column++) {
		char name[64];
		snprintf(name, sizeof name, "/series/%s", sample_columns[column].name);
		double* read = malloc((size_t)steps * sizeof *read);
		read_numbers(file, name, H5T_NATIVE_DOUBLE, steps, read);
		for (int k = 0; k < steps; k++) {
			double values[SAMPLE_COLUMNS];
			sample_values(k, values);
			assert_memory_equal(&read[k], &values[column], sizeof(double));
		}
		free(read);
		check_text(file, name, "unit", sample_columns[column].unit);
	}
}

static void series_read_back_bit_for_bit(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	check_series(file, SAMPLE_STEPS);
	H5Fclose(file);
}

// 1100 steps: more than four buffers of 256 steps and more than one chunk of 1024.
static void long_series_crosses_buffers_and_chunks(void** state) {
	Sample* sample = *state;
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k < 1100; k++) assert_int_equal(sample_write(sample, k), JN_OK);
	assert_int_equal(sample_close(sample), JN_OK);
	const hid_t file = open_file(sample);
	check_series(file, 1100);
	H5Fclose(file);
}

static void counts_are_stored_as_integers(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	const hid_t dataset = H5Dopen2(file, "/series/newton", H5P_DEFAULT);
	const hid_t type = H5Dget_type(dataset);
	assert_true(H5Tequal(type, H5T_STD_I64LE) > 0);
	H5Tclose(type);
	H5Dclose(dataset);
	H5Fclose(file);
}

static void mesh_reads_back_with_its_bodies(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	double nodes[3 * SAMPLE_NODES];
	int cells[8], tetrahedron[4];
	read_numbers(file, "/mesh/nodes", H5T_NATIVE_DOUBLE, 3 * SAMPLE_NODES, nodes);
	assert_memory_equal(nodes, sample->nodes, sizeof nodes);
	read_numbers(file, "/mesh/beam/cells", H5T_NATIVE_INT, 8, cells);
	assert_memory_equal(cells, sample_hexahedron, sizeof cells);
	read_numbers(file, "/mesh/wedge: \xC3\xA9/cells", H5T_NATIVE_INT, 4, tetrahedron);
	assert_memory_equal(tetrahedron, sample_tetrahedron, sizeof tetrahedron);
	double gravity[3];
	read_numbers(file, "/gravity", H5T_NATIVE_DOUBLE, 3, gravity);
	assert_memory_equal(gravity, sample->info.gravity, sizeof gravity);
	check_text(file, "/mesh/beam/cells", "shape", "hex8");
	assert_int_equal(read_count(file, "/mesh/beam/cells", "vtk_type"), 12);
	assert_int_equal(read_count(file, "/mesh/wedge: \xC3\xA9/cells", "first_node"), 8);
	assert_int_equal(read_count(file, "/mesh/wedge: \xC3\xA9/cells", "node_count"), 4);
	H5Fclose(file);
}

static void points_have_volumes_and_threads_an_axis(void** state) {
	Sample* sample = *state;
	static const double volumes[8] = {1, 2, 3, 4, 5, 6, 7, 1.0 / 3};
	const JnThread thread = {.frame_count = 4, .is_closed = true, .radius = 1.0 / 7, .axis = {0.5, 0.25, 0.25}};
	sample->bodies[0].volumes = volumes;
	sample->bodies[1].thread = &thread;
	sample_record(sample);
	const hid_t file = open_file(sample);
	const char* const name = "/mesh/wedge: \xC3\xA9/axis";
	double read[8], radius = 0;
	read_numbers(file, "/mesh/beam/volumes", H5T_NATIVE_DOUBLE, 8, read);
	assert_memory_equal(read, volumes, sizeof volumes);
	check_text(file, "/mesh/beam/volumes", "unit", "m^3");
	read_numbers(file, name, H5T_NATIVE_DOUBLE, 3, read);
	assert_memory_equal(read, thread.axis, sizeof thread.axis);
	read_attribute(file, name, "radius", H5T_NATIVE_DOUBLE, &radius);
	assert_memory_equal(&radius, &thread.radius, sizeof radius);
	assert_int_equal(read_count(file, name, "is_closed"), 1);
	assert_int_equal(H5Lexists(file, "/mesh/beam/axis", H5P_DEFAULT), 0);
	assert_int_equal(H5Lexists(file, "/mesh/wedge: \xC3\xA9/volumes", H5P_DEFAULT), 0);
	H5Fclose(file);
}

// XDMF's numbers: a hexahedron is 9, a tetrahedron 6.
static void mixed_topology_leads_each_cell_with_its_number(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	const int expected[14] = {9, 0, 1, 3, 2, 4, 5, 7, 6, 6, 8, 9, 10, 11}, expected_bodies[2] = {0, 1};
	int cells[14], bodies[2];
	read_numbers(file, "/topology/cells", H5T_NATIVE_INT, 14, cells);
	assert_memory_equal(cells, expected, sizeof cells);
	read_numbers(file, "/topology/body", H5T_NATIVE_INT, 2, bodies);
	assert_memory_equal(bodies, expected_bodies, sizeof bodies);
	H5Fclose(file);
}

static void plain_bodies_have_the_faces_of_their_cells_as_surface(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	const int expected[9] = {0, 3, 1, 0, 2, 3, 8, 10, 9}, expected_bodies[3] = {0, 0, 1};
	int triangles[9], bodies[3];
	read_numbers(file, "/mesh/beam/surface/triangles", H5T_NATIVE_INT, 6, triangles);
	read_numbers(file, "/mesh/wedge: \xC3\xA9/surface/triangles", H5T_NATIVE_INT, 3, triangles + 6);
	assert_memory_equal(triangles, expected, sizeof expected);
	read_numbers(file, "/topology/surface", H5T_NATIVE_INT, 9, triangles);
	assert_memory_equal(triangles, expected, sizeof expected);
	read_numbers(file, "/topology/surface_body", H5T_NATIVE_INT, 3, bodies);
	assert_memory_equal(bodies, expected_bodies, sizeof bodies);
	check_text(file, "/mesh/beam/surface", "kind", "boundary");
	assert_int_equal(read_count(file, "/mesh/wedge: \xC3\xA9/surface", "first_point"), 8);
	assert_int_equal(H5Lexists(file, "/frames/00000000/surface", H5P_DEFAULT), 0);
	H5Fclose(file);
}

static void embedded_surface_reads_back_with_nodes_of_the_run(void** state) {
	Sample* sample = *state;
	sample_embed(sample);
	sample_record(sample);
	const hid_t file = open_file(sample);
	const char* const group = "/mesh/wedge: \xC3\xA9/surface";
	const int expected[9] = {0, 3, 1, 0, 2, 3, 10, 8, 9}; // its vertices come behind the beam's 8 nodes
	int nodes[12], triangles[9], own[3];
	double rest[9], weights[12];
	read_numbers(file, "/mesh/wedge: \xC3\xA9/surface/nodes", H5T_NATIVE_INT, 12, nodes);
	for (int i = 0; i < 12; i++) assert_int_equal(nodes[i], sample_vertex_nodes[i] + 8);
	read_numbers(file, "/mesh/wedge: \xC3\xA9/surface/triangles", H5T_NATIVE_INT, 3, own);
	assert_memory_equal(own, sample_vertex_triangle, sizeof own);
	read_numbers(file, "/mesh/wedge: \xC3\xA9/surface/rest", H5T_NATIVE_DOUBLE, 9, rest);
	assert_memory_equal(rest, sample_vertices, sizeof rest);
	read_numbers(file, "/mesh/wedge: \xC3\xA9/surface/weights", H5T_NATIVE_DOUBLE, 12, weights);
	assert_memory_equal(weights, sample_vertex_weights, sizeof weights);
	read_numbers(file, "/topology/surface", H5T_NATIVE_INT, 9, triangles);
	assert_memory_equal(triangles, expected, sizeof expected);
	check_text(file, group, "kind", "embedded");
	assert_int_equal(read_count(file, group, "first_point"), 8);
	assert_int_equal(read_count(file, group, "point_count"), SAMPLE_VERTICES);
	H5Fclose(file);
}

static void embedded_surface_moves_with_its_nodes(void** state) {
	Sample* sample = *state;
	sample_embed(sample);
	sample_record(sample);
	const hid_t file = open_file(sample);
	for (long i = 0; i < SAMPLE_FRAMES; i++) {
		double x[3 * SAMPLE_NODES], v[3 * SAMPLE_NODES], points[3 * (8 + SAMPLE_VERTICES)];
		char name[64];
		sample_state(i * SAMPLE_STEPS_A_FRAME, sample, x, v);
		snprintf(name, sizeof name, "/frames/%08ld/surface", i);
		read_numbers(file, name, H5T_NATIVE_DOUBLE, 3 * (8 + SAMPLE_VERTICES), points);
		assert_memory_equal(points, x, 24 * sizeof *x);
		for (int k = 0; k < 3 * SAMPLE_VERTICES; k++) {
			double expected = 0;
			for (int j = 0; j < 4; j++)
				expected +=
					sample_vertex_weights[k / 3 * 4 + j] * x[3 * (8 + sample_vertex_nodes[k / 3 * 4 + j]) + k % 3];
			assert_true(fabs(points[24 + k] - expected) <= 1e-15); // the same sum of four numbers below 2
		}
	}
	H5Fclose(file);
}

static void fields_read_back_bit_for_bit_with_their_units(void** state) {
	Sample* sample = *state;
	sample_add_fields(sample);
	sample_record(sample);
	const hid_t file = open_file(sample);
	check_frames(sample, file, SAMPLE_FRAMES);
	for (long i = 0; i < SAMPLE_FRAMES; i++) {
		double push[3 * SAMPLE_NODES], depth[SAMPLE_NODES], read[3 * SAMPLE_NODES];
		char name[64];
		sample_field_values(i * SAMPLE_STEPS_A_FRAME, push, depth);
		snprintf(name, sizeof name, "/frames/%08ld/push", i);
		read_numbers(file, name, H5T_NATIVE_DOUBLE, 3 * SAMPLE_NODES, read);
		assert_memory_equal(read, push, sizeof push);
		check_text(file, name, "unit", "N");
		snprintf(name, sizeof name, "/frames/%08ld/depth", i);
		read_numbers(file, name, H5T_NATIVE_DOUBLE, SAMPLE_NODES, read);
		assert_memory_equal(read, depth, sizeof depth);
		check_text(file, name, "unit", "m");
	}
	H5Fclose(file);
}

static void obstacles_read_back_one_by_one_and_together(void** state) {
	Sample* sample = *state;
	sample_add_obstacles(sample);
	sample_record(sample);
	const hid_t file = open_file(sample);
	const int expected[9] = {0, 1, 2, 0, 2, 3, 4, 5, 6}, expected_obstacles[3] = {0, 0, 1};
	double points[21];
	int triangles[9], obstacles[3];
	read_numbers(file, "/obstacles/floor/points", H5T_NATIVE_DOUBLE, 12, points);
	assert_memory_equal(points, sample_floor_points, sizeof sample_floor_points);
	read_numbers(file, "/obstacles/wall/triangles", H5T_NATIVE_INT, 3, triangles);
	assert_memory_equal(triangles, sample_wall_triangle, sizeof sample_wall_triangle);
	read_numbers(file, "/topology/obstacle_points", H5T_NATIVE_DOUBLE, 21, points);
	assert_memory_equal(points, sample_floor_points, sizeof sample_floor_points);
	assert_memory_equal(points + 12, sample_wall_points, sizeof sample_wall_points);
	read_numbers(file, "/topology/obstacle_triangles", H5T_NATIVE_INT, 9, triangles);
	assert_memory_equal(triangles, expected, sizeof expected);
	read_numbers(file, "/topology/obstacle", H5T_NATIVE_INT, 3, obstacles);
	assert_memory_equal(obstacles, expected_obstacles, sizeof expected_obstacles);
	H5Fclose(file);
}

static void a_run_without_obstacles_has_no_trace_of_them(void** state) {
	Sample* sample = *state;
	sample_add_obstacles(sample);
	sample_record(sample);
	assert_int_equal(access(sample_path(sample, "obstacles.xdmf"), R_OK), 0);
	sample->info.obstacle_count = 0;
	sample_record(sample);
	assert_int_not_equal(access(sample_path(sample, "obstacles.xdmf"), F_OK), 0);
	const hid_t file = open_file(sample);
	assert_int_equal(H5Lexists(file, "/obstacles", H5P_DEFAULT), 0);
	H5Fclose(file);
}

static void file_tells_its_origin_and_outcome(void** state) {
	Sample* sample = *state;
	sample_record(sample);
	const hid_t file = open_file(sample);
	check_text(file, "/", "jounce_version", JN_VERSION);
	check_text(file, "/", "scene_name", "it's a \"beam\"");
	check_text(file, "/", "method", "tr_bdf2");
	check_text(file, "/", "blas", "OpenBLAS 0.3.21");
	check_text(file, "/", "outcome", "done");
	assert_int_equal(read_count(file, "/", "threads"), 2);
	assert_int_equal(read_count(file, "/", "simd_width"), 4);
	const hid_t scene = H5Dopen2(file, "/scene", H5P_DEFAULT);
	const hid_t type = H5Dget_type(scene);
	char* text = NULL;
	assert_true(H5Dread(scene, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text) >= 0);
	assert_string_equal(text, sample->info.scene_text);
	H5free_memory(text);
	H5Tclose(type);
	H5Dclose(scene);
	H5Fclose(file);
}

// Killed at step 12, the run has the frames of steps 0, 5 and 10.
static void killed_run_leaves_its_frames_readable(void** state) {
	Sample* sample = *state;
	const pid_t child = fork();
	if (child == 0) {
		if (sample_open(sample) != JN_OK) _exit(1);
		for (long k = 0; k <= 12; k++) {
			if (sample_write(sample, k) != JN_OK) _exit(1);
		}
		raise(SIGKILL);
	}
	int outcome = 0;
	assert_int_equal(waitpid(child, &outcome, 0), child);
	assert_true(WIFSIGNALED(outcome) && WTERMSIG(outcome) == SIGKILL);
	const hid_t file = open_file(sample);
	check_frames(sample, file, 3);
	check_text(file, "/", "outcome", "running");
	H5Fclose(file);
}

// Another process opens the file while it is being written: no lock is in its way, and the frames are there.
static void running_file_can_be_read_by_others(void** state) {
	Sample* sample = *state;
	int gate[2] = {0};
	assert_int_equal(pipe(gate), 0);
	const pid_t child = fork();
	if (child == 0) {
		char go = 0;
		if (read(gate[0], &go, 1) != 1) _exit(2);
		const hid_t file = H5Fopen(sample_path(sample, "run.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
		_exit(file >= 0 && read_count(file, "/frames", "count") == 2 ? 0 : 1);
	}
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k <= 5; k++) assert_int_equal(sample_write(sample, k), JN_OK);
	assert_int_equal(write(gate[1], "g", 1), 1);
	int outcome = 0;
	assert_int_equal(waitpid(child, &outcome, 0), child);
	close(gate[0]), close(gate[1]);
	assert_int_equal(sample_close(sample), JN_OK);
	assert_true(WIFEXITED(outcome));
	assert_int_equal(WEXITSTATUS(outcome), 0);
}

// The disk has room for `budget` more bytes of run.h5; below 0 there is no end to it.
static long budget = -1;

// The recorder writes through this one instead of the C library's.
ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
	char link[64], path[256] = "";
	snprintf(link, sizeof link, "/proc/self/fd/%d", file);
	const bool is_recording = readlink(link, path, sizeof path - 1) > 0 && strstr(path, "/run.h5") != NULL;
	if (budget >= 0 && is_recording && strncmp(path, "/tmp/", 5) == 0) {
		if (budget < (long)size) {
			errno = ENOSPC;
			return -1;
		}
		budget -= (long)size;
	}
	return syscall(SYS_pwrite64, file, data, size, offset);
}

static int run_until_full(Sample* sample, long room) {
	budget = room;
	JnStatus status = sample_open(sample);
	for (long k = 0; k < 5000 && status == JN_OK; k++) status = sample_write(sample, k);
	if (status != JN_IO_FAILED) return 2;
	if (strstr(sample->messages, sample_path(sample, "run.h5: cannot write")) == NULL) return 3;
	if (strstr(sample->messages, "No space left on device") == NULL) return 4;
	const size_t told = strlen(sample->messages);
	if (sample->recorders.count > 0 && sample_close(sample) != JN_IO_FAILED) return 5;
	return strstr(sample->messages + told, "run.h5") == NULL ? 0 : 6; // told once
}

// In a child, since HDF5's handler at exit must get through, too.
static void full_disk_ends_the_run_with_path_and_reason(void** state) {
	Sample* sample = *state;
	for (long room = 1000; room < 1000000; room *= 3) {
		const pid_t child = fork();
		if (child == 0) {
			const int failure = run_until_full(sample, room);
			if (failure != 0) print_message("room %ld: %s", room, sample->messages);
			jn_arena_free(&sample->arena);
			exit(failure);
		}
		int outcome = 0;
		assert_int_equal(waitpid(child, &outcome, 0), child);
		assert_true(WIFEXITED(outcome));
		assert_int_equal(WEXITSTATUS(outcome), 0);
	}
}

static void run_after_a_full_disk_is_recorded(void** state) {
	Sample* sample = *state;
	assert_int_equal(run_until_full(sample, 50000), 0);
	budget = -1;
	sample_record(sample);
	const hid_t file = open_file(sample);
	check_frames(sample, file, SAMPLE_FRAMES);
	check_series(file, SAMPLE_STEPS);
	H5Fclose(file);
}

// ---- a rehearsal ----

static unsigned char* read_bytes(const char* path, size_t* size) {
	FILE* file = fopen(path, "rb");
	assert_non_null(file);
	assert_int_equal(fseek(file, 0, SEEK_END), 0);
	*size = (size_t)ftell(file);
	rewind(file);
	unsigned char* bytes = malloc(*size);
	assert_non_null(bytes);
	assert_int_equal(fread(bytes, 1, *size, file), *size);
	fclose(file);
	return bytes;
}

static void a_rehearsal_writes_as_if_and_leaves_the_file_as_it_is(void** state) {
	Sample* sample = *state;
	JnH5File file;
	size_t size_before, size_after;
	const double numbers[1000] = {1};
	const hsize_t count = 1000;
	sample_record(sample);
	unsigned char* before = read_bytes(sample_path(sample, "run.h5"), &size_before);
	assert_int_equal(jn_h5_open_rehearsal(&file, sample->directory, "run.h5"), JN_OK);
	assert_int_equal(jn_h5_attribute_text(&file, "/", "outcome", "rehearsed"), JN_OK);
	assert_int_equal(jn_h5_remove(&file, "/frames/00000000"), JN_OK);
	assert_int_equal(jn_h5_array(&file, "/more", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &count, numbers), JN_OK);
	assert_int_equal(jn_h5_sync(&file), JN_OK);
	check_text(file.id, "/", "outcome", "rehearsed");
	bool is_added, is_removed;
	assert_int_equal(jn_h5_find(&file, "/more", &is_added), JN_OK);
	assert_int_equal(jn_h5_find(&file, "/frames/00000000", &is_removed), JN_OK);
	assert_true(is_added && !is_removed);
	assert_int_equal(jn_h5_close(&file), JN_OK);
	unsigned char* after = read_bytes(sample_path(sample, "run.h5"), &size_after);
	assert_int_equal(size_after, size_before);
	assert_memory_equal(after, before, size_before);
	assert_int_equal(access(sample_path(sample, "run.h5.journal"), F_OK), -1);
	free(before);
	free(after);
}

// ---- the journal ----

enum { PAGE_BYTES = 4096 };

static void write_bytes(const char* path, const void* bytes, size_t size) {
	FILE* file = fopen(path, "wb");
	assert_non_null(file);
	assert_int_equal(fwrite(bytes, 1, size, file), size);
	assert_int_equal(fclose(file), 0);
}

// Two pages of zeros, and a journal with another second page. `spoil`: this byte of it is another one.
static void leave_a_journal(const Sample* sample, long spoil) {
	static unsigned char pages[2 * PAGE_BYTES], journal[24 + 8 + PAGE_BYTES];
	uint64_t head[4] = {0, 1, 0, 1}; // magic, count, sum; the number of the page
	memcpy(head, "jounceJ1", 8);
	memset(pages, 0, sizeof pages);
	memset(journal + sizeof head, 'x', PAGE_BYTES);
	memcpy(journal, head, sizeof head);
	head[2] = crc32_z(0, journal + 24, sizeof journal - 24);
	memcpy(journal, head, sizeof head);
	if (spoil >= 0) journal[spoil] ^= 1;
	write_bytes(sample_path(sample, "run.h5"), pages, sizeof pages);
	write_bytes(sample_path(sample, "run.h5.journal"), journal, sizeof journal);
}

static void expect_second_page(const Sample* sample, char content) {
	char pages[2 * PAGE_BYTES];
	FILE* file = fopen(sample_path(sample, "run.h5"), "rb");
	assert_non_null(file);
	assert_int_equal(fread(pages, 1, sizeof pages, file), sizeof pages);
	fclose(file);
	for (int i = 0; i < 2 * PAGE_BYTES; ++i) assert_int_equal(pages[i], i < PAGE_BYTES ? 0 : content);
}

static void a_whole_journal_is_put_into_its_file(void** state) {
	Sample* sample = *state;
	leave_a_journal(sample, -1);
	assert_int_equal(jn_h5_recover(sample_path(sample, "run.h5")), JN_OK);
	expect_second_page(sample, 'x');
	assert_int_equal(access(sample_path(sample, "run.h5.journal"), F_OK), -1);
}

static void a_journal_that_is_not_whole_is_of_no_use(void** state) {
	Sample* sample = *state;
	static const long bytes[] = {0, 8, 16, 24, 32, 24 + 8 + PAGE_BYTES - 1};
	for (size_t i = 0; i < sizeof bytes / sizeof *bytes; ++i) {
		leave_a_journal(sample, bytes[i]);
		assert_int_equal(jn_h5_recover(sample_path(sample, "run.h5")), JN_OK);
		expect_second_page(sample, 0);
		assert_int_equal(access(sample_path(sample, "run.h5.journal"), F_OK), -1);
	}
}

static void the_journal_of_a_run_in_progress_is_left_alone(void** state) {
	Sample* sample = *state;
	leave_a_journal(sample, -1);
	const int journal = open(sample_path(sample, "run.h5.journal"), O_RDWR);
	assert_int_equal(flock(journal, LOCK_EX), 0);
	assert_int_equal(jn_h5_recover(sample_path(sample, "run.h5")), JN_OK);
	expect_second_page(sample, 0);
	assert_int_equal(access(sample_path(sample, "run.h5.journal"), F_OK), 0);
	close(journal);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, sample_setup, sample_teardown)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(frames_read_back_bit_for_bit),
		TEST(series_read_back_bit_for_bit),
		TEST(long_series_crosses_buffers_and_chunks),
		TEST(counts_are_stored_as_integers),
		TEST(mesh_reads_back_with_its_bodies),
		TEST(points_have_volumes_and_threads_an_axis),
		TEST(mixed_topology_leads_each_cell_with_its_number),
		TEST(file_tells_its_origin_and_outcome),
		TEST(killed_run_leaves_its_frames_readable),
		TEST(running_file_can_be_read_by_others),
		TEST(full_disk_ends_the_run_with_path_and_reason),
		TEST(run_after_a_full_disk_is_recorded),
		TEST(plain_bodies_have_the_faces_of_their_cells_as_surface),
		TEST(embedded_surface_moves_with_its_nodes),
		TEST(embedded_surface_reads_back_with_nodes_of_the_run),
		TEST(fields_read_back_bit_for_bit_with_their_units),
		TEST(obstacles_read_back_one_by_one_and_together),
		TEST(a_run_without_obstacles_has_no_trace_of_them),
		TEST(a_rehearsal_writes_as_if_and_leaves_the_file_as_it_is),
		TEST(a_whole_journal_is_put_into_its_file),
		TEST(a_journal_that_is_not_whole_is_of_no_use),
		TEST(the_journal_of_a_run_in_progress_is_left_alone),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
