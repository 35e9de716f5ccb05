/// @file wide.h
/// JN_WIDE doubles side by side: a GNU vector type on which +, -, * and / work as on numbers, and what else formulas
/// need. One lane is one element. For equal inputs 8, 4 and 2 lanes give the same bits.
#ifndef JN_MATH_WIDE_H
#define JN_MATH_WIDE_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifndef JN_WIDE
	#define JN_WIDE 2
#endif

#if JN_WIDE == 8 || JN_WIDE == 4 || defined(__SSE2__)
	#include <immintrin.h>
	#define JN_WIDE_INTRINSICS 1
#else
	#define JN_WIDE_INTRINSICS 0
#endif

/// For functions whose arguments are compile-time constants where they are used: templates in C.
#define JN_INLINE static inline __attribute__((always_inline, unused))
/// For the larger pieces that many loops of one file share.
#define JN_SHARED static __attribute__((noinline, unused))
/// Unroll the loop that follows, so that arrays of vectors become registers.
#define JN_UNROLL _Pragma("GCC unroll 16")

typedef double Wide __attribute__((vector_size(JN_WIDE * 8)));
typedef int64_t WideMask __attribute__((vector_size(JN_WIDE * 8))); ///< all bits of a lane set, or none
typedef double WideInMemory __attribute__((vector_size(JN_WIDE * 8), aligned(8), may_alias));

#if JN_WIDE_INTRINSICS && JN_WIDE == 8
	#define JN_WIDE_CALL(name) _mm512_##name
#elif JN_WIDE_INTRINSICS && JN_WIDE == 4
	#define JN_WIDE_CALL(name) _mm256_##name
#elif JN_WIDE_INTRINSICS
	#define JN_WIDE_CALL(name) _mm_##name
#endif

/// The same number in every lane.
JN_INLINE Wide wide_set(double number) {
#if JN_WIDE_INTRINSICS
	return JN_WIDE_CALL(set1_pd)(number);
#else
	return (Wide){number, number};
#endif
}

/// JN_WIDE consecutive numbers, aligned to 8 bytes at least.
JN_INLINE Wide wide_load(const double* from) {
	return *(const WideInMemory*)from;
}

JN_INLINE void wide_store(double* to, Wide a) {
	*(WideInMemory*)to = a;
}

/// from[stride * index[lane]] in each lane.
JN_INLINE Wide wide_gather(const double* from, int stride, const int* index) {
#define JN_AT(lane) from[(ptrdiff_t)stride * index[lane]]
#if JN_WIDE == 8
	return (Wide){JN_AT(0), JN_AT(1), JN_AT(2), JN_AT(3), JN_AT(4), JN_AT(5), JN_AT(6), JN_AT(7)};
#elif JN_WIDE == 4
	return (Wide){JN_AT(0), JN_AT(1), JN_AT(2), JN_AT(3)};
#else
	return (Wide){JN_AT(0), JN_AT(1)};
#endif
#undef JN_AT
}

/// out[k] = rows[lane][k] in each lane, k < count: four at a time by a transposition where four lanes are.
JN_INLINE void wide_gather_rows(const double* const rows[JN_WIDE], int count, Wide out[]) {
	int k = 0;
#if JN_WIDE == 4
	for (; k + 4 <= count; k += 4) {
		const Wide a = wide_load(rows[0] + k), b = wide_load(rows[1] + k);
		const Wide c = wide_load(rows[2] + k), d = wide_load(rows[3] + k);
		const Wide ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
		const Wide cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
		out[k] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
		out[k + 1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
		out[k + 2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
		out[k + 3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
	}
#endif
#define JN_AT(lane) rows[lane][k]
#if JN_WIDE == 8
	for (; k < count; k++)
		out[k] = (Wide){JN_AT(0), JN_AT(1), JN_AT(2), JN_AT(3), JN_AT(4), JN_AT(5), JN_AT(6), JN_AT(7)};
#elif JN_WIDE == 4
	for (; k < count; k++) out[k] = (Wide){JN_AT(0), JN_AT(1), JN_AT(2), JN_AT(3)};
#else
	for (; k < count; k++) out[k] = (Wide){JN_AT(0), JN_AT(1)};
#endif
#undef JN_AT
}

/// The points from[3 * index[lane] + axis] as out[axis][lane]; reads nothing behind a point.
JN_INLINE void wide_gather_points(const double* from, const int* index, Wide out[3]) {
#if JN_WIDE >= 4
	typedef double Four __attribute__((vector_size(32)));
	const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);
	#define JN_ROW(lane) (Four) _mm256_maskload_pd(from + 3 * (ptrdiff_t)index[lane], three)
	#if JN_WIDE == 4
	const Wide a = JN_ROW(0), b = JN_ROW(1), c = JN_ROW(2), d = JN_ROW(3);
	const Wide ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
	out[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
	out[1] = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 5, 3, 7),
									 __builtin_shufflevector(c, d, 1, 5, 3, 7), 0, 1, 4, 5);
	out[2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
	#else
		#define JN_TWO(k) __builtin_shufflevector(JN_ROW(k), JN_ROW(4 + (k)), 0, 1, 2, 3, 4, 5, 6, 7)
	const Wide a = JN_TWO(0), b = JN_TWO(1), c = JN_TWO(2), d = JN_TWO(3);
		#undef JN_TWO
	const Wide ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
			   cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14),
			   ab_odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15),
			   cd_odd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
	out[0] = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13);
	out[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 8, 9, 4, 5, 12, 13);
	out[2] = __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
	#endif
	#undef JN_ROW
#else
	const double *a = from + 3 * (ptrdiff_t)index[0], *b = from + 3 * (ptrdiff_t)index[1];
	const Wide ra = wide_load(a), rb = wide_load(b);
	out[0] = __builtin_shufflevector(ra, rb, 0, 2);
	out[1] = __builtin_shufflevector(ra, rb, 1, 3);
	out[2] = (Wide){a[2], b[2]};
#endif
}

/// mask ? a : b, lane by lane.
JN_INLINE Wide wide_select(WideMask mask, Wide a, Wide b) {
	return (Wide)((mask & (WideMask)a) | (~mask & (WideMask)b));
}

/// Whether any lane of the mask is set.
JN_INLINE bool wide_any(WideMask mask) {
#if JN_WIDE_INTRINSICS && JN_WIDE == 8
	return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) != 0;
#elif JN_WIDE_INTRINSICS
	return JN_WIDE_CALL(movemask_pd)((Wide)mask) != 0;
#else
	return (mask[0] | mask[1]) != 0;
#endif
}

JN_INLINE Wide wide_abs(Wide a) {
	return (Wide)((WideMask)a & INT64_MAX);
}

/// |magnitude| with the sign of `sign`.
JN_INLINE Wide wide_copy_sign(Wide magnitude, Wide sign) {
	return (Wide)(((WideMask)magnitude & INT64_MAX) | ((WideMask)sign & INT64_MIN));
}

/// a > b ? a : b, hence b when either is NAN.
JN_INLINE Wide wide_max(Wide a, Wide b) {
#if JN_WIDE_INTRINSICS
	return JN_WIDE_CALL(max_pd)(a, b);
#else
	return wide_select(a > b, a, b);
#endif
}

/// a < b ? a : b, hence b when either is NAN.
JN_INLINE Wide wide_min(Wide a, Wide b) {
#if JN_WIDE_INTRINSICS
	return JN_WIDE_CALL(min_pd)(a, b);
#else
	return wide_select(a < b, a, b);
#endif
}

JN_INLINE Wide wide_sqrt(Wide a) {
#if JN_WIDE_INTRINSICS
	return JN_WIDE_CALL(sqrt_pd)(a);
#else
	return (Wide){sqrt(a[0]), sqrt(a[1])};
#endif
}

#if JN_WIDE > 2
/// a * b + c, rounded once.
JN_INLINE Wide wide_fma(Wide a, Wide b, Wide c) {
	return JN_WIDE_CALL(fmadd_pd)(a, b, c);
}
#else
	#include "math/wide_fma.h"
#endif

#endif
