/// @file limits.h
/// What all adaptive controllers share: the first step, its bounds, how fast it may change, and what becomes of an attempt.
#ifndef JN_CONTROL_LIMITS_H
#define JN_CONTROL_LIMITS_H

#include "jounce/extend.h"

typedef struct JnStepLimits {
	double dt;              ///< first step [s]
	double dt_min, dt_max;  ///< bounds of all steps [s]; only a step clipped to the end or a frame is shorter
	double lowest, highest; ///< bounds of the ratio of one attempt to the one before
	double hold;            ///< the size is kept while the ratio wanted lies between jn_hold_low and this
} JnStepLimits;

/// Rows for a table of keys; `type` has a JnStepLimits `limits`; `held` is the default of `hold`.
#define JN_STEP_LIMIT_ROWS(type, held) JN_STEP_SIZE_ROWS(type), JN_STEP_RATIO_ROWS(type, held)

#define JN_STEP_SIZE_ROWS(type)                                                                                        \
	{.name = "dt",                                                                                                     \
	 .kind = JN_REAL,                                                                                                  \
	 .field = offsetof(type, limits.dt),                                                                               \
	 .value = {1e-3},                                                                                                  \
	 .low = 1e-12,                                                                                                     \
	 .high = 10,                                                                                                       \
	 .unit = "s",                                                                                                      \
	 .meaning = "first time step"},                                                                                    \
		{.name = "dt_min",                                                                                             \
		 .kind = JN_REAL,                                                                                              \
		 .field = offsetof(type, limits.dt_min),                                                                       \
		 .value = {1e-8},                                                                                              \
		 .low = 1e-12,                                                                                                 \
		 .high = 10,                                                                                                   \
		 .unit = "s",                                                                                                  \
		 .meaning = "smallest step; the run ends when a step of this size is refused"},                                \
	{                                                                                                                  \
		.name = "dt_max", .kind = JN_REAL, .field = offsetof(type, limits.dt_max), .value = {10}, .low = 1e-12,        \
		.high = 10, .unit = "s", .meaning = "largest step"                                                             \
	}

#define JN_STEP_RATIO_ROWS(type, held)                                                                                 \
	{.name = "lowest",                                                                                                 \
	 .kind = JN_REAL,                                                                                                  \
	 .field = offsetof(type, limits.lowest),                                                                           \
	 .value = {0.2},                                                                                                   \
	 .low = 0.01,                                                                                                      \
	 .high = 0.9,                                                                                                      \
	 .meaning = "smallest ratio of a step to the attempt before it"},                                                  \
		{.name = "highest",                                                                                            \
		 .kind = JN_REAL,                                                                                              \
		 .field = offsetof(type, limits.highest),                                                                      \
		 .value = {5},                                                                                                 \
		 .low = 1.1,                                                                                                   \
		 .high = 100,                                                                                                  \
		 .meaning = "largest ratio of a step to the attempt before it"},                                               \
	{                                                                                                                  \
		.name = "hold", .kind = JN_REAL, .field = offsetof(type, limits.hold), .value = {held}, .low = 1, .high = 2,   \
		.meaning =                                                                                                     \
			"the size is kept while the ratio wanted lies between 0.95 and this, which saves factorisations of "       \
			"methods that keep them; 1: never"                                                                         \
	}

/// The row of `tolerance`, an error in metres; `type` has it as a double.
#define JN_TOLERANCE_ROW(type, remedy_words, words)                                                                    \
	{                                                                                                                  \
		.name = "tolerance", .kind = JN_REAL, .field = offsetof(type, tolerance), .value = {1e-5}, .low = 0,           \
		.high = 1e3, .open = JN_OPEN_LOW, .unit = "m", .remedy = remedy_words, .meaning = words                        \
	}

/// JN_BAD_INPUT after a message when the bounds contradict each other.
JnStatus jn_limits_check(const JnController* controller, const JnStepLimits* limits);

/// The attempt is accepted; one of `factor` times its size would be the best next.
void jn_limits_accept(const JnStepLimits* limits, const JnStep* step, double factor, JnVerdict* verdict);

/// The attempt is refused. JN_RUN_FAILED when it was of the smallest size.
JnStatus jn_limits_refuse(const JnStepLimits* limits, const JnStep* step, double factor, JnVerdict* verdict);

/// Say what stopped a run: `error`, called `what`, above the tolerance of an attempt that worked (NAN: it failed by itself).
void jn_limits_explain(const JnController* controller, const JnStepLimits* limits, const char* what, double error,
					   double tolerance, JnComplaint* complaint);

/// Was the step shortened, to end on the duration or on a frame? What it tells about the next one is then little.
static inline bool jn_step_is_clipped(const JnStep* step) {
	return step->dt < step->wanted * (1 - 1e-9);
}

/// Ratios of 0.95 and more are no reason to lose a factor for.
static const double jn_hold_low = 0.95;

/// Share of its size to which a step that failed, for whatever reason, is cut.
static const double jn_cut = 0.5;

#endif
