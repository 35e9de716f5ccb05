/// @file lapack.h
/// The Fortran routines of LAPACK that are called here (Debian ships no C header with OpenBLAS). Column-major matrices.
#ifndef JN_MATH_LAPACK_H
#define JN_MATH_LAPACK_H

/// LU factorisation with partial pivoting of a[m, n]; info > 0: exactly singular.
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);

/// Solve with the factors of dgetrf_; b[n, nrhs] is overwritten. The last argument is the length of `trans`.
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda, const int* pivots,
			 double* b, const int* ldb, int* info, unsigned long trans_length);

/// Cholesky factorisation of the triangle of a[n, n] that `uplo` names; info > 0: not positive definite.
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info, unsigned long uplo_length);

/// Solve with the factor of dpotrf_; b[n, nrhs] is overwritten.
void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b,
			 const int* ldb, int* info, unsigned long uplo_length);

#endif
