// Linear elasticity: e = sym(F - I), Psi = mu e:e + lambda/2 tr(e)^2, P = 2 mu e + lambda tr(e) I.
// For small displacements and rotations only; not invariant under rotation. As kernels see F Q with a rotation Q of each
// point at rest (kernel.h), it is the corotated law with its rotations frozen at Q for good: Q^T F Q - I = Q^T (F - I) Q.
#ifndef JN_FORCE_MATERIAL_LINEAR_H
#define JN_FORCE_MATERIAL_LINEAR_H

#include "force/material/corotated_frozen.h"

enum { linear_STORED = corotated_frozen_STORED };

#define linear_energy corotated_frozen_energy
#define linear_stress corotated_frozen_stress
#define linear_tangent corotated_frozen_tangent
#define linear_linearize corotated_frozen_linearize

#endif
