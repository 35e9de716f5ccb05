/// @file node_rotation.h
/// How the surroundings of each node have turned between two configurations: the rotation R nearest to
///   A = sum over neighbours j of (x_j - x_i) (X_j - X_i)^T,   X the first configuration, x the present one.
#ifndef JN_SOLVE_NODE_ROTATION_H
#define JN_SOLVE_NODE_ROTATION_H

#include "math/pattern.h"
#include "solve/single_algebra.h"

typedef struct JnNodeRotation {
	const JnPattern* pattern;
	const bool* held; ///< held[3 * node + axis]; a node with a held entry does not turn
	int threads;
	float *from, *now;  ///< X and x, 4 a node, from the first node on
	float* quaternion;  ///< 4 a node: x y z w
	float *turn, *back; ///< R and its transpose, JN_SINGLE_INVERSE a node
	float spacing;      ///< mean distance of neighbours in X
	bool is_turned;     ///< some R is not the identity
} JnNodeRotation;

/// Free with jn_node_rotation_destroy, also after a failure.
JnStatus jn_node_rotation_create(JnNodeRotation* rotation, const JnPattern* pattern, const bool* held, int threads);
void jn_node_rotation_destroy(JnNodeRotation* rotation);

/// X = x, 3 numbers a node; all rotations are the identity.
void jn_node_rotation_begin(JnNodeRotation* rotation, const double* x);

/// The rotations from X to x. Small moves since the last call change nothing.
void jn_node_rotation_follow(JnNodeRotation* rotation, const double* x);

#endif
