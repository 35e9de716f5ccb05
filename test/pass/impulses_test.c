/// @file impulses_test.c
/// Blocks of impulses between lumped masses against what mechanics says, in whatever order they are given.
#include "pass/impulses.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "support/support.h"

enum { NODES = 4, ENTRIES = 3 * NODES };

// Node 3 is held.
static const double masses[NODES] = {1, 2, 4, INFINITY};

static void invert(double inverse[ENTRIES]) {
	for (int k = 0; k < ENTRIES; ++k) inverse[k] = 1 / masses[k / 3];
}

/// Node `a` may not come nearer to node `b` along the axis x.
static void add(JnImpulses* set, uint64_t id, int a, int b, double friction) {
	JnBlock* block;
	assert_int_equal(jn_impulses_add(set, id, JN_BLOCK_CONTACT, 2, &block), JN_OK);
	set->entries[block->first] = (JnBlockEntry){a, {1, 1}};
	set->entries[block->first + 1] = (JnBlockEntry){b, {-1, -1}};
	block->frame[0][0] = 1;
	jn_block_complete_frame(block->frame);
	block->friction = friction;
	block->is_active = true;
}

static const JnBlock* block_of(const JnImpulses* set, uint64_t id) {
	for (int i = 0; i < set->count; ++i)
		if (set->blocks[i].id == id) return &set->blocks[i];
	fail_msg("no block %d", (int)id);
	return NULL;
}

static int solve(JnImpulses* set, double v[ENTRIES]) {
	double inverse[ENTRIES];
	invert(inverse);
	jn_impulses_finish(set, inverse);
	return jn_impulses_solve(set, JN_LEVEL_VELOCITY, inverse, 1000, 0, v);
}

// lambda = (relative speed) m1 m2 / (m1 + m2), and both go on with the speed of their centre.
static void two_masses_that_meet_share_their_momentum(void** state) {
	(void)state;
	JnImpulses set = {0};
	double v[ENTRIES] = {-3, 0, 0, 3, 0, 0};
	add(&set, 7, 0, 1, 0);
	solve(&set, v);
	assert_true(fabs(set.blocks[0].impulse[JN_LEVEL_VELOCITY][0] - 6 * 2.0 / 3) <
				1e-14); // rounding of three operations
	assert_true(fabs(v[0] - 1) < 1e-14 && fabs(v[3] - 1) < 1e-14);
	jn_impulses_release(&set);
}

// A row of masses that is pushed together, in four orders of its contacts: the same sweeps, and the same bits.
static void the_order_of_blocks_does_not_matter(void** state) {
	(void)state;
	static const int orders[4][3] = {{1, 2, 3}, {3, 2, 1}, {2, 3, 1}, {3, 1, 2}};
	double expected[ENTRIES];
	for (int o = 0; o < 4; ++o) {
		JnImpulses set = {0};
		double v[ENTRIES] = {-3, 1, 0, -2, 0, 1, -1, 0, 0, 0, 0, 0}; // nodes 0, 1, 2 run into 3, one behind the other
		for (int k = 0; k < 3; ++k) {
			const int id = orders[o][k];
			add(&set, (uint64_t)id, id - 1, id == 3 ? 3 : id, 0.1 * id);
		}
		solve(&set, v);
		for (int k = 0; k < 3; ++k) assert_int_equal(set.blocks[k].id, k + 1);
		if (o == 0) memcpy(expected, v, sizeof v);
		assert_memory_equal(v, expected, sizeof v);
		jn_impulses_release(&set);
	}
	// Gauss-Seidel ends within rounding of its fixed point: all stand still along x, before what is held
	for (int node = 0; node < NODES; ++node) assert_true(fabs(expected[3 * node]) < 1e-12);
}

// |lambda_t| = mu lambda_n while it slides: dv = mu lambda_n / m across.
static void friction_takes_its_share_of_the_normal_impulse(void** state) {
	(void)state;
	JnImpulses set = {0};
	double v[ENTRIES] = {-3, 2, 0};
	add(&set, 1, 0, 3, 0.25);
	solve(&set, v);
	assert_true(fabs(v[0]) < 1e-14);
	assert_true(fabs(v[1] - (2 - 0.25 * 3)) < 1e-14);
	double sticking[ENTRIES] = {-3, 0.5, 0};
	memset(set.blocks[0].impulse, 0, sizeof set.blocks[0].impulse);
	solve(&set, sticking);
	assert_true(fabs(sticking[1]) < 1e-14); // 0.25 * 3 is more than 0.5
	jn_impulses_release(&set);
}

static void what_cannot_move_takes_no_impulse(void** state) {
	(void)state;
	JnImpulses set = {0};
	double v[ENTRIES] = {0};
	v[9] = -5; // held, and driven against itself
	add(&set, 1, 3, 3, 0.5);
	add(&set, 2, 0, 1, 0.5);
	v[0] = -1;
	solve(&set, v);
	for (int r = 0; r < 3; ++r) assert_true(block_of(&set, 1)->impulse[JN_LEVEL_VELOCITY][r] == 0);
	assert_true(v[9] == -5);
	assert_true(fabs(v[0] - v[3]) < 1e-14);
	jn_impulses_release(&set);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(two_masses_that_meet_share_their_momentum),
		cmocka_unit_test(the_order_of_blocks_does_not_matter),
		cmocka_unit_test(friction_takes_its_share_of_the_normal_impulse),
		cmocka_unit_test(what_cannot_move_takes_no_impulse),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
