// Surfaces from files and into files: the same cube in every format, what files leave unsaid, and damaged files, which
// are made from good ones.
#include <stdlib.h>
#include <unistd.h>

#include "mesh/format/export.h"
#include "mesh/format/import.h"
#include "support/support.h"
#include "surface_case.h"

static char folder[256];

typedef struct Bytes {
	size_t size;
	unsigned char data[8192];
} Bytes;

static void add(Bytes* bytes, const void* data, size_t size) {
	assert_true(bytes->size + size <= sizeof bytes->data);
	memcpy(bytes->data + bytes->size, data, size);
	bytes->size += size;
}

static void add_text(Bytes* bytes, const char* text) {
	add(bytes, text, strlen(text));
}

static const char* save(const Bytes* bytes, const char* name) {
	const char* path = path_join(folder, name);
	FILE* file = fopen(path, "wb");
	assert_non_null(file);
	assert_int_equal(fwrite(bytes->data, 1, bytes->size, file), bytes->size);
	fclose(file);
	return path;
}

static Bytes load(const char* path) {
	Bytes bytes = {0};
	FILE* file = fopen(path, "rb");
	assert_non_null(file);
	bytes.size = fread(bytes.data, 1, sizeof bytes.data, file);
	assert_true(bytes.size < sizeof bytes.data);
	fclose(file);
	return bytes;
}

/// Replace the first place of a text by another; the test fails when it is not there.
static Bytes changed(const Bytes* from, const char* old, const char* new) {
	const size_t length = strlen(old);
	for (size_t i = 0; i + length <= from->size; i++) {
		if (memcmp(from->data + i, old, length) != 0) continue;
		Bytes out = {0};
		add(&out, from->data, i);
		add_text(&out, new);
		add(&out, from->data + i + length, from->size - i - length);
		return out;
	}
	fail_msg("'%s' is not in the file", old);
	return *from;
}

static Bytes cut(const Bytes* from, size_t size) {
	Bytes out = {0};
	add(&out, from->data, size < from->size ? size : from->size);
	return out;
}

// ---- the cube from 0 to 2 in every format ----

static Bytes cube_written(const char* extension) {
	JnArena arena = {0};
	char name[32];
	snprintf(name, sizeof name, "seed.%s", extension);
	const JnSurface cube = surface_cube(&arena, 0, 2);
	const char* path = path_join(folder, name);
	assert_int_equal(jn_export_surface(&cube, path), JN_OK);
	jn_arena_free(&arena);
	return load(path);
}

/// 96 bytes of positions and 72 of node numbers.
static Bytes cube_buffer(void) {
	JnArena arena = {0};
	const JnSurface cube = surface_cube(&arena, 0, 2);
	Bytes bytes = {0};
	for (int i = 0; i < 24; i++) {
		const float x = (float)cube.nodes[i];
		add(&bytes, &x, sizeof x);
	}
	for (int i = 0; i < 36; i++) {
		const uint16_t node = (uint16_t)cube.triangles[i];
		add(&bytes, &node, sizeof node);
	}
	jn_arena_free(&arena);
	return bytes;
}

/// The text of a glTF file around the buffer; `uri` names the buffer, "" is that of a GLB file.
static Bytes gltf_text(const char* uri) {
	Bytes text = {0};
	add_text(&text, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
					"\"nodes\":[{\"children\":[1]},{\"mesh\":0}],"
					"\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
					"\"buffers\":[{\"byteLength\":168");
	add_text(&text, uri);
	add_text(&text, "}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":96},"
					"{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72}],"
					"\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","
					"\"min\":[0,0,0],\"max\":[2,2,2]},"
					"{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}]}");
	while (text.size % 4 != 0) add_text(&text, " ");
	return text;
}

static Bytes cube_gltf(void) {
	const Bytes buffer = cube_buffer();
	(void)save(&buffer, "cube.bin");
	return gltf_text(",\"uri\":\"cube.bin\"");
}

static void add_chunk(Bytes* out, const char* kind, const Bytes* content) {
	const uint32_t size = (uint32_t)content->size;
	add(out, &size, sizeof size);
	add(out, kind, 4);
	add(out, content->data, content->size);
}

static Bytes cube_glb(void) {
	const Bytes text = gltf_text(""), buffer = cube_buffer();
	const uint32_t head[2] = {2, (uint32_t)(12 + 8 + text.size + 8 + buffer.size)};
	Bytes out = {0};
	add_text(&out, "glTF");
	add(&out, head, sizeof head);
	add_chunk(&out, "JSON", &text);
	add_chunk(&out, "BIN", &buffer);
	return out;
}

static Bytes cube_file(const char* extension) {
	if (strcmp(extension, "gltf") == 0) return cube_gltf();
	if (strcmp(extension, "glb") == 0) return cube_glb();
	return cube_written(extension);
}

static const char* const extensions[] = {"obj", "ply", "stl", "off", "gltf", "glb"};
enum { FORMAT_COUNT = sizeof extensions / sizeof extensions[0] };

static void import_cube(const char* path, int nodes, double volume) {
	JnArena arena = {0};
	JnImport in;
	Words words;
	words_keep(&words);
	const JnStatus status = jn_import(path, &arena, &in);
	if (status != JN_OK || words.warnings > 0) fail_msg("%s: %s", path, words.text);
	assert_false(in.is_volume);
	assert_int_equal(in.surface.node_count, nodes);
	assert_int_equal(in.surface.triangle_count, 12);
	assert_near(path, jn_surface_volume(&in.surface), volume, 1e-15 * volume);
	assert_int_equal(jn_surface_check_closed(&in.surface, path), JN_OK);
	jn_arena_free(&arena);
}

static void every_format_gives_the_cube_with_eight_nodes_and_no_warning(void** state) {
	(void)state;
	for (int f = 0; f < FORMAT_COUNT; f++) {
		char name[32];
		snprintf(name, sizeof name, "cube.%s", extensions[f]);
		const Bytes file = cube_file(extensions[f]);
		import_cube(save(&file, name), 8, 8);
	}
}

static void round_trip_keeps_volume_and_orientation(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface ball = surface_sphere(&arena, 0.3, 12);
	for (int f = 0; f < 4; f++) {
		char name[32];
		JnImport in;
		snprintf(name, sizeof name, "ball.%s", extensions[f]);
		const char* path = path_join(folder, name);
		assert_int_equal(jn_export_surface(&ball, path), JN_OK);
		assert_false(path_exists(path_join(folder, strcat(name, ".part"))));
		Words words;
		words_keep(&words);
		assert_int_equal(jn_import(path, &arena, &in), JN_OK);
		assert_int_equal(words.warnings, 0); // none was turned, none was joined by more than equality
		assert_int_equal(in.surface.node_count, ball.node_count);
		assert_int_equal(in.surface.triangle_count, ball.triangle_count);
		const double volume = jn_surface_volume(&ball);
		assert_near(path, jn_surface_volume(&in.surface), volume, 1e-6 * volume); // files are read in single precision
		assert_int_equal(jn_surface_check_closed(&in.surface, path), JN_OK);
	}
	jn_arena_free(&arena);
}

static void placed_and_mirrored_parts_of_gltf_are_moved_and_face_outward(void** state) {
	(void)state;
	const Bytes file = cube_gltf();
	const Bytes scaled =
		changed(&file, "{\"children\":[1]}", "{\"children\":[1],\"scale\":[0.5,3,1],\"translation\":[9,0,0]}");
	import_cube(save(&scaled, "scaled.gltf"), 8, 12);
	const Bytes mirrored = changed(&file, "{\"children\":[1]}", "{\"children\":[1],\"scale\":[-1,1,1]}");
	JnArena arena = {0};
	JnImport in;
	Words words;
	words_keep(&words);
	assert_int_equal(jn_import(save(&mirrored, "mirror.gltf"), &arena, &in), JN_OK);
	assert_near("volume", jn_surface_volume(&in.surface), 8, 0);
	double low = 0;
	for (int i = 0; i < 8; i++) low = fmin(low, in.surface.nodes[3 * i]);
	assert_near("lowest x", low, -2, 0);
	jn_arena_free(&arena);
}

static void polygons_are_cut_into_triangles(void** state) {
	(void)state;
	Bytes file = {0};
	add_text(&file, "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nv 0 0 2\nv 2 0 2\nv 0 2 2\nv 2 2 2\n"
					"f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
	import_cube(save(&file, "quads.obj"), 8, 8);
}

static void binary_ply_of_both_byte_orders_is_read(void** state) {
	(void)state;
	const Bytes buffer = cube_buffer();
	for (int is_big = 0; is_big < 2; is_big++) {
		Bytes file = {0};
		add_text(&file, is_big ? "ply\nformat binary_big_endian 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
		add_text(&file, "comment a cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
						"element face 12\nproperty list uchar ushort vertex_indices\nend_header\n");
		for (int i = 0; i < 96; i++) add(&file, &buffer.data[is_big ? i / 4 * 4 + 3 - i % 4 : i], 1);
		for (int i = 0; i < 72; i++) {
			if (i % 6 == 0) add(&file, "\3", 1);
			add(&file, &buffer.data[96 + (is_big ? i ^ 1 : i)], 1);
		}
		import_cube(save(&file, is_big ? "big.ply" : "little.ply"), 8, 8);
		const Bytes short_file = cut(&file, file.size - 3);
		JnArena arena = {0};
		JnImport in;
		Words words;
		words_keep(&words);
		assert_int_equal(jn_import(save(&short_file, "short.ply"), &arena, &in), JN_BAD_INPUT);
		assert_says(&words, "face 11 of 12 is cut off");
		jn_arena_free(&arena);
	}
}

static void text_stl_is_read(void** state) {
	(void)state;
	JnArena arena = {0};
	const JnSurface cube = surface_cube(&arena, 0, 2);
	const char* path = path_join(folder, "text.stl");
	FILE* file = fopen(path, "w");
	fprintf(file, "solid cube\n");
	for (int i = 0; i < 36; i++) {
		const double* x = cube.nodes + 3 * cube.triangles[i];
		if (i % 3 == 0) fprintf(file, "facet normal 0 0 0\nouter loop\n");
		fprintf(file, "vertex %g %g %g\n", x[0], x[1], x[2]);
		if (i % 3 == 2) fprintf(file, "endloop\nendfacet\n");
	}
	fprintf(file, "endsolid cube\n");
	fclose(file);
	import_cube(path, 8, 8);
	jn_arena_free(&arena);
}

// ---- damage ----

static Bytes random_bytes(const Bytes* seed) {
	(void)seed;
	Bytes out = {.size = 3000};
	uint64_t number = 7;
	for (size_t i = 0; i < out.size; i++) {
		number = number * 6364136223846793005u + 1442695040888963407u;
		out.data[i] = (unsigned char)(number >> 56);
	}
	return out;
}

static Bytes zero_bytes(const Bytes* seed) {
	(void)seed;
	return (Bytes){.size = 500};
}

static Bytes nothing(const Bytes* seed) {
	(void)seed;
	return (Bytes){0};
}

static Bytes first_bytes(const Bytes* seed) {
	return cut(seed, 9);
}

static Bytes first_half(const Bytes* seed) {
	return cut(seed, seed->size / 2);
}

/// Half of the file, and words behind it.
static Bytes words_in_the_middle(const Bytes* seed) {
	Bytes out = cut(seed, seed->size / 3);
	add_text(&out, "\nv x y z\nthis is not a mesh { [ \n");
	add(&out, seed->data + seed->size / 3, seed->size - seed->size / 3);
	return out;
}

static Bytes (*const damages[])(const Bytes*) = {random_bytes, zero_bytes, nothing,
												 first_bytes,  first_half, words_in_the_middle};
enum { DAMAGE_COUNT = sizeof damages / sizeof damages[0] };

/// A text that a file holds and what takes its place.
typedef struct Change {
	const char *extension, *old, *new;
} Change;

static const Change changes[] = {
	{"obj", "f 1 3 4", "f 1 3 44"},
	{"obj", "f 1 3 4", "f 1 3 -44"},
	{"obj", "v 2 2 2", "v 2 nan 2"},
	{"obj", "v 2 2 2", "v 2 1e60 2"},
	{"obj", "v 2 2 2", "v 2"},
	{"obj", "f 1 3 4", "f 1 3 99999999999999999999"},
	{"obj", "f 1 3 4", "f 0 0 0"},
	{"ply", "element vertex 8", "element vertex 4000000000"},
	{"ply", "element vertex 8", "element vertex 9"},
	{"ply", "element face 12", "element face 2000000000"},
	{"ply", "element face 12", "element face -12"},
	{"ply", "\n3 0 2 3", "\n3 0 2 77"},
	{"ply", "\n3 0 2 3", "\n3 0 2 -3"},
	{"ply", "\n3 0 2 3", "\n3000000000 0 2 3"},
	{"ply", "\n2 2 2", "\n2 nan 2"},
	{"ply", "\n2 2 2", "\n2 2"},
	{"ply", "\n2 2 2", "\n2 word 2"},
	{"ply", "property double x", "property banana x"},
	{"ply", "ascii 1.0", "ebcdic 1.0"},
	{"ply", "end_header\n", ""},
	{"off", "8 12 0", "4000000000 12 0"},
	{"off", "8 12 0", "8 2000000000 0"},
	{"off", "8 12 0", "-8 12 0"},
	{"off", "8 12 0", "9 12 0"},
	{"off", "8 12 0", "8 14 0"},
	{"off", "\n3 0 2 3", "\n3 0 2 77"},
	{"off", "\n3 0 2 3", "\n3000000000 0 2 3"},
	{"off", "\n2 2 2", "\n2 nan 2"},
	{"off", "\n2 2 2", "\n2 word 2"},
	{"off", "\n2 2 2", "\n2 2"},
	{"gltf", "\"count\":8", "\"count\":4000000000"},
	{"gltf", "\"count\":36", "\"count\":400000000"},
	{"gltf", "\"count\":8", "\"count\":-8"},
	{"gltf", "\"mesh\":0", "\"mesh\":7"},
	{"gltf", "\"indices\":1", "\"indices\":7"},
	{"gltf", "\"bufferView\":0", "\"bufferView\":7"},
	{"gltf", "\"byteLength\":168", "\"byteLength\":1099511627776"},
	{"gltf", "\"byteLength\":168", "\"byteLength\":20"},
	{"gltf", "\"mesh\":0", "\"mesh\":0,\"children\":[0]"},
	{"gltf", "cube.bin", "gone.bin"},
	{"gltf", "\"POSITION\":0", "\"NORMAL\":0"},
	{"gltf", "5123", "5126"},
	{"glb", "\"count\":8", "\"count\":9"},
	{"glb", "\"count\":36", "\"count\":66"},
	{"glb", "\"mesh\":0", "\"mesh\":7"},
	{"glb", "\"indices\":1", "\"indices\":7"},
	{"glb", "\"byteLength\":72", "\"byteLength\":12"},
	{"glb", "glTF", "GLTF"},
	{"glb", "JSON", "BSON"},
};
enum { CHANGE_COUNT = sizeof changes / sizeof changes[0] };

/// Reading, or the check that everybody makes who needs a solid, says what is wrong, and names the file.
static void assert_refused(const Bytes* file, const char* extension, const char* damage) {
	char name[32];
	snprintf(name, sizeof name, "bad.%s", extension);
	const char* path = save(file, name);
	JnArena arena = {0};
	JnImport in;
	Words words;
	words_keep(&words);
	const JnStatus status = jn_import(path, &arena, &in);
	if (status != JN_BAD_INPUT && status != JN_IO_FAILED)
		fail_msg("%s, %s: '%s', expected an error: %s", extension, damage, jn_status_name(status), words.text);
	assert_says(&words, name);
	assert_int_equal(words.errors, 1);
	jn_arena_free(&arena);
}

static void damaged_files_of_every_format_are_refused(void** state) {
	(void)state;
	for (int f = 0; f < FORMAT_COUNT; f++) {
		const Bytes seed = cube_file(extensions[f]);
		for (int d = 0; d < DAMAGE_COUNT; d++) {
			if (strcmp(extensions[f], "obj") == 0 && damages[d] == first_half)
				continue; // see the test of open surfaces
			char number[32];
			snprintf(number, sizeof number, "damage %d", d);
			const Bytes bad = damages[d](&seed);
			assert_refused(&bad, extensions[f], number);
		}
	}
}

static void damaged_numbers_of_every_format_are_refused(void** state) {
	(void)state;
	for (int i = 0; i < CHANGE_COUNT; i++) {
		const Bytes seed = cube_file(changes[i].extension);
		const Bytes bad = changed(&seed, changes[i].old, changes[i].new);
		assert_refused(&bad, changes[i].extension, changes[i].new);
	}
}

static void damaged_binary_stl_is_refused(void** state) {
	(void)state;
	static const uint32_t counts[] = {0, 13, 4000000000u, 85899346u}; // the last one times 50 is 4 above 2^32
	const Bytes seed = cube_written("stl");
	for (int i = 0; i < 4; i++) {
		Bytes bad = seed;
		memcpy(bad.data + 80, &counts[i], 4);
		assert_refused(&bad, "stl", "count");
	}
	const float wrong[] = {NAN, INFINITY, 1e38f};
	for (int i = 0; i < 3; i++) {
		Bytes bad = seed;
		memcpy(bad.data + 84 + 12, &wrong[i], 4);
		assert_refused(&bad, "stl", "coordinate");
	}
}

static void deeply_nested_gltf_is_refused(void** state) {
	(void)state;
	const char* path = path_join(folder, "deep.gltf");
	FILE* file = fopen(path, "w");
	for (int i = 0; i < 1000000; i++) fputc('[', file);
	fclose(file);
	JnArena arena = {0};
	JnImport in;
	Words words;
	words_keep(&words);
	assert_int_equal(jn_import(path, &arena, &in), JN_BAD_INPUT);
	assert_says(&words, "deep.gltf: ");
	jn_arena_free(&arena);
}

static void cut_off_obj_is_found_by_its_open_edges(void** state) {
	(void)state;
	const Bytes seed = cube_written("obj");
	const Bytes bad = cut(&seed, seed.size - 16); // two whole lines: nothing in the file says that they are missing
	JnArena arena = {0};
	JnImport in;
	Words words;
	words_keep(&words);
	assert_int_equal(jn_import(save(&bad, "short.obj"), &arena, &in), JN_OK);
	assert_int_equal(in.surface.triangle_count, 10);
	assert_int_equal(jn_surface_check_closed(&in.surface, "short.obj"), JN_BAD_INPUT);
	assert_says(&words, "short.obj: the surface is open");
	jn_arena_free(&arena);
}

static void unknown_ending_names_the_known_ones(void** state) {
	(void)state;
	static const char* const names[] = {"duck.blend", "duck", "folder.stl/duck", "duck.", ".obj.d"};
	for (int i = 0; i < 5; i++) {
		JnArena arena = {0};
		JnImport in;
		Words words;
		words_keep(&words);
		assert_int_equal(jn_import(names[i], &arena, &in), JN_BAD_INPUT);
		assert_says(&words, "obj ply stl off gltf glb");
		assert_says(&words, "msh");
		assert_says(&words, "vtu");
		jn_arena_free(&arena);
	}
}

static void missing_file_and_folder_fail_as_such(void** state) {
	(void)state;
	JnArena arena = {0};
	JnImport in;
	Words words;
	words_keep(&words);
	assert_int_equal(jn_import("/no/such/duck.obj", &arena, &in), JN_IO_FAILED);
	assert_says(&words, "/no/such/duck.obj: cannot open the file: No such file");
	const JnSurface cube = surface_cube(&arena, 0, 1);
	assert_int_equal(jn_export_surface(&cube, "/no/such/duck.obj"), JN_IO_FAILED);
	assert_int_equal(jn_export_surface(&cube, path_join(folder, "duck.blend")), JN_BAD_INPUT);
	assert_says(&words, "obj ply stl off");
	jn_arena_free(&arena);
}

static void full_disk_is_an_error(void** state) {
	(void)state;
	JnArena arena = {0};
	Words words;
	if (access("/dev/full", W_OK) != 0) skip();
	const char* path = path_join(folder, "full.obj");
	assert_int_equal(symlink("/dev/full", path_join(folder, "full.obj.part")), 0);
	const JnSurface cube = surface_cube(&arena, 0, 1);
	words_keep(&words);
	assert_int_equal(jn_export_surface(&cube, path), JN_IO_FAILED);
	assert_says(&words, "No space left");
	assert_false(path_exists(path));
	jn_arena_free(&arena);
}

static int make_folder(void** state) {
	(void)state;
	return folder_create(folder);
}

static int remove_folder(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_format_gives_the_cube_with_eight_nodes_and_no_warning),
		cmocka_unit_test(round_trip_keeps_volume_and_orientation),
		cmocka_unit_test(placed_and_mirrored_parts_of_gltf_are_moved_and_face_outward),
		cmocka_unit_test(polygons_are_cut_into_triangles),
		cmocka_unit_test(binary_ply_of_both_byte_orders_is_read),
		cmocka_unit_test(text_stl_is_read),
		cmocka_unit_test(damaged_files_of_every_format_are_refused),
		cmocka_unit_test(damaged_numbers_of_every_format_are_refused),
		cmocka_unit_test(damaged_binary_stl_is_refused),
		cmocka_unit_test(deeply_nested_gltf_is_refused),
		cmocka_unit_test(cut_off_obj_is_found_by_its_open_edges),
		cmocka_unit_test(unknown_ending_names_the_known_ones),
		cmocka_unit_test(missing_file_and_folder_fail_as_such),
		cmocka_unit_test(full_disk_is_an_error),
	};
	return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
