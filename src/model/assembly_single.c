#include "model/assembly_single.h"

#include <string.h>

#include "base/aligned.h"
#include "model/assembly_parts.h"
#include "model/mass_single.h"

typedef float Four __attribute__((vector_size(16)));
typedef float FourInMemory __attribute__((vector_size(16), aligned(4), may_alias));

static Four load(const float* from) {
	return *(const FourInMemory*)from;
}

bool jn_assembly_has_single(const JnAssembly* assembly, const double* weight) {
	for (int g = 0; g < assembly->model->group_count; ++g)
		if ((weight == NULL || weight[g] != 0) && assembly->model->groups[g].kernel->product_single == NULL)
			return false;
	return true;
}

static size_t floats_of(const JnGroup* group, JnDefinite definite) {
	const JnKernel* kernel = group->kernel;
	const size_t pairs = ((size_t)group->batches + 1) / 2;
	return pairs * 2 * (size_t)kernel->width * (size_t)kernel->points *
		   (size_t)kernel->stored_reals[definite == JN_DEFINITE];
}

static bool takes(const JnStored* stored, int group) {
	return stored->weight == NULL || stored->weight[group] != 0;
}

static bool make_room(const JnAssembly* assembly, JnStored* stored) {
	size_t count = 1;
	for (int g = 0; g < assembly->model->group_count; ++g)
		if (takes(stored, g)) count += floats_of(&assembly->model->groups[g], stored->definite);
	if (count <= stored->capacity) return true;
	jn_stored_free(stored);
	stored->numbers = jn_aligned_take(count * sizeof(float));
	stored->capacity = stored->numbers != NULL ? count : 0;
	return stored->numbers != NULL;
}

void jn_stored_free(JnStored* stored) {
	jn_aligned_free(stored->numbers);
	stored->numbers = NULL;
	stored->capacity = 0;
}

// Pairs of batches first <= pair < last. A batch without a partner leaves half of its pair, where zeros stand: what lies in
// memory by chance may be infinite.
static void store_pairs(const JnGroup* group, JnTangentAt at, int first, int last, float* numbers) {
	const size_t floats = floats_of(group, at.definite) / (((size_t)group->batches + 1) / 2);
	if (2 * last > group->batches) memset(numbers + (size_t)(last - 1) * floats, 0, floats * sizeof *numbers);
	const int end = 2 * last < group->batches ? 2 * last : group->batches;
	group->kernel->store(group, 2 * first, end, at.x, at.definite == JN_DEFINITE, numbers);
}

bool jn_assembly_store(JnAssembly* assembly, JnTangentAt at, JnStored* stored) {
	stored->definite = at.definite;
	stored->weight = at.weight;
	if (!make_room(assembly, stored)) return false;
	float* numbers = stored->numbers;
	const int team = team_for(assembly, FORCE_GRAIN);
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		if (!takes(stored, g)) continue;
		const long pairs = (group->batches + 1) / 2;
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
		for (int t = 0; t < team; ++t)
			store_pairs(group, at, (int)(pairs * t / team), (int)(pairs * (t + 1) / team), numbers);
		numbers += floats_of(group, at.definite);
	}
	return true;
}

static Four full_row(const JnPattern* pattern, const float* full, const float* p, int row) {
	Four even = {0}, odd = {0};
	int k = pattern->full_start[row];
	const int end = pattern->full_start[row + 1];
	for (; k + 1 < end; k += 2) {
		even += full[k] * load(p + 4 * (size_t)pattern->full_column[k]);
		odd += full[k + 1] * load(p + 4 * (size_t)pattern->full_column[k + 1]);
	}
	if (k < end) even += full[k] * load(p + 4 * (size_t)pattern->full_column[k]);
	return even + odd;
}

// The rows low <= row < high of y.
static void put_scalars(const JnPattern* pattern, const JnSingleSum* sum, JnNodeRange range, const float* p, float* y) {
	for (int row = range.low; row < range.high; ++row) {
		Four total = {0};
		for (int i = 0; i < JN_SINGLE_TERMS; ++i) {
			const JnScalarTerm* term = &sum->scalars[i];
			if (term->scale == 0) continue;
			if (term->full != NULL)
				total += (float)term->scale * full_row(pattern, term->full, p, row);
			else
				total += (float)(term->scale * term->blocks[pattern->column_start[row]]) * load(p + 4 * (size_t)row);
		}
		*(FourInMemory*)(y + 4 * (size_t)row) = total;
	}
}

// `mass`: of each group, or NULL.
static void add_stored(const JnAssembly* assembly, JnStoredTerm term, const double* mass, JnNodeRange range,
					   const float* p, float* buffer, float* y) {
	const JnStored* stored = term.stored;
	const float* numbers = stored->numbers;
	for (int g = 0; g < assembly->model->group_count; ++g) {
		const JnGroup* group = &assembly->model->groups[g];
		const JnKernel* kernel = group->kernel;
		if (!takes(stored, g)) continue;
		const float scale = (float)(term.scale * (stored->weight != NULL ? stored->weight[g] : 1));
		const bool definite = stored->definite == JN_DEFINITE;
		const int step = batches_in(FORCE_CHUNK, group);
		const size_t floats = (size_t)kernel->width * (size_t)kernel->points * (size_t)kernel->stored_reals[definite];
		for (int first = 0; first < group->batches; first += step) {
			const int last = first + step < group->batches ? first + step : group->batches;
			if (!range.is_all && !touches(&assembly->maps[g], first, last, range)) continue;
			kernel->product_single(group, first, last, definite, numbers + (size_t)first * floats, p, buffer);
			if (mass != NULL) jn_mass_single(kernel->width)(group, first, last, mass[g] / (double)scale, p, buffer);
			jn_scatters(kernel->width)->single(group, first, last, buffer, scale, range, y);
		}
		numbers += floats_of(group, stored->definite);
	}
}

static void apply_range(const JnAssembly* assembly, const JnSingleSum* sum, JnNodeRange range, const float* p,
						double* buffer, float* y) {
	put_scalars(&assembly->model->pattern, sum, range, p, y);
	for (int i = 0; i < JN_SINGLE_TERMS; ++i)
		if (sum->stored[i].scale != 0)
			add_stored(assembly, sum->stored[i], i == 0 ? sum->mass : NULL, range, p, (void*)buffer, y);
}

void jn_assembly_apply_single(JnAssembly* assembly, const JnSingleSum* sum, const float* p, float* y) {
	const int team = team_for(assembly, FORCE_GRAIN);
	if (team == 1) {
		apply_range(assembly, sum, range_of(assembly, 0, 1), p, assembly->buffers[0], y);
		return;
	}
#pragma omp parallel for schedule(static) num_threads(team)
	for (int t = 0; t < team; ++t) apply_range(assembly, sum, range_of(assembly, t, team), p, assembly->buffers[t], y);
}
