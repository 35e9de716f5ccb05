/// @file lapack.h
/// The Fortran routines of LAPACK and BLAS that are called here (Debian ships no C header with OpenBLAS). Column-major matrices.
#ifndef JN_MATH_LAPACK_H
#define JN_MATH_LAPACK_H

/// LU factorisation with partial pivoting of a[m, n]; info > 0: exactly singular.
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);

/// Solve with the factors of dgetrf_; b[n, nrhs] is overwritten. The last argument is the length of `trans`.
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda, const int* pivots,
			 double* b, const int* ldb, int* info, unsigned long trans_length);

/// Cholesky factorisation of the triangle of a[n, n] that `uplo` names; info > 0: not positive definite.
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info, unsigned long uplo_length);

/// The triangle of the inverse, from the factor of dpotrf_.
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info, unsigned long uplo_length);

/// Solve with the factor of dpotrf_; b[n, nrhs] is overwritten.
void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b,
			 const int* ldb, int* info, unsigned long uplo_length);

/// c = alpha op(a) op(b) + beta c; c[m, n], k columns of op(a).
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,
			const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
			const int* ldc, unsigned long trans_a_length, unsigned long trans_b_length);

/// The triangle of c[n, n] that `uplo` names: alpha op(a) op(a)' + beta c, k columns of op(a).
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
			const int* lda, const double* beta, double* c, const int* ldc, unsigned long uplo_length,
			unsigned long trans_length);

/// b[m, n] = alpha op(a)^-1 b (side L) with a triangular a.
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
			const double* alpha, const double* a, const int* lda, double* b, const int* ldb, unsigned long side_length,
			unsigned long uplo_length, unsigned long trans_length, unsigned long diag_length);

/// y = alpha op(a) x + beta y, a[m, n].
void dgemv_(const char* trans, const int* m, const int* n, const double* alpha, const double* a, const int* lda,
			const double* x, const int* step_x, const double* beta, double* y, const int* step_y,
			unsigned long trans_length);

#endif
