/// @file sim_keys.h
/// The keys that say how to step, as rows of the root of a scene file and as settings for systems of the user's own.
#ifndef JN_SIM_SIM_KEYS_H
#define JN_SIM_SIM_KEYS_H

#include "control/controller.h"
#include "integrate/integrator.h"
#include "jounce/sim.h"
#include "sim/watch.h"

/// Rows for a table of keys; `path` is the place of a JnSimDef in `type`, such as `sim.` or nothing.
#define JN_SIM_KEY_ROWS(type, path)                                                                                    \
	{.name = "duration",                                                                                               \
	 .kind = JN_REAL,                                                                                                  \
	 .field = offsetof(type, path duration),                                                                           \
	 .required = true,                                                                                                 \
	 .low = 0,                                                                                                         \
	 .high = 1e9,                                                                                                      \
	 .open = JN_OPEN_LOW,                                                                                              \
	 .unit = "s",                                                                                                      \
	 .meaning = "simulated time"},                                                                                     \
		{.name = "integrator",                                                                                         \
		 .kind = JN_VARIANT,                                                                                           \
		 .field = offsetof(type, path integrator),                                                                     \
		 .text = "sdirk2",                                                                                             \
		 .rows = &jn_integrator_list,                                                                                  \
		 .tag = "method",                                                                                              \
		 .meaning = "the time integration method"},                                                                    \
		{.name = "newton",                                                                                             \
		 .kind = JN_OBJECT,                                                                                            \
		 .field = offsetof(type, path newton),                                                                         \
		 .keys = jn_newton_keys,                                                                                       \
		 .meaning = "how implicit stages are solved"},                                                                 \
		{.name = "watch",                                                                                              \
		 .kind = JN_OBJECT,                                                                                            \
		 .field = offsetof(type, path watch),                                                                          \
		 .keys = jn_watch_keys,                                                                                        \
		 .meaning = "when a gain of energy is reported"},                                                              \
	{                                                                                                                  \
		.name = "step", .kind = JN_VARIANT, .field = offsetof(type, path step), .text = "fixed",                       \
		.rows = &jn_controller_list, .tag = "controller", .meaning = "the time step and who chooses it"                \
	}

extern const JnKey jn_sim_keys[]; ///< of JnSimDef, without the model

#endif
