/// @file fragments.h
/// Pieces that hang together: connected components of points by the bonds that are left.
#ifndef JN_PASS_FRAGMENTS_H
#define JN_PASS_FRAGMENTS_H

#include "force/kernel.h"

/// Pieces of the points that elements join. Set up with jn_fragments_create.
typedef struct JnFragments {
	int point_count;
	int* parent;     ///< work space: a point's parent in its tree
	int* size;       ///< work space: points of the tree of a root
	double* number;  ///< of each point its piece, from 0 in the order of their lowest points
	int count;       ///< pieces of two points or more
	int loose_count; ///< points alone
	int largest;     ///< points of the largest piece
} JnFragments;

JnStatus jn_fragments_create(int point_count, JnArena* arena, JnFragments* fragments);

/// Forget all joints: every point is a piece by itself.
void jn_fragments_begin(JnFragments* fragments);

/// Join the nodes of the group's elements for which is_broken is false.
void jn_fragments_join(JnFragments* fragments, const JnGroup* group, const bool* is_broken);

/// Number and count the pieces of those points for which is_member is true; the others are no pieces and have number -1.
void jn_fragments_count(JnFragments* fragments, const bool* is_member);

#endif
