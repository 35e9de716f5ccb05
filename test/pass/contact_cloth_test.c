/// @file contact_cloth_test.c
/// Cloth in a scene: what it touches and how far away, friction, wind on either side, driven edges, and what is refused.
#include "model/system.h"
#include "pass/pass_case.h"

/// A sheet of 0.4 m x 0.4 m, h = 0.05 m, of 0.2 kg/m^2, in the plane of x and z; `more` goes on with its keys, `rest` with
/// those of the scene.
#define CLOTH(origin, more, rest)                                                                                      \
	"duration: 10 s\nintegrator: backward_euler\nstep: {dt: 5 ms}\n"                                                   \
	"bodies:\n"                                                                                                        \
	"  - name: cloth\n"                                                                                                \
	"    shape: {type: cloth, plane: xz, origin: " origin ", size: [0.4, 0.4], cells: [8, 8]}\n"                       \
	"    material: {law: membrane, density: 0.2, stretch: [500, 500], shear: 50, bend: [1e-3, 1e-3], "                 \
	"stretch_damping: 5 ms, bend_damping: 20 ms}\n" more rest

static double least_height(const Run* run, const double centre[3], double radius) {
	const double* x = jn_sim_state(run->sim)->x;
	double least = INFINITY;
	for (int k = 0; k < run->length; k += 3) {
		const double d[3] = {x[k] - centre[0], x[k + 1] - centre[1], x[k + 2] - centre[2]};
		least = fmin(least, radius > 0 ? sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - radius : d[1]);
	}
	return least;
}

// The default offset is a twentieth of the mean edge: those of the two triangles of a square, h (2 + sqrt 2) / 3.
static void cloth_comes_to_rest_at_its_offset_from_a_floor(void** state) {
	(void)state;
	static const char* const keys[] = {"", "    contact: {offset: 4 mm}\n"};
	const double expected[] = {0.05 * 0.05 * (2 + sqrt(2.0)) / 3, 4e-3};
	const double floor[3] = {0, 0, 0};
	for (int i = 0; i < 2; ++i) {
		Run run;
		run_open(&run, 1,
				 CLOTH("[0, 0.03, 0]", "%s", "obstacles: [{name: floor, shape: {type: plane}}]\ncontact: {}\n"),
				 keys[i]);
		run_until(&run, 0.4);
		expect_near(least_height(&run, floor, 0), expected[i], 1e-7, "height"); // contact's tolerance
		run_close(&run);
	}
}

static void cloth_lies_on_a_ball_and_does_not_pass_through(void** state) {
	(void)state;
	const double centre[3] = {0.2, 0, 0.2};
	Run run;
	run_open(&run, 1,
			 CLOTH("[0, 0.12, 0]", "",
				   "obstacles: [{name: ball, shape: {type: sphere, center: [0.2, 0, 0.2], radius: 10 cm}}]\n"
				   "contact: {friction: 0.5}\n"));
	double least = INFINITY;
	for (int i = 1; i <= 20; ++i) {
		run_until(&run, 0.02 * i);
		least = fmin(least, least_height(&run, centre, 0.1));
	}
	const double offset = 0.05 * 0.05 * (2 + sqrt(2.0)) / 3;
	// the plane of a moment stands for the ball over a step: 1 m/s and 5 ms give (v dt)^2 / 2R
	expect_near(least, offset, 1.3e-4, "least distance [m]");
	run_close(&run);
}

// A slope of 45 degrees: mu = 0.5 slides with g (sin - mu cos), mu = 1.5 stays.
static void friction_holds_cloth_on_a_slope_or_lets_it_slide(void** state) {
	(void)state;
	static const double mu[] = {0.5, 1.5};
	for (int i = 0; i < 2; ++i) {
		Run run;
		run_open(&run, 1,
				 CLOTH("[0, 0, 0]", "    contact: {offset: 0 m}\n",
					   "gravity: [6.936717523440031, -6.936717523440031, 0]\n"
					   "obstacles: [{name: floor, shape: {type: plane}}]\ncontact: {friction: %g}\n"),
				 mu[i]);
		run_until(&run, 0.2);
		const JnState* s = jn_sim_state(run.sim);
		double mean = 0;
		for (int k = 0; k < run.length; k += 3) mean += s->x[k] - jn_model_rest(run.model)[k];
		mean /= run.length / 3.0;
		const double a = mu[i] < 1 ? 9.81 * sqrt(0.5) * (1 - mu[i]) : 0;
		// backward Euler starts half a step late: v dt / 2; the cloth itself is nearly rigid
		expect_near(mean, 0.5 * a * 0.04, 0.5 * a * 0.2 * 5e-3 + 1e-5, "path with mu = %g", mu[i]);
		run_close(&run);
	}
}

// Air that comes from above or from below presses with the same force: a triangle of cloth has two sides.
static void wind_presses_on_either_side_alike(void** state) {
	(void)state;
	for (int side = -1; side <= 1; side += 2) {
		Run run;
		run_open(&run, 1, CLOTH("[0, 0, 0]", "    drag: 1.2\n", "gravity: [0, 0, 0]\nwind: {velocity: [0, %d, 0]}\n"),
				 5 * side);
		JnSystem* sys = jn_model_system(run.model);
		double sum = 0, *f = sys->space->ops->create(sys->space);
		JnReport report = {0};
		sys->report = &report;
		assert_int_equal(sys->ops->force(sys, jn_sim_state(run.sim), f), JN_OK);
		for (int k = 1; k < run.length; k += 3) sum += f[k];
		expect_near(sum, side * 0.5 * 1.225 * 1.2 * 0.16 * 25, 1e-12, "force [N]");
		sys->space->ops->destroy(sys->space, f);
		run_close(&run);
	}
}

static void driven_corners_carry_the_cloth(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 CLOTH("[0, 0, 0]",
				   "    fix: [{where: {nearest: [0, 0, 0]}}]\n"
				   "    drive: [{where: {nearest: [0.4, 0, 0]}, y: {type: keyframes, points: [[0, 0], [0.1, 0.1]]}}]\n",
				   ""));
	run_until(&run, 0.2);
	const int corner = jn_model_nearest(run.model, (const double[]){0.4, 0, 0});
	const double* x = jn_sim_state(run.sim)->x;
	expect_near(x[3 * corner + 1], 0.1, 1e-15, "height of the driven corner [m]");
	assert_true(x[3 * 40 + 1] < -0.01); // the middle has fallen
	run_close(&run);
}

static void expect_refusal(const char* const words[], const char* more, const char* rest) {
	Run run;
	log_capture();
	assert_int_equal(run_attempt(&run, CLOTH("[0, 0, 0]", "%s", "%s"), more, rest), JN_BAD_INPUT);
	run_close(&run);
	print_message("%s", log_text());
	for (int i = 0; words[i] != NULL; ++i)
		if (strstr(log_text(), words[i]) == NULL) fail_msg("no '%s' in: %s", words[i], log_text());
	log_release();
}

#define EXPECT_REFUSAL(more, rest, ...) expect_refusal((const char* const[]){__VA_ARGS__, NULL}, more, rest)

static void contact_of_cloth_with_itself_or_bodies_is_refused(void** state) {
	(void)state;
	EXPECT_REFUSAL("    contact: {self: true}\n", "contact: {}\n", "bodies[0].contact.self", "'cloth'",
				   "leave this key out");
	EXPECT_REFUSAL("",
				   "  - name: ball\n    shape: {type: ball, center: [0.2, 1, 0.2], radius: 0.1}\n"
				   "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\ncontact: {}\n",
				   "bodies[0].contact", "'cloth'", "'ball'", "active: false");
}

static void cloth_without_contact_may_stand_beside_bodies(void** state) {
	(void)state;
	Run run;
	run_open(
		&run, 1,
		CLOTH("[0, 0, 0]", "    contact: {active: false}\n",
			  "  - name: block\n    shape: {type: box, origin: [0, 1, 0], size: [0.1, 0.1, 0.1], cells: [1, 1, 1]}\n"
			  "    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n"
			  "contact: {}\n"));
	run_until(&run, 0.05);
	run_close(&run);
}

/// `material` is that of a sheet.
static void expect_material_refusal(const char* shape, const char* material, const char* const words[]) {
	Run run;
	log_capture();
	assert_int_equal(run_attempt(&run, "duration: 1 s\nbodies:\n  - name: cloth\n    shape: {%s}\n    material: {%s}\n",
								 shape, material),
					 JN_BAD_INPUT);
	run_close(&run);
	print_message("%s", log_text());
	for (int i = 0; words[i] != NULL; ++i)
		if (strstr(log_text(), words[i]) == NULL) fail_msg("no '%s' in: %s", words[i], log_text());
	log_release();
}

#define MATERIAL_REFUSAL(shape, material, ...)                                                                         \
	expect_material_refusal(shape, material, (const char* const[]){__VA_ARGS__, NULL})

static void wrong_materials_are_refused_by_name_and_value(void** state) {
	(void)state;
	static const char sheet[] = "type: cloth, size: [1, 1], cells: [2, 2]";
	MATERIAL_REFUSAL(sheet, "law: membrane, density: 0.2, stretch: [-1, 5], shear: 5, bend: [0, 0]", "stretch", "-1");
	MATERIAL_REFUSAL(sheet, "law: membrane, density: 0, stretch: [5, 5], shear: 5, bend: [0, 0]", "density", "0",
					 "0.15 kg/m^2");
	MATERIAL_REFUSAL(sheet, "law: membrane, density: 0.2, stretch: [5, 5], shear: -5, bend: [0, 0]", "shear", "-5");
	MATERIAL_REFUSAL(sheet, "law: mass_spring, density: 0.2, stretch: [5, 5], shear: 5, bend: [0, -3]", "bend", "-3");
	MATERIAL_REFUSAL(sheet, "law: membrane, density: 200 kg/m^3, stretch: [5, 5], shear: 5, bend: [0, 0]", "density",
					 "kg/m^2");
	MATERIAL_REFUSAL(sheet, "law: linear, density: 1000, young: 1e5, poisson: 0.3", "material.law", "'linear'", "tri3");
	MATERIAL_REFUSAL("type: box, size: [1, 1, 1], cells: [1, 1, 1]",
					 "law: membrane, density: 0.2, stretch: [5, 5], shear: 5, bend: [0, 0]", "'membrane'", "hex8",
					 "type: cloth");
}

// Two triangles of an OBJ file, folded at rest: no force there, and masses of half the sides' product.
static void cloth_comes_from_a_surface_file_too(void** state) {
	(void)state;
	char path[512];
	Run run;
	snprintf(path, sizeof path, "%s/fold.obj", case_folder);
	file_write(path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n");
	run_open(
		&run, 1,
		"duration: 1 s\nintegrator: backward_euler\nstep: {dt: 5 ms}\ngravity: [0, 0, 0]\nbodies:\n  - name: fold\n"
		"    shape: {type: file, path: fold.obj, triangles: true}\n"
		"    material: {law: membrane, density: 0.2, stretch: [500, 500], shear: 50, bend: [1e-3, 1e-3]}\n");
	const double second = 0.5 * sqrt(1 * 1 + 0.25 + 0.25); // |(1, 1, 0) x (0, 1, 0.5)| / 2
	expect_near(jn_model_mass(run.model), 0.2 * (0.5 + second), 1e-15, "mass [kg]");
	run_until(&run, 0.05);
	const JnEnergies e = jn_model_energies(run.model, run_state(&run));
	expect_near(e.kinetic + e.elastic, 0, 1e-20, "energy [J]");
	run_close(&run);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(cloth_comes_to_rest_at_its_offset_from_a_floor),
		cmocka_unit_test(cloth_lies_on_a_ball_and_does_not_pass_through),
		cmocka_unit_test(friction_holds_cloth_on_a_slope_or_lets_it_slide),
		cmocka_unit_test(wind_presses_on_either_side_alike),
		cmocka_unit_test(driven_corners_carry_the_cloth),
		cmocka_unit_test(contact_of_cloth_with_itself_or_bodies_is_refused),
		cmocka_unit_test(cloth_without_contact_may_stand_beside_bodies),
		cmocka_unit_test(wrong_materials_are_refused_by_name_and_value),
		cmocka_unit_test(cloth_comes_from_a_surface_file_too),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
