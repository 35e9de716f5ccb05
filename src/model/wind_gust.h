/// @file wind_gust.h
/// The wind of a scene as a function of time and place: a constant, and gusts made of n seeded sine waves,
///   u(t, x) = velocity + strength sqrt(2 / n) sum_j d_j sin(k_j . x - 2 pi f_j t + phi_j),
///   f_j = 2^(2 s_j - 1) / period,   s_j uniform in [j / n, (j + 1) / n],   |k_j| = 2 pi f_j period / wavelength,
/// with random directions of k_j, random d_j perpendicular to it (so that the air keeps its volume) and random phi_j.
/// Without a wavelength, k_j = 0. All frequencies differ: the mean of |u - velocity|^2 over all time is strength^2.
#ifndef JN_MODEL_WIND_GUST_H
#define JN_MODEL_WIND_GUST_H

#include "force/wind.h"
#include "jounce/model.h"

typedef struct JnGusts {
	JnAir start;                     ///< the air at t = 0
	double frequency[JN_WIND_WAVES]; ///< f_j [Hz]
	double turn[JN_WIND_WAVES];      ///< phi_j / 2 pi, in [0, 1)
	bool is_uniform;                 ///< the same everywhere
} JnGusts;

/// Draw the waves. At most JN_WIND_WAVES components.
void jn_gusts_create(const JnWindDef* def, JnGusts* gusts);

/// Whether the wind changes with time.
static inline bool jn_gusts_blow(const JnGusts* gusts) {
	return gusts->start.waves > 0;
}

/// The air at time t [s]: without waves where gusts are the same everywhere.
void jn_gusts_at(const JnGusts* gusts, double t, JnAir* air);

#endif
