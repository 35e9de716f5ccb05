/// @file multigrid_test.c
/// Smoothed aggregates as a preconditioner of matrices of boxes, threads and random graphs.
#include "model/system.h"
#include "solve/multigrid.h"
#include "support/model_case.h"
#include "support/random_cells.h"

enum { MOST = 100 };

// ---- boxes ----

typedef struct Box {
	Rig rig;
	JnOperator matrices;
	JnPrecondition* grid;
	const JnPattern* pattern;
	const bool* held;
	int slot, nodes;
} Box;

// A cube of n^3 cells with its z- face held, and of the x+ face only x; or free. h: the stage's part of the step; 0: no mass.
static void box_create(Box* box, int n, bool is_free, double h, int threads) {
	ModelCase c;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	for (int a = 0; a < 3; ++a) {
		c.box.size[a] = 0.4;
		c.box.cells[a] = n;
	}
	c.fix[1] = (JnFixDef){.where = face_select(FACE_X_HIGH), .axes = "x"};
	c.body.fix.count = is_free ? 0 : 2;
	rig_create(&box->rig, &c, threads);
	JnModelSystem* sys = (JnModelSystem*)box->rig.sys;
	JnMatrix* matrix = NULL;
	assert_int_equal(sys->base.ops->linearize(&sys->base, &box->rig.start), JN_OK);
	const JnShift shift = {.mass = h > 0, .stiffness = h > 0 ? h * h : 1};
	assert_int_equal(sys->base.ops->matrix(&sys->base, shift, &matrix), JN_OK);
	box->matrices = jn_model_matrix_operator(sys);
	box->pattern = &sys->model->pattern;
	box->held = sys->model->held;
	box->slot = ((JnModelMatrix*)matrix)->slot;
	box->nodes = box->rig.nodes;
	assert_int_equal(jn_precondition_multigrid.create(box->pattern, box->held, threads, &box->matrices, &box->grid),
					 JN_OK);
	assert_int_equal(jn_precondition_multigrid.update(box->grid, box->slot, true), JN_OK);
}

static void box_destroy(Box* box) {
	jn_precondition_multigrid.destroy(box->grid);
	rig_destroy(&box->rig);
}

static float* new_vector(int nodes) {
	float* out = aligned_alloc(64, (16 * (size_t)nodes / 64 + 1) * 64);
	assert_non_null(out);
	memset(out, 0, 16 * (size_t)nodes);
	return out;
}

static float* random_vector(int nodes, const bool* held, uint64_t seed) {
	float* out = new_vector(nodes);
	for (int k = 0; k < 3 * nodes; ++k) {
		const double number = random_number(&seed);
		out[k / 3 * 4 + k % 3] = held[k] ? 0 : (float)number;
	}
	return out;
}

static double dot(int nodes, const float* a, const float* b) {
	double sum = 0;
	for (int k = 0; k < 4 * nodes; ++k) sum += (double)a[k] * (double)b[k];
	return sum;
}

static double dot_wide(int count, const double* a, const double* b) {
	double sum = 0;
	for (int k = 0; k < count; ++k) sum += a[k] * b[k];
	return sum;
}

static void precondition(JnPrecondition* grid, int slot, int nodes, const double* r, double scale, double* z) {
	float *in = new_vector(nodes), *out = new_vector(nodes);
	for (int k = 0; k < 3 * nodes; ++k) in[k / 3 * 4 + k % 3] = (float)(r[k] / scale);
	jn_precondition_multigrid.apply(grid, slot, in, out);
	for (int k = 0; k < 3 * nodes; ++k) z[k] = scale * (double)out[k / 3 * 4 + k % 3];
	free(in);
	free(out);
}

// Conjugate gradients in double precision until the residual is 1e-4 of a random right-hand side.
static int iterations_of(const JnOperator* matrices, JnPrecondition* grid, int slot, int nodes, const bool* held) {
	const int n = 3 * nodes;
	double *r = malloc(4 * (size_t)n * sizeof *r), *z = r + n, *p = z + n, *q = p + n;
	uint64_t seed = 5;
	for (int k = 0; k < n; ++k) r[k] = held[k] ? 0 * random_number(&seed) : random_number(&seed);
	const double first = sqrt(dot_wide(n, r, r));
	double before = 0;
	int count = 0;
	for (; count < MOST && sqrt(dot_wide(n, r, r)) > 1e-4 * first; ++count) {
		precondition(grid, slot, nodes, r, first, z);
		const double rz = dot_wide(n, r, z);
		assert_true(rz > 0);
		for (int k = 0; k < n; ++k) p[k] = z[k] + (count > 0 ? rz / before * p[k] : 0);
		matrices->apply(matrices->user, slot, p, q);
		for (int k = 0; k < n; ++k) q[k] = held[k] ? 0 : q[k];
		const double alpha = rz / dot_wide(n, p, q);
		for (int k = 0; k < n; ++k) r[k] -= alpha * q[k];
		before = rz;
	}
	free(r);
	return count;
}

static void it_is_symmetric_and_positive_definite(void** state) {
	(void)state;
	static const double parts[] = {0, 5e-3, 0.2};
	for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
		Box box;
		box_create(&box, 7, false, parts[i], 1);
		assert_true(((const JnMultigrid*)box.grid)->used > 1 || parts[i] == 5e-3);
		for (uint64_t seed = 1; seed <= 3; ++seed) {
			float *x = random_vector(box.nodes, box.held, seed), *y = random_vector(box.nodes, box.held, seed + 10);
			float *Bx = new_vector(box.nodes), *By = new_vector(box.nodes);
			jn_precondition_multigrid.apply(box.grid, box.slot, x, Bx);
			jn_precondition_multigrid.apply(box.grid, box.slot, y, By);
			const double size = sqrt(dot(box.nodes, x, Bx) * dot(box.nodes, y, By));
			assert_true(dot(box.nodes, x, Bx) > 0 && dot(box.nodes, y, By) > 0);
			// some ten operations of single precision (6e-8) one after the other, errors of 1500 entries added up
			expect_near(dot(box.nodes, x, By) / size, dot(box.nodes, y, Bx) / size, 1e-5, "part %g", parts[i]);
			for (int k = 0; k < 3 * box.nodes; ++k)
				if (box.held[k]) assert_true(Bx[k / 3 * 4 + k % 3] == 0);
			free(x);
			free(y);
			free(Bx);
			free(By);
		}
		box_destroy(&box);
	}
}

// What the unknowns of an aggregate are in a rigid motion about the origin.
static float coarse_motion(const JnGridLevel* coarse, int j, int a, int motion) {
	const double *m = coarse->modes + 36 * j + 6 * a, *c = coarse->center + 3 * j;
	const double turned[] = {m[3] + m[2] * c[1] - m[1] * c[2], m[4] + m[0] * c[2] - m[2] * c[0],
							 m[5] + m[1] * c[0] - m[0] * c[1]};
	return (float)(motion < 3 ? m[motion] : turned[motion - 3]);
}

static void fine_motion(const double x[3], int motion, double out[3]) {
	const double moved[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -x[2], x[1]}, {x[2], 0, -x[0]}, {-x[1], x[0], 0}};
	memcpy(out, moved[motion], 3 * sizeof *out);
}

static void rigid_motions_of_a_free_body_come_from_the_coarser_level(void** state) {
	(void)state;
	Box box;
	box_create(&box, 7, true, 1, 1);
	const JnMultigrid* grid = (const JnMultigrid*)box.grid;
	const JnGridLevel *fine = &grid->levels[0], *coarse = fine + 1;
	assert_true(grid->used > 1);
	for (int motion = 0; motion < 6; ++motion) {
		float *e = new_vector(2 * coarse->nodes), *x = new_vector(box.nodes);
		for (int k = 0; k < 6 * coarse->nodes; ++k) e[k / 6 * 8 + k % 6] = coarse_motion(coarse, k / 6, k % 6, motion);
		grid->kernels->prolong(fine, e, 1, x, 1);
		double most = 0;
		for (int i = 0; i < box.nodes; ++i) {
			double expected[3];
			fine_motion(fine->center + 3 * i, motion, expected);
			for (int a = 0; a < 3; ++a) most = fmax(most, fabs((double)x[4 * i + a] - expected[a]));
		}
		// K of a rigid motion is rounding; the mass, 1e-5 of K or less for a step of 1 s, leaves its share
		expect_near(most, 0, 1e-4, "motion %d", motion);
		free(e);
		free(x);
	}
	box_destroy(&box);
}

static void iterations_do_not_grow_with_the_mesh(void** state) {
	(void)state;
	static const int cells[] = {6, 12, 16};
	static const double parts[] = {0, 0.05, 0.3};
	for (size_t i = 0; i < sizeof cells / sizeof *cells; ++i)
		for (size_t p = 0; p < sizeof parts / sizeof *parts; ++p) {
			Box box;
			box_create(&box, cells[i], false, parts[p], 1);
			const int count = iterations_of(&box.matrices, box.grid, box.slot, box.nodes, box.held);
			// measured: 5 to 8, where diagonal blocks take 188 for 16^3 without mass
			if (count > 10) fail_msg("%d cells an edge, part %g: %d iterations, most 10", cells[i], parts[p], count);
			box_destroy(&box);
		}
}

static void the_number_of_threads_changes_no_bit(void** state) {
	(void)state;
	float* found[2];
	int nodes = 0;
	for (int i = 0; i < 2; ++i) {
		Box box;
		box_create(&box, 12, false, 0.1, 1 + 2 * i); // 2197 nodes: four times what wakes a thread
		nodes = box.nodes;
		float* x = random_vector(box.nodes, box.held, 3);
		found[i] = new_vector(box.nodes);
		jn_precondition_multigrid.apply(box.grid, box.slot, x, found[i]);
		free(x);
		box_destroy(&box);
	}
	assert_memory_equal(found[0], found[1], 16 * (size_t)nodes);
	free(found[0]);
	free(found[1]);
}

static void levels_are_few_where_mass_outweighs_stiffness(void** state) {
	(void)state;
	Box box;
	box_create(&box, 8, false, 1e-4, 1);
	assert_int_equal(((const JnMultigrid*)box.grid)->used, 1);
	box_destroy(&box);
}

// ---- graphs without a mesh behind them ----

typedef struct Graph {
	RandomCells cells;
	double* blocks[2]; // of two slots
	double diagonal[9 * MOST];
} Graph;

static void graph_apply(void* user, int slot, const double* in, double* out) {
	const Graph* g = user;
	memset(out, 0, 3 * (size_t)g->cells.pattern.nodes * sizeof *out);
	jn_blocks_apply(&g->cells.pattern, g->blocks[slot], 1, in, out, 1);
}

static const double* graph_blocks(void* user, int slot) {
	return ((const Graph*)user)->blocks[slot];
}

static const double* graph_diagonal(void* user, int slot) {
	Graph* g = user;
	for (int i = 0; i < g->cells.pattern.nodes; ++i)
		memcpy(g->diagonal + 9 * i, g->blocks[slot] + 9 * g->cells.pattern.column_start[i], 9 * sizeof(double));
	return g->diagonal;
}

static JnOperator graph_operator(Graph* g) {
	return (JnOperator){.user = g, .apply = graph_apply, .blocks = graph_blocks, .diagonal = graph_diagonal};
}

// Random blocks; the second slot is four times the first. shift: larger than the entries of a row make dominant.
static void graph_create(Graph* g, int nodes, int cells, double shift) {
	cells_create(&g->cells, nodes, cells, 7);
	cells_shift(&g->cells, shift);
	const size_t count = 9 * (size_t)g->cells.pattern.blocks;
	g->blocks[0] = g->cells.blocks;
	g->blocks[1] = jn_arena_take(&g->cells.arena, count, sizeof(double));
	for (size_t k = 0; k < count; ++k) g->blocks[1][k] = 4 * g->blocks[0][k];
}

// Held: all or none, or every seventh entry. Without positions, so that aggregates have translations alone.
static void any_graph_is_served(void** state) {
	(void)state;
	for (int every = 1; every <= 7; every += 3)
		for (int cells = 0; cells <= 60; cells += 12) {
			Graph g;
			bool held[3 * MOST];
			for (int k = 0; k < 3 * MOST; ++k) held[k] = k % every == 0;
			graph_create(&g, MOST, cells, 150); // no row has more than 99 neighbours of 3 entries, few a tenth of them
			const JnOperator matrices = graph_operator(&g);
			JnPrecondition* grid = NULL;
			assert_int_equal(jn_precondition_multigrid.create(&g.cells.pattern, held, 1, &matrices, &grid), JN_OK);
			assert_int_equal(jn_precondition_multigrid.update(grid, 0, true), JN_OK);
			const int count = iterations_of(&matrices, grid, 0, MOST, held);
			if (count > 20) fail_msg("%d cells, held every %d: %d iterations, most 20", cells, every, count);
			jn_precondition_multigrid.destroy(grid);
			jn_arena_free(&g.cells.arena);
		}
}

// Nodes in a row, joined like links of a chain: blocks of a rod that may turn about itself.
static void chain_create(Graph* g, JnCellList* list, int links[2 * MOST]) {
	*g = (Graph){0};
	for (int k = 0; k < 2 * (MOST - 1); ++k) links[k] = (k + 1) / 2;
	*list = (JnCellList){.count = MOST - 1, .nodes = 2, .cells = links};
	assert_int_equal(jn_pattern_create(MOST, 1, list, &g->cells.arena, &g->cells.pattern), JN_OK);
	g->blocks[0] = jn_arena_take(&g->cells.arena, (size_t)g->cells.pattern.blocks, 9 * sizeof(double));
	for (int j = 0; j < MOST; ++j)
		for (int k = g->cells.pattern.column_start[j]; k < g->cells.pattern.column_start[j + 1]; ++k)
			for (int a = 0; a < 3; ++a) g->blocks[0][9 * k + 4 * a] = g->cells.pattern.row[k] == j ? 2.001 : -1;
}

static void aggregates_in_a_line_lack_a_rotation(void** state) {
	(void)state;
	Graph g;
	JnCellList list;
	int links[2 * MOST];
	bool held[3 * MOST] = {true, true, true};
	double positions[3 * MOST] = {0};
	for (int i = 0; i < MOST; ++i) positions[3 * i] = 0.01 * i;
	chain_create(&g, &list, links);
	JnOperator matrices = graph_operator(&g);
	matrices.rest = positions;
	JnPrecondition* grid = NULL;
	assert_int_equal(jn_precondition_multigrid.create(&g.cells.pattern, held, 1, &matrices, &grid), JN_OK);
	assert_int_equal(jn_precondition_multigrid.update(grid, 0, true), JN_OK);
	const JnMultigrid* levels = (const JnMultigrid*)grid;
	assert_true(levels->used > 1);
	for (int j = 0; j < levels->levels[1].nodes; ++j)
		assert_true(levels->levels[1].modes[36 * j + 7 * 3] == 0); // about the line
	const int count = iterations_of(&matrices, grid, 0, MOST, held);
	if (count > 15) fail_msg("%d iterations, most 15", count); // its diagonal blocks take 100
	jn_precondition_multigrid.destroy(grid);
	jn_arena_free(&g.cells.arena);
}

static void levels_of_another_slot_are_scaled(void** state) {
	(void)state;
	Graph g;
	bool held[3 * MOST] = {false};
	graph_create(&g, MOST, 60, 150);
	const JnOperator matrices = graph_operator(&g);
	JnPrecondition* grid = NULL;
	assert_int_equal(jn_precondition_multigrid.create(&g.cells.pattern, held, 1, &matrices, &grid), JN_OK);
	assert_int_equal(jn_precondition_multigrid.update(grid, 0, true), JN_OK);
	assert_int_equal(jn_precondition_multigrid.update(grid, 1, false), JN_OK);
	float *x = random_vector(MOST, held, 1), *one = new_vector(MOST), *four = new_vector(MOST);
	jn_precondition_multigrid.apply(grid, 0, x, one);
	jn_precondition_multigrid.apply(grid, 1, x, four);
	for (int k = 0; k < 4 * MOST;
		 ++k) // entries are some 1/150, the two estimates of the eigenvalue differ by per cents
		expect_near(4 * (double)four[k], (double)one[k], 2e-3, "entry %d", k);
	free(x);
	free(one);
	free(four);
	jn_precondition_multigrid.destroy(grid);
	jn_arena_free(&g.cells.arena);
}

static void a_negative_diagonal_block_is_indefinite(void** state) {
	(void)state;
	Graph g;
	bool held[3 * MOST] = {false};
	graph_create(&g, MOST, 20, 150);
	g.blocks[0][9 * g.cells.pattern.column_start[50]] = -1;
	const JnOperator matrices = graph_operator(&g);
	JnPrecondition* grid = NULL;
	assert_int_equal(jn_precondition_multigrid.create(&g.cells.pattern, held, 1, &matrices, &grid), JN_OK);
	assert_int_equal(jn_precondition_multigrid.update(grid, 0, true), JN_INDEFINITE);
	jn_precondition_multigrid.destroy(grid);
	jn_arena_free(&g.cells.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(it_is_symmetric_and_positive_definite),
		cmocka_unit_test(rigid_motions_of_a_free_body_come_from_the_coarser_level),
		cmocka_unit_test(iterations_do_not_grow_with_the_mesh),
		cmocka_unit_test(the_number_of_threads_changes_no_bit),
		cmocka_unit_test(levels_are_few_where_mass_outweighs_stiffness),
		cmocka_unit_test(any_graph_is_served),
		cmocka_unit_test(aggregates_in_a_line_lack_a_rotation),
		cmocka_unit_test(levels_of_another_slot_are_scaled),
		cmocka_unit_test(a_negative_diagonal_block_is_indefinite),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
