#include "model/assembly.h"

#include <string.h>

#include "base/parallel.h"
#include "model/scatter.h"

// Elements in a chunk: small enough that its forces or blocks stay in the cache between kernel and scatter, and a
// multiple of every batch width, so that chunks do not depend on it.
enum { FORCE_CHUNK = 64, TANGENT_CHUNK = 16, MOST_BLOCK_PAIRS = 55, MOST_NODES = 10 };

// Elements that make another thread worth waking: a fork costs 50 to 100 us, a force 0.1 us, a tangent 1 us an element.
enum { FORCE_GRAIN = 2048, TANGENT_GRAIN = 1024 };

typedef struct GroupMap {
	int pairs;  // local node pairs (i, j <= i)
	int* block; // [batches][pairs][W]: block of the pattern, ~block when transposed; NULL: matrix-free
	int* low;   // [batches]: lowest and highest node of a batch
	int* high;
} GroupMap;

struct JnAssembly {
	const JnModel* model;
	int elements;
	GroupMap* maps;   // one a group
	double** buffers; // one a thread, of a tangent chunk
	double* chunk_energy;
};

static int batches_in(int elements, const JnGroup* group) {
	return elements / group->kernel->width;
}

static int lanes_in(const JnGroup* group, int batch) {
	const int rest = group->count - batch * group->kernel->width;
	return rest < group->kernel->width ? rest : group->kernel->width;
}

static int node_at(const JnGroup* group, int batch, int i, int lane) {
	const JnKernel* kernel = group->kernel;
	return group->nodes[((size_t)batch * (size_t)kernel->nodes + (size_t)i) * (size_t)kernel->width + (size_t)lane];
}

static void map_batch(const JnPattern* pattern, const JnGroup* group, int batch, GroupMap* map) {
	const int width = group->kernel->width;
	int low = pattern->nodes, high = -1;
	for (int lane = 0; lane < width; ++lane)
		for (int i = 0; i < group->kernel->nodes; ++i) {
			const int row = node_at(group, batch, i, lane);
			low = row < low ? row : low;
			high = row > high ? row : high;
		}
	for (int lane = 0; lane < width && map->block != NULL; ++lane) {
		int* block = map->block + (size_t)batch * (size_t)map->pairs * (size_t)width + lane;
		for (int i = 0; i < group->kernel->nodes; ++i) {
			const int row = node_at(group, batch, i, lane);
			for (int j = 0; j <= i; ++j, block += width) {
				const int column = node_at(group, batch, j, lane);
				*block = row >= column ? jn_pattern_find(pattern, row, column) : ~jn_pattern_find(pattern, column, row);
			}
		}
	}
	map->low[batch] = low;
	map->high[batch] = high;
}

static JnStatus map_group(JnModel* model, const JnGroup* group, GroupMap* map) {
	const int nodes = group->kernel->nodes;
	map->pairs = nodes * (nodes + 1) / 2;
	const size_t places = (size_t)group->batches * (size_t)map->pairs * (size_t)group->kernel->width;
	if (!model->is_matrix_free) JN_NEW(&model->arena, map->block, places);
	JN_NEW(&model->arena, map->low, group->batches);
	JN_NEW(&model->arena, map->high, group->batches);
	for (int batch = 0; batch < group->batches; ++batch) map_batch(&model->pattern, group, batch, map);
	return JN_OK;
}

JnStatus jn_assembly_create(JnModel* model, JnAssembly** out) {
	JnAssembly* assembly;
	JN_NEW(&model->arena, assembly, 1);
	assembly->model = model;
	JN_NEW(&model->arena, assembly->maps, model->group_count + 1);
	size_t chunks = 0;
	for (int g = 0; g < model->group_count; ++g) {
		JN_TRY(map_group(model, &model->groups[g], &assembly->maps[g]));
		assembly->elements += model->groups[g].count;
		chunks += (size_t)model->groups[g].count / FORCE_CHUNK + 1;
	}
	JN_NEW(&model->arena, assembly->chunk_energy, chunks);
	JN_NEW(&model->arena, assembly->buffers, model->threads);
	for (int t = 0; t < model->threads; ++t)
		JN_NEW(&model->arena, assembly->buffers[t], TANGENT_CHUNK * MOST_BLOCK_PAIRS * 9);
	*out = assembly;
	return JN_OK;
}

static bool touches(const GroupMap* map, int first, int last, JnNodeRange range) {
	for (int batch = first; batch < last; ++batch)
		if (map->low[batch] < range.high && map->high[batch] >= range.low) return true;
	return false;
}

static JnScatter* scatter_of(const JnGroup* group) {
#if defined(__x86_64__)
	const int width = group->kernel->width;
	return width == 8 ? jn_scatter_8 : width == 4 ? jn_scatter_4 : jn_scatter_2;
#else
	(void)group;
	return jn_scatter_2;
#endif
}

static void add_forces(const JnAssembly* assembly, const double* x, JnNodeRange range, double* buffer, double* f) {
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		const int step = batches_in(FORCE_CHUNK, group);
		for (int first = 0; first < group->batches; first += step) {
			const int last = first + step < group->batches ? first + step : group->batches;
			if (!range.is_all && !touches(&assembly->maps[g], first, last, range)) continue;
			group->kernel->force(group, first, last, x, buffer);
			scatter_of(group)(group, first, last, buffer, 1, range, f);
		}
	}
}

// The nodes of thread `t` of `team`.
static JnNodeRange range_of(const JnAssembly* assembly, int t, int team) {
	const long nodes = assembly->model->node_count;
	return (JnNodeRange){.low = (int)(nodes * t / team), .high = (int)(nodes * (t + 1) / team), .is_all = team == 1};
}

void jn_assembly_force(JnAssembly* assembly, const double* x, double* f) {
	const int team = jn_threads_for((size_t)assembly->elements, FORCE_GRAIN, assembly->model->threads);
	if (team == 1) { // a region of one thread costs as much as a hundred springs
		add_forces(assembly, x, range_of(assembly, 0, 1), assembly->buffers[0], f);
		return;
	}
#pragma omp parallel for schedule(static) num_threads(team)
	for (int t = 0; t < team; ++t) add_forces(assembly, x, range_of(assembly, t, team), assembly->buffers[t], f);
}

typedef struct Product {
	JnTangentAt tangent;
	double scale;
	const double* p;
	double* y;
} Product;

static void add_products(const JnAssembly* assembly, const Product* product, JnNodeRange range, double* buffer) {
	const JnTangentAt* at = &product->tangent;
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		const int step = batches_in(FORCE_CHUNK, group);
		const double scale = product->scale * (at->weight != NULL ? at->weight[g] : 1);
		for (int first = 0; first < group->batches && scale != 0; first += step) {
			const int last = first + step < group->batches ? first + step : group->batches;
			if (!range.is_all && !touches(&assembly->maps[g], first, last, range)) continue;
			group->kernel->product(group, first, last, at->x, at->definite == JN_DEFINITE, product->p, buffer);
			scatter_of(group)(group, first, last, buffer, scale, range, product->y);
		}
	}
}

void jn_assembly_product(JnAssembly* assembly, JnTangentAt tangent, double scale, const double* p, double* y) {
	const Product product = {.tangent = tangent, .scale = scale, .p = p, .y = y};
	const int team = jn_threads_for((size_t)assembly->elements, FORCE_GRAIN, assembly->model->threads);
	if (team == 1) {
		add_products(assembly, &product, range_of(assembly, 0, 1), assembly->buffers[0]);
		return;
	}
#pragma omp parallel for schedule(static) num_threads(team)
	for (int t = 0; t < team; ++t) add_products(assembly, &product, range_of(assembly, t, team), assembly->buffers[t]);
}

static void add_block(double* to, const double* from, int width, double weight) {
	for (int k = 0; k < 9; ++k) to[k] += weight * from[k * width];
}

static void add_transposed(double* to, const double* from, int width, double weight) {
	for (int r = 0; r < 3; ++r)
		for (int c = 0; c < 3; ++c) to[3 * r + c] += weight * from[(3 * c + r) * width];
}

typedef struct Target {
	JnNodeRange range;
	double weight;
	double* blocks;
} Target;

static void scatter_tangent(const JnGroup* group, const GroupMap* map, int batch, const double* element,
							Target target) {
	const int width = group->kernel->width, lanes = lanes_in(group, batch);
	const int* block = map->block + (size_t)batch * (size_t)map->pairs * (size_t)width;
	for (int lane = 0; lane < lanes; ++lane)
		for (int i = 0, pair = 0; i < group->kernel->nodes; ++i)
			for (int j = 0; j <= i; ++j, ++pair) {
				const int row = node_at(group, batch, i, lane), column = node_at(group, batch, j, lane);
				const int owner = row < column ? row : column;
				if (owner < target.range.low || owner >= target.range.high) continue;
				const int place = block[pair * width + lane];
				const double* from = element + 9 * pair * width + lane;
				if (place >= 0)
					add_block(target.blocks + 9 * (size_t)place, from, width, target.weight);
				else
					add_transposed(target.blocks + 9 * (size_t)~place, from, width, target.weight);
			}
}

// Of a model that is matrix-free: block i is that of node i.
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
			for (int batch = first; batch < last; ++batch)
				if (map->block != NULL)
					scatter_tangent(group, map, batch, buffer + (batch - first) * stride, target);
				else
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
	const int team = jn_threads_for((size_t)assembly->elements, TANGENT_GRAIN, assembly->model->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int t = 0; t < team; ++t) {
		const Target target = {.range = range_of(assembly, t, team), .blocks = blocks};
		clear_columns(&assembly->model->pattern, target.range, blocks);
		add_tangents(assembly, x, definite, weight, assembly->buffers[t], target);
	}
}

// Sum of a chunk in element order, whatever the batch width.
static double chunk_sum(const JnGroup* group, int first, int last, const double* energy) {
	double sum = 0;
	for (int batch = first; batch < last; ++batch)
		for (int lane = 0; lane < lanes_in(group, batch); ++lane)
			sum += energy[(batch - first) * group->kernel->width + lane];
	return sum;
}

static double group_energy(JnAssembly* assembly, const JnGroup* group, const double* x) {
	const int step = batches_in(FORCE_CHUNK, group);
	const int chunks = (group->batches + step - 1) / step;
	const int team = jn_threads_for((size_t)group->count, FORCE_GRAIN, assembly->model->threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int c = 0; c < chunks; ++c) {
		const int first = c * step, last = first + step < group->batches ? first + step : group->batches;
		double* buffer = assembly->buffers[jn_thread_number()];
		group->kernel->energy(group, first, last, x, buffer);
		assembly->chunk_energy[c] = chunk_sum(group, first, last, buffer);
	}
	double sum = 0;
	for (int c = 0; c < chunks; ++c) sum += assembly->chunk_energy[c];
	return sum;
}

double jn_assembly_energy(JnAssembly* assembly, const double* x) {
	double sum = 0;
	for (int g = 0; g < assembly->model->group_count; ++g)
		sum += group_energy(assembly, &assembly->model->groups[g], x);
	return sum;
}

bool jn_assembly_freeze(JnAssembly* assembly, const double* x) {
	bool froze = false;
	for (int g = 0; g < assembly->model->group_count; ++g) {
		JnGroup* group = &assembly->model->groups[g];
		if (group->kernel->freeze == NULL) continue;
		group->kernel->freeze(group, 0, group->batches, x);
		froze = true;
	}
	return froze;
}
