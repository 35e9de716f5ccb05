/// @file render_plan.h
/// Which times are drawn, and how fast a film shows them.
#ifndef JN_APP_RENDER_PLAN_H
#define JN_APP_RENDER_PLAN_H

#include "render_options.h"

typedef struct RenderPlan {
	int count;
	double* times; ///< [s]
	double fps;    ///< of a film [1/s]
	double speed;  ///< simulated seconds in a second of the film; 0: its pictures were chosen one by one
} RenderPlan;

/// Form the plan for open recordings; frames are those of the first. Free with render_plan_free. Returns EXIT_DONE, or
/// EXIT_BAD_INPUT after a message.
int render_plan_create(const RenderOptions* options, const ViewSources* sources, RenderPlan* plan);
void render_plan_free(RenderPlan* plan);

#endif
