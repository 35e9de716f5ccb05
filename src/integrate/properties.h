/// @file properties.h
/// What is known of a method: from its coefficients where it has some, else measured on x'' = -omega^2 x by the very code
/// that steps models.
#ifndef JN_INTEGRATE_PROPERTIES_H
#define JN_INTEGRATE_PROPERTIES_H

#include "jounce/extend.h"

typedef struct JnIntegratorProperties {
	int order;  ///< of the row, which the order tests prove
	int stages; ///< 0: no Runge-Kutta or Rosenbrock method
	int solves; ///< linear or nonlinear systems a step
	bool a_stable, l_stable, stiffly_accurate;
	double r_infinity;      ///< amplification for omega dt -> infinity: the limit of R, or the spectral radius
	double stability_limit; ///< largest stable omega dt without damping; INFINITY: none, 0: unstable at any step
	int dispersion_order;   ///< q: phase error a step = dispersion (omega dt)^(q + 1)
	double dispersion;
	int dissipation_order; ///< r: amplitude loss a step = dissipation (omega dt)^(r + 1); 0: none
	double dissipation;
	bool is_measured; ///< on the oscillator, with default options
} JnIntegratorProperties;

/// Fill `out`. Fails only when memory is out.
JnStatus jn_integrator_properties(const JnIntegratorType* type, JnIntegratorProperties* out);

/// The largest omega dt at which the method is stable with the damping ratio `xi` >= 0: JnIntegratorProperties.stability_limit
/// where that is 0. Fails only when memory is out.
JnStatus jn_integrator_stability_limit(const JnIntegratorType* type, double xi, double* limit);

/// The dominant eigenvalue of one step.
typedef struct JnAmplification {
	double radius, phase; ///< phase in radians
} JnAmplification;

/// Step x'' = -omega^2 x - 2 xi omega v with omega dt = `nu` and damping ratio `xi` (below 0: growth), default options,
/// after the transients of multistep methods. For Runge-Kutta methods the radius is |R(z)|, z = nu (-xi + i sqrt(1 - xi^2)).
/// NAN when a step fails.
JnAmplification jn_integrator_amplification(const JnIntegratorType* type, double nu, double xi);

#endif
