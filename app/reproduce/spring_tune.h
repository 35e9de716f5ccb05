/// @file spring_tune.h
/// Runs of scenes/spring.yaml in this process: what a way to choose steps costs, and the value of its key that makes it cost as
/// much as wanted.
#ifndef JN_APP_REPRODUCE_SPRING_TUNE_H
#define JN_APP_REPRODUCE_SPRING_TUNE_H

#include "jounce/base.h"

typedef struct SpringWay {
	const char *name, *title;
	const char*
		step; ///< value of `step:` with %.17g (%1$.17g, if more than once) for the tuned number; larger ones make fewer steps
	bool is_newmark_only; ///< refuses other methods
} SpringWay;

/// What runs are tuned to have in common: accepted steps, or matrices factored, rejected attempts and halves included.
typedef enum SpringGoal { SPRING_STEPS, SPRING_WORK } SpringGoal;

typedef struct SpringTuned {
	double value; ///< of the key
	int count;    ///< steps or matrices that it comes to
} SpringTuned;

/// The text of the override "step=..." of a way.
void spring_step_text(const SpringWay* way, double value, int size, char* text);

/// Bisect the value whose count is nearest to `target`.
JnStatus spring_tune(const char* scene, const char* method, const SpringWay* way, SpringGoal goal, int target,
					 SpringTuned* tuned);

/// Positions at `count` times of equal distance, from 0 to the end of the scene, by steps of the distance / `parts`.
JnStatus spring_sample(const char* scene, const char* method, int parts, int count, double* x);

#endif
