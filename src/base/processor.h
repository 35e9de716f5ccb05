/// @file processor.h
/// What the vector unit of this processor can do.
#ifndef JN_BASE_PROCESSOR_H
#define JN_BASE_PROCESSOR_H

/// Doubles side by side for which sources compiled in several widths should be chosen: 8 with AVX-512, 4 with AVX2 and
/// FMA, 2 otherwise.
int jn_processor_width(void);

#endif
