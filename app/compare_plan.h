/// @file compare_plan.h
/// What a comparison runs: every combination of the varied keys' values, and a reference.
#ifndef JN_APP_COMPARE_PLAN_H
#define JN_APP_COMPARE_PLAN_H

#include "base/arena.h"
#include "compare_options.h"

typedef struct CompareKey {
	const char* path; ///< "step.dt"
	const char* word; ///< what labels call it: "dt"; the whole path when another key ends alike
	int count;
	const char** values; ///< as written
} CompareKey;

typedef struct CompareRun {
	const char* label; ///< "sdirk2 dt=5ms", for people
	const char* name;  ///< of its folder below runs/: "sdirk2_dt=5ms"; no other run has it
	const char* scene; ///< path of its scene file; NULL: that of the options
	int set_count;
	const char** sets;   ///< all that is set on the scene
	const char** values; ///< of each key; "" where the reference leaves a key to the scene
	bool is_reference;
	bool may_fail; ///< a failure of this run is a result like any other
	double dt;     ///< the value of step.dt when it is varied [s]; NAN otherwise
	int group;     ///< runs of one group differ in step.dt alone; -1 for the reference
	double work;   ///< steps expected, to begin with the longest and to tell the time left
} CompareRun;

typedef struct ComparePlan {
	JnArena arena;
	int key_count;
	CompareKey* keys;
	int dt_key; ///< index of step.dt among the keys, or -1
	int run_count;
	void* names;      ///< of runs so far, in a tree of tsearch
	CompareRun* runs; ///< the first key varies slowest; the reference is the last
	bool has_reference;
	int group_count;
	const char** groups; ///< labels; "" when step.dt alone is varied
	const char* scene_name;
	const char* directory; ///< of the comparison's output
} ComparePlan;

/// Form all combinations. Returns EXIT_DONE, or EXIT_BAD_INPUT after a message when a word is no key=value, a key or a
/// value comes twice, or there are too many combinations. Free with compare_plan_free in either case.
int compare_plan_create(const CompareOptions* options, ComparePlan* plan);
void compare_plan_free(ComparePlan* plan);

#endif
