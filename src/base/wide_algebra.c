// Plain loops that compilers turn into instructions of JN_WIDE doubles; exports the table jn_algebra_<width>.
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#if defined(__SSE2__)
	#include <immintrin.h>
#endif

#include "base/algebra.h"

#ifndef JN_WIDE
	#define JN_WIDE 2
#endif

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b) JOIN_NAMES(a, b)

enum { LANES = 8 };

// Entries are independent even where `out` is one of the terms: each is read before it is written.
#if defined(__clang__)
	#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
	#define INDEPENDENT _Pragma("GCC ivdep")
#endif

static void combine_one(size_t n, const JnTerm* t, double* out) {
	const double* a = t->vec;
	const double sa = t->scale;
	if (sa == 1)
		memmove(out, a, n * sizeof *out);
	else
		INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = sa * a[k];
}

static void combine_two(size_t n, const JnTerm* t, double* out) {
	const double *a = t[0].vec, *b = t[1].vec;
	const double sa = t[0].scale, sb = t[1].scale;
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = sa * a[k] + sb * b[k];
}

static void combine_three(size_t n, const JnTerm* t, double* out) {
	const double *a = t[0].vec, *b = t[1].vec, *c = t[2].vec;
	const double sa = t[0].scale, sb = t[1].scale, sc = t[2].scale;
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = sa * a[k] + sb * b[k] + sc * c[k];
}

// More terms than that are summed beside, since `out` may be a term that is still to come.
static void combine_many(size_t n, int count, const JnTerm terms[], double* out) {
	double sum[JN_ALGEBRA_CHUNK];
	for (size_t k = 0; k < n; ++k) sum[k] = terms[0].scale * terms[0].vec[k];
	for (int i = 1; i < count; ++i) {
		const double* vec = terms[i].vec;
		const double scale = terms[i].scale;
		for (size_t k = 0; k < n; ++k) sum[k] += scale * vec[k];
	}
	memcpy(out, sum, n * sizeof *sum);
}

static void combine(size_t n, int count, const JnTerm terms[], double* out) {
	if (count == 1)
		combine_one(n, terms, out);
	else if (count == 2)
		combine_two(n, terms, out);
	else if (count == 3)
		combine_three(n, terms, out);
	else
		combine_many(n, count, terms, out);
}

static double dot(size_t n, const double* a, const double* b) {
	double lane[LANES] = {0};
	size_t k = 0;
	for (; k + LANES <= n; k += LANES)
		for (int l = 0; l < LANES; ++l) lane[l] += a[k + (size_t)l] * b[k + (size_t)l];
	for (int l = 0; k < n; ++k, ++l) lane[l] += a[k] * b[k];
	return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

static double max_of_any(size_t n, const double* a) {
	double largest = 0;
	for (size_t k = 0; k < n; ++k) {
		const double size = fabs(a[k]);
		if (!(size <= largest)) largest = size; // true for NAN, which then stays
		if (isnan(largest)) return largest;
	}
	return largest;
}

typedef double Wide __attribute__((vector_size(JN_WIDE * 8)));
typedef int64_t Mask __attribute__((vector_size(JN_WIDE * 8)));
typedef double Loaded __attribute__((vector_size(JN_WIDE * 8), aligned(8), may_alias));

// The larger of two integers, lane by lane.
static inline Mask larger(Mask a, Mask b) {
#if defined(__SSE2__) && JN_WIDE == 8
	return (Mask)_mm512_max_epi64((__m512i)a, (__m512i)b);
#elif defined(__SSE2__) && JN_WIDE == 4
	return (Mask)_mm256_blendv_epi8((__m256i)a, (__m256i)b, (__m256i)(a < b));
#else
	const Mask is_less = a < b;
	return (is_less & b) | (~is_less & a);
#endif
}

// Without their signs, numbers are in the order of their bits taken as integers, and those of a NAN are the largest. Two
// chains hide the latency of each other.
static double max(size_t n, const double* a) {
	Mask most[2] = {{0}, {0}};
	size_t k = 0;
	for (; k + 2 * JN_WIDE <= n; k += 2 * JN_WIDE)
		for (int c = 0; c < 2; ++c)
			most[c] = larger(most[c], (Mask) * (const Loaded*)(a + k + (size_t)c * JN_WIDE) & INT64_MAX);
	const Wide sizes = (Wide)larger(most[0], most[1]);
	double out = max_of_any(n - k, a + k);
	for (int l = 0; l < JN_WIDE; ++l)
		if (!(sizes[l] <= out) && !isnan(out)) out = sizes[l];
	return out;
}

static void multiply(size_t n, const double* a, const double* b, double* out) {
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] = a[k] * b[k];
}

static void accumulate(size_t n, double scale, const double* a, const double* b, double* out) {
	INDEPENDENT for (size_t k = 0; k < n; ++k) out[k] += scale * (a[k] * b[k]);
}

static inline __attribute__((always_inline)) bool advance_with(size_t first, size_t last, const JnAdvance* by,
															   bool has_load, bool has_drift) {
	const double *m = by->inverse_mass, *force = by->force;
	Mask is_finite = ~(Mask){0};
	bool all_finite = true;
	size_t k = first;
	for (; k + JN_WIDE <= last; k += JN_WIDE) {
		Wide f = *(const Loaded*)(force + k);
		if (has_load) f += *(const Loaded*)(by->load + k);
		const Wide v = *(const Loaded*)(by->v + k) + by->kick * (*(const Loaded*)(m + k) * f);
		Wide x = v; // finite only where v is
		if (has_drift) x = *(const Loaded*)(by->x + k) + by->drift * v;
		is_finite &= (Wide)((Mask)x & INT64_MAX) <= DBL_MAX;
		if (has_drift) *(Loaded*)(by->x_out + k) = x;
		*(Loaded*)(by->v_out + k) = v;
	}
	for (; k < last; ++k) {
		const double f = has_load ? force[k] + by->load[k] : force[k], v = by->v[k] + by->kick * (m[k] * f);
		const double x = has_drift ? by->x[k] + by->drift * v : v;
		all_finite &= fabs(x) <= DBL_MAX;
		if (has_drift) by->x_out[k] = x;
		by->v_out[k] = v;
	}
	for (int l = 0; l < JN_WIDE; ++l) all_finite &= is_finite[l] != 0;
	return all_finite;
}

static bool advance(size_t first, size_t last, const JnAdvance* by) {
	if (by->load != NULL)
		return by->drift != 0 ? advance_with(first, last, by, true, true) : advance_with(first, last, by, true, false);
	return by->drift != 0 ? advance_with(first, last, by, false, true) : advance_with(first, last, by, false, false);
}

const JnAlgebra JOIN(jn_algebra_, JN_WIDE) = {
	.combine = combine, .dot = dot, .max = max, .multiply = multiply, .accumulate = accumulate, .advance = advance};
