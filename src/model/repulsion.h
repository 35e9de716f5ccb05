/// @file repulsion.h
/// Short-range repulsion: points of peridynamic bodies push each other away, and rigid balls and plates push points and
/// each other. For two points at y = x_i - x_j, r = |y|,
///
///   f_i = kappa (d - r) y / r  where r < d,   E = 1/2 kappa (d - r)^2,   d = min(rest_share |X_i - X_j|, reach (s_i + s_j) / 2)
///
/// with kappa = stiffness c / delta V_i V_j (EMU: Macek, Silling, Finite Elem. Anal. Des. 43 (2007); the distance d and
/// the factor 15 as in Parks, Lehoucq, Plimpton, Silling, Comput. Phys. Commun. 179 (2008), section 3.4). It acts between
/// all points: bonded ones feel it when pressed to rest_share of their distance at rest, so that a bond which breaks in
/// tension changes no force. Against a rigid thing (mesh/rigid.h) y comes from the nearest point of its rectangle,
/// d = radius + s_i / 2 and kappa is a spring constant of its own. K = -df/dx of a pair is
///
///   B = kappa (n n^T + w (P - n n^T)),   n = y / r,   w = 1 - d / r < 0
///
/// with P the projector on the directions in which y can turn: all of space for two points. Definite: w = 0.
///
/// Everything is a pure function of x. The list of pairs is an accelerator: it holds all pairs within d + margin when it
/// was made, and is made again as soon as some point has moved by half the margin since. Only then do buffers grow.
#ifndef JN_MODEL_REPULSION_H
#define JN_MODEL_REPULSION_H

#include "model/assembly.h"

typedef struct JnRepulsion JnRepulsion;

/// The repulsion of a model whose bodies are points and rigid things; *out stays NULL without `def`. Free with
/// jn_repulsion_destroy. JN_BAD_INPUT for bodies that it does not know.
JnStatus jn_repulsion_create(const JnRepulsionDef* def, const JnModelDef* model_def, JnModel* model, JnRepulsion** out);
void jn_repulsion_destroy(JnRepulsion*);

/// Forget the list of pairs: the next call makes it.
void jn_repulsion_forget(JnRepulsion*);

/// f += forces at x [N].
JnStatus jn_repulsion_force(JnRepulsion*, const double* x, double* f);

/// Energy at x [J].
double jn_repulsion_energy(JnRepulsion*, const double* x);

/// Keep K at x for what follows.
JnStatus jn_repulsion_linearize(JnRepulsion*, const double* x);

/// y += scale K p.
void jn_repulsion_product(const JnRepulsion*, JnDefinite, double scale, const double* p, double* y);

/// blocks[9 * node] += diagonal blocks of K, for a pattern that has only these.
void jn_repulsion_add_diagonal(const JnRepulsion*, JnDefinite, double* blocks);

/// Pairs that touched at the last force or energy.
int jn_repulsion_touching(const JnRepulsion*);

#endif
