/// @file half_test.c
/// Halves of sparse right-hand sides against solutions: their dot products are those of the inverse.
#include "solve/half.h"

#include "solve/qp_case.h"
#include "support/random_cells.h"

enum { COLUMNS = 40, PER_COLUMN = 5, FIRST_CALL = 25, STRIDE = COLUMNS + 7 };

typedef struct Sparse {
	int start[COLUMNS + 1], entry[COLUMNS * PER_COLUMN];
	double value[COLUMNS * PER_COLUMN];
} Sparse;

// Column 3 has no entries, column 5 names one entry twice, and every fourth column repeats the entries of the one before.
static void fill_sparse(Sparse* s, int entries, uint64_t seed) {
	s->start[0] = 0;
	for (int j = 0; j < COLUMNS; ++j) {
		s->start[j + 1] = s->start[j] + (j == 3 ? 0 : PER_COLUMN);
		for (int k = s->start[j]; k < s->start[j + 1]; ++k) {
			const int any = (int)(0.5 * (random_number(&seed) + 1) * entries) % entries;
			s->entry[k] = j % 4 == 1 ? s->entry[k - PER_COLUMN] : any;
			s->value[k] = random_number(&seed);
		}
	}
	s->entry[s->start[5] + 1] = s->entry[s->start[5]];
}

static void spread(const Sparse* s, int j, int entries, double* out) {
	memset(out, 0, (size_t)entries * sizeof *out);
	for (int k = s->start[j]; k < s->start[j + 1]; ++k) out[s->entry[k]] += s->value[k];
}

static double product(const Sparse* s, int i, const double* x) {
	double sum = 0;
	for (int k = s->start[i]; k < s->start[i + 1]; ++k) sum += s->value[k] * x[s->entry[k]];
	return sum;
}

static void append(JnSolver* solver, const Sparse* s, int first, int last, JnHalf* half) {
	int start[COLUMNS + 1];
	for (int j = first; j <= last; ++j) start[j - first] = s->start[j] - s->start[first];
	const JnColumns columns = {last - first, start, s->entry + s->start[first], s->value + s->start[first]};
	assert_int_equal(jn_solver_direct.half(solver, 0, &columns, half), JN_OK);
}

static void expect_products(JnSolver* solver, int entries, JnHalf* half, const char* what) {
	Sparse s;
	fill_sparse(&s, entries, 17);
	double *products = calloc((size_t)STRIDE * STRIDE, sizeof *products),
		   *rhs = calloc(2 * (size_t)entries, sizeof *rhs), *x = rhs + entries, size[COLUMNS];
	jn_half_clear(half);
	append(solver, &s, 0, FIRST_CALL, half);
	assert_int_equal(jn_half_products(half, 0, STRIDE, products), JN_OK);
	append(solver, &s, FIRST_CALL, COLUMNS, half);
	assert_int_equal(half->count, COLUMNS);
	assert_int_equal(jn_half_products(half, FIRST_CALL, STRIDE, products), JN_OK);
	for (int j = 0; j < COLUMNS; ++j) size[j] = sqrt(products[j * (STRIDE + 1)]);
	for (int j = 0; j < COLUMNS; ++j) {
		spread(&s, j, entries, rhs);
		assert_int_equal(jn_solver_direct.solve(solver, 0, rhs, x), JN_OK);
		for (int i = j; i < COLUMNS; ++i) // rounding in matrices conditioned better than 1e3
			expect_near(products[i + STRIDE * j], product(&s, i, x), 1e-12 * size[i] * size[j], "%s, %d and %d", what,
						i, j);
	}
	free(products);
	free(rhs);
}

static void halves_of_boxes_multiply_to_the_inverse(void** state) {
	(void)state;
	JnHalf half = {0}; // used again for another matrix
	for (int clamp = 0; clamp < 2; ++clamp) {
		QpCase c;
		qp_case_boxes(&c, (QpBoxes){{5, 4, 6}, 2, 0.01, 1e5, clamp ? FACE_Z_LOW : FACE_NONE});
		expect_products(c.solver, 3 * c.pattern.nodes, &half, clamp ? "clamped boxes" : "free boxes");
		qp_case_destroy(&c);
	}
	jn_half_release(&half);
}

static void halves_drop_what_is_held(void** state) {
	(void)state;
	enum { NODES = 60, CELLS = 50 };
	JnHalf half = {0};
	for (uint64_t seed = 1; seed <= 4; ++seed) {
		RandomCells r;
		bool held[3 * NODES];
		for (int k = 0; k < 3 * NODES; ++k) held[k] = k % 7 == 0 || k / 3 % 5 == (int)seed;
		cells_create(&r, NODES, CELLS, seed);
		cells_shift(&r, 120); // dominant: no row has more than 59 neighbours of 3 entries, and few have a third as many
		JnSolver* solver = NULL;
		assert_int_equal(jn_solver_direct.create(&(JnDirectDef){0}, &r.pattern, held, 1, &solver), JN_OK);
		assert_int_equal(jn_solver_direct.factor(solver, 0, r.blocks), JN_OK);
		expect_products(solver, 3 * NODES, &half, "random cells");
		jn_solver_direct.destroy(solver);
		jn_arena_free(&r.arena);
	}
	jn_half_release(&half);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(halves_of_boxes_multiply_to_the_inverse),
		cmocka_unit_test(halves_drop_what_is_held),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
