/// @file repulsion_meeting.h
/// What the parts of repulsion share: points and rigid things, and all of them that overlap at some x.
#ifndef JN_MODEL_REPULSION_MEETING_H
#define JN_MODEL_REPULSION_MEETING_H

#include "detect/neighbours.h"
#include "mesh/rigid.h"
#include "model/repulsion.h"

/// A pair of points that may meet before the list is made again.
typedef struct JnRepulsionPair {
	int nodes[2]; ///< ascending
	double reach; ///< d [m]
	double kappa; ///< [N/m]
} JnRepulsionPair;

/// A rigid body.
typedef struct JnRepulsionRigid {
	int node;
	const JnRigid* shape;
	double stiffness; ///< [N/m]; NAN: by the other side
} JnRepulsionRigid;

/// K of a pair that overlapped at the last linearize: B to both diagonal blocks, -B beside them.
typedef struct JnRepulsionBlock {
	int nodes[2];
	double exact[6], definite[6]; ///< xx yx yy zx zy zz [N/m]
} JnRepulsionBlock;

struct JnRepulsion {
	const JnRepulsionDef* def;
	const JnModel* model;
	JnArena arena;
	int point_count; ///< of peridynamic bodies
	int* points;     ///< their nodes, ascending
	int rigid_count;
	JnRepulsionRigid* rigids;
	double* spacing; ///< of each node's body; twice the radius of a ball, 0 for a plate [m]
	double* modulus; ///< of each node's body: stiffness c / delta [N/m^7]
	double* push;    ///< stiffness of each node against rigid things [N/m]
	double* volume;  ///< of each node [m^3]
	double margin;   ///< [m]
	double farthest; ///< largest d that two points can have [m]

	bool is_built;
	double* built; ///< positions of the points when the list was made
	JnNeighbours near;
	int pair_count;
	JnRepulsionPair* pairs;
	size_t pair_capacity;

	int block_count;
	JnRepulsionBlock* blocks;
	size_t block_capacity;
	int touching;
};

/// Two that overlap.
typedef struct JnRepulsionMeeting {
	int nodes[2];
	double y[3];       ///< to the first from the second, or from its nearest point [m]
	double r, reach;   ///< 0 < r < reach
	double kappa;      ///< [N/m]
	double turning[6]; ///< P, xx yx yy zx zy zz
} JnRepulsionMeeting;

typedef JnStatus JnRepulsionVisit(JnRepulsion*, const JnRepulsionMeeting*, void* user);

/// Bring the list of pairs up to date with x.
JnStatus jn_repulsion_find_pairs(JnRepulsion*, const double* x);

/// Call `visit` for all pairs of points that overlap at x, then for all rigid things, always in the same order.
JnStatus jn_repulsion_visit_points(JnRepulsion*, const double* x, JnRepulsionVisit* visit, void* user);
JnStatus jn_repulsion_visit_rigids(JnRepulsion*, const double* x, JnRepulsionVisit* visit, void* user);

#endif
