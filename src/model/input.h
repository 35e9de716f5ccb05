/// @file input.h
/// Displacements that a program sets from step to step, such as those of a hand: between two of them nodes move on the cubic
/// that has the positions and velocities of both.
#ifndef JN_MODEL_INPUT_H
#define JN_MODEL_INPUT_H

#include "jounce/sim.h"
#include "model/motion.h"

/// A displacement and its velocity at a time.
typedef struct JnInputKey {
	double t, x[3], v[3];
} JnInputKey;

struct JnInput {
	const char* name;
	int count;
	int* held;             ///< places of its coordinates among the model's held ones, ascending
	JnInputKey from, to;   ///< the motion: before `from` and after `to` it stands still
	JnInputKey next;       ///< where to go in the next step
	bool is_set, has_rate; ///< `next` is there, with a velocity
};

/// What is set becomes the motion over the step from t to t + dt.
void jn_input_begin(JnInput* input, double t, double dt);

/// Displacement, velocity and acceleration at a time.
void jn_input_at(const JnInput* input, double t, JnMotionValue out[3]);

#endif
