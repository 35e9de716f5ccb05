// In the form m l^2 theta'' = -m g l sin theta, so that energies are in J.
#include "model/pendulum.h"

#include <math.h>
#include <string.h>

static double torque(const JnPendulumDef* def) {
	return def->mass * def->gravity * def->length;
}

static int force(void* user, double t, const double* x, const double* v, double* f) {
	(void)t;
	(void)v;
	f[0] = -torque(user) * sin(x[0]);
	f[1] = f[2] = 0;
	return 0;
}

static double energy(void* user, double t, const double* x) {
	const double half = sin(0.5 * x[0]);
	(void)t;
	return 2 * torque(user) * half * half; // 1 - cos theta without its rounding
}

static int tangent(void* user, double t, const double* x, const double* v, double* stiffness, double* damping) {
	(void)t;
	(void)v;
	memset(stiffness, 0, 9 * sizeof *stiffness);
	memset(damping, 0, 9 * sizeof *damping);
	stiffness[0] = torque(user) * cos(x[0]);
	return 0;
}

static JnStatus create(const void* options, JnSystem** sys) {
	const JnPendulumDef* def = options;
	const double m = def->mass * def->length * def->length, mass[9] = {m, 0, 0, 0, m, 0, 0, 0, m};
	const JnUserSystemDef user = {
		.count = 3, .user = (void*)options, .force = force, .energy = energy, .tangent = tangent, .mass = mass};
	JN_TRY(jn_user_system_create(&user, sys));
	(*sys)->space->node_entries = 3;
	return JN_OK;
}

static void start(const void* options, double* x, double* v) {
	const JnPendulumDef* def = options;
	x[0] = def->angle;
	v[0] = def->speed;
	x[1] = x[2] = v[1] = v[2] = 0;
}

static const JnPassColumn columns[] = {{"theta", "rad", false}, {"omega", "rad/s", false}};

static void measure(const void* options, const JnState* state, double* values) {
	(void)options;
	values[0] = state->x[0];
	values[1] = state->v[0];
}

static const JnKey keys[] = {
	{.name = "gravity",
	 .kind = JN_REAL,
	 .field = offsetof(JnPendulumDef, gravity),
	 .value = {9.81},
	 .low = 0,
	 .high = 1e6,
	 .unit = "m/s^2",
	 .meaning = "g"},
	{.name = "length",
	 .kind = JN_REAL,
	 .field = offsetof(JnPendulumDef, length),
	 .value = {1},
	 .low = 0,
	 .high = 1e6,
	 .open = JN_OPEN_LOW,
	 .unit = "m",
	 .meaning = "from the pivot to the mass"},
	{.name = "mass",
	 .kind = JN_REAL,
	 .field = offsetof(JnPendulumDef, mass),
	 .value = {1},
	 .low = 0,
	 .high = 1e12,
	 .open = JN_OPEN_LOW,
	 .unit = "kg",
	 .meaning = "at the end of the rod"},
	{.name = "angle",
	 .kind = JN_REAL,
	 .field = offsetof(JnPendulumDef, angle),
	 .value = {1},
	 .low = -1e3,
	 .high = 1e3,
	 .unit = "rad",
	 .meaning = "at the start, from hanging down"},
	{.name = "speed",
	 .kind = JN_REAL,
	 .field = offsetof(JnPendulumDef, speed),
	 .low = -1e6,
	 .high = 1e6,
	 .unit = "rad/s",
	 .meaning = "angular speed at the start"},
	{0},
};

const JnSystemType jn_system_pendulum = {
	.row = {.name = "pendulum",
			.doc = "a mass on a rod that swings or turns over: theta'' = -(g/l) sin theta",
			.keys = keys,
			.options_size = sizeof(JnPendulumDef)},
	.create = create,
	.start = start,
	.column_count = sizeof columns / sizeof *columns,
	.columns = columns,
	.measure = measure,
};
