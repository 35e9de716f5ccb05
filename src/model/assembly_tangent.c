// From element matrices to the blocks of the pattern.
#include <string.h>

#include "model/assembly_parts.h"

typedef struct Target {
	JnNodeRange range;
	double weight;
	double* blocks;
} Target;

static void add_block(double* to, const double* from, int width, double weight) {
	for (int k = 0; k < 9; ++k) to[k] += weight * from[k * width];
}

// Of the diagonal blocks alone: block i is that of node i.
static void scatter_diagonal(const JnGroup* group, int batch, const double* element, Target target) {
	const int width = group->kernel->width, lanes = lanes_in(group, batch);
	for (int lane = 0; lane < lanes; ++lane)
		for (int i = 0; i < group->kernel->nodes; ++i) {
			const int node = node_at(group, batch, i, lane), pair = i * (i + 1) / 2 + i;
			if (node < target.range.low || node >= target.range.high) continue;
			add_block(target.blocks + 9 * (size_t)node, element + 9 * pair * width + lane, width, target.weight);
		}
}

static void add_tangents(const JnAssembly* assembly, const double* x, JnDefinite definite, const double* weight,
						 double* buffer, Target target) {
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		const GroupMap* map = &assembly->maps[g];
		target.weight = weight != NULL ? weight[g] : 1;
		if (target.weight == 0) continue;
		const int step = batches_in(TANGENT_CHUNK, group), stride = 9 * map->pairs * group->kernel->width;
		for (int first = 0; first < group->batches; first += step) {
			const int last = first + step < group->batches ? first + step : group->batches;
			if (!touches(map, first, last, target.range)) continue;
			group->kernel->tangent(group, first, last, x, definite == JN_DEFINITE, buffer);
			if (map->block != NULL)
				jn_scatters(group->kernel->width)
					->blocks(group, first, last,
							 map->block + (size_t)first * (size_t)(map->pairs * group->kernel->width), buffer,
							 target.weight, target.range, target.blocks);
			for (int batch = first; batch < last && map->block == NULL; ++batch)
				scatter_diagonal(group, batch, buffer + (batch - first) * stride, target);
		}
	}
}

static void clear_columns(const JnPattern* pattern, JnNodeRange range, double* blocks) {
	const size_t first = 9 * (size_t)pattern->column_start[range.low],
				 last = 9 * (size_t)pattern->column_start[range.high];
	memset(blocks + first, 0, (last - first) * sizeof *blocks);
}

void jn_assembly_tangent(JnAssembly* assembly, const double* x, JnDefinite definite, const double* weight,
						 double* blocks) {
	const int team = team_for(assembly, TANGENT_GRAIN);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int t = 0; t < team; ++t) {
		const Target target = {.range = range_of(assembly, t, team), .blocks = blocks};
		clear_columns(&assembly->model->pattern, target.range, blocks);
		add_tangents(assembly, x, definite, weight, assembly->buffers[t], target);
	}
}

// The whole matrix of an element, of which the diagonal blocks are kept; for kernels that know no better.
static void add_diagonal_of_tangent(const JnGroup* group, int pairs, int first, int last, JnTangentAt at,
									double* buffer, Target target) {
	const int stride = 9 * pairs * group->kernel->width, step = batches_in(TANGENT_CHUNK, group);
	for (int from = first; from < last; from += step) {
		const int to = from + step < last ? from + step : last;
		group->kernel->tangent(group, from, to, at.x, at.definite == JN_DEFINITE, buffer);
		for (int batch = from; batch < to; ++batch)
			scatter_diagonal(group, batch, buffer + (batch - from) * stride, target);
	}
}

static void add_diagonals(const JnAssembly* assembly, JnTangentAt at, double* buffer, Target target) {
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		const JnKernel* kernel = group->kernel;
		target.weight = at.weight != NULL ? at.weight[g] : 1;
		if (target.weight == 0) continue;
		const int step = batches_in(FORCE_CHUNK, group);
		for (int first = 0; first < group->batches; first += step) {
			const int last = first + step < group->batches ? first + step : group->batches;
			if (!touches(&assembly->maps[g], first, last, target.range)) continue;
			if (kernel->diagonal == NULL) {
				add_diagonal_of_tangent(group, assembly->maps[g].pairs, first, last, at, buffer, target);
				continue;
			}
			kernel->diagonal(group, first, last, at.x, at.definite == JN_DEFINITE, buffer);
			jn_scatters(kernel->width)
				->triangles(group, first, last, buffer, target.weight, target.range, target.blocks);
		}
	}
}

void jn_assembly_diagonal(JnAssembly* assembly, JnTangentAt tangent, double* blocks) {
	const int team = team_for(assembly, DIAGONAL_GRAIN);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int t = 0; t < team; ++t) {
		const Target target = {.range = range_of(assembly, t, team), .blocks = blocks};
		memset(blocks + 9 * (size_t)target.range.low, 0,
			   9 * (size_t)(target.range.high - target.range.low) * sizeof *blocks);
		add_diagonals(assembly, tangent, assembly->buffers[t], target);
	}
}
