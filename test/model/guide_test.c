// Needles along curves: tables against the curves that they are of, derivatives, distances along the curve, frames.
#include "math/vec3.h"
#include "mesh/thread.h"
#include "model/guide.h"
#include "model/hold.h"
#include "model/system.h"
#include "pass/pass_case.h"

static const double pi = 3.14159265358979323846;
enum { LINKS = 30, NEEDLE = 10 };

static const char* const curves[] = {
	"{type: helix, radius: 5 cm, pitch: 10 cm, turns: 2, axis: z}",
	"{type: torus_knot, ring: 8 cm, tube: 3 cm}",
	"{type: spline, points: [{at: [0, 0, 0]}, {at: [0.1, 0, 0]}, {at: [0.1, 0.1, 0.05]}, {at: [0.2, 0.2, 0]}]}",
	"{type: overhand, size: 10 cm, tail: 10 cm}",
};
enum { CURVES = sizeof curves / sizeof *curves };

static void open_needle(Run* run, const char* curve, const char* head, const char* more) {
	run_open(
		run, 1,
		"duration: 2 s\nintegrator: {method: symplectic_euler}\nstep: {dt: 0.05 ms}\nbodies:\n"
		"  - shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [-0.3, 0, 0]}], radius: 2 mm, links: 30, needle: "
		"10%s}\n"
		"    material: {law: constraints, density: 1000 kg/m^3, stiffness: 50 kPa}\n    mass: lumped\n"
		"    drive: [{where: {set: needle}, along: {curve: %s, head: %s}}]\n",
		more, curve, head);
}

static const JnGuide* guide_of(const Run* run) {
	assert_int_equal(run->model->guide_count, 1);
	return &run->model->guides[0];
}

// Central differences with h = 1e-5: where cubics meet, within h of a place, bends have a kink of some 1e3/m^3 * h.
static void a_track_has_the_slopes_and_bends_of_its_values(void** state) {
	(void)state;
	for (int c = 0; c < CURVES; ++c) {
		Run run;
		open_needle(&run, curves[c], "{type: sine, amplitude: 0.1, frequency: 1}", "");
		const JnTrack* track = &guide_of(&run)->track;
		const double h = 1e-5;
		double worst[2] = {0};
		for (double s = -0.0301; s < track->length + 0.03; s += 0.0023) {
			JnTrackPoint before, now, after;
			jn_track_at(track, s - h, &before);
			jn_track_at(track, s, &now);
			jn_track_at(track, s + h, &after);
			for (int k = 0; k < JN_TRACK_REALS; ++k) {
				const double scale = k < 3 ? 1 : 20; // directions turn by 1/(5 cm)
				worst[0] = fmax(worst[0], fabs((after.value[k] - before.value[k]) / (2 * h) - now.slope[k]) / scale);
				worst[1] =
					fmax(worst[1], fabs((after.slope[k] - before.slope[k]) / (2 * h) - now.bend[k]) / (20 * scale));
			}
		}
		expect_at_most(worst[0], 1e-5, "%s: slopes", curves[c]);
		expect_at_most(worst[1], 1e-3, "%s: bends, kinked where cubics meet", curves[c]);
		run_close(&run);
	}
}

static void a_track_lies_on_its_curve_with_frames_of_length_one(void** state) {
	(void)state;
	Run run;
	open_needle(&run, curves[0], "{type: sine, amplitude: 0.1, frequency: 1}", "");
	const JnTrack* track = &guide_of(&run)->track;
	double off = 0, skew = 0;
	for (double s = 0; s < track->length; s += 0.00137) {
		JnTrackPoint at;
		jn_track_at(track, s, &at);
		const double angle = 4 * pi * s / track->length;
		const double X[3] = {0.05 * cos(angle), 0.05 * sin(angle), 0.1 * angle / (2 * pi)};
		off = fmax(off, vec3_distance(at.value, X));
		skew = fmax(skew, fabs(vec3_dot(at.value + 3, at.value + 6)) + fabs(vec3_length(at.value + 3) - 1));
		skew = fmax(skew, fabs(vec3_dot(at.value + 3, at.slope)) + fabs(vec3_length(at.slope) - 1));
	}
	expect_at_most(off, 1e-10, "distance from the helix"); // (13 mrad)^4 5/384 of 5 cm
	expect_at_most(skew, 1e-5, "frames");                  // slopes of cubics: third order
	run_close(&run);
}

static void velocities_and_accelerations_are_derivatives(void** state) {
	(void)state;
	static const char* const heads[] = {"{type: sine, amplitude: 0.2, frequency: 0.7, phase: 0.4}",
										"{type: keyframes, points: [[0, 0], [1, 0.5]]}"};
	for (int c = 0; c < CURVES; ++c) {
		Run run;
		open_needle(&run, curves[c], heads[c % 2], "");
		JnHold* hold = &((JnModelSystem*)jn_model_system(run.model))->hold;
		const double h = 1e-5;
		const int count = run.model->held_count;
		JnMotionValue* kept = calloc(3 * (size_t)count, sizeof *kept);
		double worst[2] = {0};
		for (double t = 0.0171; t < 1; t += 0.0713) {
			for (int i = 0; i < 3; ++i) {
				const JnMotionValue* values = jn_hold_at(run.model, hold, t + (i - 1) * h);
				memcpy(kept + i * count, values, (size_t)count * sizeof *kept);
			}
			for (int k = 0; k < count; ++k) {
				const JnMotionValue *a = kept + k, *b = a + count, *d = b + count;
				worst[0] = fmax(worst[0], fabs((d->x - a->x) / (2 * h) - b->v));
				worst[1] = fmax(worst[1], fabs((d->v - a->v) / (2 * h) - b->a));
			}
		}
		expect_at_most(worst[0], 1e-6, "%s: velocity (about 1 m/s)", curves[c]);
		expect_at_most(worst[1], 1e-3, "%s: acceleration (about 50 m/s^2), kinked where cubics meet", curves[c]);
		free(kept);
		run_close(&run);
	}
}

static void axis_at(const Run* run, const double* x, int frame, double X[3]) {
	const JnThread* thread = run->model->bodies[0].mesh.thread;
	for (int a = 0; a < 3; ++a) {
		X[a] = 0;
		for (int i = 0; i < 3; ++i) X[a] += thread->axis[i] * x[9 * frame + 3 * i + a];
	}
}

// After a second of a smooth way to 0.5 m, frame k is 1 cm k behind the head on the helix.
static void frames_keep_their_distance_behind_the_head(void** state) {
	(void)state;
	Run run;
	open_needle(&run, curves[0], "{type: keyframes, points: [[0, 0], [1, 0.5]]}", "");
	const double length = 4 * pi * hypot(0.05, 0.1 / (2 * pi));
	JnState s = *run_state(&run);
	s.t = 1;
	JnSystem* sys = jn_model_system(run.model);
	sys->ops->prescribe(sys, &s, NULL);
	for (int k = 0; k <= NEEDLE; ++k) {
		double X[3];
		axis_at(&run, s.x, k, X);
		const double angle = 4 * pi * (0.5 - 0.01 * k) / length;
		const double expected[3] = {0.05 * cos(angle), 0.05 * sin(angle), 0.1 * angle / (2 * pi)};
		expect_near(vec3_distance(X, expected), 0, 1e-9, "frame %d",
					k); // of the arc length, 4th order in 64 samples a quarter
	}
	run_close(&run);
}

static void edge_of(const double* x, int frame, double out[3]) {
	for (int a = 0; a < 3; ++a) out[a] = x[9 * frame + 3 + a] - x[9 * frame + a];
	vec3_normalize(out);
}

// Where the thread lies on its curve at rest, nothing jumps when it begins; twisted at rest, it stays so.
static void a_needle_that_lies_on_its_curve_begins_at_rest(void** state) {
	(void)state;
	for (int twisted = 0; twisted < 2; ++twisted) {
		Run run;
		open_needle(&run, "{type: polyline, points: [{at: [-1, 0, 0]}, {at: [1, 0, 0]}]}",
					"{type: keyframes, points: [[0, 1 m], [1, 1.5 m]]}", twisted ? ", twist: 2" : "");
		const double* rest = jn_model_rest(run.model);
		double jump = 0, way = 0;
		for (int k = 0; k < run.length; ++k) jump = fmax(jump, fabs(run_state(&run)->x[k] - rest[k]));
		JnState s = *run_state(&run);
		s.t = 1;
		JnSystem* sys = jn_model_system(run.model);
		sys->ops->prescribe(sys, &s, NULL);
		for (int k = 0; k < 9 * (NEEDLE + 1); ++k) way = fmax(way, fabs(s.x[k] - rest[k] - (k % 3 == 0 ? 0.5 : 0)));
		expect_at_most(jump, 1e-12, "jump at the start");
		expect_at_most(way, 1e-12, "difference from a way of 0.5 m");
		run_close(&run);
	}
}

// Along a helix: the frames turn against Frenet's by the torsion.
static void frames_of_a_needle_do_not_twist(void** state) {
	(void)state;
	Run run;
	open_needle(&run, curves[0], "{type: keyframes, points: [[0, 0], [1, 0.5]]}", "");
	const double rise = 0.1 / (2 * pi), torsion = rise / (0.0025 + rise * rise);
	JnState s = *run_state(&run);
	JnSystem* sys = jn_model_system(run.model);
	double first = 0;
	s.t = 1;
	sys->ops->prescribe(sys, &s, NULL);
	for (int k = 0; k <= NEEDLE; ++k) {
		double X[3], edge[3], along[3], binormal[3];
		axis_at(&run, s.x, k, X);
		edge_of(s.x, k, edge);
		const double normal[3] = {-X[0] / 0.05, -X[1] / 0.05, 0};
		memcpy(along, (double[3]){-X[1], X[0], rise}, sizeof along);
		vec3_normalize(along);
		vec3_cross(along, normal, binormal);
		const double angle = atan2(vec3_dot(edge, binormal), vec3_dot(edge, normal)) - torsion * 0.01 * k;
		if (k == 0) first = angle;
		expect_near(remainder(angle - first, 2 * pi), 0, 1e-7, "angle of frame %d", k);
	}
	run_close(&run);
}

static void the_other_end_may_lead(void** state) {
	(void)state;
	Run run;
	run_open(&run, 1,
			 "duration: 2 s\nintegrator: {method: symplectic_euler}\nstep: {dt: 0.05 ms}\nbodies:\n"
			 "  - shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [0.3, 0, 0]}], radius: 2 mm, links: 30}\n"
			 "    material: {law: constraints, density: 1000 kg/m^3, stiffness: 50 kPa}\n    mass: lumped\n"
			 "    drive: [{where: {set: end}, along: {leads: end, curve: {type: polyline, points: [{at: [0, 0, 0]}, "
			 "{at: [1, "
			 "0, 0]}]}, head: {type: keyframes, points: [[0, 0.3], [1, 0.4]]}}}]\n");
	const double* rest = jn_model_rest(run.model);
	for (int k = 0; k < run.length; ++k) assert_true(fabs(run_state(&run)->x[k] - rest[k]) < 1e-12);
	run_close(&run);
}

// Positions at 20 ms, in steps of dt.
static void run_needle(const char* method, double dt, double* x) {
	Run run;
	run_open(&run, 1,
			 "duration: 20 ms\nintegrator: {method: %s}\nstep: {dt: %.17g}\nbodies:\n"
			 "  - shape: {type: thread, points: [{at: [0, 0, 0]}, {at: [-0.3, 0, 0]}], radius: 2 mm, links: 30, "
			 "needle: 10}\n"
			 "    material: {law: constraints, density: 1000 kg/m^3, stiffness: 20 kPa}\n    mass: lumped\n"
			 "    drive: [{where: {set: needle}, along: {curve: {type: helix, radius: 5 cm, pitch: 10 cm, turns: 2}, "
			 "head: {type: "
			 "sine, amplitude: 2 cm, frequency: 10}}}]\n",
			 method, dt);
	while (!jn_sim_is_done(run.sim)) run_step(&run);
	assert_int_equal(run.length, 9 * (LINKS + 1));
	memcpy(x, run_state(&run)->x, (size_t)run.length * sizeof *x);
	run_close(&run);
}

static double difference_of(const double* a, const double* b) {
	double sum = 0;
	for (int k = 0; k < 9 * (LINKS + 1); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
	return sqrt(sum);
}

// Their stages ask for the needle at times within the step.
static void methods_keep_their_order_behind_a_needle(void** state) {
	(void)state;
	static const struct {
		const char* method;
		int order;
	} cases[] = {{"verlet", 2}, {"rk4", 4}, {"pefrl", 4}};
	const double dt = 2e-2 / 256;
	double reference[9 * (LINKS + 1)], coarse[9 * (LINKS + 1)], fine[9 * (LINKS + 1)];
	run_needle("rk4", dt / 16, reference);
	for (int m = 0; m < 3; ++m) {
		run_needle(cases[m].method, dt, coarse);
		run_needle(cases[m].method, dt / 2, fine);
		const double first = difference_of(coarse, reference), second = difference_of(fine, reference);
		const double order = log2(first / second);
		print_message("%s: errors %g and %g m, order %.2f\n", cases[m].method, first, second, order);
		expect_at_most(cases[m].order - 0.2, order, "%s: order",
					   cases[m].method); // higher terms, at a step not yet small
	}
}

static void expect_refusal(const char* drive, const char* shape, const char* part) {
	Run run;
	log_capture();
	const JnStatus status =
		run_attempt(&run,
					"duration: 1 s\nintegrator: {method: backward_euler}\nstep: {dt: 1 ms}\nbodies:\n"
					"  - shape: %s\n    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n"
					"    drive: [%s]\n",
					shape, drive);
	if (status != JN_BAD_INPUT || strstr(log_text(), part) == NULL)
		fail_msg("%s: expected '%s', got '%s'", drive, part, log_text());
	log_release();
	run_close(&run);
}

static void what_cannot_follow_a_curve_is_refused(void** state) {
	(void)state;
	static const char box[] = "{type: box, size: [1, 1, 1], cells: [1, 1, 2]}";
	static const char thread[] = "{type: thread, radius: 1 cm, links: 5, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}]}";
	static const char along[] =
		"along: {curve: {type: circle, radius: 1}, head: {type: sine, amplitude: 1, frequency: 1}}";
	char drive[512];
	snprintf(drive, sizeof drive, "{where: {face: z-}, %s}", along);
	expect_refusal(drive, box, "bodies[0].drive[0].along: 'body' is no thread");
	snprintf(drive, sizeof drive, "{where: {set: start}, input: hand, %s}", along);
	expect_refusal(drive, thread, "bodies[0].drive[0]: several things move it");
	expect_refusal(
		"{where: {set: start}, along: {curve: {type: circle, radius: 1}, head: {type: keyframes, points: [[1, 0], [0, "
		"1]]}}}",
		thread, "bodies[0].drive[0].along.head.points[1]: its time");
	expect_refusal("{where: {set: start}, along: {curve: {type: spline, points: []}, head: {type: sine, amplitude: 1, "
				   "frequency: 1}}}",
				   thread, "bodies[0].drive[0].along.curve.points: 0 points");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_track_has_the_slopes_and_bends_of_its_values),
		cmocka_unit_test(a_track_lies_on_its_curve_with_frames_of_length_one),
		cmocka_unit_test(velocities_and_accelerations_are_derivatives),
		cmocka_unit_test(frames_keep_their_distance_behind_the_head),
		cmocka_unit_test(a_needle_that_lies_on_its_curve_begins_at_rest),
		cmocka_unit_test(frames_of_a_needle_do_not_twist),
		cmocka_unit_test(the_other_end_may_lead),
		cmocka_unit_test(methods_keep_their_order_behind_a_needle),
		cmocka_unit_test(what_cannot_follow_a_curve_is_refused),
	};
	return cmocka_run_group_tests(tests, case_set_up, case_tear_down);
}
