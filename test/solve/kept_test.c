/// @file kept_test.c
/// Factors that are carried along, and the solver that chooses among them. A body that has only turned is solved as if it had not, whatever its shape.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "solve/kept.h"
#include "solve/node_rotation.h"
#include "solve/precondition.h"
#include "solve/solver.h"
#include "support/support.h"

enum { MOST_NODES = 216 };

/// Points on a grid, joined to all neighbours: masses and stretched springs, whose matrix turns with the positions.
typedef struct Net {
	JnArena arena;
	JnPattern pattern;
	int nodes, sizes[3];
	double x[3 * MOST_NODES], blocks[9 * 14 * MOST_NODES], diagonal[9 * MOST_NODES];
	bool held[3 * MOST_NODES];
} Net;

static int node_at(const Net* net, int i, int j, int k) {
	return i + net->sizes[0] * (j + net->sizes[1] * k);
}

static int clip(int i, int size) {
	return i < size - 1 ? i : size - 1;
}

// Cells of 2 x 2 x 2 nodes, fewer where the grid is thin.
static void build_pattern(Net* net) {
	static int cells[8 * MOST_NODES];
	int count = 0;
	const int* n = net->sizes;
	for (int k = 0; k < (n[2] > 1 ? n[2] - 1 : 1); ++k)
		for (int j = 0; j < (n[1] > 1 ? n[1] - 1 : 1); ++j)
			for (int i = 0; i < (n[0] > 1 ? n[0] - 1 : 1); ++i, ++count)
				for (int c = 0; c < 8; ++c)
					cells[8 * count + c] =
						node_at(net, clip(i + c % 2, n[0]), clip(j + c / 2 % 2, n[1]), clip(k + c / 4, n[2]));
	const JnCellList list = {.count = count, .nodes = 8, .cells = cells};
	assert_int_equal(jn_pattern_create(net->nodes, 1, &list, &net->arena, &net->pattern), JN_OK);
}

// A spring of stiffness `along`, and `across` it: along n n' + across (1 - n n').
static void spring(const double d[3], double block[9]) {
	const double along = 1000, across = 100, square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
	for (int e = 0; e < 9; ++e) block[e] = (along - across) * d[e / 3] * d[e % 3] / square + (e % 4 == 0 ? across : 0);
}

static void fill_blocks(Net* net) {
	const JnPattern* pattern = &net->pattern;
	memset(net->blocks, 0, sizeof net->blocks);
	for (int node = 0; node < net->nodes; ++node)
		for (int e = 0; e < 9; e += 4) net->blocks[9 * pattern->column_start[node] + e] += 1;
	for (int node = 0; node < net->nodes; ++node)
		for (int k = pattern->column_start[node] + 1; k < pattern->column_start[node + 1]; ++k) {
			const int other = pattern->row[k];
			double block[9], d[3];
			for (int a = 0; a < 3; ++a) d[a] = net->x[3 * other + a] - net->x[3 * node + a];
			spring(d, block);
			for (int e = 0; e < 9; ++e) {
				net->blocks[9 * k + e] -= block[e];
				net->blocks[9 * pattern->column_start[node] + e] += block[e];
				net->blocks[9 * pattern->column_start[other] + e] += block[e];
			}
		}
}

static void net_create(Net* net, int nx, int ny, int nz) {
	*net = (Net){.nodes = nx * ny * nz, .sizes = {nx, ny, nz}};
	build_pattern(net);
	for (int k = 0; k < nz; ++k)
		for (int j = 0; j < ny; ++j)
			for (int i = 0; i < nx; ++i) {
				const int node = node_at(net, i, j, k);
				const double at[3] = {i, j + (nz > 1 ? 0.1 * i * i : 0), k};
				for (int a = 0; a < 3; ++a) {
					net->x[3 * node + a] = at[a];
					net->held[3 * node + a] = i == 0;
				}
			}
	fill_blocks(net);
}

// About an axis that is no axis of the grid.
static void turn(Net* net, double angle) {
	const double n[3] = {0.48, 0.6, 0.64}, c = cos(angle), s = sin(angle);
	for (int node = 0; node < net->nodes; ++node) {
		double* x = net->x + 3 * node;
		const double along = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
		const double cross[3] = {n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]};
		const double from[3] = {x[0], x[1], x[2]};
		for (int a = 0; a < 3; ++a) x[a] = c * from[a] + s * cross[a] + (1 - c) * along * n[a];
	}
	fill_blocks(net);
}

static void multiply(void* user, int slot, const double* in, double* out) {
	Net* net = user;
	(void)slot;
	memset(out, 0, 3 * (size_t)net->nodes * sizeof *out);
	jn_blocks_apply(&net->pattern, net->blocks, 1, in, out, 1);
}

static const double* blocks_of(void* user, int slot) {
	(void)slot;
	return ((Net*)user)->blocks;
}

static const double* diagonal_of(void* user, int slot) {
	Net* net = user;
	(void)slot;
	for (int node = 0; node < net->nodes; ++node)
		memcpy(net->diagonal + 9 * node, net->blocks + 9 * net->pattern.column_start[node], 9 * sizeof(double));
	return net->diagonal;
}

static const double* positions_of(void* user, int slot) {
	(void)slot;
	return ((Net*)user)->x;
}

static JnSolver* new_solver(Net* net, JnWay way) {
	static JnCgDef defs[JN_WAY_COUNT];
	JnSolver* cg = NULL;
	defs[way] = (JnCgDef){.tolerance = 1e-6, .max_iterations = 500, .precondition = way};
	assert_int_equal(jn_solver_cg.create(&defs[way], &net->pattern, net->held, 1, &cg), JN_OK);
	jn_solver_cg.attach(
		cg,
		(JnOperator){
			.user = net, .apply = multiply, .diagonal = diagonal_of, .blocks = blocks_of, .positions = positions_of});
	return cg;
}

static int iterations_for(JnSolver* cg, int nodes) {
	double rhs[3 * MOST_NODES];
	for (int k = 0; k < 3 * nodes; ++k) rhs[k] = sin(1.7 * k);
	assert_int_equal(cg->type->factor(cg, 0, NULL), JN_OK);
	assert_int_equal(cg->type->solve(cg, 0, rhs, rhs), JN_OK);
	return cg->iterations;
}

static void check_turns(int nx, int ny, int nz, const char* what) {
	static Net net;
	static const double angles[] = {0.1, 1, 2, -1.5, -0.5, 0.01};
	net_create(&net, nx, ny, nz);
	JnSolver* cg = new_solver(&net, JN_WAY_KEPT);
	const int at_rest = iterations_for(cg, net.nodes);
	assert_in_range(at_rest, 1, 2); // its own factor, in single precision
	for (size_t i = 0; i < sizeof angles / sizeof *angles; ++i) {
		turn(&net, angles[i]);
		const int turned = iterations_for(cg, net.nodes); // rotations are found to 1e-3, which leaves three digits each
		if (turned > 4) fail_msg("%s turned by %g: %d iterations, %d at rest", what, angles[i], turned, at_rest);
	}
	cg->type->destroy(cg);
	jn_arena_free(&net.arena);
}

static void a_turned_body_is_solved_as_if_it_had_not(void** state) {
	(void)state;
	check_turns(6, 6, 6, "block");
	check_turns(20, 8, 1, "sheet");
	check_turns(60, 1, 1, "thread");
}

// Eliminating a thread from end to end fills nothing in: the incomplete factor is a complete one.
static void an_incomplete_factor_of_a_thread_is_complete(void** state) {
	(void)state;
	static Net net;
	net_create(&net, 60, 1, 1);
	JnSolver* cg = new_solver(&net, JN_WAY_INCOMPLETE);
	assert_in_range(iterations_for(cg, net.nodes), 1, 2); // rounding of single precision
	turn(&net, 2);
	assert_in_range(iterations_for(cg, net.nodes), 1, 4);
	cg->type->destroy(cg);
	jn_arena_free(&net.arena);
}

static void an_incomplete_factor_halves_the_iterations_at_least(void** state) {
	(void)state;
	static Net net;
	net_create(&net, 6, 6, 6);
	JnSolver *block = new_solver(&net, JN_WAY_BLOCK), *incomplete = new_solver(&net, JN_WAY_INCOMPLETE);
	const int with_block = iterations_for(block, net.nodes), with_factor = iterations_for(incomplete, net.nodes);
	if (2 * with_factor > with_block) fail_msg("%d iterations, %d with diagonal blocks", with_factor, with_block);
	turn(&net, 1);
	assert_in_range(iterations_for(incomplete, net.nodes), 1, with_factor + 2);
	block->type->destroy(block);
	incomplete->type->destroy(incomplete);
	jn_arena_free(&net.arena);
}

// Whatever is refused, the answer is the same.
static void auto_without_memory_for_a_factor_solves_all_the_same(void** state) {
	(void)state;
	static Net net;
	static const JnCgDef defs[2] = {{.tolerance = 1e-10, .max_iterations = 500},
									{.tolerance = 1e-10, .max_iterations = 500, .memory = 1}};
	double x[2][3 * MOST_NODES];
	net_create(&net, 4, 4, 4); // few enough for a factor at once
	for (int which = 0; which < 2; ++which) {
		JnSolver* solver = NULL;
		assert_int_equal(jn_solver_auto.create(&defs[which], &net.pattern, net.held, 1, &solver), JN_OK);
		for (int k = 0; k < 3 * net.nodes; ++k) x[which][k] = sin(1.7 * k);
		assert_int_equal(solver->type->factor(solver, 0, net.blocks), JN_OK);
		assert_int_equal(solver->type->solve(solver, 0, x[which], x[which]), JN_OK);
		assert_true((solver->way == JN_WAY_DIRECT) == (which == 0) && solver->way != JN_WAY_KEPT);
		assert_true(solver->is_iterative == (which == 1));
		solver->type->destroy(solver);
	}
	for (int k = 0; k < 3 * net.nodes; ++k) // solutions are some 0.1, the smallest eigenvalue is above 1
		if (!(fabs(x[0][k] - x[1][k]) <= 1e-8)) fail_msg("entry %d: %.17g and %.17g", k, x[0][k], x[1][k]);
	jn_arena_free(&net.arena);
}

// Once it has spent enough auto wants to know what a factor would cost, and is told that there is no room for one: once.
static void a_factor_that_is_too_large_is_asked_for_once(void** state) {
	(void)state;
	static Net net;
	static const JnCgDef def = {.tolerance = 1e-8, .max_iterations = 500, .memory = 1};
	static double x[3 * MOST_NODES];
	JnSolver* solver = NULL;
	net_create(&net, 6, 6, 6);
	assert_int_equal(jn_solver_cg.create(&def, &net.pattern, net.held, 1, &solver), JN_OK);
	log_capture();
	for (int i = 0; i < 2000; ++i) {
		for (int k = 0; k < 3 * net.nodes; ++k) x[k] = sin(1.7 * k + i);
		assert_int_equal(solver->type->factor(solver, 0, net.blocks), JN_OK);
		assert_int_equal(solver->type->solve(solver, 0, x, x), JN_OK);
		assert_true(solver->way != JN_WAY_KEPT && solver->way != JN_WAY_DIRECT);
	}
	log_release();
	const char* first = strstr(log_text(), "none is made");
	assert_non_null(first);
	assert_null(strstr(first + 1, "none is made"));
	solver->type->destroy(solver);
	jn_arena_free(&net.arena);
}

// In single precision, half of what the factor takes in double; the incomplete one has the entries of the matrix.
static void preconditioners_tell_what_they_keep(void** state) {
	(void)state;
	static Net net;
	net_create(&net, 6, 6, 6);
	const JnOperator matrices = {.user = &net, .apply = multiply, .diagonal = diagonal_of, .blocks = blocks_of};
	static const JnPreconditionType* const types[] = {&jn_precondition_block, &jn_precondition_incomplete,
													  &jn_precondition_kept};
	size_t bytes[3];
	for (int k = 0; k < 3; ++k) {
		JnPrecondition* made = NULL;
		assert_int_equal(types[k]->create(&net.pattern, net.held, 1, &matrices, &made), JN_OK);
		assert_int_equal(types[k]->update(made, 0, true), JN_OK);
		bytes[k] = types[k]->bytes(made);
		if (k == 2) assert_int_equal(bytes[k], jn_solver_direct.cost(jn_kept_direct(made)).bytes / 2);
		types[k]->destroy(made);
	}
	assert_true(bytes[0] > 0);
	assert_int_equal(bytes[1] / bytes[0], net.pattern.blocks / net.nodes);
	assert_true(bytes[2] > bytes[1]); // it fills in
	jn_arena_free(&net.arena);
}

static void without_positions_the_factor_is_soon_useless(void** state) {
	(void)state;
	static Net net;
	static const JnCgDef def = {.tolerance = 1e-6, .max_iterations = 500, .precondition = JN_WAY_KEPT};
	JnSolver* cg = NULL;
	net_create(&net, 6, 6, 6);
	assert_int_equal(jn_solver_cg.create(&def, &net.pattern, net.held, 1, &cg), JN_OK);
	jn_solver_cg.attach(cg,
						(JnOperator){.user = &net, .apply = multiply, .diagonal = diagonal_of, .blocks = blocks_of});
	iterations_for(cg, net.nodes);
	turn(&net, 1);
	assert_true(iterations_for(cg, net.nodes) > 20);
	cg->type->destroy(cg);
	jn_arena_free(&net.arena);
}

// An angle of 2.9 at once, a plane folded over, points on one another: no number may be lost.
static void rotations_stay_finite(void** state) {
	(void)state;
	static Net net;
	JnNodeRotation rotation;
	net_create(&net, 12, 12, 1);
	assert_int_equal(jn_node_rotation_create(&rotation, &net.pattern, net.held, 1), JN_OK);
	jn_node_rotation_begin(&rotation, net.x);
	for (int shape = 0; shape < 3; ++shape) {
		for (int node = 0; node < net.nodes; ++node)
			net.x[3 * node + shape] = shape < 2 ? fabs(net.x[3 * node + shape] - 5) : 0 * net.x[3 * node];
		if (shape == 2) memset(net.x, 0, sizeof net.x);
		jn_node_rotation_follow(&rotation, net.x);
		for (int node = 0; node < net.nodes; ++node)
			for (int r = 0; r < 3; ++r)
				for (int c = 0; c < 3; ++c) {
					double dot = 0; // of two columns
					for (int k = 0; k < 3; ++k)
						dot +=
							(double)rotation.turn[12 * node + 4 * r + k] * (double)rotation.turn[12 * node + 4 * c + k];
					assert_true(fabs(dot - (r == c)) < 1e-5); // roundings of single precision
				}
	}
	jn_node_rotation_destroy(&rotation);
	jn_arena_free(&net.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_turned_body_is_solved_as_if_it_had_not),
		cmocka_unit_test(an_incomplete_factor_of_a_thread_is_complete),
		cmocka_unit_test(an_incomplete_factor_halves_the_iterations_at_least),
		cmocka_unit_test(auto_without_memory_for_a_factor_solves_all_the_same),
		cmocka_unit_test(a_factor_that_is_too_large_is_asked_for_once),
		cmocka_unit_test(preconditioners_tell_what_they_keep),
		cmocka_unit_test(without_positions_the_factor_is_soon_useless),
		cmocka_unit_test(rotations_stay_finite),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
