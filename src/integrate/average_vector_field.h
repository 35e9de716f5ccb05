/// @file average_vector_field.h
/// The energy-conserving method of the averaged force.
#ifndef JN_INTEGRATE_AVERAGE_VECTOR_FIELD_H
#define JN_INTEGRATE_AVERAGE_VECTOR_FIELD_H

#include "jounce/extend.h"

extern const JnIntegratorType jn_average_vector_field;

#endif
