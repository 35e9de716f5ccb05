// Relaxation: one projection against its equations, and batches whose elements share no node.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "force/relax.h"

enum { NODES = 40, SPRINGS = 120, MOST_LANES = 8 };

static uint64_t seed = 7;

static double random_real(void) {
	seed = seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(seed >> 11) / (double)((uint64_t)1 << 53);
}

static void expect_near(double value, double expected, double tolerance, const char* what) {
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%s: %.17g, expected %.17g, tolerance %.3g", what, value, expected, tolerance);
}

/// Springs between random nodes, each longer or shorter than the distance of its nodes.
typedef struct Net {
	JnArena arena;
	double x[3 * NODES], w[3 * NODES], mass[NODES];
	JnRelaxElement springs[SPRINGS];
	JnGroup group;
	double* lambda;
} Net;

static void net_create(Net* net, int width, int springs) {
	memset(net, 0, sizeof *net);
	seed = 7;
	for (int k = 0; k < 3 * NODES; ++k) net->x[k] = random_real();
	for (int i = 0; i < NODES; ++i) net->mass[i] = 0.5 + random_real();
	for (int k = 0; k < 3 * NODES; ++k) net->w[k] = 1 / net->mass[k / 3];
	for (int e = 0; e < springs; ++e) {
		const int i = (int)(NODES * random_real()), j = (i + 1 + (int)((NODES - 1) * random_real())) % NODES;
		net->springs[e] = (JnRelaxElement){.nodes = {i, j}, .rest = {0.3 + 0.5 * random_real()}};
	}
	assert_int_equal(jn_relax_group_create(jn_relax_kernel(JN_RELAX_spring, width), springs, net->springs, 0,
										   &net->arena, &net->group),
					 JN_OK);
	net->lambda = jn_arena_take(&net->arena, (size_t)net->group.batches * MOST_LANES, sizeof *net->lambda);
	assert_non_null(net->lambda);
}

static void net_free(Net* net) {
	jn_arena_free(&net->arena);
}

static void relax(Net* net, double compliance, int sweeps) {
	const JnRelaxation how = {.inverse_mass = net->w, .compliance = compliance, .factor = 1};
	for (int i = 0; i < sweeps; ++i)
		net->group.kernel->relax(&net->group, 0, net->group.batches, &how, net->x, net->lambda);
}

static double length_of(const Net* net, const JnRelaxElement* spring) {
	const double *a = net->x + 3 * (ptrdiff_t)spring->nodes[0], *b = net->x + 3 * (ptrdiff_t)spring->nodes[1];
	return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

// A width that this processor has, or 0.
static int lanes(int width) {
	return jn_relax_kernel(JN_RELAX_spring, width) != NULL ? width : 0;
}

// No two elements of a batch share a node, and each is there once.
static void expect_sound_batches(const Net* net) {
	int found[SPRINGS] = {0};
	const JnGroup* group = &net->group;
	const int width = group->kernel->width;
	for (int e = 0; e < group->count; ++e) {
		const int lane = e % width, batch = e / width;
		const double k = group->rest[(batch * 2 + 1) * width + lane];
		for (int f = batch * width; f < e && k != 0; ++f) {
			if (group->rest[(batch * 2 + 1) * width + f % width] == 0) continue;
			for (int i = 0; i < 4; ++i)
				assert_int_not_equal(jn_group_node(group, e, i / 2), jn_group_node(group, f, i % 2));
		}
		for (int s = 0; s < SPRINGS && k != 0; ++s)
			found[s] += net->springs[s].nodes[0] == jn_group_node(group, e, 0) &&
						net->springs[s].nodes[1] == jn_group_node(group, e, 1) &&
						net->springs[s].rest[0] == group->rest[batch * 2 * width + lane];
	}
	for (int s = 0; s < SPRINGS; ++s) assert_int_equal(found[s], 1);
}

static void no_two_elements_of_a_batch_share_a_node_and_none_is_lost(void** state) {
	(void)state;
	Net net;
	net_create(&net, 0, SPRINGS);
	expect_sound_batches(&net);
	net_free(&net);
}

// A wheel: all 120 springs have the hub, so that each needs a batch of its own, more than are kept open at once (64).
static void a_node_may_have_any_number_of_elements(void** state) {
	(void)state;
	Net net;
	net_create(&net, 0, SPRINGS);
	for (int e = 0; e < SPRINGS; ++e) net.springs[e].nodes[0] = 0, net.springs[e].nodes[1] = 1 + e % (NODES - 1);
	assert_int_equal(
		jn_relax_group_create(jn_relax_kernel(JN_RELAX_spring, 0), SPRINGS, net.springs, 0, &net.arena, &net.group),
		JN_OK);
	assert_int_equal(net.group.count, 8 * SPRINGS);
	expect_sound_batches(&net);
	net_free(&net);
}

// One behind the other in the order of 8 lanes, by the formulas with ordinary numbers.
static void relax_one_by_one(Net* net, const Net* order) {
	const JnGroup* group = &order->group;
	const int width = group->kernel->width;
	for (int e = 0; e < group->count; ++e) {
		const int lane = e % width, batch = e / width, i = jn_group_node(group, e, 0), j = jn_group_node(group, e, 1);
		const double rest = group->rest[batch * 2 * width + lane];
		if (group->rest[(batch * 2 + 1) * width + lane] == 0) continue;
		double *a = net->x + 3 * (ptrdiff_t)i, *b = net->x + 3 * (ptrdiff_t)j;
		const double length = sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
		const double wa = 1 / net->mass[i], wb = 1 / net->mass[j], pull = -(length - rest) / (wa + wb) / length;
		for (int axis = 0; axis < 3; ++axis) {
			const double d = a[axis] - b[axis];
			a[axis] += wa * pull * d;
			b[axis] -= wb * pull * d;
		}
	}
}

static void batches_relax_like_elements_one_behind_the_other(void** state) {
	(void)state;
	Net plain;
	net_create(&plain, 0, SPRINGS);
	Net order = plain;
	relax_one_by_one(&plain, &order);
	for (int width = 2; width <= MOST_LANES; width *= 2) {
		Net net;
		if (lanes(width) == 0) continue;
		net_create(&net, width, SPRINGS);
		relax(&net, 0, 1);
		for (int k = 0; k < 3 * NODES; ++k)
			expect_near(net.x[k], plain.x[k], 1e-13, "x"); // roundings of 120 projections
		net_free(&net);
	}
	net_free(&order);
}

static void rigid_projection_restores_the_length(void** state) {
	(void)state;
	Net net;
	net_create(&net, 0, 1);
	relax(&net, 0, 1);
	expect_near(length_of(&net, &net.springs[0]), net.springs[0].rest[0], 1e-15, "length"); // one rounding
	net_free(&net);
}

// C + alpha' lambda = 0 ends the sweeps, and lambda, which moved the nodes, is C0 / (w0 + w1 + alpha') [XPBD, equation 18].
static void compliant_projection_stops_where_lambda_balances_it(void** state) {
	(void)state;
	Net net;
	net_create(&net, 0, 1);
	const JnRelaxElement* spring = &net.springs[0];
	const double before = length_of(&net, spring) - spring->rest[0], compliance = 0.7;
	const double w = net.w[3 * spring->nodes[0]] + net.w[3 * spring->nodes[1]];
	relax(&net, compliance, 5);
	expect_near(net.lambda[0], -before / (w + compliance), 1e-15, "lambda"); // sums of a few roundings
	expect_near(length_of(&net, spring) - spring->rest[0], before * compliance / (w + compliance), 1e-15, "C");
	net_free(&net);
}

static void projections_keep_momentum_and_angular_momentum(void** state) {
	(void)state;
	Net net, old;
	net_create(&net, 0, 1);
	old = net;
	relax(&net, 0, 1);
	for (int a = 0; a < 3; ++a) {
		const int b = (a + 1) % 3, c = (a + 2) % 3;
		double p = 0, L = 0;
		for (int i = 0; i < NODES; ++i) {
			const double* x = old.x + 3 * (ptrdiff_t)i;
			double d[3];
			for (int k = 0; k < 3; ++k) d[k] = net.mass[i] * (net.x[3 * i + k] - x[k]);
			p += d[a];
			L += x[b] * d[c] - x[c] * d[b];
		}
		expect_near(p, 0, 1e-15, "sum m dx"); // roundings of numbers below 1
		expect_near(L, 0, 1e-15, "sum x x m dx");
	}
	assert_true(length_of(&net, &net.springs[0]) != length_of(&old, &old.springs[0]));
	net_free(&net);
}

// An element of six nodes with masses, moved by one projection of a kernel.
typedef struct Single {
	JnArena arena;
	JnGroup group;
	double x[18], before[18], w[18], mass[6], lambda[MOST_LANES];
} Single;

static void single_relax(Single* single, JnRelaxKernel which, const double* rest) {
	JnRelaxElement element = {.nodes = {0, 1, 2, 3, 4, 5}};
	memset(single, 0, sizeof *single);
	memcpy(element.rest, rest, JN_RELAX_MOST_REALS * sizeof *rest);
	for (int k = 0; k < 18; ++k) single->x[k] = random_real();
	for (int i = 0; i < 6; ++i) single->mass[i] = 0.5 + random_real();
	for (int k = 0; k < 18; ++k) single->w[k] = 1 / single->mass[k / 3];
	memcpy(single->before, single->x, sizeof single->x);
	assert_int_equal(jn_relax_group_create(jn_relax_kernel(which, 0), 1, &element, 0, &single->arena, &single->group),
					 JN_OK);
	const JnRelaxation how = {.inverse_mass = single->w, .factor = 1};
	for (int i = 0; i < 30; ++i)
		single->group.kernel->relax(&single->group, 0, single->group.batches, &how, single->x, single->lambda);
	jn_arena_free(&single->arena);
}

static void expect_centre_stays(const Single* single) {
	for (int a = 0; a < 3; ++a) {
		double p = 0;
		for (int i = 0; i < 6; ++i) p += single->mass[i] * (single->x[3 * i + a] - single->before[3 * i + a]);
		expect_near(p, 0, 1e-14, "sum m dx"); // roundings of 30 projections
	}
}

static void axis_becomes_as_long_as_at_rest_whatever_the_weights(void** state) {
	(void)state;
	static const double weights[2][3] = {{1, 0, 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
	for (int k = 0; k < 2; ++k) {
		const double* w = weights[k];
		const double rest[JN_RELAX_MOST_REALS] = {w[0], w[1], w[2], 0.8};
		double d[3] = {0};
		Single single;
		single_relax(&single, JN_RELAX_axis, rest);
		for (int i = 0; i < 9; ++i) d[i % 3] += w[i / 3] * (single.x[9 + i] - single.x[i]);
		expect_near(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), 0.8, 1e-14, "axis");
		expect_centre_stays(&single);
		assert_true(single.x[0] != single.before[0]);
		assert_true((single.x[3] != single.before[3]) == (w[1] != 0));
	}
}

static void volume_becomes_that_at_rest(void** state) {
	(void)state;
	static const double rests[2] = {0.1, -0.05};
	for (int k = 0; k < 2; ++k) {
		const double rest[JN_RELAX_MOST_REALS] = {rests[k]};
		Single single;
		single_relax(&single, JN_RELAX_volume, rest);
		const double* x = single.x;
		double d[3][3];
		for (int i = 0; i < 9; ++i) d[i / 3][i % 3] = x[i] - x[9 + i % 3];
		const double V =
			(d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) + d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
			 d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
			6;
		expect_near(V, rests[k], 1e-13, "volume"); // Newton's method on a cubic, in 30 iterations
		expect_centre_stays(&single);
	}
}

static void held_coordinates_stay(void** state) {
	(void)state;
	Net net, old;
	net_create(&net, 0, SPRINGS);
	for (int k = 0; k < 3 * NODES; k += 2) net.w[k] = 0;
	old = net;
	relax(&net, 0, 3);
	for (int k = 0; k < 3 * NODES; k += 2) assert_true(net.x[k] == old.x[k]);
	assert_true(net.x[1] != old.x[1]);
	net_free(&net);
}

static void springs_between_held_nodes_or_at_one_place_move_nothing(void** state) {
	(void)state;
	Net net, old;
	net_create(&net, 0, 2);
	memcpy(net.x + 3 * (ptrdiff_t)net.springs[0].nodes[0], net.x + 3 * (ptrdiff_t)net.springs[0].nodes[1],
		   3 * sizeof(double));
	for (int i = 0; i < 2; ++i)
		for (int a = 0; a < 3; ++a) net.w[3 * net.springs[1].nodes[i] + a] = 0;
	old = net;
	relax(&net, 0, 2);
	assert_memory_equal(net.x, old.x, sizeof net.x);
	net_free(&net);
}

static void strain_is_the_change_of_length_over_the_length_at_rest(void** state) {
	(void)state;
	Net net;
	double strain[MOST_LANES] = {0};
	net_create(&net, 0, 1);
	net.group.kernel->strain(&net.group, 0, 1, net.x, strain);
	expect_near(strain[0], length_of(&net, &net.springs[0]) / net.springs[0].rest[0] - 1, 1e-15, "strain");
	for (int lane = 1; lane < net.group.kernel->width; ++lane) assert_true(strain[lane] == 0); // padding
	net_free(&net);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(no_two_elements_of_a_batch_share_a_node_and_none_is_lost),
		cmocka_unit_test(a_node_may_have_any_number_of_elements),
		cmocka_unit_test(batches_relax_like_elements_one_behind_the_other),
		cmocka_unit_test(rigid_projection_restores_the_length),
		cmocka_unit_test(compliant_projection_stops_where_lambda_balances_it),
		cmocka_unit_test(projections_keep_momentum_and_angular_momentum),
		cmocka_unit_test(axis_becomes_as_long_as_at_rest_whatever_the_weights),
		cmocka_unit_test(volume_becomes_that_at_rest),
		cmocka_unit_test(held_coordinates_stay),
		cmocka_unit_test(springs_between_held_nodes_or_at_one_place_move_nothing),
		cmocka_unit_test(strain_is_the_change_of_length_over_the_length_at_rest),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
