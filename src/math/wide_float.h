/// @file wide_float.h
/// 2 * JN_WIDE floats side by side, two batches of doubles in one register, and points of four floats in memory, of which
/// the last is 0: rows that are loaded and stored whole.
#ifndef JN_MATH_WIDE_FLOAT_H
#define JN_MATH_WIDE_FLOAT_H

#include "math/wide.h"

enum { JN_WIDE_FLOATS = 2 * JN_WIDE };

typedef float WideFloat __attribute__((vector_size(JN_WIDE * 8)));
typedef float WideFloatInMemory __attribute__((vector_size(JN_WIDE * 8), aligned(4), may_alias));
typedef float FourFloats __attribute__((vector_size(16)));
typedef float FourFloatsInMemory __attribute__((vector_size(16), aligned(4), may_alias));
typedef float HalfFloatInMemory __attribute__((vector_size(JN_WIDE * 4), aligned(4), may_alias));

JN_INLINE WideFloat wide_float_set(float number) {
#if JN_WIDE_INTRINSICS
	return JN_WIDE_CALL(set1_ps)(number);
#else
	return (WideFloat){number, number, number, number};
#endif
}

/// Consecutive numbers, aligned to 4 bytes at least.
JN_INLINE WideFloat wide_float_load(const float* from) {
	return *(const WideFloatInMemory*)from;
}

JN_INLINE void wide_float_store(float* to, WideFloat a) {
	*(WideFloatInMemory*)to = a;
}

/// JN_WIDE doubles, rounded, as so many floats.
JN_INLINE void wide_store_rounded(float* to, Wide a) {
	*(HalfFloatInMemory*)to = __builtin_convertvector(a, HalfFloatInMemory);
}

#if JN_WIDE > 2
/// a * b + c, rounded once.
JN_INLINE WideFloat wide_float_fma(WideFloat a, WideFloat b, WideFloat c) {
	return JN_WIDE_CALL(fmadd_ps)(a, b, c);
}
#elif defined(__FP_FAST_FMAF)
JN_INLINE WideFloat wide_float_fma(WideFloat a, WideFloat b, WideFloat c) {
	for (int k = 0; k < JN_WIDE_FLOATS; ++k) a[k] = __builtin_fmaf(a[k], b[k], c[k]);
	return a;
}
#else
/// a * b + c, rounded once: in doubles the product is exact, and a sum rounded to odd may be rounded again.
JN_SHARED WideFloat wide_float_fma(WideFloat a, WideFloat b, WideFloat c) {
	WideFloat out = {0};
	JN_UNROLL for (int k = 0; k < 4; k += 2) {
		const Wide sum = wide_sum_to_odd((Wide){a[k], a[k + 1]} * (Wide){b[k], b[k + 1]}, (Wide){c[k], c[k + 1]});
		out[k] = (float)sum[0];
		out[k + 1] = (float)sum[1];
	}
	return out;
}
#endif

JN_INLINE FourFloats four_floats_load(const float* from) {
	return *(const FourFloatsInMemory*)from;
}

JN_INLINE void four_floats_store(float* to, FourFloats a) {
	*(FourFloatsInMemory*)to = a;
}

/// Turn four rows of four within each quarter of 128 bits:
///   a0 a1 a2 a3      a0 b0 c0 d0
///   b0 b1 b2 b3  ->  a1 b1 c1 d1
///   c0 c1 c2 c3      a2 b2 c2 d2
///   d0 d1 d2 d3      a3 b3 c3 d3
JN_INLINE void wide_float_transpose(WideFloat r[4]) {
#if JN_WIDE_INTRINSICS
	const WideFloat ab = JN_WIDE_CALL(unpacklo_ps)(r[0], r[1]), ab_high = JN_WIDE_CALL(unpackhi_ps)(r[0], r[1]);
	const WideFloat cd = JN_WIDE_CALL(unpacklo_ps)(r[2], r[3]), cd_high = JN_WIDE_CALL(unpackhi_ps)(r[2], r[3]);
	r[0] = JN_WIDE_CALL(shuffle_ps)(ab, cd, 0x44);
	r[1] = JN_WIDE_CALL(shuffle_ps)(ab, cd, 0xEE);
	r[2] = JN_WIDE_CALL(shuffle_ps)(ab_high, cd_high, 0x44);
	r[3] = JN_WIDE_CALL(shuffle_ps)(ab_high, cd_high, 0xEE);
#else
	const WideFloat a = r[0], b = r[1], c = r[2], d = r[3];
	for (int k = 0; k < 4; ++k) r[k] = (WideFloat){a[k], b[k], c[k], d[k]};
#endif
}

/// The points from[4 * node] of two batches of JN_WIDE nodes: out[axis][lane].
JN_INLINE void wide_float_gather(const float* from, const int* first, const int* second, WideFloat out[3]) {
	WideFloat row[4];
#define JN_ROW(lane) four_floats_load(from + 4 * (ptrdiff_t)((lane) < JN_WIDE ? first : second)[(lane) % JN_WIDE])
	JN_UNROLL for (int k = 0; k < 4; ++k) {
#if JN_WIDE == 8
		const FourFloats a = JN_ROW(k), b = JN_ROW(4 + k), c = JN_ROW(8 + k), d = JN_ROW(12 + k);
		typedef float EightFloats __attribute__((vector_size(32)));
		const EightFloats ab = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7),
						  cd = __builtin_shufflevector(c, d, 0, 1, 2, 3, 4, 5, 6, 7);
		row[k] = __builtin_shufflevector(ab, cd, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#elif JN_WIDE == 4
		row[k] = __builtin_shufflevector(JN_ROW(k), JN_ROW(4 + k), 0, 1, 2, 3, 4, 5, 6, 7);
#else
		row[k] = JN_ROW(k);
#endif
	}
#undef JN_ROW
	wide_float_transpose(row);
	JN_UNROLL for (int a = 0; a < 3; ++a) out[a] = row[a];
}

#endif
