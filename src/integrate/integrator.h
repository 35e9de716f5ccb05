/// @file integrator.h
/// Making and running integrators; the methods themselves are rows of the list.
#ifndef JN_INTEGRATE_INTEGRATOR_H
#define JN_INTEGRATE_INTEGRATOR_H

#include "jounce/extend.h"

extern const JnRowList jn_integrator_list; ///< rows are &JnIntegratorType.row
extern const JnKey jn_newton_keys[];       ///< of JnNewtonDef

/// An integrator of the method `choice` with vectors of `space`; NULL when memory is out. It keeps pointers to the
/// options of `choice`. Free with jn_integrator_destroy.
JnIntegrator* jn_integrator_create(const JnVariant* choice, const JnNewtonDef* newton, JnSpace* space);
void jn_integrator_destroy(JnIntegrator* integrator);

/// JN_OK when the method can step the system; else JN_BAD_INPUT after a message that says what is missing and what to set.
JnStatus jn_integrator_accepts(const JnIntegratorType* type, const JnSystem* sys);

/// Forget the kept tangent: the next stage makes a new one.
void jn_integrator_forget(JnIntegrator* integrator);

/// Forget the history of earlier steps, because someone edited the state. The kept tangent stays: it is only a way to
/// solve.
void jn_integrator_reset(JnIntegrator* integrator);

/// Write or read history: that of multistep methods, and what first guesses and directions have learned. The kept tangent is
/// not part of it: after reading there is none.
void jn_integrator_archive(JnIntegrator* integrator, JnArchive* archive);

/// a = M^-1 f(s): the acceleration of a state, held entries as prescribed [m/s^2]. Uses integrator->residual as work.
JnStatus jn_acceleration(JnIntegrator* integrator, JnSystem* sys, JnState* s, JnVec a);

/// The residual of the equations that the last solve of a stage ended with [N], whether it succeeded or not.
const double* jn_integrator_residual(const JnIntegrator* integrator);

/// JN_OK, or JN_NOT_FINITE when a position or velocity is infinite or NaN.
JnStatus jn_state_check(JnSpace* space, const JnState* s);

#endif
