#include "model/spring_1d.h"

#include <string.h>

static int force(void* user, double t, const double* x, const double* v, double* f) {
	const JnSpringDef* spring = user;
	(void)t;
	f[0] = -spring->k_x * (x[0] + x[0] * x[0] * x[0]) - spring->k_v * (v[0] + v[0] * v[0] * v[0]);
	f[1] = f[2] = 0;
	return 0;
}

static double energy(void* user, double t, const double* x) {
	const JnSpringDef* spring = user;
	const double square = x[0] * x[0];
	(void)t;
	return spring->k_x * (0.5 * square + 0.25 * square * square);
}

static int tangent(void* user, double t, const double* x, const double* v, double* stiffness, double* damping) {
	const JnSpringDef* spring = user;
	(void)t;
	memset(stiffness, 0, 9 * sizeof *stiffness);
	memset(damping, 0, 9 * sizeof *damping);
	stiffness[0] = spring->k_x * (1 + 3 * x[0] * x[0]);
	damping[0] = spring->k_v * (1 + 3 * v[0] * v[0]);
	return 0;
}

static JnStatus create(const void* options, JnSystem** sys) {
	const JnSpringDef* spring = options;
	const double m = spring->mass, mass[9] = {m, 0, 0, 0, m, 0, 0, 0, m};
	const JnUserSystemDef def = {
		.count = 3, .user = (void*)options, .force = force, .energy = energy, .tangent = tangent, .mass = mass};
	JN_TRY(jn_user_system_create(&def, sys));
	(*sys)->space->node_entries = 3;
	return JN_OK;
}

static void start(const void* options, double* x, double* v) {
	const JnSpringDef* spring = options;
	x[0] = spring->x;
	v[0] = spring->v;
	x[1] = x[2] = v[1] = v[2] = 0;
}

static const JnPassColumn columns[] = {{"x", "m", false}, {"v", "m/s", false}};

static void measure(const void* options, const JnState* state, double* values) {
	(void)options;
	values[0] = state->x[0];
	values[1] = state->v[0];
}

static const JnKey keys[] = {
	{.name = "k_x",
	 .kind = JN_REAL,
	 .field = offsetof(JnSpringDef, k_x),
	 .value = {100},
	 .low = 0,
	 .high = 1e12,
	 .unit = "N/m",
	 .meaning = "stiffness: the force is -k_x (x + x^3)"},
	{.name = "k_v",
	 .kind = JN_REAL,
	 .field = offsetof(JnSpringDef, k_v),
	 .value = {1},
	 .low = 0,
	 .high = 1e12,
	 .unit = "N s/m",
	 .meaning = "damping: its force is -k_v (v + v^3)"},
	{.name = "mass",
	 .kind = JN_REAL,
	 .field = offsetof(JnSpringDef, mass),
	 .value = {1},
	 .low = 0,
	 .high = 1e12,
	 .open = JN_OPEN_LOW,
	 .unit = "kg",
	 .meaning = "of the node"},
	{.name = "x",
	 .kind = JN_REAL,
	 .field = offsetof(JnSpringDef, x),
	 .value = {-1},
	 .low = -1e6,
	 .high = 1e6,
	 .unit = "m",
	 .meaning = "position at the start"},
	{.name = "v",
	 .kind = JN_REAL,
	 .field = offsetof(JnSpringDef, v),
	 .low = -1e6,
	 .high = 1e6,
	 .unit = "m/s",
	 .meaning = "velocity at the start"},
	{0},
};

const JnSystemType jn_system_spring_1d = {
	.row = {.name = "spring_1d",
			.doc = "a mass on a nonlinear spring along x: m x'' = -k_x (x + x^3) - k_v (v + v^3)",
			.keys = keys,
			.options_size = sizeof(JnSpringDef)},
	.create = create,
	.start = start,
	.column_count = sizeof columns / sizeof *columns,
	.columns = columns,
	.measure = measure,
};
