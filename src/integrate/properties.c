// The oscillator x'' = -nu^2 x - 2 xi nu v is stepped by the method itself, dt = 1. One-step methods give their 2x2 amplification
// matrix from two unit states; methods with history are run until their spurious roots have died, and the matrix then
// follows from three successive states.
#include "integrate/properties.h"

#include <math.h>

#include "base/arena.h"
#include "base/key.h"
#include "base/space.h"
#include "integrate/integrator.h"
#include "integrate/tableau.h"

enum { TRANSIENT = 60 };

typedef struct Oscillator {
	double nu, xi; // omega dt, damping ratio
	JnArena arena;
	JnSystem* sys;
	JnIntegrator* integrator;
	JnState start, end;
} Oscillator;

static int spring(void* user, double t, const double* x, const double* v, double* f) {
	const Oscillator* o = user;
	(void)t;
	f[0] = -o->nu * o->nu * x[0] - 2 * o->xi * o->nu * v[0];
	return 0;
}

static int spring_tangent(void* user, double t, const double* x, const double* v, double* stiffness, double* damping) {
	const Oscillator* o = user;
	(void)t, (void)x, (void)v;
	stiffness[0] = o->nu * o->nu;
	damping[0] = 2 * o->xi * o->nu;
	return 0;
}

static void oscillator_close(Oscillator* o) {
	jn_integrator_destroy(o->integrator);
	if (o->sys != NULL) {
		jn_state_destroy(o->sys->space, &o->start);
		jn_state_destroy(o->sys->space, &o->end);
	}
	jn_user_system_destroy(o->sys);
	jn_arena_free(&o->arena);
}

static JnStatus oscillator_open(const JnIntegratorType* type, double nu, double xi, Oscillator* o) {
	*o = (Oscillator){.nu = nu, .xi = xi};
	const JnUserSystemDef def = {.count = 1, .user = o, .force = spring, .tangent = spring_tangent};
	JnVariant choice = {.row = &type->row};
	JnNewtonDef newton;
	JN_TRY(jn_keys_read(jn_newton_keys, NULL, "", &o->arena, &newton));
	if (type->row.options_size > 0) {
		choice.options = jn_arena_take(&o->arena, 1, type->row.options_size);
		if (choice.options == NULL) return JN_OUT_OF_MEMORY;
		JN_TRY(jn_keys_read(type->row.keys, NULL, "", &o->arena, choice.options));
	}
	newton.mode = 1; // linear: exact here, and no tolerance to miss at large nu
	JN_TRY(jn_user_system_create(&def, &o->sys));
	JN_TRY(jn_state_create(o->sys->space, &o->start));
	JN_TRY(jn_state_create(o->sys->space, &o->end));
	o->integrator = jn_integrator_create(&choice, &newton, o->sys->space);
	return o->integrator != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

static void put(Oscillator* o, double x, double v) {
	o->start.t = 0;
	o->start.x[0] = x;
	o->start.v[0] = v;
	jn_integrator_forget(o->integrator);
	jn_integrator_reset(o->integrator);
	jn_state_touch(o->sys->space, &o->start);
}

static JnStatus advance(Oscillator* o) {
	JnReport report = {0};
	o->sys->report = &report;
	JN_TRY(o->sys->ops->begin(o->sys, &o->start));
	JnStep step = {.sys = o->sys, .start = &o->start, .end = &o->end, .dt = 1};
	JN_TRY(o->integrator->type->step(o->integrator, &step));
	if (o->integrator->type->commit != NULL) o->integrator->type->commit(o->integrator, &step);
	const JnState swap = o->start;
	o->start = o->end;
	o->end = swap;
	return JN_OK;
}

// Eigenvalue of largest size of a 2x2 matrix; x and v / nu as coordinates.
static JnAmplification dominant(double a, double b, double c, double d) {
	const double half_trace = 0.5 * (a + d), determinant = a * d - b * c;
	const double under_root = half_trace * half_trace - determinant;
	if (under_root < 0) return (JnAmplification){sqrt(determinant), atan2(sqrt(-under_root), half_trace)};
	return (JnAmplification){fabs(half_trace) + sqrt(under_root), half_trace < 0 ? 3.14159265358979323846 : 0};
}

static JnStatus one_step(Oscillator* o, JnAmplification* out) {
	put(o, 1, 0);
	JN_TRY(advance(o));
	const double a = o->start.x[0], c = o->start.v[0] / o->nu;
	put(o, 0, o->nu);
	JN_TRY(advance(o));
	*out = dominant(a, o->start.x[0], c, o->start.v[0] / o->nu);
	return JN_OK;
}

// y2 = M y1 and y3 = M y2 give M, as long as y1 and y2 are independent; each run is scaled to stay in range.
static JnStatus many_steps(Oscillator* o, JnAmplification* out) {
	double x[3], v[3];
	put(o, 1, 0.3 * o->nu);
	for (int i = 0; i < TRANSIENT; ++i) JN_TRY(advance(o));
	for (int i = 0; i < 3; ++i) {
		JN_TRY(advance(o));
		x[i] = o->start.x[0];
		v[i] = o->start.v[0] / o->nu;
	}
	const double area = x[0] * v[1] - x[1] * v[0];
	const double a = (x[1] * v[1] - x[2] * v[0]) / area, b = (x[0] * x[2] - x[1] * x[1]) / area;
	const double c = (v[1] * v[1] - v[2] * v[0]) / area, d = (x[0] * v[2] - x[1] * v[1]) / area;
	*out = dominant(a, b, c, d);
	if (!isfinite(out->radius)) *out = (JnAmplification){hypot(x[2], v[2]) / hypot(x[1], v[1]), 0};
	return JN_OK;
}

// NAN when a step fails; JN_OUT_OF_MEMORY is all that it returns beside JN_OK.
static JnStatus amplify(const JnIntegratorType* type, double nu, double xi, JnAmplification* out) {
	Oscillator oscillator;
	JnStatus status = oscillator_open(type, nu, xi, &oscillator);
	if (status == JN_OK) status = type->memory_size > 0 ? many_steps(&oscillator, out) : one_step(&oscillator, out);
	oscillator_close(&oscillator);
	if (status != JN_OK) *out = (JnAmplification){NAN, NAN};
	return status == JN_OUT_OF_MEMORY ? status : JN_OK;
}

JnAmplification jn_integrator_amplification(const JnIntegratorType* type, double nu, double xi) {
	JnAmplification out;
	amplify(type, nu, xi, &out);
	return out;
}

static JnStatus narrow(const JnIntegratorType* type, double nu, double xi, double* low, double* high) {
	JnAmplification at;
	JN_TRY(amplify(type, nu, xi, &at));
	*(at.radius <= 1 + 1e-9 ? low : high) = nu; // NAN is not stable
	return JN_OK;
}

JnStatus jn_integrator_stability_limit(const JnIntegratorType* type, double xi, double* limit) {
	double low = 0, high = 0;
	const double first = xi > 0 ? fmin(1e-2, 0.1 * fmin(xi, 1 / xi)) : 1e-2; // overdamped ones end near 1 / xi
	for (double nu = first; nu < 1e3 && high == 0; nu *= 1.1) JN_TRY(narrow(type, nu, xi, &low, &high));
	for (int i = 0; i < 40 && low > 0 && high > 0; ++i) JN_TRY(narrow(type, 0.5 * (low + high), xi, &low, &high));
	*limit = high == 0 ? INFINITY : low;
	return JN_OK;
}

// error = constant nu^(order + 1), from two values of nu; order 0 when there is only rounding.
static void fit(double coarse, double fine, double nu, int* order, double* constant) {
	const double rounding = 1e-12;
	if (fabs(coarse) < rounding || fabs(fine) < rounding) return;
	*order = (int)lround(log2(fabs(coarse / fine))) - 1;
	*constant =
		(4 * fine / pow(nu, *order + 1) - coarse / pow(2 * nu, *order + 1)) / 3; // the next term is nu^2 times it
}

static JnStatus measure(const JnIntegratorType* type, JnIntegratorProperties* out) {
	const double coarse = 0.2, fine = 0.1;
	JnAmplification at_coarse, at_fine, at_infinity = {INFINITY, 0};
	JN_TRY(amplify(type, coarse, 0, &at_coarse));
	JN_TRY(amplify(type, fine, 0, &at_fine));
	fit(1 - at_coarse.radius, 1 - at_fine.radius, fine, &out->dissipation_order, &out->dissipation);
	fit(coarse - at_coarse.phase, fine - at_fine.phase, fine, &out->dispersion_order, &out->dispersion);
	out->solves = (type->needs & JN_NEEDS_TANGENT) != 0;
	out->a_stable = isinf(out->stability_limit) != 0;
	if (out->a_stable) JN_TRY(amplify(type, 1e5, 0, &at_infinity));
	out->r_infinity = at_infinity.radius;
	out->l_stable = out->a_stable && out->r_infinity < 1e-3;
	out->is_measured = true;
	return JN_OK;
}

JnStatus jn_integrator_properties(const JnIntegratorType* type, JnIntegratorProperties* out) {
	*out = (JnIntegratorProperties){.order = type->order};
	JN_TRY(jn_integrator_stability_limit(type, 0, &out->stability_limit));
	if (type->properties == NULL) return measure(type, out);
	JnTableauProperties exact = {0};
	type->properties(type->table, &exact);
	out->stages = exact.stages;
	out->solves = exact.implicit_solves;
	out->a_stable = exact.a_stable;
	out->l_stable = exact.l_stable;
	out->stiffly_accurate = exact.stiffly_accurate;
	out->r_infinity = exact.r_infinity;
	out->dispersion_order = exact.dispersion_order;
	out->dispersion = exact.dispersion;
	out->dissipation_order = exact.dissipation_order;
	out->dissipation = exact.dissipation;
	return JN_OK;
}
