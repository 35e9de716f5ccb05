// What constraints measure, against independent computations: twist by quaternions, the barrier of volumes by its formula.
#include "constraint_sample.h"
#include "force/constraint/torsion.h"
#include "force/constraint/volume.h"

static const double PI = 3.14159265358979323846;

static void expect(double value, double expected, double tolerance, const char* what) {
	if (fabs(value - expected) <= tolerance) return;
	fail_msg("%s: %.17g, expected %.17g, tolerance %.3g", what, value, expected, tolerance);
}

/// A rotation by `angle` about a unit axis as a quaternion w, x, y, z.
static void quaternion(const double axis[3], double angle, double q[4]) {
	q[0] = cos(0.5 * angle);
	for (int a = 0; a < 3; ++a) q[a + 1] = sin(0.5 * angle) * axis[a];
}

static void multiply(const double a[4], const double b[4], double out[4]) {
	out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
	out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
	out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
	out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

/// out = q v q*.
static void rotate(const double q[4], const double v[3], double out[3]) {
	const double pure[4] = {0, v[0], v[1], v[2]}, back[4] = {q[0], -q[1], -q[2], -q[3]};
	double half[4], full[4];
	multiply(q, pure, half);
	multiply(half, back, full);
	memcpy(out, full + 1, 3 * sizeof *out);
}

/// theta of torsion.h for two frames, of sections at the angle `spread` between P - R and Q - R.
static double twist(const double first[4], const double second[4], double spread) {
	const double rest[TORSION_REALS] = {-cos(spread) / sin(spread), 1 / sin(spread), 0, 1, 1};
	const double section[3][3] = {{0, 0, 0}, {1e-3, 0, 0}, {1e-3 * cos(spread), 1e-3 * sin(spread), 0}};
	double lanes[TORSION_REALS * JN_WIDE], x[6][3];
	Wide edges[5][3];
	for (int i = 0; i < 6; ++i) {
		rotate(i < 3 ? first : second, section[i % 3], x[i]);
		x[i][2] += 0.01 * (i / 3);
	}
	for (int k = 0; k < TORSION_REALS * JN_WIDE; ++k) lanes[k] = rest[k / JN_WIDE];
	for (int k = 0; k < 15; ++k) edges[k / 3][k % 3] = wide_set(x[k / 3][k % 3] - x[5][k % 3]);
	Torsion s;
	torsion_load(lanes, edges, &s);
	return s.change[0];
}

// The second frame is the first, twisted about its normal, then swung about an axis in its plane: the twist is what was put
// in, and 2 atan2(z, w) of the quaternion between the two, in the axes of the first.
static void twist_is_that_of_swing_and_twist_between_the_frames(void** unused) {
	(void)unused;
	uint64_t seed = 9;
	for (int i = 0; i < 1000; ++i) {
		const double theta = PI * random_real(&seed), swing = 0.95 * PI * random_real(&seed);
		const double way = PI * random_real(&seed), spread = i % 2 ? PI / 2 : PI / 3;
		const double normal[3] = {0, 0, 1}, across[3] = {cos(way), sin(way), 0};
		double axis[3] = {random_real(&seed), random_real(&seed), random_real(&seed)}, first[4], second[4];
		const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
		for (int a = 0; a < 3; ++a) axis[a] /= length;
		double twisted[4], swung[4], between[4];
		quaternion(axis, PI * random_real(&seed), first);
		quaternion(normal, theta, twisted);
		quaternion(across, swing, swung);
		multiply(swung, twisted, between);
		multiply(first, between, second);
		double by_quaternion = 2 * atan2(between[3], between[0]);
		if (by_quaternion > PI) by_quaternion -= 2 * PI;
		if (by_quaternion < -PI) by_quaternion += 2 * PI;
		expect(by_quaternion, theta, 1e-12, "twist of the quaternion");
		// swings up to 0.95 pi leave 1 + cos = 0.012 of N and D: two digits less than rounding
		expect(twist(first, second, spread), theta, 1e-12, "twist of the frames");
	}
}

static void barrier(double r, double* value, double* slope, double* curvature) {
	const Barrier b = volume_barrier(wide_set(r));
	*value = b.value[0];
	*slope = b.slope[0];
	*curvature = b.curvature[0];
}

static void the_barrier_is_its_formula_between_its_ends(void** unused) {
	(void)unused;
	for (int i = 1; i < 1000; ++i) {
		const double r = VOLUME_BEND + (1 - VOLUME_BEND) * i / 1000, open = 1 - r;
		double value, slope, curvature;
		barrier(r, &value, &slope, &curvature);
		expect(value, -open * open * log(r), 1e-14, "b"); // rounding
		expect(slope, 2 * open * log(r) - open * open / r, 1e-13, "b'");
		expect(curvature, -2 * log(r) + 4 * open / r + open * open / (r * r), 1e-11, "b''"); // of order 400
	}
}

// Steps of 1e-9 across the ends of the formula change b by 1e-9 of the derivative above, b'' by |b'''| 1e-9 at most.
static void the_barrier_has_no_jump_up_to_its_second_derivative(void** unused) {
	(void)unused;
	static const double ends[] = {0.05, 1};
	for (int i = 0; i < 2; ++i) {
		double below[3], above[3];
		barrier(ends[i] - 1e-9, &below[0], &below[1], &below[2]);
		barrier(ends[i] + 1e-9, &above[0], &above[1], &above[2]);
		for (int k = 0; k < 3; ++k)
			expect(above[k], below[k], 1e-4, "derivative across an end"); // |b'''| < 2e4 at 0.05
	}
}

static void the_barrier_pushes_back_ever_harder_inside_out(void** unused) {
	(void)unused;
	double last = 0;
	for (double r = 1; r > -3; r -= 0.01) {
		double value, slope, curvature;
		barrier(r, &value, &slope, &curvature);
		assert_true(isfinite(value) && slope <= last + 1e-12 && curvature >= 0);
		last = slope;
	}
	assert_true(last < -1000);
}

// Cells that start inside out, r = -0.4, and move in a viscous medium (v = f).
static void a_cell_that_is_inside_out_recovers_its_volume(void** unused) {
	(void)unused;
	ConstraintSample s = constraint_sample(JN_CONSTRAINT_volume, 0, CLOTH_FOLDED, 4);
	double f[SAMPLE_ELEMENTS][SAMPLE_MOST_REALS], E[SAMPLE_ELEMENTS];
	Sample view = cloth_view(&s);
	const double dt = 1e-3; // g^2 E'' of order 100 at most
	for (int step = 0; step < 20000; ++step) {
		sample_force(&view, f);
		for (int e = 0; e < SAMPLE_ELEMENTS; ++e)
			for (int k = 0; k < s.reals; ++k) s.x[e * s.reals + k] += dt * f[e][k];
	}
	sample_energy(&view, E);
	for (int e = 0; e < SAMPLE_ELEMENTS; ++e) {
		const double* x = s.x + e * s.reals;
		double d[3][3], n[3];
		for (int k = 0; k < 9; ++k) d[k / 3][k % 3] = x[k] - x[9 + k % 3];
		for (int a = 0; a < 3; ++a)
			n[a] = d[1][(a + 1) % 3] * d[2][(a + 2) % 3] - d[1][(a + 2) % 3] * d[2][(a + 1) % 3];
		const double V = (d[0][0] * n[0] + d[0][1] * n[1] + d[0][2] * n[2]) / 6;
		print_message("volume: %.6g of %.6g m^3\n", V, 1e-3 / 6);
		expect(V, 1e-3 / 6, 1e-3 * 1e-3 / 6, "volume"); // 0.1 %
	}
	jn_arena_free(&s.arena);
}

static void wide_logarithm_is_that_of_the_c_library(void** unused) {
	(void)unused;
	for (int i = 0; i < 100000; ++i) {
		const double a = i % 3 == 0 ? exp(-300 + 0.006 * i) : 0.04 + 1e-5 * i, expected = log(a);
		const double found = wide_logarithm(wide_set(a))[0];
		if (!(fabs(found - expected) <= 5e-16 * fmax(1e-3, fabs(expected)))) // 2 units in the last place
			fail_msg("wide_logarithm(%.17g) is %.17g, expected %.17g", a, found, expected);
	}
	assert_true(wide_logarithm(wide_set(1))[0] == 0);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(twist_is_that_of_swing_and_twist_between_the_frames),
		cmocka_unit_test(wide_logarithm_is_that_of_the_c_library),
		cmocka_unit_test(the_barrier_is_its_formula_between_its_ends),
		cmocka_unit_test(the_barrier_has_no_jump_up_to_its_second_derivative),
		cmocka_unit_test(the_barrier_pushes_back_ever_harder_inside_out),
		cmocka_unit_test(a_cell_that_is_inside_out_recovers_its_volume),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
