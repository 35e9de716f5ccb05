/// @file invariance_test.c
/// What a scene does does not depend on how it is looked at: turned, mirrored, shifted, in other units, with its nodes
/// and cells in another order. Over all laws and elements, and all scenes of scenes/ whose motion is smooth: with
/// contact, collisions, fracture and piercing a difference of the last bit may decide whether something happens.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "force/kernel.h"
#include "support/coarse_scene.h"
#include "support/golden.h"
#include "support/moved.h"
#include "support/support.h"

enum { STEPS = 50 };

// What rounding in the last of 53 bits becomes: positions are of order 1 m, or 10 m where shifted, 1e-15 of the size after a
// step; 50 steps of swinging bodies, some with elements that buckle, make 1e-10 of it at most, which was seen.
static const double TOLERANCE = 1e-9;

#define UNTURNED                                                                                                       \
	{                                                                                                                  \
		{1, 0, 0}, {0, 1, 0}, {                                                                                        \
			0, 0, 1                                                                                                    \
		}                                                                                                              \
	}

static const Move as_it_is = {.name = "as it is", .turn = UNTURNED, .length = 1, .mass = 1};

static const Move moves[] = {
	// (2, 3, 6)/7, (6, 2, -3)/7, (-3, 6, -2)/7: a rotation by numbers that are not exact
	{.name = "turned",
	 .turn = {{2 / 7.0, 3 / 7.0, 6 / 7.0}, {6 / 7.0, 2 / 7.0, -3 / 7.0}, {-3 / 7.0, 6 / 7.0, -2 / 7.0}},
	 .length = 1,
	 .mass = 1},
	{.name = "shifted", .turn = UNTURNED, .shift = {3, -4, 7}, .length = 1, .mass = 1},
	// I - 2 n n' with n = (2, 3, 6)/7
	{.name = "mirrored",
	 .turn = {{41 / 49.0, -12 / 49.0, -24 / 49.0},
			  {-12 / 49.0, 31 / 49.0, -36 / 49.0},
			  {-24 / 49.0, -36 / 49.0, -23 / 49.0}},
	 .mirrors = true,
	 .length = 1,
	 .mass = 1},
	{.name = "in millimetres and grams", .turn = UNTURNED, .length = 1000, .mass = 1000},
	{.name = "in units a power of two smaller", .turn = UNTURNED, .length = 1024, .mass = 4096},
	{.name = "in a larger unit", .turn = UNTURNED, .length = 1.0 / 32, .mass = 1.0 / 16},
	{.name = "with nodes and cells in another order", .turn = UNTURNED, .length = 1, .mass = 1, .shuffle = 7},
	{.name = "with another first node in each cell", .turn = UNTURNED, .length = 1, .mass = 1, .renumbers = true},
};

static bool is_power_of_two(double number) {
	int power;
	return frexp(number, &power) == 0.5;
}

// Units that only change exponents, and nothing else: the same bits. The mass goes into square roots, of Cholesky.
static bool is_exact(const Move* move) {
	return move->length != 1 && is_power_of_two(move->length) && is_power_of_two(sqrt(move->mass));
}

typedef struct Course {
	Moved moved;
	int nodes;
	double *x, *v;
} Course;

static void end_course(Course* course) {
	free(course->moved.order);
	free(course->x);
	free(course->v);
}

static double* copy_of(const double* vector, int nodes) {
	const size_t bytes = 3 * (size_t)nodes * sizeof *vector;
	double* copy = malloc(bytes);
	assert_non_null(copy);
	return memcpy(copy, vector, bytes);
}

// Random motion and gusts are drawn node by node and wave by wave.
static void calm(JnSceneDef* def) {
	for (int b = 0; b < def->sim.model.bodies.count; ++b)
		((JnBodyDef*)def->sim.model.bodies.data)[b].scatter.amplitude = 0;
	if (def->sim.model.wind != NULL) def->sim.model.wind->gusts = NULL;
}

static bool is_smooth(const JnSceneDef* def, const char** why) {
	const JnSimDef* sim = &def->sim;
	*why = sim->system.row != NULL               ? "it has no mesh"
		   : strcmp(def->name, "armadillo") == 0 ? "its start is random, and nothing else moves it"
		   : sim->contact != NULL                ? "contact"
		   : sim->collision != NULL              ? "collisions"
		   : sim->model.repulsion != NULL        ? "repulsion"
		   : strstr(def->name, "notch") != NULL  ? "fracture"
												 : NULL;
	return *why == NULL;
}

// False, with the reason, when the scene cannot be moved so.
static bool run(const char* path, const Sets* sets, const Move* move, Course* out, const char** why) {
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	JnArena arena = {0};
	*out = (Course){0};
	log_capture();
	if (jn_scene_load(path, sets->count, sets->list, &scene) != JN_OK) fail_msg("%s: %s", path, log_text());
	JnSceneDef* def = (JnSceneDef*)jn_scene_def(scene); // the test's own
	const bool is_run = is_smooth(def, why) && can_move(def, move, why);
	if (is_run) {
		calm(def);
		move_scene(def, move, &arena, &out->moved);
		if (jn_scene_build(scene, 1, &sim) != JN_OK) fail_msg("%s %s: %s", path, move->name, log_text());
		for (int step = 0; step < STEPS; ++step)
			if (jn_sim_step(sim) != JN_OK) fail_msg("%s %s, step %d: %s", path, move->name, step, log_text());
		out->nodes = out->moved.nodes;
		out->x = copy_of(jn_sim_state(sim)->x, out->nodes);
		out->v = copy_of(jn_sim_state(sim)->v, out->nodes);
	}
	log_release();
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	jn_arena_free(&arena);
	return is_run;
}

static double size_of(const double* points, int nodes) {
	double low[3], high[3], most = 0;
	memcpy(low, points, sizeof low);
	memcpy(high, points, sizeof high);
	for (int k = 0; k < 3 * nodes; ++k) {
		low[k % 3] = fmin(low[k % 3], points[k]);
		high[k % 3] = fmax(high[k % 3], points[k]);
	}
	for (int a = 0; a < 3; ++a) most = fmax(most, high[a] - low[a]);
	return most;
}

// The largest difference of copy and moved original, relative to the extent of the original.
static double difference(const Course* original, const Course* copy, const Move* move, const double* a, const double* b,
						 double size) {
	double most = 0;
	for (int node = 0; node < original->nodes; ++node) {
		double expected[3];
		move_point(move, a + 3 * node, expected);
		for (int axis = 0; axis < 3; ++axis) {
			const double apart = fabs(b[3 * copy->moved.order[node] + axis] - expected[axis]);
			if (!(apart <= most)) most = apart;
		}
	}
	return most / (move->length * size);
}

/// What is stiff for the steps it is given: positions are rounded to 1e-16 of the distance from the origin (1e-15 m where the
/// scene is shifted), and the force of a strain from that stands against small ones.
static const struct {
	const char* scene;
	double tolerance;
} stiff[] = {
	{"spinning_bar.yaml", 1e-7},  // 10 GPa; 8e-9 was seen
	{"suture_thread.yaml", 5e-6}, // links of 1 mm, 750 MPa, each of 1e-5 N of weight; 5e-7 was seen
};

static double tolerance_of(const char* name, const Move* move) {
	if (is_exact(move)) return 0;
	for (size_t i = 0; i < sizeof stiff / sizeof *stiff; ++i)
		if (strcmp(stiff[i].scene, name) == 0) return stiff[i].tolerance;
	return TOLERANCE;
}

static void compare(const char* name, const Course* original, const Course* copy, const Move* move) {
	Move unshifted = *move;
	memset(unshifted.shift, 0, sizeof unshifted.shift);
	const double size = size_of(original->x, original->nodes);
	double fastest = 0;
	for (int k = 0; k < 3 * original->nodes; ++k) fastest = fmax(fastest, fabs(original->v[k]));
	const double x = difference(original, copy, move, original->x, copy->x, size);
	if (fastest == 0) fail_msg("%s does not move", name);
	const double v = difference(original, copy, &unshifted, original->v, copy->v, fastest);
	const double tolerance = tolerance_of(name, move);
	if (getenv("JN_TEST_VERBOSE") != NULL) print_message("%-28s %-40s x %.1e v %.1e\n", name, move->name, x, v);
	if (!(x <= tolerance && v <= tolerance))
		fail_msg("%s %s: positions differ by %.3g, velocities by %.3g, tolerance %.3g", name, move->name, x, v,
				 tolerance);
}

static void check(const char* name, const char* path, const Sets* sets) {
	const char* why;
	Course original;
	if (!run(path, sets, &as_it_is, &original, &why)) {
		print_message("%s: left out, %s\n", name, why);
		return;
	}
	for (size_t i = 0; i < sizeof moves / sizeof *moves; ++i) {
		Course copy;
		if (run(path, sets, &moves[i], &copy, &why))
			compare(name, &original, &copy, &moves[i]);
		else
			print_message("%s: not %s, %s\n", name, moves[i].name, why);
		end_course(&copy);
	}
	end_course(&original);
}

/// The scene in which a law is looked at; without an entry: the bar, with each element.
static const struct {
	const char *law, *scene, *material;
} beds[] = {
	{"membrane", "cloth", NULL},
	{"mass_spring", "cloth",
	 "{law: mass_spring, density: 0.2, stretch: [500, 400], shear: 100, bend: [0.5, 0.4], stretch_damping: 5 ms}"},
	{"constraints", "thread", NULL},
	{"rod", "thread", "{law: rod, density: 1000 kg/m^3, young: 500 kPa, damping: 0.05 ms}"},
	{"peridynamic", "points", NULL},
};

static void prepare(Sets* sets) {
	add_set(sets, "newton.tolerance=1e-12"); // far below the differences that are looked for
	add_set(sets, "solver={method: direct}");
}

static void check_solid(const char* law) {
	static const char* const elements[] = {"tet4", "tet10", "hex8"};
	for (int element = 0; element < 3; ++element) {
		Sets sets = {.count = 0};
		char name[64];
		add_set(&sets, "bodies[0].material.law=%s", law);
		add_set(&sets, "bodies[0].shape.element=%s", elements[element]);
		prepare(&sets);
		snprintf(name, sizeof name, "%s, %s", law, elements[element]);
		check(name, JN_SOURCE_DIR "/test/reference/scenes/solid.yaml", &sets);
	}
}

static void check_law(const char* law) {
	for (size_t i = 0; i < sizeof beds / sizeof *beds; ++i) {
		if (strcmp(beds[i].law, law) != 0) continue;
		Sets sets = {.count = 0};
		char path[256];
		if (beds[i].material != NULL) add_set(&sets, "bodies[0].material=%s", beds[i].material);
		prepare(&sets);
		snprintf(path, sizeof path, JN_SOURCE_DIR "/test/reference/scenes/%s.yaml", beds[i].scene);
		check(law, path, &sets);
		return;
	}
	check_solid(law);
}

static void all_laws_and_elements_move_alike_however_they_are_looked_at(void** state) {
	(void)state;
	for (int i = 0; i < jn_law_list.count; ++i) {
		const char* law = jn_law_list.rows[i]->name;
		if (strcmp(law, "rigid") != 0) check_law(law); // a ball alone flies on a line
	}
}

static void smooth_scenes_go_alike_however_they_are_looked_at(void** state) {
	(void)state;
	for (char** path = golden_scenes(JN_SOURCE_DIR "/scenes"); *path != NULL; ++path) {
		Plan plan;
		make_plan(*path, &plan);
		prepare(&plan.coarse);
		add_set(&plan.coarse, "step={dt: %.17g s}", plan.dt); // those that adapt it decide by thresholds
		check(strrchr(*path, '/') + 1, *path, &plan.coarse);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(all_laws_and_elements_move_alike_however_they_are_looked_at),
		cmocka_unit_test(smooth_scenes_go_alike_however_they_are_looked_at),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
