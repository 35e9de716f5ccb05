/// @file order_problems.h
/// The problems on which the order of every integrator is measured: three of a few unknowns, given by callbacks as a user would
/// write them, and a solid of Stable Neo-Hookean hexahedra. All are smooth, and started away from rest.
///
/// Explicit methods ask for a diagonal mass: each problem comes with its own mass and with a diagonal one.
#ifndef JN_TEST_TABLE_ORDER_PROBLEMS_H
#define JN_TEST_TABLE_ORDER_PROBLEMS_H

#include <math.h>
#include <string.h>

#include "base/key.h"
#include "jounce/extend.h"
#include "jounce/scene.h"

enum { ORDER_MOST_REALS = 270 }; ///< entries of x of the largest problem, twice: 45 nodes

typedef enum OrderMass { ORDER_MASS_OWN, ORDER_MASS_DIAGONAL } OrderMass;

/// A problem that is ready to be stepped, from x and v at t = 0. Free with order_system_destroy.
typedef struct OrderSystem {
	JnSystem* sys;
	JnModel* model; ///< owns sys; NULL for a system of callbacks
	JnArena arena;  ///< of the scene
	JnSceneDef scene;
	int length;
	double x[ORDER_MOST_REALS / 2], v[ORDER_MOST_REALS / 2];
} OrderSystem;

typedef struct OrderProblem {
	const char* name; ///< in messages and at the head of a column
	const char* text; ///< what it is, for the page
	double duration;  ///< [s]
	int coarsest[4];  ///< steps at the largest of three sizes, for methods of first to fourth and higher order
	int reference;    ///< steps of the reference
	JnStatus (*create)(OrderMass mass, OrderSystem* out);
} OrderProblem;

static inline void order_system_destroy(OrderSystem* problem) {
	if (problem->model == NULL) jn_user_system_destroy(problem->sys);
	jn_model_destroy(problem->model);
	jn_arena_free(&problem->arena);
}

// ---- a pendulum, x = angle:  m L^2 x'' = -m g L sin x,  m = 2 kg, L = 1 m

static inline int order_pendulum_force(void* user, double t, const double* x, const double* v, double* f) {
	(void)user, (void)t, (void)v;
	f[0] = -2 * 9.81 * sin(x[0]);
	return 0;
}

static inline double order_pendulum_energy(void* user, double t, const double* x) {
	(void)user, (void)t;
	return 2 * 9.81 * (1 - cos(x[0]));
}

static inline int order_pendulum_tangent(void* user, double t, const double* x, const double* v, double* stiffness,
										 double* damping) {
	(void)user, (void)t, (void)v;
	stiffness[0] = 2 * 9.81 * cos(x[0]);
	damping[0] = 0;
	return 0;
}

static inline JnStatus order_pendulum_create(OrderMass mass, OrderSystem* out) {
	(void)mass; // one unknown: diagonal as it is
	const JnUserSystemDef def = {.count = 1,
								 .force = order_pendulum_force,
								 .energy = order_pendulum_energy,
								 .tangent = order_pendulum_tangent,
								 .mass = (const double[]){2}};
	*out = (OrderSystem){.length = 1, .x = {1.5}, .v = {0.8}};
	return jn_user_system_create(&def, &out->sys);
}

// ---- two masses:  M x'' = -K x - D x', the user pointer is D or NULL

static const double order_pair_stiffness[4] = {30, -10, -10, 20};               // [N/m]
static const double order_pair_damping[4] = {0.9, -0.2, -0.2, 0.1};             // [N s/m], no combination of M and K
static const double order_pair_masses[2][4] = {{2, 0.5, 0.5, 1}, {2, 0, 0, 1}}; // [kg], by OrderMass

static inline int order_pair_force(void* user, double t, const double* x, const double* v, double* f) {
	(void)t;
	const double *K = order_pair_stiffness, *D = user;
	for (int i = 0; i < 2; ++i) f[i] = -K[2 * i] * x[0] - K[2 * i + 1] * x[1];
	for (int i = 0; D != NULL && i < 2; ++i) f[i] -= D[2 * i] * v[0] + D[2 * i + 1] * v[1];
	return 0;
}

static inline double order_pair_energy(void* user, double t, const double* x) {
	(void)user, (void)t;
	const double* K = order_pair_stiffness;
	return 0.5 * (K[0] * x[0] * x[0] + 2 * K[1] * x[0] * x[1] + K[3] * x[1] * x[1]);
}

static inline int order_pair_tangent(void* user, double t, const double* x, const double* v, double* stiffness,
									 double* damping) {
	(void)t, (void)x, (void)v;
	const double* D = user;
	memcpy(stiffness, order_pair_stiffness, sizeof order_pair_stiffness);
	for (int k = 0; k < 4; ++k) damping[k] = D != NULL ? D[k] : 0;
	return 0;
}

static inline JnStatus order_create_pair(OrderMass mass, const double* damping, OrderSystem* out) {
	const JnUserSystemDef def = {.count = 2,
								 .user = (void*)(uintptr_t)damping,
								 .force = order_pair_force,
								 .energy = order_pair_energy,
								 .tangent = order_pair_tangent,
								 .mass = order_pair_masses[mass]};
	*out = (OrderSystem){.length = 2, .x = {0.5, -0.2}, .v = {-1, 2}};
	return jn_user_system_create(&def, &out->sys);
}

static inline JnStatus order_pair_create(OrderMass mass, OrderSystem* out) {
	return order_create_pair(mass, NULL, out);
}

static inline JnStatus order_damped_create(OrderMass mass, OrderSystem* out) {
	return order_create_pair(mass, order_pair_damping, out);
}

// ---- a hardening spring under a load that depends on time:  x'' = -4 x - 3 x^3 + 5 cos 3 t

static inline int order_load_force(void* user, double t, const double* x, const double* v, double* f) {
	(void)user, (void)v;
	f[0] = -4 * x[0] - 3 * x[0] * x[0] * x[0] + 5 * cos(3 * t + 0.5);
	return 0;
}

static inline int order_load_tangent(void* user, double t, const double* x, const double* v, double* stiffness,
									 double* damping) {
	(void)user, (void)t, (void)v;
	stiffness[0] = 4 + 9 * x[0] * x[0];
	damping[0] = 0;
	return 0;
}

static inline JnStatus order_load_create(OrderMass mass, OrderSystem* out) {
	(void)mass; // one unknown: diagonal as it is
	const JnUserSystemDef def = {
		.count = 1, .force = order_load_force, .tangent = order_load_tangent, .depends_on_time = true};
	*out = (OrderSystem){.length = 1, .x = {0.7}, .v = {-0.5}};
	return jn_user_system_create(&def, &out->sys);
}

// ---- the solid: 2 x 2 x 4 hexahedra that bend and twist under gravity, clamped below; its face above free or driven

static const char order_solid_scene[] = "duration: 1 s\nsolver: {method: direct}\n"
										"gravity: [1, -9.81, 0.5]\n"
										"bodies:\n"
										"  - name: box\n"
										"    shape: {type: box, size: [0.2, 0.2, 0.4], cells: [2, 2, 4]}\n"
										"    material: {law: stable_neo_hookean, density: 1000 kg/m^3, young: 10 kPa, "
										"poisson: 0.3}\n"
										"    fix: [{where: {face: z-}}]\n";

static const char order_solid_drive[] =
	"bodies[0].drive=[{where: {face: z+}, x: {type: sine, amplitude: 2 cm, frequency: 8 Hz}}]";

// A twist and a bend that grow from the clamped end: smooth in space, and large enough that nothing is linear.
static inline void order_set_in_motion(OrderSystem* solid) {
	const double* rest = jn_model_rest(solid->model);
	memcpy(solid->x, rest, (size_t)solid->length * sizeof(double));
	for (int k = 0; k < solid->length; k += 3) {
		const double *X = rest + k, height = X[2] * X[2] / 0.16;
		solid->v[k] = height * (0.8 - 6 * (X[1] - 0.1));
		solid->v[k + 1] = height * (0.5 + 6 * (X[0] - 0.1));
		solid->v[k + 2] = 0.4 * X[2];
	}
}

static inline JnStatus order_create_solid(OrderMass mass, const char* change, OrderSystem* out) {
	JnDocument scene;
	*out = (OrderSystem){0};
	JN_TRY(jn_document_parse("solid", order_solid_scene, &out->arena, &scene));
	if (mass == ORDER_MASS_DIAGONAL) JN_TRY(jn_document_set(&scene, "bodies[0].mass=lumped"));
	if (change != NULL) JN_TRY(jn_document_set(&scene, change));
	JN_TRY(jn_keys_read(jn_scene_keys, scene.root, "", &out->arena, &out->scene));
	JN_TRY(jn_model_create(&out->scene.sim.model, 1, &out->model));
	out->sys = jn_model_system(out->model);
	out->length = 3 * jn_model_node_count(out->model);
	if (2 * out->length > ORDER_MOST_REALS) return JN_BAD_INPUT;
	order_set_in_motion(out);
	return JN_OK;
}

static inline JnStatus order_solid_create(OrderMass mass, OrderSystem* out) {
	return order_create_solid(mass, NULL, out);
}

static inline JnStatus order_driven_create(OrderMass mass, OrderSystem* out) {
	return order_create_solid(mass, order_solid_drive, out);
}

// Steps of the small problems: small enough for the leading term to rule methods made for a small one (sdirk_3345), large
// enough for errors of fourth order to stand above 1e-12, what Newton leaves. The largest frequency of the solid is some
// 300 rad/s: 0.3 rad a step at 64 steps. Explicit Euler, which lets it grow, needs far more.
#define ORDER_SMALL .duration = 2, .coarsest = {4096, 1024, 512, 128}, .reference = 8192
#define ORDER_SOLID .duration = 1.0 / 16, .coarsest = {1024, 64, 128, 64}, .reference = 1024

static const OrderProblem order_problems[] = {
	{.name = "pendulum",
	 .text = "`2 x'' = -2 · 9.81 sin x` from x = 1.5, x' = 0.8, over 2 s: nonlinear, without damping",
	 .create = order_pendulum_create,
	 ORDER_SMALL},
	{.name = "pair",
	 .text = "two masses, `M x'' = -K x` with M = [2 0.5; 0.5 1] and K = [30 -10; -10 20], over 2 s: linear, its mass "
			 "not diagonal",
	 .create = order_pair_create,
	 ORDER_SMALL},
	{.name = "damped pair",
	 .text = "the same with `-D x'`, D = [0.9 -0.2; -0.2 0.1], which is no combination of M and K",
	 .create = order_damped_create,
	 ORDER_SMALL},
	{.name = "load",
	 .text = "`x'' = -4 x - 3 x^3 + 5 cos(3 t + 0.5)` over 2 s: a force that depends on time",
	 .create = order_load_create,
	 ORDER_SMALL},
	{.name = "solid",
	 .text = "2 × 2 × 4 hexahedra, Stable Neo-Hookean, 0.2 × 0.2 × 0.4 m, E = 10 kPa, clamped below, bending and "
			 "twisting under gravity for 1/16 s; consistent mass, no damping",
	 .create = order_solid_create,
	 ORDER_SOLID},
	{.name = "driven solid",
	 .text = "the same with its upper face on a sine of 2 cm and 8 Hz: nodes that follow a path in time",
	 .create = order_driven_create,
	 ORDER_SOLID},
};
enum { ORDER_PROBLEM_COUNT = sizeof order_problems / sizeof *order_problems };

#endif
