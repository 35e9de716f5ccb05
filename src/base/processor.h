/// @file processor.h
/// What the vector unit of this processor can do.
#ifndef JN_BASE_PROCESSOR_H
#define JN_BASE_PROCESSOR_H

/// Doubles side by side for which sources compiled in several widths should be chosen: 8 with AVX-512, 4 with AVX2 and
/// FMA, 2 otherwise. JN_SIMD_WIDTH=2 or 4 in the environment asks for fewer (docs/determinism.md); more than there are, and
/// other values, count for nothing. Read whenever a model is built.
int jn_processor_width(void);

#endif
