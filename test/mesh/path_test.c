// Curves by their arc length: lengths, equal distances, frames against theory, knots against their determinants.
#include "math/vec3.h"
#include "mesh/shape/path.h"
#include "mesh/shape_case.h"
#include "support/knot.h"

static const double pi = 3.14159265358979323846;
enum { MOST = 1200 };

typedef struct PathCase {
	JnPathDef def;
	JnPath path;
	JnArena arena;
	JnStation stations[MOST];
} PathCase;

static PathCase c;

static JnStatus path_try(const char* text) {
	static const JnKey keys[] = {JN_PATH_KEY_ROWS(JnPathDef, , true), {0}};
	JnDocument document;
	c = (PathCase){0};
	JN_TRY(jn_document_parse("test.yaml", text, &c.arena, &document));
	JN_TRY(jn_keys_read(keys, document.root, "", &c.arena, &c.def));
	return jn_path_create(&c.def, "curve", &c.arena, &c.path);
}

static void path_make(const char* text, int count, double twist) {
	if (path_try(text) != JN_OK) fail_msg("%s is refused", text);
	assert_true(count <= MOST);
	jn_path_stations(&c.path, count, twist, c.stations);
}

static void path_free(void) {
	jn_arena_free(&c.arena);
}

static void expect(double value, double expected, double tolerance, const char* what) {
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: %.17g, expected %.17g, tolerance %.3g", what, value, expected, tolerance);
}

static const char* const all[] = {
	"curve: {type: polyline, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 1, 0]}, {at: [2, 1, 1]}]}",
	"curve: {type: spline, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 1, 0]}, {at: [2, 1, 1]}]}",
	"curve: {type: spline, closed: true, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 1, 1]}, {at: [0, 1, 1]}]}",
	"curve: {type: helix, radius: 0.5, pitch: 0.2, turns: 3.3}",
	"curve: {type: circle, radius: 0.5, axis: x}",
	"curve: {type: circle, radius: 0.5, angle: 100 deg, axis: z}",
	"curve: {type: torus_knot, ring: 0.5, tube: 0.2}",
	"curve: {type: overhand, size: 0.2, tail: 1}",
};
enum { CURVES = sizeof all / sizeof *all };

static void frames_are_right_handed_and_orthonormal(void** state) {
	(void)state;
	for (int i = 0; i < CURVES; ++i) {
		path_make(all[i], 101, 0.25 * (i % 5 == 0));
		for (int k = 0; k < 101; ++k) {
			const JnStation* s = &c.stations[k];
			double cross[3];
			vec3_cross(s->across[0], s->across[1], cross);
			expect(vec3_distance(cross, s->along), 0, 1e-14, all[i]); // roundings of some ten operations
			expect(vec3_length(s->across[0]), 1, 1e-14, all[i]);
			expect(vec3_length(s->across[1]), 1, 1e-14, all[i]);
			expect(vec3_dot(s->across[0], s->across[1]), 0, 1e-14, all[i]);
		}
		path_free();
	}
}

static void lengths_are_those_of_theory(void** state) {
	(void)state;
	static const struct {
		const char* text;
		double length;
	} cases[] = {
		{"curve: {type: helix, radius: 0.5, pitch: 0.2, turns: 3.3}", 3.3 * 3.1479524140446213}, // hypot(pi, 0.2)
		{"curve: {type: circle, radius: 0.5}", 3.14159265358979323846},
		{"curve: {type: circle, radius: 2, angle: 1 rad}", 2},
		{"curve: {type: polyline, points: [{at: [0, 0, 0]}, {at: [3, 0, 4]}, {at: [3, 2, 4]}]}", 7},
		{"curve: {type: polyline, closed: true, points: [{at: [0, 0, 0]}, {at: [3, 0, 0]}, {at: [3, 4, 0]}]}", 12},
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		path_make(cases[i].text, 3, 0);
		expect(c.path.length, cases[i].length, 1e-8 * cases[i].length,
			   cases[i].text); // (pi / 128)^4 / 480 a quarter turn
		path_free();
	}
}

// Halves of the ways between stations, measured again in 2000 chords each.
static double measured(double from, double to) {
	double length = 0, last[3], next[3], along[3];
	jn_path_place(&c.path, from, last, along);
	for (int i = 1; i <= 2000; ++i) {
		jn_path_place(&c.path, from + (to - from) * i / 2000, next, along);
		length += vec3_distance(last, next);
		memcpy(last, next, sizeof last);
	}
	return length;
}

static void stations_stand_at_equal_arc_lengths(void** state) {
	(void)state;
	for (int i = 0; i < CURVES; ++i) {
		path_make(all[i], 13, 0);
		const int parts = c.path.is_closed ? 13 : 12;
		const double step = c.path.length / parts;
		for (int k = 0; k < parts; ++k) {
			double X[3], along[3];
			jn_path_place(&c.path, step * k, X, along);
			expect(vec3_distance(X, c.stations[k].X), 0, 1e-12, all[i]);
			// chords of a bend fall short by (1/2000 of it)^2 / 24; one of them cuts a corner
			expect(measured(step * k, step * (k + 1)) / step, 1, i == 0 ? 1.0 / 2000 : 1e-6, all[i]);
		}
		path_free();
	}
}

static void a_square_has_stations_at_its_corners_and_between_them(void** state) {
	(void)state;
	path_make(
		"curve: {type: polyline, closed: true, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 1, 0]}, {at: [0, 1, "
		"0]}]}",
		8, 0);
	static const double expected[8][3] = {{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0.5, 1}, {0, 1}, {0, 0.5}};
	for (int k = 0; k < 8; ++k) expect(vec3_distance(c.stations[k].X, expected[k]), 0, 1e-12, "corner");
	path_free();
}

// Frenet's frame turns about the tangent by the torsion c / (r^2 + c^2), c = pitch / 2 pi, a frame without twist not at all.
static void frames_of_a_helix_turn_against_frenets_by_its_torsion(void** state) {
	(void)state;
	for (int twist = 0; twist < 2; ++twist) {
		path_make("curve: {type: helix, radius: 0.5, pitch: 0.6, turns: 3, axis: z}", 200, 1.5 * twist);
		const double rise = 0.6 / (2 * pi), torsion = rise / (0.25 + rise * rise);
		double first = 0, worst = 0;
		for (int k = 0; k < 200; ++k) {
			const JnStation* s = &c.stations[k];
			const double length = c.path.length * k / 199, r = hypot(s->X[0], s->X[1]);
			const double normal[3] = {-s->X[0] / r, -s->X[1] / r, 0};
			double binormal[3];
			vec3_cross(s->along, normal, binormal);
			const double angle = atan2(vec3_dot(s->across[0], binormal), vec3_dot(s->across[0], normal));
			const double expected = (2 * pi * 1.5 * twist / c.path.length - torsion) * length;
			if (k == 0) first = angle;
			worst = fmax(worst, fabs(remainder(angle - first - expected, 2 * pi)));
		}
		print_message("twist %d: angle off by %g\n", twist, worst);
		assert_true(worst < 1e-8); // double reflection: fourth order in 4096 steps of 0.005 rad, here 19 rad in all
		path_free();
	}
}

// The twist from each frame of a loop to the next, the last and the first included, is the same.
static void frames_of_loops_close_and_share_what_is_missing(void** state) {
	(void)state;
	static const int loops[] = {2, 4, 6};
	for (int i = 0; i < 3; ++i) {
		path_make(all[loops[i]], 600, 0);
		double low = INFINITY, high = -INFINITY;
		for (int k = 0; k < 600; ++k) {
			const JnStation *from = &c.stations[k], *to = &c.stations[(k + 1) % 600];
			JnStation carried = *to;
			jn_station_carry(from, &carried);
			const double twist =
				atan2(vec3_dot(to->across[0], carried.across[1]), vec3_dot(to->across[0], carried.across[0]));
			low = fmin(low, twist);
			high = fmax(high, twist);
		}
		print_message("%s: twists %g to %g\n", all[loops[i]], low, high);
		assert_true(c.path.is_closed);
		assert_true(high - low < 1e-5);            // one step of double reflection in place of eight
		assert_true(fabs(high) * 600 < pi + 0.01); // half a turn at most
		path_free();
	}
}

static int determinant(int count) {
	static double points[3 * MOST];
	for (int k = 0; k < count; ++k) memcpy(points + 3 * k, c.stations[k].X, sizeof c.stations[k].X);
	return knot_determinant(count, points, c.path.is_closed);
}

static void knots_are_knots(void** state) {
	(void)state;
	static const struct {
		const char* text;
		int determinant;
	} cases[] = {
		{"curve: {type: torus_knot, ring: 0.5, tube: 0.2}", 3},
		{"curve: {type: torus_knot, p: 2, q: 5, ring: 0.5, tube: 0.2}", 5},
		{"curve: {type: torus_knot, p: 1, q: 3, ring: 0.5, tube: 0.2}", 1},
		{"curve: {type: overhand, size: 0.2, tail: 1}", 3},
		{"curve: {type: overhand, size: 0.2, tail: 0, }\nrotate: [0.3, 1, 2]", 3},
		{"curve: {type: circle, radius: 1}", 1},
		{"curve: {type: helix, radius: 1, pitch: 0.1, turns: 5}", 1},
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		path_make(cases[i].text, 400, 0);
		assert_int_equal(determinant(400), cases[i].determinant);
		path_free();
	}
}

// What its documentation promises, for a size of 1: bends of 0.21 or wider, strands 0.43 or more apart.
static void an_overhand_knot_is_loose(void** state) {
	(void)state;
	path_make("curve: {type: overhand, size: 1, tail: 1}", MOST, 0);
	const double step = c.path.length / (MOST - 1);
	double bend = INFINITY, gap = INFINITY, low[3], high[3];
	memcpy(low, c.stations[0].X, sizeof low);
	memcpy(high, low, sizeof high);
	for (int k = 0; k < MOST; ++k) {
		for (int a = 0; a < 3; ++a) {
			low[a] = fmin(low[a], c.stations[k].X[a]);
			high[a] = fmax(high[a], c.stations[k].X[a]);
		}
		if (k > 0) bend = fmin(bend, step / vec3_distance(c.stations[k].along, c.stations[k - 1].along));
		for (int i = 0; step * (k - i) > 0.7; ++i) // farther along it than half a turn of the sharpest bend
			gap = fmin(gap, vec3_distance(c.stations[k].X, c.stations[i].X));
	}
	print_message("bend %g, gap %g, box %g x %g x %g\n", bend, gap, high[0] - low[0], high[1] - low[1],
				  high[2] - low[2]);
	assert_true(bend > 0.21 && gap > 0.43);
	assert_true(high[1] - low[1] < 1.05 && high[2] - low[2] < 1.05);
	expect(c.stations[0].X[0], -2, 1e-12, "start of the tail");
	expect(c.stations[MOST - 1].X[0], 2, 1e-12, "end of the tail");
	expect(c.stations[0].along[0], 1, 1e-14, "direction of the tail");
	path_free();
}

static void a_curve_is_turned_about_its_origin_and_moved(void** state) {
	(void)state;
	path_make("{curve: {type: circle, radius: 2, axis: z}, origin: [1, 2, 3], rotate: [90 deg, 0, 0]}", 4, 0);
	static const double expected[4][3] = {{3, 2, 3}, {1, 2, 5}, {-1, 2, 3}, {1, 2, 1}};
	for (int k = 0; k < 4; ++k)
		expect(vec3_distance(c.stations[k].X, expected[k]), 0, 1e-8, "place"); // of the arc lengths
	path_free();
}

static void expect_refusal(const char* text, const char* part) {
	log_capture();
	const JnStatus status = path_try(text);
	if (status != JN_BAD_INPUT || strstr(log_text(), part) == NULL)
		fail_msg("%s: expected '%s', got '%s'", text, part, log_text());
	log_release();
	path_free();
}

static void curves_that_are_none_are_refused(void** state) {
	(void)state;
	expect_refusal("curve: {type: spline, points: [{at: [0, 0, 0]}]}", "curve.points: 1 points make no curve; give 2");
	expect_refusal("curve: {type: polyline, closed: true, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}]}",
				   "no closed curve");
	expect_refusal("curve: {type: polyline, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1, 0, 0]}]}",
				   "curve.points[2]: lies at the point before it");
	expect_refusal(
		"curve: {type: spline, closed: true, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [0, 1, 0]}, {at: [0, "
		"0, 0]}]}",
		"curve.points[0]: lies at the point before it");
	expect_refusal("curve: {type: polyline, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [0.5, 0, 0]}]}",
				   "curve.points[1]: the curve turns right round");
	expect_refusal("curve: {type: spline, closed: true, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [2, 0, 0]}]}",
				   "curve.points[0]: the curve turns right round");
	expect_refusal("curve: {type: torus_knot, p: 2, q: 4, ring: 1, tube: 0.3}", "common factor 2");
	expect_refusal("curve: {type: torus_knot, ring: 1, tube: 1}", "not smaller than the ring");
	expect_refusal("curve: {type: helix, radius: 1, pitch: 0, turns: 1.5}", "runs into itself");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(frames_are_right_handed_and_orthonormal),
		cmocka_unit_test(lengths_are_those_of_theory),
		cmocka_unit_test(stations_stand_at_equal_arc_lengths),
		cmocka_unit_test(a_square_has_stations_at_its_corners_and_between_them),
		cmocka_unit_test(frames_of_a_helix_turn_against_frenets_by_its_torsion),
		cmocka_unit_test(frames_of_loops_close_and_share_what_is_missing),
		cmocka_unit_test(knots_are_knots),
		cmocka_unit_test(an_overhand_knot_is_loose),
		cmocka_unit_test(a_curve_is_turned_about_its_origin_and_moved),
		cmocka_unit_test(curves_that_are_none_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
