/// @file plan.h
/// Which rows and which parts of a scene stand together, decided before anything is written: what cannot stand together would
/// only be refused.
#ifndef JN_TEST_RANDOM_PLAN_H
#define JN_TEST_RANDOM_PLAN_H

#include <stdbool.h>

#include "base/random.h"
#include "jounce/extend.h"

enum { PLAN_BODIES = 3 };

typedef struct PlanBody {
	const JnRow *law, *shape;
	const char* element; ///< that the law needs; NULL: any
	const char* file;    ///< for shapes from files
	bool has_horizon;    ///< in metres; else in spacings
	const char* filling; ///< key that makes cells of its surface; "": none, the file is a volume
} PlanBody;

typedef struct Plan {
	const JnRow *method, *controller;
	bool needs_lumped;     ///< the method is explicit
	double wildness;       ///< probability that a number is drawn from all that its key allows
	const char* parts;     ///< of the root that stand there, divided by '|'
	char list[160];        ///< memory of `parts`
	int damping_stiffness; ///< the same for all bodies
	double damping_start;
	int body_count; ///< 0: a system
	PlanBody bodies[PLAN_BODIES];
} Plan;

typedef enum PlanWord { PLAN_SAYS_NOTHING, PLAN_SAYS_YES, PLAN_SAYS_NO } PlanWord;

void plan_make(Plan* plan, long index, JnRandom* random);

/// A controller that can serve the method, and mostly only such; `combined` where it may hold others.
const JnRow* plan_controller(const Plan* plan, JnRandom* random, bool may_combine);

/// Does the plan want the key at `path`?
PlanWord plan_says(const Plan* plan, const char* path);

const char* plan_sets(const PlanBody* body); ///< sets that the shape brings, divided by '|'; NULL: none
bool plan_is_thread(const PlanBody* body);
bool plan_is_cloth(const PlanBody* body);

#endif
