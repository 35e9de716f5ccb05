/// @file knot_case.h
/// The scene of a knot that is pulled tight, watched.
#ifndef JN_TEST_PASS_KNOT_CASE_H
#define JN_TEST_PASS_KNOT_CASE_H

#include "pass/collision_case.h"
#include "support/knot.h"

/// What was seen of a knot.
typedef struct KnotStory {
	double least;          ///< distance of two links that are no neighbours, in diameters
	int least_determinant; ///< of the axis, closed by a straight line
	int most_determinant;
	double start_tension; ///< at the end of the run, in what hangs there
	double end_tension;
	double speed; ///< root mean square at the end of the run [m/s]
} KnotStory;

static inline int axis_determinant(const Run* run) {
	const int frames = frames_of(run, 0);
	double* axis = malloc(3 * (size_t)frames * sizeof *axis);
	assert_non_null(axis);
	for (int k = 0; k < frames; ++k) axis_of(run, 0, k, run_state(run)->x, axis + 3 * (ptrdiff_t)k);
	const int determinant = knot_determinant(frames, axis, false);
	free(axis);
	return determinant;
}

static inline double link_strain(const Run* run, int link) {
	double now[2][3], rest[2][3];
	for (int i = 0; i < 2; ++i) {
		axis_of(run, 0, link + i, run_state(run)->x, now[i]);
		axis_of(run, 0, link + i, run->model->rest, rest[i]);
	}
	return vec3_distance(now[0], now[1]) / vec3_distance(rest[0], rest[1]) - 1;
}

/// Run scenes/knot.yaml for a while; EA = E pi r^2 turns strains into tensions, which are given over weight and load below.
static inline KnotStory knot_run(double duration, double look) {
	char path[1200], set[64];
	Run run = {0};
	KnotStory story = {.least = INFINITY, .least_determinant = 1000};
	snprintf(path, sizeof path, "%s/scenes/knot.yaml", JN_SOURCE_DIR);
	snprintf(set, sizeof set, "duration=%.17g s", duration);
	const char* const sets[] = {set};
	assert_int_equal(jn_scene_load(path, 1, sets, &run.scene), JN_OK);
	assert_int_equal(jn_scene_build(run.scene, 1, &run.sim), JN_OK);
	run.model = jn_sim_model(run.sim);
	run.length = 3 * jn_model_node_count(run.model);
	const JnStrand* strand = &run_collision(&run)->strands[0];
	for (double t = look; t < duration + 0.5 * look; t += look) {
		run_until(&run, fmin(t, duration));
		const int determinant = axis_determinant(&run);
		story.least = fmin(story.least, links_apart(&run, 0, 0, strand->apart) / (2 * strand->radius));
		if (determinant < story.least_determinant) story.least_determinant = determinant;
		if (determinant > story.most_determinant) story.most_determinant = determinant;
	}
	const double EA = 5e5 * 3.14159265358979 * strand->radius * strand->radius, load = 0.16; // as the scene says
	const double weight = 9.81 * body_mass(&run, 0);
	story.start_tension = EA * link_strain(&run, 1) / (load + weight * (1 - 1.5 / strand->link_count));
	story.end_tension = EA * link_strain(&run, strand->link_count - 2) / (load + weight * 1.5 / strand->link_count);
	story.speed = sqrt(2 * run_energies(&run).kinetic / body_mass(&run, 0));
	run_close(&run);
	print_message("least distance %.4f diameters, determinants %d to %d, tensions %.4f and %.4f, %.3g m/s\n",
				  story.least, story.least_determinant, story.most_determinant, story.start_tension, story.end_tension,
				  story.speed);
	return story;
}

#endif
