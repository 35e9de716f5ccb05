/// @file petsc.h
/// A model of ours as PETSc's TS sees it: M a - f(t, x, v) = 0 for x, or two equations of first order for y = (x, v).
///
/// With a shift s the matrix of M v' - f(x, v) = 0, x' - v = 0 is condensed onto the velocities:
///   dx = (b1 + dv) / s,   (s M + D + K / s) dv = b2 - K b1 / s.
#ifndef JN_BENCHMARK_PEERS_PETSC_H
#define JN_BENCHMARK_PEERS_PETSC_H

#include <petscts.h>

#include "blocks.h"

typedef struct Petsc {
	Peer* peer;
	bool is_second;                         ///< M a = f, unknowns x
	bool is_explicit;                       ///< of the derivatives of y alone, without a matrix
	double mass, damping, stiffness, shift; ///< of its present matrix
	double *b, *c;                          ///< n
	PeerBlocks blocks;
	int written;
} Petsc;

/// PETSc's kind of status.
PetscErrorCode petsc_check(JnStatus status);

/// Held entries keep a, scaled, in place of what out has there: their rows are those of a unit matrix.
void petsc_add_held(const Petsc* p, double scale, const double* a, double* out);

/// Give TS its functions; A as petsc_make_matrix made it, NULL for explicit methods.
PetscErrorCode petsc_set_equations(Petsc* p, TS ts, Mat A);

/// linear: own, a matrix that is only multiplied; icc, the upper triangle in blocks; pbjacobi, all blocks.
PetscErrorCode petsc_make_matrix(Petsc* p, const char* linear, Mat* out);

/// Of the last peer_linearize and the shifts in p.
PetscErrorCode petsc_fill_matrix(Petsc* p, Mat A);

/// A preconditioner that is our factor.
PetscErrorCode petsc_apply_factor(PC pc, Vec In, Vec Out);

#endif
