/// @file law.h
/// What a constitutive law is inside the kernels: functions of the deformation gradient F, one element a lane.
///
///   <law>_energy(constants, frozen, F)        energy density Psi [J/m^3]
///   <law>_stress(constants, frozen, F, P)     first Piola stress P = dPsi/dF [Pa]
///   <law>_tangent(constants, frozen, F, A)    A = dP/dF [Pa], 9x9 and symmetric
///   <law>_linearize(constants, frozen, F, stored)   what differential.h needs for dP/dF : D: <law>_STORED numbers
///
/// `constants` come from the law's prepare(); `frozen` points at [frozen_reals][JN_WIDE] numbers, or is NULL.
/// Entry (a, c) of F has the index 3 a + c in A; formulas write A[ac][bd].
#ifndef JN_FORCE_MATERIAL_LAW_H
#define JN_FORCE_MATERIAL_LAW_H

#include "math/mat3.h"

/// Places in `constants` of the Lame constants [Pa], the same for all laws.
enum { JN_LAW_MU = 0, JN_LAW_LAMBDA = 1, JN_LAW_OWN = 2 };

/// dP/dF: only entries [i][j] with j <= i are set and read.
typedef struct WideTangent {
	Wide at[9][9];
} WideTangent;

typedef Wide WideEnergy(const double* constants, const double* frozen, const WideMat3* F);
typedef void WideStress(const double* constants, const double* frozen, const WideMat3* F, WideMat3* P);
typedef void WideLinearize(const double* constants, const double* frozen, const WideMat3* F, Wide stored[]);
typedef void WideTangentOf(const double* constants, const double* frozen, const WideMat3* F, WideTangent* A);

JN_INLINE void store_mat3(const WideMat3* A, Wide stored[9]) {
	JN_UNROLL for (int i = 0; i < 9; i++) stored[i] = A->at[i / 3][i % 3];
}

/// The lower triangle by rows.
JN_INLINE void store_symmetric(const WideMat3* A, Wide stored[6]) {
	stored[0] = A->at[0][0];
	stored[1] = A->at[1][0];
	stored[2] = A->at[1][1];
	stored[3] = A->at[2][0];
	stored[4] = A->at[2][1];
	stored[5] = A->at[2][2];
}

/// Run a statement for every entry [ac][bd] of the lower half of a tangent.
#define JN_EACH_TANGENT_ENTRY(statement)                                                                               \
	JN_UNROLL for (int ac = 0; ac < 9; ac++) {                                                                         \
		JN_UNROLL for (int bd = 0; bd < 9; bd++) {                                                                     \
			if (bd > ac) continue;                                                                                     \
			const int a = ac / 3, c = ac % 3, b = bd / 3, d = bd % 3;                                                  \
			statement                                                                                                  \
		}                                                                                                              \
	}

#endif
