/// @file exponential.h
/// The exponential Rosenbrock-Euler method, and the functions of small dense matrices that it needs.
#ifndef JN_INTEGRATE_EXPONENTIAL_H
#define JN_INTEGRATE_EXPONENTIAL_H

#include "jounce/extend.h"

/// Largest Krylov subspace. A step keeps a position and a velocity for each of its directions, whatever the keys say.
#define JN_MAX_SUBSPACE 60

extern const JnIntegratorType jn_exponential_rosenbrock;

/// The first columns of phi1(A) and phi2(A), phi1(z) = (e^z - 1)/z, phi2(z) = (phi1(z) - 1)/z, for A[n, n], row by row,
/// n <= JN_MAX_SUBSPACE. Uses about 200 kB of stack.
void jn_phi_columns(int n, const double* A, double* phi1, double* phi2);

#endif
