/// @file stability.h
/// The largest step at which an explicit method is stable: nu / omega, where omega is the largest frequency of M^-1 K and nu the
/// method's own limit at the damping ratio of that mode (integrate/properties.h).
#ifndef JN_SIM_STABILITY_H
#define JN_SIM_STABILITY_H

#include "jounce/sim.h"

typedef struct JnStability {
	double nu;     ///< of the method
	double omega;  ///< [1/s], from below
	double xi;     ///< damping ratio of that mode
	double limit;  ///< largest stable step [s]; 0: no step is
	int entry;     ///< of the vectors, that which moves most in that mode
	bool at_start; ///< of the start of the run; else of the last good state
} JnStability;

/// Does `dt` exceed the limit of stability of `method` (an explicit one) at the start of the run, or at its last good state?
/// `out` tells of the first of them where it does. False also where the limit cannot be known. Allocates.
bool jn_sim_is_unstable(JnSim* sim, const JnIntegratorType* method, double dt, JnStability* out);

/// omega, xi and entry at the last good state, whatever the method. False where they cannot be known. Allocates.
bool jn_sim_largest_frequency(JnSim* sim, JnStability* out);

#endif
