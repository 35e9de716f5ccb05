/// @file sample_run.h
/// A small made-up run for the tests of the recorders: a hexahedron and a tetrahedron, steps from formulas.
#ifndef JN_TEST_RECORD_SAMPLE_RUN_H
#define JN_TEST_RECORD_SAMPLE_RUN_H

#define _GNU_SOURCE

#include <ftw.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "record/recorder.h"

enum { SAMPLE_NODES = 12, SAMPLE_COLUMNS = 8, SAMPLE_STEPS = 21, SAMPLE_FRAMES = 5, SAMPLE_STEPS_A_FRAME = 5 };

static const JnColumn sample_columns[SAMPLE_COLUMNS] = {
	{"step", "", true},
	{"t", "s", false},
	{"dt", "s", false},
	{"kinetic", "J", false},
	{"total", "J", false},
	{"newton", "", true},
	{"specific_error", "J/kg", false},
	{"probe.tip.y", "m", false},
};

static const int sample_hexahedron[8] = {0, 1, 3, 2, 4, 5, 7, 6};
static const int sample_tetrahedron[4] = {8, 9, 10, 11};
static const int sample_beam_triangles[6] = {0, 3, 1, 0, 2, 3};
static const int sample_wedge_triangles[3] = {8, 10, 9};

/// A surface of three vertices that the tetrahedron carries along; the last vertex is outside of it.
enum { SAMPLE_VERTICES = 3 };
static double sample_vertices[3 * SAMPLE_VERTICES];
static int sample_vertex_triangle[3] = {2, 0, 1};
static const int sample_vertex_nodes[4 * SAMPLE_VERTICES] = {0, 1, 2, 3, 1, 3, 0, 2, 0, 1, 2, 3};
static const double sample_vertex_weights[4 * SAMPLE_VERTICES] = {0.25, 0.25, 0.25, 0.25, 0.5,  0.5,
																  0,    0,    1.5,  -0.5, -0.1, 0.1};
static const JnEmbedding sample_embedding = {
	.surface = {SAMPLE_VERTICES, sample_vertices, 1, sample_vertex_triangle},
	.cell_nodes = 4,
	.nodes = sample_vertex_nodes,
	.weights = sample_vertex_weights,
};

enum { SAMPLE_FIELDS = 2 };
static const JnField sample_fields[SAMPLE_FIELDS] = {{"push", "N", 3}, {"depth", "m", 1}};

/// A floor of two triangles and a wall of one.
enum { SAMPLE_OBSTACLES = 2 };
static double sample_floor_points[12] = {0, 0, 0, 0, 0, 1.5, 1.5, 0, 1.5, 1.5, 0, 0};
static double sample_wall_points[9] = {0, 0, 0, 0.1, 0, 0, 0, 1 / 3.0, 0};
static int sample_floor_triangles[6] = {0, 1, 2, 0, 2, 3}, sample_wall_triangle[3] = {0, 1, 2};
static const JnRecordObstacle sample_obstacles[SAMPLE_OBSTACLES] = {
	{"floor", {4, sample_floor_points, 2, sample_floor_triangles}},
	{"wall", {3, sample_wall_points, 1, sample_wall_triangle}},
};

typedef struct Sample {
	char directory[64];
	double nodes[3 * SAMPLE_NODES];
	JnRecordBody bodies[2];
	JnRecordInfo info;
	JnArena arena;
	JnRecorders recorders;
	char messages[4096]; // all warnings and errors, one a line
} Sample;

static inline void sample_keep_message(void* user, JnLogLevel level, const char* message) {
	Sample* sample = user;
	const size_t length = strlen(sample->messages);
	if (level == JN_LOG_INFO) return;
	snprintf(sample->messages + length, sizeof sample->messages - length, "%s\n", message);
}

static inline int sample_setup(void** state) {
	static Sample sample;
	sample = (Sample){.directory = "/tmp/jounce_record_XXXXXX"};
	if (mkdtemp(sample.directory) == NULL) return -1;
	for (int i = 0; i < SAMPLE_NODES; i++) {
		sample.nodes[3 * i] = (i & 1) + 0.1;
		sample.nodes[3 * i + 1] = (i >> 1 & 1) / 3.0;
		sample.nodes[3 * i + 2] = (i >> 2) * 1e-3;
	}
	sample.bodies[0] =
		(JnRecordBody){"beam", JN_HEX8, 0, 8, 1, sample_hexahedron, 2, sample_beam_triangles, NULL, NULL, NULL};
	sample.bodies[1] = (JnRecordBody){"wedge: \xC3\xA9",      JN_TET4, 8,    4,   1, sample_tetrahedron, 1,
									  sample_wedge_triangles, NULL,    NULL, NULL};
	sample.info = (JnRecordInfo){
		.directory = sample.directory,
		.scene_name = "it's a \"beam\"",
		.scene_path = "scenes/b\xFF.yaml",
		.scene_text = "name: beam\n# --set dt=1e-3\n",
		.method = "tr_bdf2",
		.node_count = SAMPLE_NODES,
		.nodes = sample.nodes,
		.body_count = 2,
		.bodies = sample.bodies,
		.column_count = SAMPLE_COLUMNS,
		.columns = sample_columns,
		.wants_plots = true,
		.total_mass = 2.5,
		.gravity = {0, -9.81, 1.0 / 3},
		.threads = 2,
		.simd_width = 4,
		.blas = "OpenBLAS 0.3.21",
	};
	jn_log_set_sink(sample_keep_message, &sample);
	*state = &sample;
	return 0;
}

/// Let the second body carry the surface of three vertices.
static inline void sample_embed(Sample* sample) {
	jn_embedding_positions(&sample_embedding, sample->nodes + 3 * (ptrdiff_t)sample->bodies[1].first_node,
						   sample_vertices);
	sample->bodies[1].triangle_count = sample_embedding.surface.triangle_count;
	sample->bodies[1].triangles = sample_embedding.surface.triangles;
	sample->bodies[1].embedding = &sample_embedding;
}

static inline int sample_remove(const char* path, const struct stat* facts, int kind, struct FTW* walk) {
	(void)facts, (void)kind, (void)walk;
	return remove(path);
}

static inline int sample_teardown(void** state) {
	Sample* sample = *state;
	jn_log_set_sink(NULL, NULL);
	jn_arena_free(&sample->arena);
	return nftw(sample->directory, sample_remove, 16, FTW_DEPTH | FTW_PHYS);
}

/// The numbers of step k; most need all 17 digits.
static inline void sample_values(long k, double values[SAMPLE_COLUMNS]) {
	const double t = (double)k * 0.1 / 3;
	const double numbers[SAMPLE_COLUMNS] = {
		(double)k,   t, k > 0 ? 0.1 / 3 : 0, sin(t) * sin(t), 0.5, (double)(k % 4), k > 0 ? 1e-12 * exp(t) : 0,
		-cos(t) / 7,
	};
	memcpy(values, numbers, sizeof numbers);
}

/// Positions and velocities of step k.
static inline void sample_state(long k, const Sample* sample, double* x, double* v) {
	for (int i = 0; i < 3 * SAMPLE_NODES; i++) {
		x[i] = sample->nodes[i] * (1 + 0.01 * (double)k);
		v[i] = sin((double)(i + 1) * (double)(k + 1));
	}
}

/// Let the run have a floor and a wall.
static inline void sample_add_obstacles(Sample* sample) {
	sample->info.obstacle_count = SAMPLE_OBSTACLES;
	sample->info.obstacles = sample_obstacles;
}

/// Record two made-up fields in each frame.
static inline void sample_add_fields(Sample* sample) {
	sample->info.field_count = SAMPLE_FIELDS;
	sample->info.fields = sample_fields;
}

/// Both fields of step k.
static inline void sample_field_values(long k, double push[3 * SAMPLE_NODES], double depth[SAMPLE_NODES]) {
	for (int i = 0; i < 3 * SAMPLE_NODES; i++) push[i] = exp(0.1 * (double)(i - k));
	for (int i = 0; i < SAMPLE_NODES; i++) depth[i] = -1 / (double)(i + k + 3);
}

static inline JnStatus sample_write(Sample* sample, long k) {
	double values[SAMPLE_COLUMNS], x[3 * SAMPLE_NODES], v[3 * SAMPLE_NODES];
	double push[3 * SAMPLE_NODES], depth[SAMPLE_NODES];
	const double* const fields[SAMPLE_FIELDS] = {push, depth};
	sample_values(k, values);
	sample_state(k, sample, x, v);
	sample_field_values(k, push, depth);
	const JnRecordStep step = {.step = k,
							   .t = values[1],
							   .is_frame = k % SAMPLE_STEPS_A_FRAME == 0,
							   .x = x,
							   .v = v,
							   .values = values,
							   .fields = sample->info.field_count > 0 ? fields : NULL};
	return jn_recorders_write(&sample->recorders, &step);
}

static inline JnRecordEnd sample_end(void) {
	return (JnRecordEnd){
		.outcome = "done",
		.message = "tab\there, quote \", backslash \\",
		.wall_seconds = 4,
		.seconds_predict = 2.5,
		.steps = SAMPLE_STEPS - 1,
		.frames = SAMPLE_FRAMES,
		.newton = 30,
		.t = 2,
		.t_end = 2,
		.specific_error = 1e-12,
		.specific_error_max = INFINITY,
	};
}

static inline JnStatus sample_open(Sample* sample) {
	return jn_recorders_open(&sample->recorders, &sample->arena, &sample->info, NULL);
}

static inline JnStatus sample_close(Sample* sample) {
	const JnRecordEnd end = sample_end();
	return jn_recorders_close(&sample->recorders, &end);
}

/// Open, write all steps, close.
static inline void sample_record(Sample* sample) {
	assert_int_equal(sample_open(sample), JN_OK);
	for (long k = 0; k < SAMPLE_STEPS; k++) assert_int_equal(sample_write(sample, k), JN_OK);
	assert_int_equal(sample_close(sample), JN_OK);
}

static inline const char* sample_path(const Sample* sample, const char* name) {
	static char path[512];
	snprintf(path, sizeof path, "%s/%s", sample->directory, name);
	return path;
}

/// The text of a file of the run; the caller frees it.
static inline char* sample_read(const Sample* sample, const char* name) {
	FILE* stream = fopen(sample_path(sample, name), "r");
	assert_non_null(stream);
	char* text = NULL;
	size_t size = 0;
	const ssize_t length = getdelim(&text, &size, '\0', stream);
	fclose(stream);
	assert_true(length > 0);
	return text;
}

#endif
