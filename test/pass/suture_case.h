/// @file suture_case.h
/// The scene of a running stitch, watched.
#ifndef JN_TEST_PASS_SUTURE_CASE_H
#define JN_TEST_PASS_SUTURE_CASE_H

#include "pass/collision_case.h"
#include "pass/suture.h"

/// What was seen of a suture, at the end of a run but for `error`.
typedef struct SutureStory {
	int sites;
	bool is_tip_inside;
	double error;   ///< largest of all steps [m]
	double drawn;   ///< [m]
	double gather;  ///< sum of the distances of sites that follow each other, over those at rest
	double stretch; ///< length of the thread over that at rest
} SutureStory;

static inline void site_place(const JnSite* site, const double* x, double out[3]) {
	for (int a = 0; a < 3; ++a) {
		out[a] = 0;
		for (int i = 0; i < 3; ++i) out[a] += site->weights[i] * x[3 * (ptrdiff_t)site->nodes[i] + a];
	}
}

static inline double sites_apart(const JnSuture* pass, const double* x) {
	double sum = 0;
	for (int i = 0; i + 1 < pass->count; ++i) {
		double a[3], b[3];
		site_place(&pass->sites[i], x, a);
		site_place(&pass->sites[i + 1], x, b);
		sum += vec3_distance(a, b);
	}
	return sum;
}

static inline double thread_length(const Run* run, const double* x) {
	double sum = 0, a[3], b[3];
	for (int k = 0; k + 1 < frames_of(run, 0); ++k) {
		axis_of(run, 0, k, x, a);
		axis_of(run, 0, k + 1, x, b);
		sum += vec3_distance(a, b);
	}
	return sum;
}

static inline SutureStory suture_run(double duration) {
	char path[1200];
	Run run = {0};
	SutureStory story = {0};
	snprintf(path, sizeof path, "%s/scenes/suture.yaml", JN_SOURCE_DIR);
	assert_int_equal(jn_scene_load(path, 0, NULL, &run.scene), JN_OK);
	assert_int_equal(jn_scene_build(run.scene, 1, &run.sim), JN_OK);
	run.model = jn_sim_model(run.sim);
	run.length = 3 * jn_model_node_count(run.model);
	const JnSuture* pass = (const JnSuture*)run_pass_of(&run, &jn_pass_suture);
	while (run_state(&run)->t < duration * (1 - 1e-9)) {
		run_step(&run);
		story.error = fmax(story.error, pass->error);
	}
	story.sites = pass->count;
	story.is_tip_inside = pass->is_tip_inside;
	story.drawn = pass_column(&pass->base, "suture_drawn");
	story.gather = sites_apart(pass, run_state(&run)->x) / sites_apart(pass, run.model->rest);
	story.stretch = thread_length(&run, run_state(&run)->x) / thread_length(&run, run.model->rest);
	run_close(&run);
	print_message("%d sites, error %.3g m, %.4f m drawn, sites %.3f times as far apart, thread %.3f times as long\n",
				  story.sites, story.error, story.drawn, story.gather, story.stretch);
	return story;
}

#endif
