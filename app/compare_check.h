/// @file compare_check.h
/// Find bad input before any run starts.
#ifndef JN_APP_COMPARE_CHECK_H
#define JN_APP_COMPARE_CHECK_H

#include "compare_plan.h"

/// Load and build every run's scene. Fills each run's `work`, the plan's `scene_name` and `directory`. Returns EXIT_DONE; EXIT_BAD_INPUT
/// or EXIT_FILE_FAILED after a message that names the combination, also when a run and the reference have different meshes
/// or durations.
int compare_plan_check(const CompareOptions* options, ComparePlan* plan);

#endif
