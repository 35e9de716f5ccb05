/// @file beam.h
/// The beam of scenes/beam.yaml, run through the library to the instants of test/reference/beam.csv.
#ifndef JN_TEST_SCENE_BEAM_H
#define JN_TEST_SCENE_BEAM_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/support.h"

static const char beam_scene[] = JN_SOURCE_DIR "/scenes/beam.yaml";
static const char beam_table[] = JN_SOURCE_DIR "/test/reference/beam.csv";

typedef struct Beam {
	JnScene* scene;
	JnSim* sim;
	int mid;
} Beam;

/// What a state of the beam comes to.
typedef struct BeamFacts {
	double t, kinetic, elastic, gravity; ///< [s], [J]
	double total;                        ///< [J/kg]
	double displacement;                 ///< y of the middle [m]
} BeamFacts;

/// Factors, whose directions land far below the tolerance. `tolerance`: of Newton's method; NULL: the scene's.
static inline void beam_open(Beam* beam, const char* method, const char* law, double dt, const char* tolerance) {
	char words[4][96];
	const char* sets[5] = {"solver.method=direct", words[0], words[1], words[2], words[3]};
	snprintf(words[0], sizeof words[0], "integrator.method=%s", method);
	snprintf(words[1], sizeof words[1], "bodies[0].material.law=%s", law);
	snprintf(words[2], sizeof words[2], "step.dt=%.17g", dt);
	snprintf(words[3], sizeof words[3], "newton.tolerance=%s", tolerance != NULL ? tolerance : "");
	assert_int_equal(jn_scene_load(beam_scene, tolerance != NULL ? 5 : 4, sets, &beam->scene), JN_OK);
	assert_int_equal(jn_scene_build(beam->scene, 1, &beam->sim), JN_OK);
	beam->mid = jn_model_nearest(jn_sim_model(beam->sim), (const double[3]){0.125, 0.125, 1.0});
}

static inline void beam_close(Beam* beam) {
	jn_sim_destroy(beam->sim);
	jn_scene_destroy(beam->scene);
}

static inline BeamFacts beam_after(Beam* beam, int steps) {
	while (jn_sim_steps(beam->sim) < steps) assert_int_equal(jn_sim_step(beam->sim), JN_OK);
	JnModel* model = jn_sim_model(beam->sim);
	const JnState* state = jn_sim_state(beam->sim);
	const JnEnergies e = jn_model_energies(model, state);
	return (BeamFacts){
		.t = state->t,
		.kinetic = e.kinetic,
		.elastic = e.elastic,
		.gravity = e.gravity,
		.total = (e.kinetic + e.elastic + e.gravity) / jn_model_mass(model),
		.displacement = state->x[3 * beam->mid + 1] - jn_model_rest(model)[3 * beam->mid + 1],
	};
}

/// Print value, expected and tolerance, and return whether they agree.
static inline bool agrees(const char* what, double value, double expected, double tolerance) {
	if (fabs(value - expected) <= tolerance) return true;
	print_error("%s: %.15g, expected %.15g, difference %.2e, tolerance %.2e\n", what, value, expected, value - expected,
				tolerance);
	return false;
}

/// Compare with row `row` of the reference.
///
/// Both sides solve their stages to a residual of 1e-12 of the weight and round differently; a step leaves about that
/// much in the energies, relative to their size, and later steps amplify it. Allowed are 1e-11 of the gravity energy,
/// times `growth`: the steps taken, or more over long times.
static inline bool beam_agrees(const Table* table, int row, const BeamFacts* facts, double growth) {
	char label[128];
	const double scale = fabs(table_number(table, row, "gravity"));
	const double joule = 1e-11 * scale * growth;
	snprintf(label, sizeof label, "line %d", row + 1);
	bool fine = agrees(label, facts->t, table_number(table, row, "t"), 1e-12);
	fine &= agrees("total [J/kg]", facts->total, table_number(table, row, "total_specific"), joule / 125);
	fine &= agrees("kinetic [J]", facts->kinetic, table_number(table, row, "kinetic"), joule);
	fine &= agrees("elastic [J]", facts->elastic, table_number(table, row, "elastic"), joule);
	fine &= agrees("gravity [J]", facts->gravity, table_number(table, row, "gravity"), joule);
	fine &= agrees("displacement [m]", facts->displacement, table_number(table, row, "mid_y_displacement"),
				   1e-11 * growth * fabs(table_number(table, row, "mid_y_displacement")));
	return fine;
}

#endif
