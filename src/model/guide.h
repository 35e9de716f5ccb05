/// @file guide.h
/// Frames of a thread that run along a curve, such as a needle: each keeps its distance behind the head, whose arc length
/// is a motion in time, and its frame follows that of the curve, which does not twist.
#ifndef JN_MODEL_GUIDE_H
#define JN_MODEL_GUIDE_H

#include "jounce/model.h"
#include "model/motion.h"
#include "model/track.h"

struct JnBody;

/// A node of a guided frame: x = X + c_0 A_0 + c_1 A_1 with the track's position X and directions A.
typedef struct JnGuideNode {
	int node;         ///< of the model
	int held[3];      ///< places of its coordinates among the model's held ones; -1: something else moves that one
	double offset[2]; ///< c [m]
} JnGuideNode;

typedef struct JnGuideFrame {
	double behind;  ///< distance behind the head along the curve [m]
	int first, end; ///< nodes of JnGuide.nodes
} JnGuideFrame;

typedef struct JnGuide JnGuide;
struct JnGuide {
	JnTrack track;
	JnVariant head; ///< the motion: arc length of the head [m]
	int frame_count, node_count;
	JnGuideFrame* frames;
	JnGuideNode* nodes;
};

extern const JnKey jn_along_keys[]; ///< of JnAlongDef

/// The guide of the chosen nodes (one a node of the body's mesh), in the arena. `what` is the key path of `along`.
/// JN_BAD_INPUT when the body is no thread, or for what the curve or the motion refuse.
JnStatus jn_guide_create(const JnAlongDef* def, const char* what, const struct JnBody* body, const bool* chosen,
						 JnArena* arena, JnGuide* guide);

/// Position [m], velocity and acceleration of its nodes at time t, into values[held].
void jn_guide_at(const JnGuide* guide, double t, JnMotionValue* values);

#endif
