// Vectors are cut into chunks of CHUNK entries. A reduction sums each chunk in LANES interleaved accumulators and then
// the chunks in order, so that its bits depend neither on the threads nor on the width of the vector unit.
#include "base/space.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "base/parallel.h"

enum { CHUNK = 4096, LANES = 8, ALIGNMENT = 64, GRAIN = 65536, MOST_TERMS = 16 };

typedef struct HostSpace {
	JnSpace base;
	size_t chunks;
	double* partial; // one number a chunk
} HostSpace;

static JnVec create(JnSpace* space) {
	const size_t bytes = (space->length * sizeof(double) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
	JnVec vec = aligned_alloc(ALIGNMENT, bytes > 0 ? bytes : ALIGNMENT);
	if (vec == NULL) {
		jn_error(JN_OUT_OF_MEMORY, "out of memory: a vector of %zu numbers", space->length);
		return NULL;
	}
	return memset(vec, 0, bytes);
}

static void destroy(JnSpace* space, JnVec vec) {
	(void)space;
	free(vec);
}

static int threads_of(const JnSpace* space) {
	return jn_threads_for(space->length, GRAIN, space->threads);
}

static size_t chunk_end(const JnSpace* space, size_t chunk) {
	const size_t end = (chunk + 1) * CHUNK;
	return end < space->length ? end : space->length;
}

// Entries are independent even where `out` is one of the terms: each is read before it is written.
#if defined(__clang__)
	#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
	#define INDEPENDENT _Pragma("GCC ivdep")
#endif

static void combine_one(double* out, const JnTerm* t, size_t n) {
	const double* a = t->vec;
	const double sa = t->scale;
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = sa * a[k];
}

static void combine_two(double* out, const JnTerm* t, size_t n) {
	const double *a = t[0].vec, *b = t[1].vec;
	const double sa = t[0].scale, sb = t[1].scale;
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = sa * a[k] + sb * b[k];
}

static void combine_three(double* out, const JnTerm* t, size_t n) {
	const double *a = t[0].vec, *b = t[1].vec, *c = t[2].vec;
	const double sa = t[0].scale, sb = t[1].scale, sc = t[2].scale;
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = sa * a[k] + sb * b[k] + sc * c[k];
}

// More terms than that: each chunk is summed beside, since `out` may be a term that is still to come.
static void combine_many(double* out, int count, const JnTerm terms[], size_t n) {
	double sum[CHUNK];
	for (size_t k = 0; k < n; ++k) sum[k] = terms[0].scale * terms[0].vec[k];
	for (int i = 1; i < count; ++i) {
		const double* vec = terms[i].vec;
		const double scale = terms[i].scale;
		for (size_t k = 0; k < n; ++k) sum[k] += scale * vec[k];
	}
	memcpy(out, sum, n * sizeof *sum);
}

// out[first .. last) = sum of the terms, in their order.
static void combine_range(double* out, int count, const JnTerm terms[], size_t first, size_t last) {
	JnTerm here[MOST_TERMS];
	for (int i = 0; i < count; ++i) here[i] = (JnTerm){terms[i].scale, terms[i].vec + first};
	const size_t n = last - first;
	if (count == 1)
		combine_one(out + first, here, n);
	else if (count == 2)
		combine_two(out + first, here, n);
	else if (count == 3)
		combine_three(out + first, here, n);
	else
		combine_many(out + first, count, here, n);
}

static void combine(JnSpace* space, JnVec out, int count, const JnTerm terms[]) {
	const long chunks = (long)((HostSpace*)space)->chunks;
	assert(count >= 0 && count <= MOST_TERMS);
	if (count == 0) {
		memset(out, 0, space->length * sizeof *out);
		return;
	}
	if (threads_of(space) == 1) {
		for (long c = 0; c < chunks; ++c)
			combine_range(out, count, terms, (size_t)c * CHUNK, chunk_end(space, (size_t)c));
		return;
	}
#pragma omp parallel for schedule(static) num_threads(threads_of(space))
	for (long c = 0; c < chunks; ++c) combine_range(out, count, terms, (size_t)c * CHUNK, chunk_end(space, (size_t)c));
}

static double dot_range(const double* a, const double* b, size_t n) {
	double lane[LANES] = {0};
	size_t k = 0;
	for (; k + LANES <= n; k += LANES)
		for (int l = 0; l < LANES; ++l) lane[l] += a[k + (size_t)l] * b[k + (size_t)l];
	for (int l = 0; k < n; ++k, ++l) lane[l] += a[k] * b[k];
	return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

static double dot(JnSpace* space, const double* a, const double* b) {
	HostSpace* host = (HostSpace*)space;
	const long chunks = (long)host->chunks;
#pragma omp parallel for schedule(static) num_threads(threads_of(space)) if (threads_of(space) > 1)
	for (long c = 0; c < chunks; ++c) {
		const size_t first = (size_t)c * CHUNK;
		host->partial[c] = dot_range(a + first, b + first, chunk_end(space, (size_t)c) - first);
	}
	double sum = 0;
	for (long c = 0; c < chunks; ++c) sum += host->partial[c];
	return sum;
}

static double max_range(const double* a, size_t n) {
	double largest = 0;
	for (size_t k = 0; k < n; ++k) {
		const double size = fabs(a[k]);
		if (!(size <= largest)) largest = size; // true for NAN, which then stays
		if (isnan(largest)) return largest;
	}
	return largest;
}

static double max(JnSpace* space, const double* a) {
	return max_range(a, space->length);
}

static double longest(JnSpace* space, const double* a) {
	const size_t entries = space->node_entries > 1 ? (size_t)space->node_entries : 1;
	double largest = 0;
	for (size_t k = 0; k < space->length; k += entries) {
		double square = 0;
		for (size_t i = 0; i < entries; ++i) square += a[k + i] * a[k + i];
		if (!(square <= largest)) largest = square; // true for NAN, which then stays
		if (isnan(largest)) return largest;
	}
	return sqrt(largest);
}

static const JnSpaceOps host_ops = {
	.create = create, .destroy = destroy, .combine = combine, .dot = dot, .max = max, .longest = longest};

JnSpace* jn_host_space_create(size_t length, int threads) {
	HostSpace* host = calloc(1, sizeof *host);
	const size_t chunks = (length + CHUNK - 1) / CHUNK;
	double* partial = calloc(chunks + 1, sizeof *partial);
	if (host == NULL || partial == NULL) {
		free(host);
		free(partial);
		jn_error(JN_OUT_OF_MEMORY, "out of memory: a space of %zu numbers", length);
		return NULL;
	}
	host->base = (JnSpace){.ops = &host_ops, .length = length, .threads = threads > 0 ? threads : 1};
	host->chunks = chunks;
	host->partial = partial;
	return &host->base;
}

void jn_host_space_destroy(JnSpace* space) {
	if (space == NULL) return;
	free(((HostSpace*)space)->partial);
	free(space);
}

JnStatus jn_state_create(JnSpace* space, JnState* state) {
	*state = (JnState){.x = space->ops->create(space), .v = space->ops->create(space)};
	if (state->x != NULL && state->v != NULL) return JN_OK;
	jn_state_destroy(space, state);
	return JN_OUT_OF_MEMORY;
}

void jn_state_destroy(JnSpace* space, JnState* state) {
	space->ops->destroy(space, state->x);
	space->ops->destroy(space, state->v);
	*state = (JnState){0};
}

void jn_state_copy(JnSpace* space, const JnState* from, JnState* to) {
	space->ops->combine(space, to->x, 1, &(JnTerm){1, from->x});
	space->ops->combine(space, to->v, 1, &(JnTerm){1, from->v});
	to->t = from->t;
	to->stamp = from->stamp;
}
