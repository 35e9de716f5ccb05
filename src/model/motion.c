// Sine: x = amplitude sin(2 pi frequency t + phase).
// Keyframes: between two keys either a straight line, or the quintic that starts and ends at rest
// (10 s^3 - 15 s^4 + 6 s^5, minimum jerk), whose acceleration is continuous everywhere.
#include "model/motion.h"

#include <math.h>

#include "base/log.h"

typedef struct SineDef {
	double amplitude, frequency, phase;
} SineDef;

typedef struct KeyframesDef {
	JnPoints points;
	int curve; // 0 smooth, 1 linear
} KeyframesDef;

static const double pi = 3.14159265358979323846;

static JnMotionValue sine_at(const void* options, double t) {
	const SineDef* def = options;
	const double omega = 2 * pi * def->frequency;
	const double angle = omega * t + def->phase;
	return (JnMotionValue){.x = def->amplitude * sin(angle),
						   .v = def->amplitude * omega * cos(angle),
						   .a = -def->amplitude * omega * omega * sin(angle)};
}

static JnMotionValue between(const double from[2], const double to[2], double t, int curve) {
	const double duration = to[0] - from[0], rise = to[1] - from[1];
	const double s = (t - from[0]) / duration;
	if (curve == 1) return (JnMotionValue){.x = from[1] + rise * s, .v = rise / duration, .a = 0};
	return (JnMotionValue){
		.x = from[1] + rise * s * s * s * (10 + s * (-15 + 6 * s)),
		.v = rise / duration * 30 * s * s * (1 - s) * (1 - s),
		.a = rise / (duration * duration) * 60 * s * (1 - s) * (1 - 2 * s),
	};
}

static JnMotionValue keyframes_at(const void* options, double t) {
	const KeyframesDef* def = options;
	const JnPoints* points = &def->points;
	if (t <= points->data[0][0]) return (JnMotionValue){.x = points->data[0][1]};
	for (int i = 1; i < points->count; ++i)
		if (t < points->data[i][0]) return between(points->data[i - 1], points->data[i], t, def->curve);
	return (JnMotionValue){.x = points->data[points->count - 1][1]};
}

static JnStatus keyframes_check(const void* options, const char* what) {
	const JnPoints* points = &((const KeyframesDef*)options)->points;
	if (points->count < 1)
		return jn_error(JN_BAD_INPUT, "%s.points: empty; give at least one [time, displacement] pair", what);
	for (int i = 1; i < points->count; ++i)
		if (!(points->data[i][0] > points->data[i - 1][0]))
			return jn_error(JN_BAD_INPUT,
							"%s.points[%d]: its time %g s is not after the %g s before it; let times rise", what, i,
							points->data[i][0], points->data[i - 1][0]);
	return JN_OK;
}

static const char* const curves[] = {"smooth", "linear", NULL};

static const JnKey sine_keys[] = {
	{.name = "amplitude",
	 .kind = JN_REAL,
	 .field = offsetof(SineDef, amplitude),
	 .required = true,
	 .unit = "m",
	 .meaning = "largest displacement"},
	{.name = "frequency",
	 .kind = JN_REAL,
	 .field = offsetof(SineDef, frequency),
	 .required = true,
	 .low = 0,
	 .high = 1e6,
	 .unit = "Hz",
	 .meaning = "cycles a second"},
	{.name = "phase",
	 .kind = JN_REAL,
	 .field = offsetof(SineDef, phase),
	 .unit = "rad",
	 .meaning = "angle at t = 0; 90 deg starts at the largest displacement"},
	{0},
};

static const JnKey keyframes_keys[] = {
	{.name = "points",
	 .kind = JN_POINTS,
	 .field = offsetof(KeyframesDef, points),
	 .required = true,
	 .unit = "m",
	 .meaning = "[time, displacement] pairs with rising times; constant before the first and after the last"},
	{.name = "curve",
	 .kind = JN_CHOICE,
	 .field = offsetof(KeyframesDef, curve),
	 .names = curves,
	 .meaning = "smooth: at rest at every key, acceleration continuous; linear: straight, velocity jumps at keys"},
	{0},
};

static const JnMotionType sine = {
	.row = {.name = "sine", .doc = "oscillates about rest", .keys = sine_keys, .options_size = sizeof(SineDef)},
	.at = sine_at,
};

static const JnMotionType keyframes = {
	.row = {.name = "keyframes",
			.doc = "moves through given positions at given times",
			.keys = keyframes_keys,
			.options_size = sizeof(KeyframesDef)},
	.at = keyframes_at,
	.check = keyframes_check,
};

static const JnRow* const rows[] = {&sine.row, &keyframes.row};

const JnRowList jn_motion_list = {.noun = "motion", .rows = rows, .count = sizeof rows / sizeof *rows};
