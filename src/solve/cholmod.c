// Supernodal sparse Cholesky by CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008).
//
// The fill-reducing order is computed on the node graph, whose vertices are 3x3 blocks, and expanded: nine times fewer
// entries to order, and the three unknowns of a node stay together. The analysis serves every later factorisation.
#include <cholmod.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "solve/blas.h"
#include "solve/solver.h"

typedef struct Direct {
	JnSolver base;
	const JnPattern* pattern;
	bool* held;      // 3 * nodes; an entry held in a free node keeps an identity row
	int* free_index; // node -> its number among the nodes with a free entry, or -1
	int free_nodes;
	cholmod_common common;
	cholmod_sparse* matrix; // lower triangle of the free entries
	cholmod_factor* symbolic;
	cholmod_factor* factors[JN_SOLVER_SLOTS];
	cholmod_dense *rhs, *solution, *work1, *work2;
	JnSolverCost cost;
} Direct;

// CHOLMOD 3 asks OpenMP for four threads in its assembly loops whatever the machine has; none are better for our sizes.
typedef struct Quiet {
	int levels;
} Quiet;

static Quiet quiet_begin(void) {
	const Quiet quiet = {omp_get_max_active_levels()};
	omp_set_max_active_levels(0);
	return quiet;
}

static void quiet_end(Quiet quiet) {
	omp_set_max_active_levels(quiet.levels);
}

static void destroy(JnSolver* solver) {
	if (solver == NULL) return;
	Direct* direct = (Direct*)solver;
	cholmod_common* common = &direct->common;
	for (int slot = 0; slot < JN_SOLVER_SLOTS; ++slot) cholmod_free_factor(&direct->factors[slot], common);
	cholmod_free_factor(&direct->symbolic, common);
	cholmod_free_sparse(&direct->matrix, common);
	cholmod_free_dense(&direct->rhs, common);
	cholmod_free_dense(&direct->solution, common);
	cholmod_free_dense(&direct->work1, common);
	cholmod_free_dense(&direct->work2, common);
	cholmod_finish(common);
	free(direct->held);
	free(direct->free_index);
	free(direct);
}

static void number_free_nodes(Direct* direct) {
	for (int node = 0; node < direct->pattern->nodes; ++node) {
		const bool* held = direct->held + 3 * (size_t)node;
		direct->free_index[node] = held[0] && held[1] && held[2] ? -1 : direct->free_nodes++;
	}
}

// Count of stored blocks between free nodes in column `node`, the diagonal included.
static int free_blocks(const Direct* direct, int node) {
	const JnPattern* pattern = direct->pattern;
	int count = 0;
	for (int k = pattern->column_start[node]; k < pattern->column_start[node + 1]; ++k)
		count += direct->free_index[pattern->row[k]] >= 0;
	return count;
}

// The graph of the free nodes, lower triangle, without numbers.
static cholmod_sparse* node_graph(Direct* direct) {
	const JnPattern* pattern = direct->pattern;
	size_t entries = 0;
	for (int node = 0; node < pattern->nodes; ++node)
		if (direct->free_index[node] >= 0) entries += (size_t)free_blocks(direct, node);
	const size_t n = (size_t)direct->free_nodes;
	cholmod_sparse* graph = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_PATTERN, &direct->common);
	if (graph == NULL) return NULL;
	int *start = graph->p, *row = graph->i, place = 0;
	for (int node = 0; node < pattern->nodes; ++node) {
		if (direct->free_index[node] < 0) continue;
		start[direct->free_index[node]] = place;
		for (int k = pattern->column_start[node]; k < pattern->column_start[node + 1]; ++k)
			if (direct->free_index[pattern->row[k]] >= 0) row[place++] = direct->free_index[pattern->row[k]];
	}
	start[n] = place;
	return graph;
}

static void choose_orderings(cholmod_common* common, int ordering) {
	static const int metis_then_amd[] = {CHOLMOD_METIS, CHOLMOD_AMD};
	common->nmethods = ordering == 0 ? 2 : 1;
	for (int i = 0; i < common->nmethods; ++i) common->method[i].ordering = metis_then_amd[ordering == 2 ? 1 : i];
}

// A permutation of the free entries: the order of the node graph, three entries a node. NULL when memory is out.
static int* order_entries(Direct* direct, int ordering) {
	cholmod_common* common = &direct->common;
	cholmod_sparse* graph = node_graph(direct);
	if (graph == NULL) return NULL;
	choose_orderings(common, ordering);
	cholmod_factor* nodal = cholmod_analyze(graph, common);
	cholmod_free_sparse(&graph, common);
	if (nodal == NULL) return NULL;
	int* order = malloc(3 * (size_t)direct->free_nodes * sizeof *order);
	const int* node_order = nodal->Perm;
	for (int i = 0; order != NULL && i < direct->free_nodes; ++i)
		for (int axis = 0; axis < 3; ++axis) order[3 * i + axis] = 3 * node_order[i] + axis;
	cholmod_free_factor(&nodal, common);
	return order;
}

// The scalar matrix: column 3 j + c holds rows c .. 2 of the diagonal block, then three rows of each block below.
static cholmod_sparse* entry_matrix(Direct* direct) {
	const JnPattern* pattern = direct->pattern;
	size_t entries = 0;
	for (int node = 0; node < pattern->nodes; ++node)
		if (direct->free_index[node] >= 0) entries += 9 * (size_t)free_blocks(direct, node) - 3;
	const size_t n = 3 * (size_t)direct->free_nodes;
	if (entries > (size_t)INT32_MAX) return NULL;
	cholmod_sparse* matrix = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_REAL, &direct->common);
	if (matrix == NULL) return NULL;
	int *start = matrix->p, *row = matrix->i, place = 0;
	for (int node = 0; node < pattern->nodes; ++node) {
		const int column = direct->free_index[node];
		for (int c = 0; column >= 0 && c < 3; ++c) {
			start[3 * column + c] = place;
			for (int r = c; r < 3; ++r) row[place++] = 3 * column + r;
			for (int k = pattern->column_start[node] + 1; k < pattern->column_start[node + 1]; ++k) {
				const int below = direct->free_index[pattern->row[k]];
				for (int r = 0; below >= 0 && r < 3; ++r) row[place++] = 3 * below + r;
			}
		}
	}
	start[n] = place;
	return matrix;
}

static JnStatus analyse(Direct* direct, int ordering) {
	cholmod_common* common = &direct->common;
	int* order = order_entries(direct, ordering);
	direct->matrix = order != NULL ? entry_matrix(direct) : NULL;
	if (direct->matrix != NULL) {
		common->nmethods = 1;
		common->method[0].ordering = CHOLMOD_GIVEN;
		direct->symbolic = cholmod_analyze_p(direct->matrix, order, NULL, 0, common);
	}
	free(order);
	if (direct->symbolic == NULL)
		return jn_error(JN_OUT_OF_MEMORY,
						"the sparse Cholesky analysis of %d nodes failed (CHOLMOD status %d); the matrix does not fit",
						direct->free_nodes, common->status);
	direct->cost = (JnSolverCost){
		.factor_flops = common->fl, .factor_entries = common->lnz, .bytes = direct->symbolic->xsize * sizeof(double)};
	direct->rhs = cholmod_zeros(direct->matrix->nrow, 1, CHOLMOD_REAL, common);
	return direct->rhs != NULL ? JN_OK : jn_error(JN_OUT_OF_MEMORY, "out of memory: right-hand side of the solver");
}

static JnStatus create(const void* options, const JnPattern* pattern, const bool* held, JnSolver** out) {
	*out = NULL;
	const size_t entries = 3 * (size_t)pattern->nodes;
	Direct* direct = calloc(1, sizeof *direct);
	if (direct == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: direct solver");
	direct->base.type = &jn_solver_direct;
	direct->pattern = pattern;
	direct->held = malloc(entries * sizeof *direct->held + 1);
	direct->free_index = malloc((entries / 3 + 1) * sizeof *direct->free_index);
	jn_blas_prepare();
	cholmod_start(&direct->common);
	direct->common.supernodal = CHOLMOD_SUPERNODAL;
	direct->common.print = 0;
	direct->common.try_catch = 1;
	JnStatus status = direct->held != NULL && direct->free_index != NULL ? JN_OK : JN_OUT_OF_MEMORY;
	if (status == JN_OK) {
		memcpy(direct->held, held, entries * sizeof *held);
		number_free_nodes(direct);
		const Quiet quiet = quiet_begin();
		status = analyse(direct, ((const JnDirectDef*)options)->ordering);
		quiet_end(quiet);
	}
	if (status != JN_OK)
		destroy(&direct->base);
	else
		*out = &direct->base;
	return status;
}

// Column c of the block at `k`, masked where either entry is held.
static double entry(const Direct* direct, const double* blocks, int k, int row_node, int r, int column_node, int c) {
	const bool masked =
		direct->held[3 * (size_t)row_node + (size_t)r] || direct->held[3 * (size_t)column_node + (size_t)c];
	if (!masked) return blocks[9 * (size_t)k + 3 * (size_t)r + (size_t)c];
	return row_node == column_node && r == c ? 1.0 : 0.0;
}

static void fill(Direct* direct, const double* blocks) {
	const JnPattern* pattern = direct->pattern;
	double* value = direct->matrix->x;
	size_t place = 0;
	for (int node = 0; node < pattern->nodes; ++node) {
		if (direct->free_index[node] < 0) continue;
		const int first = pattern->column_start[node];
		for (int c = 0; c < 3; ++c) {
			for (int r = c; r < 3; ++r) value[place++] = entry(direct, blocks, first, node, r, node, c);
			for (int k = first + 1; k < pattern->column_start[node + 1]; ++k) {
				const int row = pattern->row[k];
				for (int r = 0; direct->free_index[row] >= 0 && r < 3; ++r)
					value[place++] = entry(direct, blocks, k, row, r, node, c);
			}
		}
	}
}

static JnStatus factor(JnSolver* solver, int slot, const double* blocks) {
	Direct* direct = (Direct*)solver;
	cholmod_common* common = &direct->common;
	if (direct->factors[slot] == NULL) direct->factors[slot] = cholmod_copy_factor(direct->symbolic, common);
	cholmod_factor* numeric = direct->factors[slot];
	if (numeric == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: a factor of %zu bytes", direct->cost.bytes);
	fill(direct, blocks);
	const Quiet quiet = quiet_begin();
	const int worked = cholmod_factorize(direct->matrix, numeric, common);
	quiet_end(quiet);
	if (worked && common->status == CHOLMOD_OK && numeric->minor == numeric->n) return JN_OK;
	if (common->status == CHOLMOD_NOT_POSDEF) return JN_INDEFINITE;
	return jn_error(JN_OUT_OF_MEMORY, "the sparse factorisation failed (CHOLMOD status %d) at %zu bytes a factor",
					common->status, direct->cost.bytes);
}

static JnStatus solve(JnSolver* solver, int slot, const double* rhs, double* out) {
	Direct* direct = (Direct*)solver;
	cholmod_common* common = &direct->common;
	double* b = direct->rhs->x;
	for (int node = 0; node < direct->pattern->nodes; ++node)
		for (int axis = 0; direct->free_index[node] >= 0 && axis < 3; ++axis) {
			const size_t k = 3 * (size_t)node + (size_t)axis;
			b[3 * direct->free_index[node] + axis] = direct->held[k] ? 0 : rhs[k];
		}
	const Quiet quiet = quiet_begin();
	const int worked = cholmod_solve2(CHOLMOD_A, direct->factors[slot], direct->rhs, NULL, &direct->solution, NULL,
									  &direct->work1, &direct->work2, common);
	quiet_end(quiet);
	if (!worked) return jn_error(JN_OUT_OF_MEMORY, "the sparse solve failed (CHOLMOD status %d)", common->status);
	const double* x = direct->solution->x;
	for (int node = 0; node < direct->pattern->nodes; ++node)
		for (int axis = 0; axis < 3; ++axis) {
			const size_t k = 3 * (size_t)node + (size_t)axis;
			out[k] = direct->held[k] ? 0 : x[3 * direct->free_index[node] + axis];
		}
	return JN_OK;
}

static JnSolverCost cost(const JnSolver* solver) {
	return ((const Direct*)solver)->cost;
}

static const char* const orderings[] = {"auto", "metis", "amd", NULL};

static const JnKey keys[] = {
	{.name = "ordering",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnDirectDef, ordering),
	 .names = orderings,
	 .meaning = "fill-reducing order of the node graph; auto takes the better of METIS and AMD"},
	{0},
};

const JnSolverType jn_solver_direct = {
	.row = {.name = "direct",
			.doc = "sparse Cholesky (CHOLMOD, supernodal), analysed once, its factors kept while they serve",
			.keys = keys,
			.options_size = sizeof(JnDirectDef)},
	.create = create,
	.destroy = destroy,
	.factor = factor,
	.solve = solve,
	.cost = cost,
};
