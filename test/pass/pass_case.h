/// @file pass_case.h
/// Scenes for tests of contact, written as YAML in the test: built, stepped, and asked for what the pass records.
#ifndef JN_TEST_PASS_PASS_CASE_H
#define JN_TEST_PASS_PASS_CASE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "model/model.h"
#include "support/support.h"

/// Fail, with value, expected and tolerance, unless |value - expected| <= tolerance; print them anyway.
#define expect_near(value, expected, tolerance, ...)                                                                   \
	do {                                                                                                               \
		const double near_value = (value), near_expected = (expected), near_tolerance = (tolerance);                   \
		char near_name[160];                                                                                           \
		snprintf(near_name, sizeof near_name, __VA_ARGS__);                                                            \
		print_message("%s: %.6g, expected %.6g, tolerance %.3g\n", near_name, near_value, near_expected,               \
					  near_tolerance);                                                                                 \
		if (!(fabs(near_value - near_expected) <= near_tolerance))                                                     \
			fail_msg("%s: %.17g, expected %.17g, tolerance %.3g", near_name, near_value, near_expected,                \
					 near_tolerance);                                                                                  \
	} while (0)

/// Fail, with both numbers, unless value <= bound; print them anyway.
#define expect_at_most(value, bound, ...)                                                                              \
	do {                                                                                                               \
		const double most_value = (value), most_bound = (bound);                                                       \
		char most_name[160];                                                                                           \
		snprintf(most_name, sizeof most_name, __VA_ARGS__);                                                            \
		print_message("%s: %.6g, at most %.6g\n", most_name, most_value, most_bound);                                  \
		if (!(most_value <= most_bound)) fail_msg("%s: %.17g, at most %.17g", most_name, most_value, most_bound);      \
	} while (0)

/// A scene being simulated.
typedef struct Run {
	JnScene* scene;
	JnSim* sim;
	JnModel* model;
	int length; ///< 3 * nodes
	char path[1100];
} Run;

static char case_folder[256]; // where scenes and their files are

static inline int case_set_up(void** state) {
	(void)state;
	return folder_create(case_folder);
}

static inline int case_tear_down(void** state) {
	(void)state;
	folder_remove(case_folder);
	return 0;
}

/// Write the scene, read it and build it. The status is that of the first that fails; run_close in any case.
__attribute__((format(printf, 3, 0))) static inline JnStatus run_try(Run* run, int threads, const char* format,
																	 va_list arguments) {
	char* text = malloc(1 << 16);
	assert_non_null(text);
	const int length = vsnprintf(text, 1 << 16, format, arguments);
	assert_true(length < 1 << 16);
	*run = (Run){0};
	snprintf(run->path, sizeof run->path, "%s/scene.yaml", case_folder);
	file_write(run->path, text);
	free(text);
	JnStatus status = jn_scene_load(run->path, 0, NULL, &run->scene);
	if (status == JN_OK) status = jn_scene_build(run->scene, threads, &run->sim);
	if (status != JN_OK) return status;
	run->model = jn_sim_model(run->sim);
	run->length = 3 * jn_model_node_count(run->model);
	return JN_OK;
}

/// The same, which must work.
__attribute__((format(printf, 3, 4))) static inline void run_open(Run* run, int threads, const char* format, ...) {
	va_list arguments;
	va_start(arguments, format);
	const JnStatus status = run_try(run, threads, format, arguments);
	va_end(arguments);
	if (status != JN_OK) fail_msg("the scene cannot be built: %s", jn_status_name(status));
}

/// For scenes that may be refused.
__attribute__((format(printf, 2, 3))) static inline JnStatus run_attempt(Run* run, const char* format, ...) {
	va_list arguments;
	va_start(arguments, format);
	const JnStatus status = run_try(run, 1, format, arguments);
	va_end(arguments);
	return status;
}

static inline void run_close(Run* run) {
	jn_sim_destroy(run->sim);
	jn_scene_destroy(run->scene);
	*run = (Run){0};
}

static inline const JnState* run_state(const Run* run) {
	return jn_sim_state(run->sim);
}

static inline void run_step(Run* run) {
	const JnStatus status = jn_sim_step(run->sim);
	if (status != JN_OK)
		fail_msg("%s, step %ld: %s", jn_scene_def(run->scene)->sim.integrator.row->name, jn_sim_steps(run->sim) + 1,
				 jn_status_name(status));
}

static inline void run_steps(Run* run, int count) {
	for (int i = 0; i < count; ++i) run_step(run);
}

/// Step until time t is reached, up to rounding.
static inline void run_until(Run* run, double t) {
	while (run_state(run)->t < t * (1 - 1e-9)) run_step(run);
}

static inline const JnPass* run_pass(const Run* run) {
	int count;
	JnPass* const* passes = jn_sim_passes(run->sim, &count);
	assert_int_equal(count, 1);
	return passes[0];
}

/// What the pass says in a column of the series.
static inline double run_column(const Run* run, const char* name) {
	const JnPass* pass = run_pass(run);
	double values[32];
	assert_in_range(pass->type->column_count, 1, 32);
	pass->type->measure(pass, values);
	for (int i = 0; i < pass->type->column_count; ++i)
		if (strcmp(pass->type->columns[i].name, name) == 0) return values[i];
	fail_msg("there is no column '%s'", name);
	return NAN;
}

/// What the pass records at the nodes.
static inline const double* run_field(const Run* run, const char* name) {
	const JnPass* pass = run_pass(run);
	for (int i = 0; i < pass->type->field_count; ++i)
		if (strcmp(pass->type->fields[i].name, name) == 0) return pass->type->field(pass, i);
	fail_msg("there is no field '%s'", name);
	return NULL;
}

static inline JnEnergies run_energies(const Run* run) {
	return jn_model_energies(run->model, run_state(run));
}

static inline double run_energy(const Run* run) {
	const JnEnergies e = run_energies(run);
	return e.kinetic + e.elastic + e.gravity;
}

/// Where the entries of a body begin, and how many they are.
static inline int body_first(const Run* run, int body) {
	return 3 * run->model->bodies[body].first_node;
}

static inline int body_length(const Run* run, int body) {
	return 3 * run->model->bodies[body].mesh.node_count;
}

/// Mean over the nodes of a body of one axis of a vector.
static inline double body_mean(const Run* run, int body, const double* vector, int axis) {
	double sum = 0;
	for (int k = axis; k < body_length(run, body); k += 3) sum += vector[body_first(run, body) + k];
	return 3 * sum / body_length(run, body);
}

/// Least and greatest of one axis over the nodes of a body.
static inline double body_low(const Run* run, int body, const double* vector, int axis) {
	double least = INFINITY;
	for (int k = axis; k < body_length(run, body); k += 3) least = fmin(least, vector[body_first(run, body) + k]);
	return least;
}

static inline double body_high(const Run* run, int body, const double* vector, int axis) {
	double most = -INFINITY;
	for (int k = axis; k < body_length(run, body); k += 3) most = fmax(most, vector[body_first(run, body) + k]);
	return most;
}

static inline double body_largest(const Run* run, int body, const double* vector) {
	double most = 0;
	for (int k = 0; k < body_length(run, body); ++k) most = fmax(most, fabs(vector[body_first(run, body) + k]));
	return most;
}

/// Largest difference of two vectors, or NAN when an entry is not finite.
static inline double largest_difference(const double* a, const double* b, int length) {
	double most = 0;
	for (int k = 0; k < length; ++k) {
		const double difference = fabs(a[k] - b[k]);
		if (!(difference <= most)) most = difference;
	}
	return most;
}

#endif
