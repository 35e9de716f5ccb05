// Supernodal sparse Cholesky by CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008).
//
// The fill-reducing order is computed on the node graph, whose vertices are 3x3 blocks, and expanded: nine times fewer
// entries to order, and the three unknowns of a node stay together. The matrix is then stored in that order, so that a
// factorisation starts without the permuted copy that CHOLMOD would make each time; a table says where each entry of the
// blocks goes. The analysis serves every later factorisation.
#include <cholmod.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"
#include "solve/blas.h"
#include "solve/cholmod_half.h"
#include "solve/direct.h"
#include "solve/single.h"
#include "solve/solver.h"

typedef struct Direct {
	JnSolver base;
	const JnPattern* pattern;
	int free_nodes;
	int* free_index; // node -> its number among the nodes with a free entry, or -1
	int* position;   // entry 3 * node + axis -> its place in the factor's order, or -1 when it is held
	int* target;     // 9 * block + 3 * row + column -> its number in the matrix, or -1
	cholmod_common common;
	cholmod_sparse* matrix; // lower triangle in the factor's order; entries held in free nodes are identity rows
	cholmod_factor* symbolic;
	cholmod_factor* factors[JN_DIRECT_SLOTS];
	cholmod_dense *rhs, *solution, *work1, *work2;
	cholmod_dense *many_rhs, *many_solution, *many_work1, *many_work2; // of solve_many, for its last count
	float* single[JN_DIRECT_SLOTS]; // the factors once more, in single precision, then their inverse diagonals
	size_t* single_panel;           // where panels begin, and the size of all
	float *single_x, *single_work;  // a vector, and a panel's rows
	JnSingleSolve* single_solve;    // NULL: double precision only
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
	for (int slot = 0; slot < JN_DIRECT_SLOTS; ++slot) {
		cholmod_free_factor(&direct->factors[slot], common);
		jn_aligned_free(direct->single[slot]);
	}
	free(direct->single_panel);
	free(direct->single_x);
	jn_aligned_free(direct->single_work);
	cholmod_free_factor(&direct->symbolic, common);
	cholmod_free_sparse(&direct->matrix, common);
	cholmod_free_dense(&direct->rhs, common);
	cholmod_free_dense(&direct->solution, common);
	cholmod_free_dense(&direct->work1, common);
	cholmod_free_dense(&direct->work2, common);
	cholmod_free_dense(&direct->many_rhs, common);
	cholmod_free_dense(&direct->many_solution, common);
	cholmod_free_dense(&direct->many_work1, common);
	cholmod_free_dense(&direct->many_work2, common);
	cholmod_finish(common);
	free(direct->free_index);
	free(direct->position);
	free(direct->target);
	free(direct);
}

static void number_free_nodes(Direct* direct, const bool* all_held) {
	for (int node = 0; node < direct->pattern->nodes; ++node) {
		const bool* held = all_held + 3 * (size_t)node;
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

// Place of each node in the fill-reducing order, columns postordered; NULL when memory is out.
static int* order_nodes(Direct* direct, int ordering) {
	cholmod_common* common = &direct->common;
	cholmod_sparse* graph = node_graph(direct);
	if (graph == NULL) return NULL;
	choose_orderings(common, ordering);
	cholmod_factor* nodal = cholmod_analyze(graph, common);
	cholmod_free_sparse(&graph, common);
	if (nodal == NULL) return NULL;
	int* place = malloc(((size_t)direct->free_nodes + 1) * sizeof *place);
	const int* order = nodal->Perm;
	for (int i = 0; place != NULL && i < direct->free_nodes; ++i) place[order[i]] = i;
	cholmod_free_factor(&nodal, common);
	return place;
}

// Call `visit` for every entry of the lower triangle in the factor's order, with its number 9 * block + 3 * r + c.
typedef void Visit(Direct*, int row, int column, size_t number);

static void visit_block(Direct* direct, int k, int row_node, int column_node, const int* place, Visit* visit) {
	const int row = place[direct->free_index[row_node]], column = place[direct->free_index[column_node]];
	for (int r = 0; r < 3; ++r)
		for (int c = 0; c < 3; ++c) {
			const int i = 3 * row + r, j = 3 * column + c;
			if (row == column && r < c) continue; // the other half of a diagonal block
			visit(direct, i > j ? i : j, i > j ? j : i, 9 * (size_t)k + 3 * (size_t)r + (size_t)c);
		}
}

static void visit_entries(Direct* direct, const int* place, Visit* visit) {
	const JnPattern* pattern = direct->pattern;
	for (int node = 0; node < pattern->nodes; ++node) {
		if (direct->free_index[node] < 0) continue;
		for (int k = pattern->column_start[node]; k < pattern->column_start[node + 1]; ++k)
			if (direct->free_index[pattern->row[k]] >= 0) visit_block(direct, k, pattern->row[k], node, place, visit);
	}
}

static void count_entry(Direct* direct, int row, int column, size_t number) {
	(void)row, (void)number;
	++((int*)direct->matrix->p)[column + 1];
}

static void put_entry(Direct* direct, int row, int column, size_t number) {
	(void)number;
	int* start = direct->matrix->p;
	((int*)direct->matrix->i)[start[column]++] = row;
}

static void find_entry(Direct* direct, int row, int column, size_t number) {
	const int *start = direct->matrix->p, *rows = direct->matrix->i;
	int low = start[column], high = start[column + 1] - 1;
	while (low < high) {
		const int middle = low + (high - low) / 2;
		if (rows[middle] < row)
			low = middle + 1;
		else
			high = middle;
	}
	direct->target[number] = low;
}

static size_t count_entries(const Direct* direct) {
	size_t entries = 0;
	for (int node = 0; node < direct->pattern->nodes; ++node)
		if (direct->free_index[node] >= 0) entries += 9 * (size_t)free_blocks(direct, node) - 3;
	return entries;
}

static int by_value(const void* a, const void* b) {
	const int left = *(const int*)a, right = *(const int*)b;
	return (left > right) - (left < right);
}

// The pattern of the matrix, rows sorted, and the table of targets.
static JnStatus lay_out(Direct* direct, const int* place) {
	const size_t n = 3 * (size_t)direct->free_nodes, entries = count_entries(direct);
	const size_t numbers = 9 * (size_t)direct->pattern->blocks;
	if (entries > (size_t)INT32_MAX) return JN_OUT_OF_MEMORY;
	direct->matrix = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_REAL, &direct->common);
	direct->target = malloc(numbers * sizeof *direct->target);
	if (direct->matrix == NULL || direct->target == NULL) return JN_OUT_OF_MEMORY;
	int *start = direct->matrix->p, *rows = direct->matrix->i;
	memset(start, 0, (n + 1) * sizeof *start);
	visit_entries(direct, place, count_entry);
	for (size_t j = 0; j < n; ++j) start[j + 1] += start[j];
	visit_entries(direct, place, put_entry); // moves each start to the next one
	memmove(start + 1, start, n * sizeof *start);
	start[0] = 0;
	for (size_t j = 0; j < n; ++j) qsort(rows + start[j], (size_t)(start[j + 1] - start[j]), sizeof *rows, by_value);
	for (size_t k = 0; k < numbers; ++k) direct->target[k] = -1;
	visit_entries(direct, place, find_entry);
	return JN_OK;
}

// A held entry of a free node: its row and column go nowhere, and its diagonal is 1 for good.
static void isolate(Direct* direct, size_t held_entry) {
	const JnPattern* pattern = direct->pattern;
	const int node = (int)(held_entry / 3), axis = (int)(held_entry % 3);
	for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k) {
		const bool is_row = pattern->full_block[k] >= 0;
		const size_t block = (size_t)(is_row ? pattern->full_block[k] : ~pattern->full_block[k]);
		const bool is_diagonal = pattern->full_column[k] == node;
		for (int other = 0; other < 3; ++other) {
			int* along = &direct->target[9 * block + 3 * (size_t)axis + (size_t)other];
			int* across = &direct->target[9 * block + 3 * (size_t)other + (size_t)axis];
			if (is_diagonal && other == axis && *along >= 0) ((double*)direct->matrix->x)[*along] = 1;
			if (is_row || is_diagonal) *along = -1;
			if (!is_row || is_diagonal) *across = -1;
		}
	}
}

static void place_entries(Direct* direct, const int* place, const bool* held) {
	memset(direct->matrix->x, 0, direct->matrix->nzmax * sizeof(double));
	for (int node = 0; node < direct->pattern->nodes; ++node)
		for (int axis = 0; axis < 3; ++axis) {
			const size_t k = 3 * (size_t)node + (size_t)axis;
			const bool is_free = direct->free_index[node] >= 0;
			direct->position[k] = is_free && !held[k] ? 3 * place[direct->free_index[node]] + axis : -1;
			if (is_free && held[k]) isolate(direct, k);
		}
}

// Vectors and places for factors in single precision.
static JnStatus prepare_single(Direct* direct) {
	const cholmod_factor* factor = direct->symbolic;
	const int *super = factor->super, *pi = factor->pi;
	int longest = JN_SINGLE_LANES;
	direct->single_panel = malloc((factor->nsuper + 1) * sizeof *direct->single_panel);
	direct->single_x = malloc(factor->n * sizeof *direct->single_x);
	if (direct->single_panel == NULL || direct->single_x == NULL) return JN_OUT_OF_MEMORY;
	direct->single_panel[0] = 0;
	for (size_t s = 0; s < factor->nsuper; ++s) {
		const int stride = jn_single_stride(pi[s + 1] - pi[s]);
		direct->single_panel[s + 1] = direct->single_panel[s] + (size_t)stride * (size_t)(super[s + 1] - super[s]);
		longest = stride > longest ? stride : longest;
	}
	direct->single_work = jn_aligned_take((size_t)longest * sizeof(float));
	return direct->single_work != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static JnStatus analyse(Direct* direct, int ordering, const bool* held) {
	cholmod_common* common = &direct->common;
	int* place = order_nodes(direct, ordering);
	JnStatus status = place != NULL ? lay_out(direct, place) : JN_OUT_OF_MEMORY;
	if (status == JN_OK) {
		place_entries(direct, place, held);
		common->nmethods = 1;
		common->method[0].ordering = CHOLMOD_NATURAL;
		common->postorder = 0;
		direct->symbolic = cholmod_analyze(direct->matrix, common);
		direct->rhs = cholmod_zeros(direct->matrix->nrow, 1, CHOLMOD_REAL, common);
	}
	free(place);
	if (direct->symbolic == NULL || direct->rhs == NULL)
		return jn_error(JN_OUT_OF_MEMORY,
						"out of memory: the sparse Cholesky analysis of %d nodes failed (CHOLMOD status %d)",
						direct->free_nodes, common->status);
	if (direct->single_solve != NULL && prepare_single(direct) != JN_OK)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: solver");
	direct->cost = (JnSolverCost){
		.factor_flops = common->fl, .factor_entries = common->lnz, .bytes = direct->symbolic->xsize * sizeof(double)};
	return JN_OK;
}

static JnStatus create(const void* options, const JnPattern* pattern, const bool* held, int threads, JnSolver** out) {
	(void)threads; // CHOLMOD takes those of BLAS
	*out = NULL;
	const size_t entries = 3 * (size_t)pattern->nodes;
	Direct* direct = calloc(1, sizeof *direct);
	if (direct == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: direct solver");
	direct->base.type = &jn_solver_direct;
	direct->pattern = pattern;
	direct->free_index = malloc((entries / 3 + 1) * sizeof *direct->free_index);
	direct->position = malloc((entries + 1) * sizeof *direct->position);
	if (((const JnDirectDef*)options)->precision == 0) direct->single_solve = jn_single_solve();
	jn_blas_prepare();
	cholmod_start(&direct->common);
	direct->common.supernodal = CHOLMOD_SUPERNODAL;
	direct->common.print = 0;
	direct->common.try_catch = 1;
	JnStatus status = JN_OUT_OF_MEMORY;
	if (direct->free_index == NULL || direct->position == NULL) {
		jn_error(status, "out of memory: direct solver of %d nodes", pattern->nodes);
	} else {
		number_free_nodes(direct, held);
		const Quiet quiet = quiet_begin();
		status = analyse(direct, ((const JnDirectDef*)options)->ordering, held);
		quiet_end(quiet);
	}
	if (status != JN_OK)
		destroy(&direct->base);
	else
		*out = &direct->base;
	return status;
}

static void fill(Direct* direct, const double* blocks) {
	double* value = direct->matrix->x;
	const size_t numbers = 9 * (size_t)direct->pattern->blocks;
	for (size_t k = 0; k < numbers; ++k)
		if (direct->target[k] >= 0) value[direct->target[k]] = blocks[k];
}

static JnSingleFactor single_factor(const Direct* direct, int slot) {
	const cholmod_factor* factor = direct->symbolic; // whose structure all have
	return (JnSingleFactor){.supernodes = (int)factor->nsuper,
							.super = factor->super,
							.pi = factor->pi,
							.rows = factor->s,
							.panel = direct->single_panel,
							.x = direct->single[slot],
							.inverse = direct->single[slot] + direct->single_panel[factor->nsuper]};
}

static void copy_panel(const cholmod_factor* factor, const JnSingleFactor* single, size_t s) {
	const int first = single->super[s], columns = single->super[s + 1] - first,
			  rows = single->pi[s + 1] - single->pi[s];
	const double* from = (const double*)factor->x + ((const int*)factor->px)[s];
	for (int j = 0; j < columns; ++j, from += rows) {
		float* to = single->x + single->panel[s] + (size_t)j * (size_t)jn_single_stride(rows);
		single->inverse[first + j] = (float)(1 / from[j]);
		for (int i = j + 1; i < rows; ++i) to[i] = (float)from[i];
	}
}

static JnStatus copy_to_single(Direct* direct, int slot) {
	const cholmod_factor* factor = direct->factors[slot];
	const size_t bytes = (direct->single_panel[factor->nsuper] + factor->n) * sizeof(float);
	if (direct->single[slot] == NULL) { // padding and upper triangles are zeroed here and stay so
		direct->single[slot] = jn_aligned_take(bytes);
		if (direct->single[slot] == NULL)
			return jn_error(JN_OUT_OF_MEMORY, "out of memory: a factor of %zu bytes", bytes);
	}
	const JnSingleFactor single = single_factor(direct, slot);
	for (size_t s = 0; s < factor->nsuper; ++s) copy_panel(factor, &single, s);
	return JN_OK;
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
	if (worked && common->status == CHOLMOD_OK && numeric->minor == numeric->n)
		return direct->single_solve != NULL ? copy_to_single(direct, slot) : JN_OK;
	if (common->status == CHOLMOD_NOT_POSDEF) return JN_INDEFINITE;
	return jn_error(JN_OUT_OF_MEMORY, "the sparse factorisation failed (CHOLMOD status %d) at %zu bytes a factor",
					common->status, direct->cost.bytes);
}

static JnStatus solve(JnSolver* solver, int slot, const double* rhs, double* out) {
	Direct* direct = (Direct*)solver;
	cholmod_common* common = &direct->common;
	double* b = direct->rhs->x; // its held entries stay 0
	const size_t entries = 3 * (size_t)direct->pattern->nodes;
	for (size_t k = 0; k < entries; ++k)
		if (direct->position[k] >= 0) b[direct->position[k]] = rhs[k];
	const Quiet quiet = quiet_begin();
	const int worked = cholmod_solve2(CHOLMOD_A, direct->factors[slot], direct->rhs, NULL, &direct->solution, NULL,
									  &direct->work1, &direct->work2, common);
	quiet_end(quiet);
	if (!worked) return jn_error(JN_OUT_OF_MEMORY, "the sparse solve failed (CHOLMOD status %d)", common->status);
	const double* x = direct->solution->x;
	for (size_t k = 0; k < entries; ++k) out[k] = direct->position[k] >= 0 ? x[direct->position[k]] : 0;
	return JN_OK;
}

static JnStatus solve_many(JnSolver* solver, int slot, int count, const double* rhs, double* out) {
	Direct* direct = (Direct*)solver;
	cholmod_common* common = &direct->common;
	const size_t entries = 3 * (size_t)direct->pattern->nodes, n = direct->matrix->nrow;
	if (direct->many_rhs != NULL && direct->many_rhs->ncol != (size_t)count)
		cholmod_free_dense(&direct->many_rhs, common);
	if (direct->many_rhs == NULL) direct->many_rhs = cholmod_zeros(n, (size_t)count, CHOLMOD_REAL, common);
	if (direct->many_rhs == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: %d right-hand sides", count);
	double* b = direct->many_rhs->x;
	for (size_t j = 0; j < (size_t)count; ++j)
		for (size_t k = 0; k < entries; ++k)
			if (direct->position[k] >= 0) b[j * n + (size_t)direct->position[k]] = rhs[j * entries + k];
	const Quiet quiet = quiet_begin();
	const int worked = cholmod_solve2(CHOLMOD_A, direct->factors[slot], direct->many_rhs, NULL, &direct->many_solution,
									  NULL, &direct->many_work1, &direct->many_work2, common);
	quiet_end(quiet);
	if (!worked) return jn_error(JN_OUT_OF_MEMORY, "the sparse solve failed (CHOLMOD status %d)", common->status);
	const double* x = direct->many_solution->x;
	for (size_t j = 0; j < (size_t)count; ++j)
		for (size_t k = 0; k < entries; ++k)
			out[j * entries + k] = direct->position[k] >= 0 ? x[j * n + (size_t)direct->position[k]] : 0;
	return JN_OK;
}

static JnStatus approximate(JnSolver* solver, int slot, double tolerance, const double* rhs, double* out) {
	(void)tolerance;
	Direct* direct = (Direct*)solver;
	if (direct->single_solve == NULL) return solve(solver, slot, rhs, out);
	const JnSingleFactor single = single_factor(direct, slot);
	const size_t entries = 3 * (size_t)direct->pattern->nodes;
	double largest = 0;
	for (size_t k = 0; k < entries; ++k)
		if (direct->position[k] >= 0) largest = fmax(largest, fabs(rhs[k]));
	const double scale = largest > 0 ? largest : 1; // residuals may lie outside the range of single precision
	memset(direct->single_x, 0, direct->matrix->nrow * sizeof *direct->single_x);
	for (size_t k = 0; k < entries; ++k)
		if (direct->position[k] >= 0) direct->single_x[direct->position[k]] = (float)(rhs[k] / scale);
	direct->single_solve(&single, direct->single_x, direct->single_work);
	for (size_t k = 0; k < entries; ++k)
		out[k] = direct->position[k] >= 0 ? scale * (double)direct->single_x[direct->position[k]] : 0;
	return JN_OK;
}

void jn_direct_solve_nodes(JnSolver* solver, int slot, const float* r, float* z) {
	Direct* direct = (Direct*)solver;
	const JnSingleFactor single = single_factor(direct, slot);
	const size_t nodes = (size_t)direct->pattern->nodes;
	memset(direct->single_x, 0, direct->matrix->nrow * sizeof *direct->single_x);
	for (size_t k = 0; k < 3 * nodes; ++k)
		if (direct->position[k] >= 0) direct->single_x[direct->position[k]] = r[4 * (k / 3) + k % 3];
	direct->single_solve(&single, direct->single_x, direct->single_work);
	for (size_t node = 0; node < nodes; ++node) {
		for (size_t axis = 0; axis < 3; ++axis) {
			const int place = direct->position[3 * node + axis];
			z[4 * node + axis] = place >= 0 ? direct->single_x[place] : 0;
		}
		z[4 * node + 3] = 0;
	}
}

void jn_direct_keep_single(JnSolver* solver, int slot) {
	Direct* direct = (Direct*)solver;
	cholmod_free_factor(&direct->factors[slot], &direct->common);
}

static JnStatus half(JnSolver* solver, int slot, const JnColumns* columns, JnHalf* out) {
	const Direct* direct = (const Direct*)solver;
	return jn_cholmod_half(direct->factors[slot], direct->position, columns, out);
}

static JnSolverCost cost(const JnSolver* solver) {
	return ((const Direct*)solver)->cost;
}

static const char* const precisions[] = {"mixed", "double", NULL};
static const char* const orderings[] = {"auto", "metis", "amd", NULL};

static const JnKey keys[] = {
	{.name = "ordering",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnDirectDef, ordering),
	 .names = orderings,
	 .meaning = "fill-reducing order of the node graph; auto takes the better of METIS and AMD"},
	{.name = "precision",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnDirectDef, precision),
	 .names = precisions,
	 .meaning =
		 "mixed: Newton's directions from a copy of the factor in single precision, residuals in double; double: all "
		 "in double"},
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
	.solve_many = solve_many,
	.half = half,
	.approximate = approximate,
	.cost = cost,
};
