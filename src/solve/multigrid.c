// The preconditioner `multigrid`: one hierarchy of levels, made for the matrix of the last renewal, serves all slots. On the
// finest level it works with the present matrix of the slot, and what comes from coarser levels is scaled by the ratio of
// the two diagonals.
#include <stdlib.h>

#include "base/log.h"
#include "base/processor.h"
#include "solve/multigrid.h"

// Sums of the diagonals of two matrices that the same levels may serve differ by less than this factor.
static const double alike = 8;

static const JnGridKernels* best_kernels(void) {
#if defined(__x86_64__)
	const int width = jn_processor_width();
	return width == 8 ? &jn_grid_kernels_8 : width == 4 ? &jn_grid_kernels_4 : &jn_grid_kernels_2;
#else
	return &jn_grid_kernels_2;
#endif
}

static void destroy(JnPrecondition* base) {
	if (base == NULL) return;
	JnMultigrid* grid = (JnMultigrid*)base;
	jn_arena_free(&grid->arena);
	free(grid);
}

static JnStatus fill_finest(JnMultigrid* grid) {
	JnGridLevel* level = &grid->levels[0];
	const JnPattern* pattern = grid->pattern;
	const size_t reals = 4 * (size_t)pattern->nodes + 1;
	*level = (JnGridLevel){.nodes = pattern->nodes,
						   .size = 3,
						   .stride = 4,
						   .start = pattern->full_start,
						   .column = pattern->full_column,
						   .full_block = pattern->full_block,
						   .held = grid->held};
	JN_NEW(&grid->arena, level->center, reals);
	JN_NEW(&grid->arena, level->vector, reals);
	JN_NEW(&grid->arena, level->r, reals);
	JN_NEW(&grid->arena, level->d, reals);
	JN_NEW(&grid->arena, level->q, reals);
	return JN_OK;
}

// What levels will cost, before there are any: the narrower the rows of A, the more room coarser ones take beside them.
static void guess_operations(JnMultigrid* grid) {
	const double row = (double)grid->pattern->full_start[grid->pattern->nodes] / (grid->pattern->nodes + 1);
	const bool is_wide = row > 14; // solids; else sheets of triangles and threads
	grid->base.apply_products = is_wide ? 5.3 : 10;
	grid->base.setup_products = is_wide ? 50 : 90;
}

static JnStatus create(const JnPattern* pattern, const bool* held, int threads, const JnOperator* matrices,
					   JnPrecondition** out) {
	*out = NULL;
	JnMultigrid* grid = calloc(1, sizeof *grid);
	if (grid == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: multigrid");
	*grid = (JnMultigrid){.base.type = &jn_precondition_multigrid,
						  .pattern = pattern,
						  .held = held,
						  .threads = threads,
						  .matrices = matrices,
						  .kernels = best_kernels()};
	guess_operations(grid);
	const JnStatus status = fill_finest(grid);
	if (status != JN_OK) {
		destroy(&grid->base);
		return status;
	}
	*out = &grid->base;
	return JN_OK;
}

// Operations of all but the products with A, given in products with A.
static void count_operations(JnMultigrid* grid) {
	const double finest = 18.0 * grid->levels[0].start[grid->pattern->nodes];
	double apply = 0, setup = 0;
	for (int l = 0; l + 1 < grid->used; ++l) {
		const JnGridLevel *level = &grid->levels[l], *coarse = level + 1;
		const double row = coarse->start[coarse->nodes], smoothing = level->start[level->nodes];
		apply += 4.0 * level->size * JN_GRID_MODES * level->p_start[level->nodes];
		apply += 4 * 2.0 * JN_GRID_MODES * JN_GRID_MODES * row;
		setup += level->work + 2.0 * level->size * level->size * JN_GRID_MODES * smoothing;
	}
	grid->base.apply_products = grid->used > 1 ? 4 + apply / finest : 0;
	grid->base.setup_products = setup / finest;
}

// Levels made for a time step of another order of magnitude would do harm: what is rigid there is mass here.
static bool is_alike(const JnMultigrid* grid, int slot) {
	const double ratio = grid->slots[slot].size / grid->size;
	return ratio < alike && ratio * alike > 1;
}

static JnStatus update(JnPrecondition* base, int slot, bool renew) {
	JnMultigrid* grid = (JnMultigrid*)base;
	const bool is_first = grid->count == 0;
	JN_TRY(jn_grid_renew_slot(grid, slot));
	if (!renew && !is_first && is_alike(grid, slot)) return JN_OK;
	grid->count = is_first ? 1 : grid->count;
	JN_TRY(jn_grid_renew(grid, slot));
	count_operations(grid);
	return JN_OK;
}

static void apply(JnPrecondition* base, int slot, const float* r, float* z) {
	JnMultigrid* grid = (JnMultigrid*)base;
	grid->levels[0].inverse = grid->slots[slot].inverse;
	grid->levels[0].eigenvalue = grid->slots[slot].eigenvalue;
	if (grid->used > 1)
		jn_grid_cycle(grid, slot, 0, r, z);
	else
		grid->kernels->relax(&grid->levels[0], (JnGridRelax){.c = 1, .beta = 1}, r, NULL, z, grid->threads);
}

static size_t bytes(const JnPrecondition* base) {
	return ((const JnMultigrid*)base)->arena.used;
}

const JnPreconditionType jn_precondition_multigrid = {
	.name = "multigrid",
	.create = create,
	.destroy = destroy,
	.update = update,
	.apply = apply,
	.bytes = bytes,
};
