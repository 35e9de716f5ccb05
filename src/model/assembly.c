#include "model/assembly.h"

#include "model/assembly_parts.h"

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

static size_t points_of(const JnGroup* group) {
	return (size_t)group->count * (size_t)(group->kernel->law != NULL ? group->kernel->points : POINTS_OF_OTHERS);
}

JnStatus jn_assembly_create(JnModel* model, JnAssembly** out) {
	JnAssembly* assembly;
	JN_NEW(&model->arena, assembly, 1);
	assembly->model = model;
	JN_NEW(&model->arena, assembly->maps, model->group_count + 1);
	size_t chunks = 0;
	for (int g = 0; g < model->group_count; ++g) {
		JN_TRY(map_group(model, &model->groups[g], &assembly->maps[g]));
		assembly->points += points_of(&model->groups[g]);
		chunks += (size_t)model->groups[g].count / FORCE_CHUNK + 1;
	}
	JN_NEW(&model->arena, assembly->chunk_energy, chunks);
	JN_NEW(&model->arena, assembly->buffers, model->threads);
	for (int t = 0; t < model->threads; ++t)
		JN_NEW(&model->arena, assembly->buffers[t], TANGENT_CHUNK * MOST_BLOCK_PAIRS * 9);
	*out = assembly;
	return JN_OK;
}

static void add_forces(const JnAssembly* assembly, const double* x, JnNodeRange range, double* buffer, double* f) {
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		const int step = batches_in(FORCE_CHUNK, group);
		for (int first = 0; first < group->batches; first += step) {
			const int last = first + step < group->batches ? first + step : group->batches;
			if (!range.is_all && !touches(&assembly->maps[g], first, last, range)) continue;
			group->kernel->force(group, first, last, x, buffer);
			jn_scatters(group->kernel->width)->forces(group, first, last, buffer, 1, range, f);
		}
	}
}

void jn_assembly_force(JnAssembly* assembly, const double* x, double* f) {
	const int team = team_for(assembly, FORCE_GRAIN);
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
			jn_scatters(group->kernel->width)->forces(group, first, last, buffer, scale, range, product->y);
		}
	}
}

void jn_assembly_product(JnAssembly* assembly, JnTangentAt tangent, double scale, const double* p, double* y) {
	const Product product = {.tangent = tangent, .scale = scale, .p = p, .y = y};
	const int team = team_for(assembly, FORCE_GRAIN);
	if (team == 1) {
		add_products(assembly, &product, range_of(assembly, 0, 1), assembly->buffers[0]);
		return;
	}
#pragma omp parallel for schedule(static) num_threads(team)
	for (int t = 0; t < team; ++t) add_products(assembly, &product, range_of(assembly, t, team), assembly->buffers[t]);
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
	const int team = jn_threads_for(points_of(group), FORCE_GRAIN, assembly->model->threads);
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
