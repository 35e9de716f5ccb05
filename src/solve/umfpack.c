// Sparse LU by UMFPACK (Davis 2004), for matrices whose pattern is symmetric while their numbers are not.
//
// The blocks come row by row, so that the free entries are stored by rows: UMFPACK, which reads columns, is given the
// transpose and solves with the transpose of that. METIS orders rows and columns alike; pivots off the diagonal are taken
// only where the diagonal is far too small.
#include <stdlib.h>
#include <umfpack.h>

#include "base/log.h"
#include "solve/blas.h"
#include "solve/solver.h"

typedef SuiteSparse_long Long;

typedef struct Lu {
	JnSolver base;
	const JnPattern* pattern;
	Long count;          // free entries
	Long* index;         // entry 3 * node + axis -> its number among the free ones, or -1 when it is held
	Long *start, *other; // rows of the free entries: start[count + 1], and the number of each column
	double* numbers;     // one a column of a row
	double *rhs, *solution;
	double* work; // count numbers, and as many places
	Long* places;
	void* symbolic;
	void* numeric[JN_SOLVER_SLOTS];
	double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
	JnSolverCost cost;
} Lu;

static void destroy(JnSolver* solver) {
	if (solver == NULL) return;
	Lu* lu = (Lu*)solver;
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot)
		if (lu->numeric[slot] != NULL) umfpack_dl_free_numeric(&lu->numeric[slot]);
	if (lu->symbolic != NULL) umfpack_dl_free_symbolic(&lu->symbolic);
	free(lu->index);
	free(lu->start);
	free(lu->other);
	free(lu->numbers);
	free(lu->rhs);
	free(lu->solution);
	free(lu->work);
	free(lu->places);
	free(lu);
}

static void number_free_entries(Lu* lu, const bool* held) {
	for (int k = 0; k < 3 * lu->pattern->nodes; ++k) lu->index[k] = held[k] ? -1 : lu->count++;
}

// Visit the entries between free ones, row by row, columns ascending: `other` when blocks is NULL, else `numbers`.
static Long walk(Lu* lu, const double* blocks) {
	const JnPattern* pattern = lu->pattern;
	Long place = 0;
	for (int node = 0; node < pattern->nodes; ++node)
		for (int r = 0; r < 3; ++r) {
			const Long row = lu->index[3 * node + r];
			if (row < 0) continue;
			if (blocks == NULL) lu->start[row] = place;
			for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k)
				for (int c = 0; c < 3; ++c) {
					const Long column = lu->index[3 * pattern->full_column[k] + c];
					if (column < 0) continue;
					if (blocks == NULL)
						lu->other[place++] = column;
					else
						lu->numbers[place++] = blocks[9 * (size_t)k + (size_t)(3 * r + c)];
				}
		}
	return place;
}

static JnStatus allocate(Lu* lu, const bool* held) {
	const size_t entries = 3 * (size_t)lu->pattern->nodes;
	const size_t numbers = 9 * (size_t)lu->pattern->full_start[lu->pattern->nodes];
	lu->index = malloc((entries + 1) * sizeof *lu->index);
	lu->start = malloc((entries + 1) * sizeof *lu->start);
	lu->other = malloc((numbers + 1) * sizeof *lu->other);
	lu->numbers = malloc((numbers + 1) * sizeof *lu->numbers);
	lu->rhs = malloc((entries + 1) * sizeof *lu->rhs);
	lu->solution = malloc((entries + 1) * sizeof *lu->solution);
	lu->work = malloc((entries + 1) * sizeof *lu->work);
	lu->places = malloc((entries + 1) * sizeof *lu->places);
	if (lu->index == NULL || lu->start == NULL || lu->other == NULL || lu->numbers == NULL || lu->rhs == NULL ||
		lu->solution == NULL || lu->work == NULL || lu->places == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: unsymmetric solver");
	number_free_entries(lu, held);
	lu->start[lu->count] = walk(lu, NULL);
	return JN_OK;
}

static JnStatus analyse(Lu* lu) {
	umfpack_dl_defaults(lu->control);
	lu->control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
	lu->control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
	lu->control[UMFPACK_IRSTEP] = 0; // refinement would need the numbers of every slot
	const int status = (int)umfpack_dl_symbolic(lu->count, lu->count, lu->start, lu->other, NULL, &lu->symbolic,
												lu->control, lu->info);
	if (status != UMFPACK_OK)
		return jn_error(JN_OUT_OF_MEMORY, "the sparse LU analysis of %ld unknowns failed (UMFPACK status %d)",
						(long)lu->count, status);
	lu->cost =
		(JnSolverCost){.factor_flops = lu->info[UMFPACK_FLOPS_ESTIMATE],
					   .factor_entries = lu->info[UMFPACK_LNZ_ESTIMATE] + lu->info[UMFPACK_UNZ_ESTIMATE],
					   .bytes = (size_t)(lu->info[UMFPACK_NUMERIC_SIZE_ESTIMATE] * lu->info[UMFPACK_SIZE_OF_UNIT])};
	return JN_OK;
}

static JnStatus create(const void* options, const JnPattern* pattern, const bool* held, int threads, JnSolver** out) {
	(void)threads;
	(void)options;
	*out = NULL;
	jn_blas_prepare();
	Lu* lu = calloc(1, sizeof *lu);
	if (lu == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: unsymmetric solver");
	lu->base.type = &jn_solver_unsymmetric;
	lu->pattern = pattern;
	JnStatus status = allocate(lu, held);
	if (status == JN_OK) status = analyse(lu);
	if (status == JN_OK)
		*out = &lu->base;
	else
		destroy(&lu->base);
	return status;
}

static JnStatus factor(JnSolver* solver, int slot, const double* blocks) {
	Lu* lu = (Lu*)solver;
	walk(lu, blocks);
	if (lu->numeric[slot] != NULL) umfpack_dl_free_numeric(&lu->numeric[slot]);
	const int status = (int)umfpack_dl_numeric(lu->start, lu->other, lu->numbers, lu->symbolic, &lu->numeric[slot],
											   lu->control, lu->info);
	if (status == UMFPACK_OK) {
		lu->cost.factor_flops = lu->info[UMFPACK_FLOPS]; // pivots are known now: the estimates are upper bounds
		lu->cost.factor_entries = lu->info[UMFPACK_LNZ] + lu->info[UMFPACK_UNZ];
		lu->cost.bytes = (size_t)(lu->info[UMFPACK_NUMERIC_SIZE] * lu->info[UMFPACK_SIZE_OF_UNIT]);
		return JN_OK;
	}
	if (status == UMFPACK_WARNING_singular_matrix) return JN_INDEFINITE;
	return jn_error(JN_OUT_OF_MEMORY, "the sparse LU factorisation failed (UMFPACK status %d) at %zu bytes a factor",
					status, lu->cost.bytes);
}

static JnStatus solve(JnSolver* solver, int slot, const double* rhs, double* out) {
	Lu* lu = (Lu*)solver;
	const int entries = 3 * lu->pattern->nodes;
	for (int k = 0; k < entries; ++k)
		if (lu->index[k] >= 0) lu->rhs[lu->index[k]] = rhs[k];
	const int status = (int)umfpack_dl_wsolve(UMFPACK_At, lu->start, lu->other, lu->numbers, lu->solution, lu->rhs,
											  lu->numeric[slot], lu->control, lu->info, lu->places, lu->work);
	if (status != UMFPACK_OK)
		return jn_error(JN_OUT_OF_MEMORY, "the sparse LU solve failed (UMFPACK status %d)", status);
	for (int k = 0; k < entries; ++k) out[k] = lu->index[k] >= 0 ? lu->solution[lu->index[k]] : 0;
	return JN_OK;
}

static JnSolverCost cost(const JnSolver* solver) {
	return ((const Lu*)solver)->cost;
}

static JnStatus approximate(JnSolver* solver, int slot, double tolerance, const double* rhs, double* out) {
	(void)tolerance;
	return solve(solver, slot, rhs, out);
}

const JnSolverType jn_solver_unsymmetric = {
	.row = {.name = "unsymmetric", .doc = "sparse LU (UMFPACK), analysed once, its factors kept while they serve"},
	.create = create,
	.destroy = destroy,
	.factor = factor,
	.solve = solve,
	.approximate = approximate,
	.cost = cost,
};
