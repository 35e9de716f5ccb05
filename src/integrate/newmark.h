/// @file newmark.h
/// Newmark's method and its relatives with weighted forces.
#ifndef JN_INTEGRATE_NEWMARK_H
#define JN_INTEGRATE_NEWMARK_H

#include "jounce/extend.h"

extern const JnIntegratorType jn_newmark, jn_linearized_newmark, jn_hht_alpha, jn_generalized_alpha;

#endif
