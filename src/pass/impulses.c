#include "pass/impulses.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "math/vec3.h"
#include "math/wide.h"

static const double longest_guess =
	10; // times a step: what a far shorter one leaves to do is not in proportion to its time

void jn_impulses_release(JnImpulses* set) {
	free(set->blocks);
	free(set->entries);
	*set = (JnImpulses){0};
}

JnStatus jn_impulses_reserve(JnImpulses* set, int blocks, int entries) {
	JN_TRY(jn_grow((void**)&set->blocks, &set->capacity, (size_t)blocks, sizeof *set->blocks));
	return jn_grow((void**)&set->entries, &set->entry_capacity, (size_t)entries, sizeof *set->entries);
}

JnStatus jn_impulses_add(JnImpulses* set, uint64_t id, JnBlockKind kind, int count, JnBlock** out) {
	JN_TRY(jn_impulses_reserve(set, set->count + 1, set->entry_count + count));
	JnBlock* block = &set->blocks[set->count++];
	*block = (JnBlock){.id = id, .kind = kind, .first = set->entry_count, .count = count};
	set->entry_count += count;
	*out = block;
	return JN_OK;
}

// Member by member, for there is padding between; the numbers from the frame on stand together.
static void archive_block(JnBlock* block, JnArchive* archive, int entries) {
	int head[4] = {(int)block->kind, block->is_active, block->first, block->count};
	jn_archive_bytes(archive, "id", &block->id, sizeof block->id);
	jn_archive_bytes(archive, "head", head, sizeof head);
	jn_archive_bytes(archive, "block", block->frame, sizeof *block - offsetof(JnBlock, frame));
	const bool is_sound = head[2] >= 0 && head[3] >= 0 && head[3] <= entries && head[2] <= entries - head[3];
	if (!is_sound) jn_archive_refuse(archive, "head", "has more entries than there are");
	block->kind = (JnBlockKind)head[0];
	block->is_active = head[1] != 0;
	block->first = is_sound ? head[2] : 0;
	block->count = is_sound ? head[3] : 0;
}

void jn_impulses_archive(JnImpulses* set, JnArchive* archive, int nodes) {
	const int count = jn_archive_count(archive, "blocks", set->count, sizeof *set->blocks);
	const int entries = jn_archive_count(archive, "entries", set->entry_count, sizeof *set->entries);
	const JnStatus status = archive->is_reading ? jn_impulses_reserve(set, count, entries) : JN_OK;
	if (archive->status == JN_OK) archive->status = status;
	if (archive->is_reading && status == JN_OK && count > 0)
		memset(set->blocks, 0, (size_t)count * sizeof *set->blocks);
	for (int i = 0; i < count && archive->status == JN_OK; ++i) archive_block(&set->blocks[i], archive, entries);
	for (int k = 0; k < entries && archive->status == JN_OK; ++k) {
		jn_archive_indices(archive, "node", &set->entries[k].node, 1, 0, nodes);
		jn_archive_reals(archive, "weight", set->entries[k].weight, 2);
	}
	jn_archive_real(archive, "dt", &set->dt);
	if (!archive->is_reading) return;
	set->count = archive->status == JN_OK ? count : 0;
	set->entry_count = archive->status == JN_OK ? entries : 0;
}

void jn_block_complete_frame(double frame[3][3]) {
	const double* n = frame[0];
	const int least =
		fabs(n[0]) <= fabs(n[1]) ? (fabs(n[0]) <= fabs(n[2]) ? 0 : 2) : (fabs(n[1]) <= fabs(n[2]) ? 1 : 2);
	double other[3] = {0, 0, 0};
	other[least] = 1;
	vec3_cross(n, other, frame[1]);
	vec3_normalize(frame[1]);
	vec3_cross(n, frame[1], frame[2]);
}

// out = sum of weight[which] * y
static inline void gather(const JnImpulses* set, const JnBlock* block, int which, const double* y, double out[3]) {
	out[0] = out[1] = out[2] = 0;
	for (int k = block->first; k < block->first + block->count; ++k) {
		const double* at = y + 3 * (ptrdiff_t)set->entries[k].node;
		const double w = set->entries[k].weight[which];
		for (int a = 0; a < 3; ++a) out[a] += w * at[a];
	}
}

void jn_block_motion(const JnImpulses* set, const JnBlock* block, const double* y, double out[3]) {
	double sum[3];
	gather(set, block, 0, y, sum);
	out[0] = vec3_dot(block->frame[0], sum);
	gather(set, block, 1, y, sum);
	out[1] = vec3_dot(block->frame[1], sum);
	out[2] = vec3_dot(block->frame[2], sum);
}

void jn_block_push(const JnImpulses* set, const JnBlock* block, const double lambda[3], double scale,
				   const double* inverse_mass, double* y) {
	for (int k = block->first; k < block->first + block->count; ++k) {
		const JnBlockEntry* entry = &set->entries[k];
		for (int a = 0; a < 3; ++a) {
			const ptrdiff_t at = 3 * (ptrdiff_t)entry->node + a;
			const double push = entry->weight[0] * lambda[0] * block->frame[0][a] +
								entry->weight[1] * (lambda[1] * block->frame[1][a] + lambda[2] * block->frame[2][a]);
			y[at] += scale * push * (inverse_mass != NULL ? inverse_mass[at] : 1);
		}
	}
}

// In order already, but for the last few: insertion.
static void sort(JnImpulses* set) {
	for (int i = 1; i < set->count; ++i) {
		if (set->blocks[i - 1].id <= set->blocks[i].id) continue;
		const JnBlock block = set->blocks[i];
		int k = i;
		for (; k > 0 && set->blocks[k - 1].id > block.id; --k) set->blocks[k] = set->blocks[k - 1];
		set->blocks[k] = block;
	}
}

static void find_inverse(const JnImpulses* set, const double* inverse_mass, JnBlock* block) {
	double sum[3] = {0, 0, 0};
	for (int k = block->first; k < block->first + block->count; ++k) {
		const JnBlockEntry* entry = &set->entries[k];
		for (int a = 0; a < 3; ++a)
			block->couple[a] += entry->weight[0] * entry->weight[1] * inverse_mass[3 * (ptrdiff_t)entry->node + a];
		for (int r = 0; r < 3; ++r)
			for (int a = 0; a < 3; ++a) {
				const double along = entry->weight[r > 0] * block->frame[r][a];
				sum[r] += along * along * inverse_mass[3 * (ptrdiff_t)entry->node + a];
			}
	}
	for (int r = 0; r < 3; ++r) block->inverse[r] = sum[r] > 0 ? 1 / sum[r] : 0;
}

void jn_impulses_finish(JnImpulses* set, const double* inverse_mass) {
	sort(set);
	for (int i = 0; i < set->count; ++i) find_inverse(set, inverse_mass, &set->blocks[i]);
}

// Impulses as vectors in space, seen in the frame of another block.
static void turn(const JnBlock* from, JnLevel level, double scale, JnBlock* to) {
	for (int r = 0; r < 3; ++r) {
		to->impulse[level][r] = 0;
		for (int s = 0; s < 3; ++s)
			to->impulse[level][r] += scale * from->impulse[level][s] * vec3_dot(from->frame[s], to->frame[r]);
	}
	if (to->kind == JN_BLOCK_CONTACT && to->impulse[level][0] < 0)
		memset(to->impulse[level], 0, sizeof to->impulse[level]);
}

void jn_impulses_warm(JnImpulses* set, const JnImpulses* old) {
	const double ratio = old->dt > 0 ? fmin(set->dt / old->dt, longest_guess) : 0;
	for (int i = 0, k = 0; i < set->count; ++i) {
		JnBlock* block = &set->blocks[i];
		while (k < old->count && old->blocks[k].id < block->id) ++k;
		if (k == old->count || old->blocks[k].id != block->id) continue;
		turn(&old->blocks[k], JN_LEVEL_POSITION, ratio * ratio, block);
		turn(&old->blocks[k], JN_LEVEL_VELOCITY, ratio, block);
	}
}

void jn_impulses_join(JnImpulses* set, const JnImpulses* old) {
	for (int i = 0, k = 0; i < set->count; ++i) {
		JnBlock* block = &set->blocks[i];
		while (k < old->count && old->blocks[k].id < block->id) ++k;
		if (k == old->count || old->blocks[k].id != block->id) continue;
		const double own[3] = {block->impulse[JN_LEVEL_POSITION][0], block->impulse[JN_LEVEL_POSITION][1],
							   block->impulse[JN_LEVEL_POSITION][2]};
		turn(&old->blocks[k], JN_LEVEL_POSITION, 1, block);
		turn(&old->blocks[k], JN_LEVEL_VELOCITY, 1, block);
		for (int r = 0; r < 3; ++r) block->impulse[JN_LEVEL_POSITION][r] += own[r];
	}
}

// ---- a sweep

// A block in the middle of a sweep: sums of weight * y for row 0 and for the others, and changes of their impulses in space.
typedef struct Visit {
	double sum[2][3], push[2][3];
} Visit;

static inline void look(const JnImpulses* set, const JnBlock* block, const double* y, Visit* visit) {
	double first[3] = {0, 0, 0}, others[3] = {0, 0, 0};
	const JnBlockEntry* entry = set->entries + block->first;
	for (const JnBlockEntry* last = entry + block->count; entry < last; ++entry) {
		const double* at = y + 3 * (ptrdiff_t)entry->node;
		JN_UNROLL for (int a = 0; a < 3; ++a) {
			first[a] += entry->weight[0] * at[a];
			others[a] += entry->weight[1] * at[a];
		}
	}
	*visit = (Visit){.sum = {{first[0], first[1], first[2]}, {others[0], others[1], others[2]}}};
}

// y += M^-1 of both pushes.
static inline void act(const JnImpulses* set, const JnBlock* block, const Visit* visit, const double* inverse_mass,
					   double* y) {
	const double *p = visit->push[0], *q = visit->push[1];
	const JnBlockEntry* entry = set->entries + block->first;
	for (const JnBlockEntry* last = entry + block->count; entry < last; ++entry) {
		const ptrdiff_t at = 3 * (ptrdiff_t)entry->node;
		JN_UNROLL for (int a = 0; a < 3; ++a) y[at + a] +=
			inverse_mass[at + a] * (entry->weight[0] * p[a] + entry->weight[1] * q[a]);
	}
}

// Shorten (a, b) to the radius.
static inline void clamp_disk(double* a, double* b, double radius) {
	const double square = *a * *a + *b * *b;
	if (square <= radius * radius) return;
	const double share = radius / sqrt(square);
	*a *= share;
	*b *= share;
}

static inline double larger(double a, double b) {
	return a > b ? a : b;
}

// Rows 1 and 2, whose impulse stays within the radius; what that does to row 0. Returns the largest change of their motion.
static inline double visit_pair(JnBlock* block, JnLevel level, double radius, Visit* visit) {
	double* lambda = block->impulse[level];
	const double *d = block->frame[1], *e = block->frame[2], *sum = visit->sum[1];
	double a = lambda[1] - block->inverse[1] * (vec3_dot(d, sum) - block->target[level][1]);
	double b = lambda[2] - block->inverse[2] * (vec3_dot(e, sum) - block->target[level][2]);
	clamp_disk(&a, &b, radius);
	const double da = a - lambda[1], db = b - lambda[2];
	JN_UNROLL for (int k = 0; k < 3; ++k) {
		visit->push[1][k] = da * d[k] + db * e[k];
		visit->sum[0][k] += block->couple[k] * visit->push[1][k];
	}
	lambda[1] = a;
	lambda[2] = b;
	return larger(block->inverse[1] > 0 ? fabs(da) / block->inverse[1] : 0,
				  block->inverse[2] > 0 ? fabs(db) / block->inverse[2] : 0);
}

// Row 0, whose impulse stays between two bounds, likewise.
static inline double visit_first(JnBlock* block, JnLevel level, double low, double high, Visit* visit) {
	double* lambda = block->impulse[level];
	const double* d = block->frame[0];
	double found = lambda[0] - block->inverse[0] * (vec3_dot(d, visit->sum[0]) - block->target[level][0]);
	found = found < low ? low : found > high ? high : found;
	const double change = found - lambda[0];
	JN_UNROLL for (int k = 0; k < 3; ++k) {
		visit->push[0][k] = change * d[k];
		visit->sum[1][k] += block->couple[k] * visit->push[0][k];
	}
	lambda[0] = found;
	return fabs(change) / block->inverse[0];
}

static double sweep_block(const JnImpulses* set, JnBlock* block, JnLevel level, const double* inverse_mass, double* y) {
	double *lambda = block->impulse[level], change;
	Visit visit;
	if (block->inverse[0] == 0) return 0;
	look(set, block, y, &visit);
	if (block->kind == JN_BLOCK_SITE) {
		change = visit_pair(block, level, INFINITY, &visit);
		const double bound = block->friction * sqrt(lambda[1] * lambda[1] + lambda[2] * lambda[2]) + block->hold[level];
		change = larger(change, visit_first(block, level, -bound, bound, &visit));
	} else {
		change = visit_first(block, level, 0, INFINITY, &visit);
		if (block->friction > 0 && (lambda[0] > 0 || lambda[1] != 0 || lambda[2] != 0))
			change = larger(change, visit_pair(block, level, block->friction * lambda[0], &visit));
	}
	if (change > 0) act(set, block, &visit, inverse_mass, y);
	return change;
}

// y += M^-1 J^T impulses. Returns the largest motion of a row that its impulse makes.
static double begin(const JnImpulses* set, JnLevel level, const double* inverse_mass, double* y) {
	double scale = 0;
	for (int i = 0; i < set->count; ++i) {
		const JnBlock* block = &set->blocks[i];
		const double* lambda = block->impulse[level];
		if (lambda[0] == 0 && lambda[1] == 0 && lambda[2] == 0) continue;
		for (int r = 0; r < 3; ++r)
			if (block->inverse[r] > 0) scale = fmax(scale, fabs(lambda[r]) / block->inverse[r]);
		jn_block_push(set, block, lambda, 1, inverse_mass, y);
	}
	return scale;
}

int jn_impulses_solve(JnImpulses* set, JnLevel level, const double* inverse_mass, int most, double tolerance,
					  double* y) {
	double scale = begin(set, level, inverse_mass, y);
	for (int sweep = 0; sweep < most; ++sweep) {
		double largest = 0;
		for (int i = 0; i < set->count; ++i) {
			JnBlock* block = &set->blocks[i];
			if (level == JN_LEVEL_POSITION || block->is_active)
				largest = fmax(largest, sweep_block(set, block, level, inverse_mass, y));
		}
		scale = fmax(scale, largest);
		if (largest <= tolerance * scale) return sweep + 1;
	}
	return most;
}
