/// @file body_matrix.h
/// Matrices m M + d D + k K of single bodies, K definite, each with its own factor: what contact solves with. A body that
/// nothing touches costs nothing. The integrator's matrix of all bodies (matrix.c) is left as it is.
#ifndef JN_MODEL_BODY_MATRIX_H
#define JN_MODEL_BODY_MATRIX_H

#include "model/system.h"

typedef struct JnBodyMatrix {
	JnPattern pattern; ///< of the body's nodes, numbered from 0
	JnSolver* solver;  ///< NULL: no node of the body is free
	const bool* held;  ///< 3 * nodes
	double* blocks;    ///< 9 a block of the pattern; part of JnBodyMatrices.blocks
	bool is_factored;
} JnBodyMatrix;

typedef struct JnBodyMatrices {
	JnModelSystem* sys;
	double* blocks;       ///< 9 a block of the model's pattern: the matrices of all bodies
	double* weight;       ///< one a group: 1 for those of bodies that were asked for, 0 for others
	JnBodyMatrix* bodies; ///< one a body
} JnBodyMatrices;

/// Analyse the pattern of every body that `wanted` names, into the model's arena. Free with jn_body_matrices_release.
JnStatus jn_body_matrices_create(JnModel* model, const bool* wanted, JnBodyMatrices* out);
void jn_body_matrices_release(JnBodyMatrices* matrices);

/// Fill the blocks of the bodies that `wanted` names, K being the definite form at positions x; their factors are out of
/// date. The other bodies' blocks are zero.
void jn_body_matrices_fill(JnBodyMatrices* matrices, const bool* wanted, JnShift shift, const double* x);

/// Factor the matrix of a body unless that was done since it was filled. JN_INDEFINITE cannot happen but for rounding.
JnStatus jn_body_matrix_factor(JnBodyMatrices* matrices, int body);

#endif
