// Vectors are cut into chunks of CHUNK entries. A reduction sums each chunk in interleaved accumulators and then
// the chunks in order, so that its bits depend neither on the threads nor on the width of the vector unit.
#include "base/space.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/algebra.h"
#include "base/aligned.h"
#include "base/log.h"
#include "base/parallel.h"

enum { CHUNK = JN_ALGEBRA_CHUNK, GRAIN = 65536, MOST_TERMS = 16 };

typedef struct HostSpace {
	JnSpace base;
	const JnAlgebra* algebra;
	size_t chunks;
	double* partial; // one number a chunk
} HostSpace;

static JnVec create(JnSpace* space) {
	JnVec vec = jn_aligned_take(space->length * sizeof(double));
	if (vec == NULL) jn_error(JN_OUT_OF_MEMORY, "out of memory: a vector of %zu numbers", space->length);
	return vec;
}

static void destroy(JnSpace* space, JnVec vec) {
	(void)space;
	jn_aligned_free(vec);
}

static int threads_of(const JnSpace* space) {
	return jn_threads_for(space->length, GRAIN, space->threads);
}

static size_t chunk_end(const JnSpace* space, size_t chunk) {
	const size_t end = (chunk + 1) * CHUNK;
	return end < space->length ? end : space->length;
}

// out[first .. last) = sum of the terms, in their order.
static void combine_range(const JnAlgebra* algebra, JnVec out, int count, const JnTerm terms[], size_t first,
						  size_t last) {
	JnTerm here[MOST_TERMS];
	for (int i = 0; i < count; ++i) here[i] = (JnTerm){terms[i].scale, terms[i].vec + first};
	algebra->combine(last - first, count, here, out + first);
}

static void combine(JnSpace* space, JnVec out, int count, const JnTerm terms[]) {
	const HostSpace* host = (const HostSpace*)space;
	const long chunks = (long)host->chunks;
	assert(count >= 0 && count <= MOST_TERMS);
	if (count == 0) {
		memset(out, 0, space->length * sizeof *out);
		return;
	}
	if (chunks == 1) {
		host->algebra->combine(space->length, count, terms, out);
		return;
	}
	if (threads_of(space) == 1) {
		for (long c = 0; c < chunks; ++c)
			combine_range(host->algebra, out, count, terms, (size_t)c * CHUNK, chunk_end(space, (size_t)c));
		return;
	}
#pragma omp parallel for schedule(static) num_threads(threads_of(space))
	for (long c = 0; c < chunks; ++c)
		combine_range(host->algebra, out, count, terms, (size_t)c * CHUNK, chunk_end(space, (size_t)c));
}

static double dot_chunk(const HostSpace* host, long chunk, const double* a, const double* b) {
	const size_t first = (size_t)chunk * CHUNK;
	return host->algebra->dot(chunk_end(&host->base, (size_t)chunk) - first, a + first, b + first);
}

static double dot(JnSpace* space, const double* a, const double* b) {
	HostSpace* host = (HostSpace*)space;
	const long chunks = (long)host->chunks;
	const int team = threads_of(space);
	double sum = 0;
	if (team == 1) {
		for (long c = 0; c < chunks; ++c) sum += dot_chunk(host, c, a, b);
		return sum;
	}
#pragma omp parallel for schedule(static) num_threads(team)
	for (long c = 0; c < chunks; ++c) host->partial[c] = dot_chunk(host, c, a, b);
	for (long c = 0; c < chunks; ++c) sum += host->partial[c];
	return sum;
}

static double max(JnSpace* space, const double* a) {
	return ((const HostSpace*)space)->algebra->max(space->length, a);
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
	host->algebra = jn_algebra_best();
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
