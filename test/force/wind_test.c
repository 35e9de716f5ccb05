/// @file wind_test.c
/// The wind's load on triangles against the law written out plainly, its derivatives against differences, and the air.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/random.h"
#include "force/wind.h"

enum { LANES = JN_WIND_LANES, BLOCKS = 3, NODES = 40 };

static const int widths[] = {2, 4, 8};
enum { WIDTH_COUNT = sizeof widths / sizeof *widths };

typedef struct Cloud {
	double x[3 * NODES], v[3 * NODES];
	int nodes[BLOCKS * 3 * LANES];
	double factor[BLOCKS * LANES];
	JnWindSurface surface;
	JnAir air;
} Cloud;

static double random_in(JnRandom* random, double size) {
	return size * (2 * jn_random_uniform(random) - 1);
}

static void random_air(JnRandom* random, int waves, JnAir* air) {
	*air = (JnAir){.waves = waves};
	for (int a = 0; a < 3; ++a) air->velocity[a] = random_in(random, 5);
	for (int j = 0; j < waves; ++j) {
		air->phase[j] = 3 + random_in(random, 3);
		for (int a = 0; a < 3; ++a) {
			air->wave[j][a] = random_in(random, 4);
			air->amplitude[j][a] = random_in(random, 2);
		}
	}
}

static void random_cloud(uint64_t seed, int waves, Cloud* cloud) {
	JnRandom random = {seed};
	for (int k = 0; k < 3 * NODES; ++k) {
		cloud->x[k] = random_in(&random, 1);
		cloud->v[k] = random_in(&random, 2);
	}
	for (int k = 0; k < BLOCKS * 3 * LANES; ++k) cloud->nodes[k] = (int)(jn_random_bits(&random) % NODES);
	for (int k = 0; k < BLOCKS * LANES; ++k) cloud->factor[k] = 0.1 + jn_random_uniform(&random);
	random_air(&random, waves, &cloud->air);
	cloud->surface = (JnWindSurface){.blocks = BLOCKS, .nodes = cloud->nodes, .factor = cloud->factor};
}

static void triangle_of(const Cloud* cloud, int triangle, const double* p[3], double centre[3], double speed[3]) {
	const int* corner = cloud->nodes + triangle / LANES * 3 * LANES + triangle % LANES;
	for (int a = 0; a < 3; ++a) centre[a] = speed[a] = 0;
	for (int c = 0; c < 3; ++c) {
		p[c] = cloud->x + 3 * corner[c * LANES];
		for (int a = 0; a < 3; ++a) {
			centre[a] += p[c][a] / 3;
			speed[a] += cloud->v[3 * corner[c * LANES] + a] / 3;
		}
	}
}

// A third of 1/2 rho C_d A (w.n) |w.n| n, with n, A and w one after the other.
static void plain_force(const Cloud* cloud, int triangle, double out[3]) {
	const double* p[3];
	double centre[3], speed[3], wind[3], gradient[9], e[3], d[3];
	triangle_of(cloud, triangle, p, centre, speed);
	jn_air_at(&cloud->air, centre, wind, gradient);
	for (int a = 0; a < 3; ++a) {
		e[a] = p[1][a] - p[0][a];
		d[a] = p[2][a] - p[0][a];
	}
	double n[3] = {e[1] * d[2] - e[2] * d[1], e[2] * d[0] - e[0] * d[2], e[0] * d[1] - e[1] * d[0]}, through = 0;
	const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), area = length / 2;
	for (int a = 0; a < 3; ++a) {
		n[a] = length > 0 ? n[a] / length : 0;
		through += (wind[a] - speed[a]) * n[a];
	}
	const double half_rho_drag = 3 * cloud->factor[triangle];
	for (int a = 0; a < 3; ++a) out[a] = half_rho_drag * area * through * fabs(through) * n[a] / 3;
}

static void forces_of_blocks_are_the_law_for_all_widths(void** state) {
	(void)state;
	int checked = 0;
	for (int i = 0; i < WIDTH_COUNT; ++i)
		for (int waves = 0; waves <= 16; waves += 8) {
			JnWindForces* forces = jn_wind_forces(widths[i]);
			if (forces == NULL) continue; // a processor without such vectors
			Cloud cloud;
			double out[BLOCKS * LANES * 4];
			random_cloud(5 + (uint64_t)waves, waves, &cloud);
			forces(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out);
			for (int t = 0; t < BLOCKS * LANES; ++t) {
				double expected[3];
				plain_force(&cloud, t, expected);
				for (int a = 0; a < 3; ++a, ++checked) {
					const double value = out[4 * t + a];
					// forces up to 100 N, from some 50 operations on numbers of that size
					if (!(fabs(value - expected[a]) <= 1e-13 * 100))
						fail_msg("%d lanes, %d waves, triangle %d: %.17g, expected %.17g", widths[i], waves, t, value,
								 expected[a]);
				}
			}
		}
	assert_true(checked >= 3 * 3 * BLOCKS * LANES); // two lanes always run
}

static void eight_lanes_give_the_bits_of_four_and_parts_those_of_the_whole(void** state) {
	(void)state;
	Cloud cloud;
	double out[2][BLOCKS * LANES * 4];
	JnWindForces *four = jn_wind_forces(4), *eight = jn_wind_forces(8), *any = jn_wind_forces(0);
	random_cloud(11, 8, &cloud);
	any(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out[0]);
	any(&cloud.surface, &cloud.air, 0, 1, cloud.x, cloud.v, out[1]); // as two threads would
	any(&cloud.surface, &cloud.air, 1, BLOCKS, cloud.x, cloud.v, out[1] + 4 * LANES);
	assert_memory_equal(out[0], out[1], sizeof out[0]);
	if (four == NULL || eight == NULL) return; // a processor without such vectors
	four(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out[0]);
	eight(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out[1]);
	assert_memory_equal(out[0], out[1], sizeof out[0]);
}

// One triangle of 2 m^2 in the plane z = 0, whose normal is +z.
static void flat_triangle(Cloud* cloud, double wind_z) {
	random_cloud(1, 0, cloud);
	const double x[9] = {0, 0, 0, 2, 0, 0, 0, 2, 0};
	memcpy(cloud->x, x, sizeof x);
	memset(cloud->v, 0, sizeof cloud->v);
	for (int k = 0; k < BLOCKS * 3 * LANES; ++k) cloud->nodes[k] = k % (3 * LANES) / LANES;
	for (int k = 0; k < BLOCKS * LANES; ++k) cloud->factor[k] = 1.225 * 1.5 / 6;
	cloud->air = (JnAir){.velocity = {3, -4, wind_z}};
}

static void wind_pushes_along_itself_with_its_square(void** state) {
	(void)state;
	for (int side = -1; side <= 1; side += 2) {
		Cloud cloud;
		double out[BLOCKS * LANES * 4];
		flat_triangle(&cloud, 10 * side);
		for (int k = 2; k < 9; k += 3) cloud.v[k] = 3 * side; // the triangle gives way
		jn_wind_forces(0)(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out);
		// 1/2 1.225 1.5 2 m^2 (10 - 3)^2, a third at each corner; what blows along the surface does nothing
		const double expected = side * 0.5 * 1.225 * 1.5 * 2 * 49 / 3;
		assert_true(out[0] == 0 && out[1] == 0);
		if (!(fabs(out[2] - expected) <= 1e-14)) fail_msg("%.17g, expected %.17g", out[2], expected);
	}
}

static void a_triangle_without_area_has_no_force_and_no_tangent(void** state) {
	(void)state;
	Cloud cloud;
	double out[BLOCKS * LANES * 4];
	for (int kind = 0; kind < 2; ++kind) {
		flat_triangle(&cloud, 10);
		const double line[9] = {0, 0, 0, 1, 1, 1, 2, 2, 2};
		for (int k = 0; k < 9; ++k) cloud.x[k] = kind == 0 ? line[k] : 0.5;
		jn_wind_forces(0)(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out);
		for (int k = 0; k < BLOCKS * LANES * 4; ++k) assert_true(out[k] == 0);
		JnWindTangent tangent;
		const double* p[3] = {cloud.x, cloud.x + 3, cloud.x + 6};
		jn_wind_tangent(1, p, (double[]){1, 2, 3}, (double[9]){0}, &tangent);
		for (int k = 0; k < 27; ++k) assert_true(tangent.stiffness[k / 9][k % 9] == 0);
		for (int k = 0; k < 3; ++k) assert_true(tangent.damping[k] == 0);
	}
}

static void the_sine_of_waves_is_that_of_the_library(void** state) {
	(void)state;
	Cloud cloud;
	double out[BLOCKS * LANES * 4];
	JnRandom random = {3};
	for (int trial = 0; trial < 2000; ++trial) {
		const double angle = random_in(&random, trial % 2 == 0 ? 10 : 1e5);
		flat_triangle(&cloud, 0);
		cloud.air = (JnAir){.waves = 1, .amplitude = {{0, 0, 1}}};
		cloud.air.wave[0][2] = angle;
		for (int k = 2; k < 9; k += 3) cloud.x[k] = 1; // wave . x is the angle, up to rounding of a third
		for (int k = 0; k < BLOCKS * LANES; ++k) cloud.factor[k] = 0.5;
		jn_wind_forces(0)(&cloud.surface, &cloud.air, 0, BLOCKS, cloud.x, cloud.v, out);
		const double value = copysign(sqrt(fabs(out[2])), out[2]);
		// the centre's 1 is rounded by 1e-16 at most, times the angle; the polynomial and a root add 5e-16. Near 0 the root
		// of the force's rounding counts alone
		const double tolerance = 1e-15 + 3e-16 * fabs(angle);
		if (!(fabs(value - sin(angle)) <= tolerance)) fail_msg("sin %.17g: %.17g, not %.17g", angle, value, sin(angle));
	}
}

static void force_on_corner(Cloud* cloud, double out[3]) {
	double all[4 * LANES];
	jn_wind_forces(0)(&cloud->surface, &cloud->air, 0, 1, cloud->x, cloud->v, all);
	for (int a = 0; a < 3; ++a) out[a] = all[a];
}

// -(f(+h) - f(-h)) / 2h over one number.
static void difference(Cloud* cloud, double* number, double h, double out[3]) {
	const double at = *number;
	double ahead[3], behind[3];
	*number = at + h;
	force_on_corner(cloud, ahead);
	*number = at - h;
	force_on_corner(cloud, behind);
	*number = at;
	for (int a = 0; a < 3; ++a) out[a] = -(ahead[a] - behind[a]) / (2 * h);
}

static double largest_of(const JnWindTangent* tangent) {
	double most = 0;
	for (int k = 0; k < 27; ++k) most = fmax(most, fabs(tangent->stiffness[k / 9][k % 9]));
	return most;
}

static void expect_tangent(Cloud* cloud, uint64_t seed) {
	const double* p[3];
	double centre[3], speed[3], w[3], gradient[9], by_x[3], by_v[3];
	JnWindTangent tangent;
	triangle_of(cloud, 0, p, centre, speed);
	jn_air_at(&cloud->air, centre, w, gradient);
	for (int a = 0; a < 3; ++a) w[a] -= speed[a];
	jn_wind_tangent(cloud->factor[0], p, w, gradient, &tangent);
	// h = 1e-6: h^2 f''' / 6, also of slivers, and rounding 1e-15 f / h, both below 1e-7 of the largest entry
	const double tolerance = 1e-6 * fmax(largest_of(&tangent), 1e-3);
	for (int c = 0; c < 3; ++c)
		for (int axis = 0; axis < 3; ++axis) {
			const int k = 3 * cloud->nodes[c * LANES] + axis;
			difference(cloud, &cloud->x[k], 1e-6, by_x);
			difference(cloud, &cloud->v[k], 1e-6, by_v);
			for (int a = 0; a < 3; ++a) {
				const double K = tangent.stiffness[c][3 * a + axis], D = tangent.damping[a] * tangent.damping[axis];
				if (!(fabs(K - by_x[a]) <= tolerance) || !(fabs(D - by_v[a]) <= tolerance))
					fail_msg("seed %d, corner %d: K %.12g, expected %.12g; D %.12g, expected %.12g", (int)seed, c, K,
							 by_x[a], D, by_v[a]);
			}
		}
}

static void derivatives_are_differences_of_the_force(void** state) {
	(void)state;
	for (uint64_t seed = 1; seed <= 50; ++seed)
		for (int waves = 0; waves <= 8; waves += 8) {
			Cloud cloud;
			random_cloud(seed, waves, &cloud);
			for (int c = 0; c < 3; ++c) cloud.nodes[c * LANES] = 3 * c + (int)seed % 3; // three different corners
			expect_tangent(&cloud, seed);
		}
}

static void the_gradient_of_the_air_is_its_difference(void** state) {
	(void)state;
	JnRandom random = {9};
	JnAir air;
	random_air(&random, 8, &air);
	for (int trial = 0; trial < 20; ++trial) {
		double x[3], u[3], gradient[9], ahead[3], behind[3], other[9];
		for (int a = 0; a < 3; ++a) x[a] = random_in(&random, 3);
		jn_air_at(&air, x, u, gradient);
		for (int c = 0; c < 3; ++c) {
			const double at = x[c], h = 1e-5;
			x[c] = at + h;
			jn_air_at(&air, x, ahead, other);
			x[c] = at - h;
			jn_air_at(&air, x, behind, other);
			x[c] = at;
			for (int r = 0; r < 3; ++r) // h^2 4^3 2 8 / 6 = 2e-8 at most
				assert_true(fabs(gradient[3 * r + c] - (ahead[r] - behind[r]) / (2 * h)) <= 1e-7);
		}
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(forces_of_blocks_are_the_law_for_all_widths),
		cmocka_unit_test(eight_lanes_give_the_bits_of_four_and_parts_those_of_the_whole),
		cmocka_unit_test(wind_pushes_along_itself_with_its_square),
		cmocka_unit_test(a_triangle_without_area_has_no_force_and_no_tangent),
		cmocka_unit_test(the_sine_of_waves_is_that_of_the_library),
		cmocka_unit_test(derivatives_are_differences_of_the_force),
		cmocka_unit_test(the_gradient_of_the_air_is_its_difference),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
