#include "solve/qp_penalty.h"

#include <cholmod.h>
#include <omp.h>
#include <string.h>

#include "base/log.h"
#include "solve/blas.h"

struct JnPenaltyFactor {
	cholmod_common common;
	cholmod_factor* factor;
	cholmod_dense *rhs, *solution, *work1, *work2;
};

static const double gradient_tolerance = 1e-11; // of conjugate gradients: below what the splitting is asked for
enum { GRADIENT_STEPS = 500 };

static JnStatus prepare(JnPenalty* penalty) {
	if (penalty->factor != NULL) return JN_OK;
	penalty->factor = calloc(1, sizeof *penalty->factor);
	if (penalty->factor == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: contact solver");
	jn_blas_prepare();
	cholmod_common* common = &penalty->factor->common;
	cholmod_start(common);
	common->print = 0;
	common->try_catch = 1;
	common->nmethods = 1;
	common->method[0].ordering = CHOLMOD_AMD;
	common->supernodal = CHOLMOD_SUPERNODAL;
	return JN_OK;
}

void jn_penalty_begin(JnPenalty* penalty) {
	if (penalty->factor != NULL) cholmod_free_factor(&penalty->factor->factor, &penalty->factor->common);
}

void jn_penalty_release(JnPenalty* penalty) {
	free(penalty->vectors.at);
	if (penalty->factor == NULL) return;
	JnPenaltyFactor* f = penalty->factor;
	cholmod_free_factor(&f->factor, &f->common);
	cholmod_free_dense(&f->rhs, &f->common);
	cholmod_free_dense(&f->solution, &f->common);
	cholmod_free_dense(&f->work1, &f->common);
	cholmod_free_dense(&f->work2, &f->common);
	cholmod_finish(&f->common);
	free(f);
}

static bool is_held(const JnContactProblem* problem, size_t entry) {
	return problem->held != NULL && problem->held[entry];
}

// Entries of the triplet matrix at most: the blocks of C, those of each contact, and the held diagonal.
static size_t count_triplets(const JnContactProblem* problem) {
	size_t count = 9 * (size_t)problem->matrix.pattern->blocks + 3 * (size_t)problem->nodes;
	for (int i = 0; i < problem->count; ++i) {
		const size_t nodes = (size_t)(problem->start[i + 1] - problem->start[i]);
		count += 9 * nodes * nodes;
	}
	return count;
}

static void put(cholmod_triplet* triplet, const JnContactProblem* problem, size_t row, size_t column, double value) {
	if (row < column || is_held(problem, row) || is_held(problem, column)) return;
	((int*)triplet->i)[triplet->nnz] = (int)row;
	((int*)triplet->j)[triplet->nnz] = (int)column;
	((double*)triplet->x)[triplet->nnz++] = value;
}

static void put_matrix(cholmod_triplet* triplet, const JnContactProblem* problem) {
	const JnPattern* pattern = problem->matrix.pattern;
	for (int node = 0; node < problem->nodes; ++node)
		for (int k = pattern->column_start[node]; k < pattern->column_start[node + 1]; ++k)
			for (size_t e = 0; e < 9; ++e)
				put(triplet, problem, 3 * (size_t)pattern->row[k] + e / 3, 3 * (size_t)node + e % 3,
					problem->matrix.blocks[9 * (size_t)k + e]);
	for (size_t k = 0; k < 3 * (size_t)problem->nodes; ++k) {
		if (!is_held(problem, k)) continue;
		((int*)triplet->i)[triplet->nnz] = ((int*)triplet->j)[triplet->nnz] = (int)k;
		((double*)triplet->x)[triplet->nnz++] = 1;
	}
}

// rho E^2 times the sum of r r' over the contact's rows r of the frame: n n', or the identity with friction.
static void direction_block(const JnQp* qp, int contact, double rho, double block[9]) {
	const double* frame = qp->problem->frame[contact];
	const int rows = qp->rows.first[contact + 1] - qp->rows.first[contact];
	const double e = qp->rows.scale[contact];
	for (int a = 0; a < 9; ++a) {
		block[a] = 0;
		for (int r = 0; r < rows; ++r) block[a] += rho * e * e * frame[3 * r + a / 3] * frame[3 * r + a % 3];
	}
}

static void put_contact(cholmod_triplet* triplet, const JnQp* qp, int contact, double rho) {
	const JnContactProblem* problem = qp->problem;
	double block[9];
	direction_block(qp, contact, rho, block);
	for (int k = problem->start[contact]; k < problem->start[contact + 1]; ++k)
		for (int l = problem->start[contact]; l < problem->start[contact + 1]; ++l)
			for (size_t e = 0; e < 9; ++e)
				put(triplet, problem, 3 * (size_t)problem->node[k] + e / 3, 3 * (size_t)problem->node[l] + e % 3,
					problem->weight[k] * problem->weight[l] * block[e]);
}

static cholmod_sparse* assemble(JnPenaltyFactor* f, const JnQp* qp, const double* rho) {
	const size_t n = 3 * (size_t)qp->problem->nodes, most = count_triplets(qp->problem);
	cholmod_triplet* triplet = cholmod_allocate_triplet(n, n, most, -1, CHOLMOD_REAL, &f->common);
	if (triplet == NULL) return NULL;
	put_matrix(triplet, qp->problem);
	for (int i = 0; i < qp->rows.contacts; ++i)
		put_contact(triplet, qp, i, rho[i]); // zeros too: one pattern for all rho
	cholmod_sparse* matrix = cholmod_triplet_to_sparse(triplet, 0, &f->common);
	cholmod_free_triplet(&triplet, &f->common);
	return matrix;
}

JnStatus jn_penalty_factor(JnPenalty* penalty, JnQp* qp, const double* rho) {
	penalty->rho = rho;
	++qp->report.factorizations;
	if (qp->problem->matrix.blocks == NULL || qp->problem->matrix.pattern == NULL) return JN_OK;
	JN_TRY(prepare(penalty));
	JnPenaltyFactor* f = penalty->factor;
	const int levels = omp_get_max_active_levels();
	omp_set_max_active_levels(0); // CHOLMOD asks for four threads whatever the machine has
	cholmod_sparse* matrix = assemble(f, qp, rho);
	if (matrix != NULL && f->factor == NULL) f->factor = cholmod_analyze(matrix, &f->common);
	const bool worked = f->factor != NULL && matrix != NULL && cholmod_factorize(matrix, f->factor, &f->common);
	omp_set_max_active_levels(levels);
	const bool is_definite = worked && f->common.status == CHOLMOD_OK && f->factor->minor == f->factor->n;
	cholmod_free_sparse(&matrix, &f->common);
	if (is_definite) return JN_OK;
	if (worked || f->common.status == CHOLMOD_NOT_POSDEF) return JN_INDEFINITE;
	return jn_error(JN_OUT_OF_MEMORY, "the factorisation of a contact problem failed (CHOLMOD status %d)",
					f->common.status);
}

static JnStatus solve_sparse(JnPenaltyFactor* f, const JnQp* qp, const double* rhs, double* change) {
	const size_t n = 3 * (size_t)qp->problem->nodes;
	if (f->rhs != NULL && f->rhs->nrow != n) cholmod_free_dense(&f->rhs, &f->common);
	if (f->rhs == NULL) f->rhs = cholmod_zeros(n, 1, CHOLMOD_REAL, &f->common);
	if (f->rhs == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: contact solver");
	for (size_t k = 0; k < n; ++k) ((double*)f->rhs->x)[k] = is_held(qp->problem, k) ? 0 : rhs[k];
	const int levels = omp_get_max_active_levels();
	omp_set_max_active_levels(0);
	const int worked =
		cholmod_solve2(CHOLMOD_A, f->factor, f->rhs, NULL, &f->solution, NULL, &f->work1, &f->work2, &f->common);
	omp_set_max_active_levels(levels);
	if (!worked)
		return jn_error(JN_OUT_OF_MEMORY, "the solve of a contact problem failed (CHOLMOD status %d)",
						f->common.status);
	memcpy(change, f->solution->x, n * sizeof *change);
	return JN_OK;
}

static double dot(size_t n, const double* a, const double* b) {
	double sum = 0;
	for (size_t k = 0; k < n; ++k) sum += a[k] * b[k];
	return sum;
}

// out = (C + G' R G) x, 0 on held entries; rows and impulse are work.
static void multiply(const JnPenalty* penalty, const JnQp* qp, const double* x, double* rows, double* impulse,
					 double* out) {
	const JnContactProblem* problem = qp->problem;
	jn_qp_rows_apply(qp, x, rows);
	for (int i = 0; i < qp->rows.contacts; ++i)
		for (int row = qp->rows.first[i]; row < qp->rows.first[i + 1]; ++row) rows[row] *= penalty->rho[i];
	jn_qp_rows_transpose(qp, rows, impulse);
	problem->matrix.apply(problem->matrix.user, x, out);
	for (size_t k = 0; k < 3 * (size_t)problem->nodes; ++k) out[k] = is_held(problem, k) ? 0 : out[k] + impulse[k];
}

static JnStatus solve_gradients(JnPenalty* penalty, JnQp* qp, const double* rhs, double* x) {
	const JnContactMatrix* matrix = &qp->problem->matrix;
	const size_t n = 3 * (size_t)qp->problem->nodes;
	JN_TRY(jn_numbers_reserve(&penalty->vectors, 5 * n + (size_t)qp->rows.count));
	double *r = penalty->vectors.at, *z = r + n, *p = z + n, *q = p + n, *impulse = q + n, *rows = impulse + n;
	memset(x, 0, n * sizeof *x);
	for (size_t k = 0; k < n; ++k) r[k] = is_held(qp->problem, k) ? 0 : rhs[k];
	memset(p, 0, n * sizeof *p);
	double last = 1, goal = 0;
	for (int step = 0; step < GRADIENT_STEPS; ++step) {
		JN_TRY(matrix->solve(matrix->user, r, z));
		++qp->report.solves;
		const double now = dot(n, r, z);
		if (step == 0) goal = gradient_tolerance * gradient_tolerance * now;
		if (!(now > goal)) break;
		for (size_t k = 0; k < n; ++k) p[k] = z[k] + (step > 0 ? now / last : 0) * p[k];
		multiply(penalty, qp, p, rows, impulse, q);
		const double length = now / dot(n, p, q);
		for (size_t k = 0; k < n; ++k) x[k] += length * p[k], r[k] -= length * q[k];
		last = now;
	}
	return JN_OK;
}

JnStatus jn_penalty_solve(JnPenalty* penalty, JnQp* qp, const double* rhs, double* change) {
	if (qp->problem->matrix.blocks == NULL || qp->problem->matrix.pattern == NULL)
		return solve_gradients(penalty, qp, rhs, change);
	++qp->report.solves;
	return solve_sparse(penalty->factor, qp, rhs, change);
}
