/// @file eigen.h
/// The spectrum of element matrices.
#ifndef JN_TEST_FORCE_EIGEN_H
#define JN_TEST_FORCE_EIGEN_H

#include "sample.h"

/// Eigenvalues of a symmetric matrix by cyclic Jacobi, an independent computation; V receives the eigenvectors.
static inline void eigenvalues(int n, SampleMatrix A, double values[], SampleMatrix V) {
	for (int i = 0; i < n * n; i++) V[i / n][i % n] = i / n == i % n;
	double most = 0;
	for (int i = 0; i < n; i++) most = fmax(most, largest(A[i], n));
	for (int turn = 0; turn < 12 * n * n; turn++) {
		const int p = turn / n % n, q = turn % n;
		if (p >= q || fabs(A[p][q]) < 1e-17 * most) continue;
		const double zeta = (A[q][q] - A[p][p]) / (2 * A[p][q]);
		const double t = (zeta < 0 ? -1 : 1) / (fabs(zeta) + hypot(1, zeta)), c = 1 / hypot(1, t), s = t * c;
		for (int k = 0; k < n; k++) {
			const double kp = A[k][p], kq = A[k][q], vp = V[k][p], vq = V[k][q];
			A[k][p] = c * kp - s * kq;
			A[k][q] = s * kp + c * kq;
			V[k][p] = c * vp - s * vq;
			V[k][q] = s * vp + c * vq;
		}
		for (int k = 0; k < n; k++) {
			const double pk = A[p][k], qk = A[q][k];
			A[p][k] = c * pk - s * qk;
			A[q][k] = s * pk + c * qk;
		}
	}
	for (int i = 0; i < n; i++) values[i] = A[i][i];
}

static inline double smallest(const double* values, int count) {
	double least = values[0];
	for (int i = 1; i < count; i++) least = fmin(least, values[i]);
	return least;
}

#endif
