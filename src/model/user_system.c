// A system of the user's own equations behind the verbs of JnSystem, with dense matrices factored by LAPACK: made for up to
// some hundreds of unknowns.
//
// M is constant. K = -df/dx and D = -df/dv come from a callback, from products with it, or from central differences.
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/log.h"
#include "base/space.h"
#include "jounce/extend.h"
#include "math/lapack.h"

enum { SLOTS = 4 };

typedef struct UserMatrix {
	JnMatrix base;
	JnShift shift;
	double* factor; // n * n, column-major LU
	int* pivots;
	bool is_used;
	uint64_t last_use;
} UserMatrix;

typedef struct UserSystem {
	JnSystem base;
	JnUserSystemDef def;
	int n;
	JnArena arena;
	double *mass, *stiffness, *damping; // n * n, row-major
	double *work, *shifted_x, *shifted_v, *plus, *minus;
	uint64_t tangent_stamp;
	UserMatrix matrices[SLOTS];
	uint64_t uses;
} UserSystem;

static UserSystem* of(JnSystem* sys) {
	return (UserSystem*)sys;
}

static JnStatus evaluate(UserSystem* sys, double t, const double* x, const double* v, double* f) {
	++sys->base.report->forces;
	if (sys->def.force(sys->def.user, t, x, v, f) != 0) return JN_NOT_FINITE;
	for (int i = 0; i < sys->n; ++i)
		if (!isfinite(f[i])) return JN_NOT_FINITE;
	return JN_OK;
}

// Residuals are judged against the largest force met at the start of a step, so that a passage through equilibrium asks
// for no impossible accuracy.
static JnStatus begin(JnSystem* base, const JnState* start) {
	UserSystem* sys = of(base);
	JN_TRY(evaluate(sys, start->t, start->x, start->v, sys->plus));
	double sum = 0;
	for (int i = 0; i < sys->n; ++i) sum += sys->plus[i] * sys->plus[i];
	base->force_scale = fmax(base->force_scale, sqrt(sum));
	base->force_floor = 16 * DBL_EPSILON * base->force_scale;
	return JN_OK;
}

static void prescribe(JnSystem* base, JnState* s, JnVec a) {
	(void)base, (void)s, (void)a;
}

static void hold(JnSystem* base, JnVec r) {
	(void)base, (void)r;
}

static JnStatus force(JnSystem* base, const JnState* s, JnVec f) {
	return evaluate(of(base), s->t, s->x, s->v, f);
}

static double energy(JnSystem* base, const JnState* s) {
	const UserSystem* sys = of(base);
	return sys->def.energy != NULL ? sys->def.energy(sys->def.user, s->t, s->x) : NAN;
}

// Column j of -df/dx or -df/dv, by a central difference whose step balances rounding and truncation.
static JnStatus difference(UserSystem* sys, const JnState* s, double* varied, int j, double* matrix) {
	const double value = varied[j], step = cbrt(DBL_EPSILON) * fmax(1, fabs(value));
	varied[j] = value + step;
	JN_TRY(evaluate(sys, s->t, sys->shifted_x, sys->shifted_v, sys->plus));
	varied[j] = value - step;
	JN_TRY(evaluate(sys, s->t, sys->shifted_x, sys->shifted_v, sys->minus));
	varied[j] = value;
	for (int i = 0; i < sys->n; ++i) matrix[i * sys->n + j] = -(sys->plus[i] - sys->minus[i]) / (2 * step);
	return JN_OK;
}

static JnStatus tangent_by_differences(UserSystem* sys, const JnState* s) {
	memcpy(sys->shifted_x, s->x, (size_t)sys->n * sizeof(double));
	memcpy(sys->shifted_v, s->v, (size_t)sys->n * sizeof(double));
	for (int j = 0; j < sys->n; ++j) {
		JN_TRY(difference(sys, s, sys->shifted_x, j, sys->stiffness));
		JN_TRY(difference(sys, s, sys->shifted_v, j, sys->damping));
	}
	return JN_OK;
}

// Column j of K and D by products with the unit vector.
static JnStatus tangent_by_products(UserSystem* sys, const JnState* s) {
	const int n = sys->n;
	memset(sys->work, 0, (size_t)n * sizeof(double));
	for (int j = 0; j < n; ++j) {
		sys->work[j] = 1;
		if (sys->def.tangent_product(sys->def.user, s->t, s->x, s->v, sys->work, sys->plus, sys->minus) != 0)
			return JN_NOT_FINITE;
		sys->work[j] = 0;
		for (int i = 0; i < n; ++i) {
			sys->stiffness[i * n + j] = sys->plus[i];
			sys->damping[i * n + j] = sys->minus[i];
		}
	}
	return JN_OK;
}

static JnStatus make_tangent(UserSystem* sys, const JnState* s) {
	const JnUserSystemDef* def = &sys->def;
	if (def->tangent != NULL)
		return def->tangent(def->user, s->t, s->x, s->v, sys->stiffness, sys->damping) == 0 ? JN_OK : JN_NOT_FINITE;
	return def->tangent_product != NULL ? tangent_by_products(sys, s) : tangent_by_differences(sys, s);
}

static JnStatus linearize(JnSystem* base, const JnState* s) {
	UserSystem* sys = of(base);
	if (sys->tangent_stamp == s->stamp) return JN_OK;
	sys->tangent_stamp = 0;
	JN_TRY(make_tangent(sys, s));
	for (int k = 0; k < sys->n * sys->n; ++k)
		if (!isfinite(sys->stiffness[k]) || !isfinite(sys->damping[k])) return JN_NOT_FINITE;
	sys->tangent_stamp = s->stamp;
	++base->report->tangents;
	for (int i = 0; i < SLOTS; ++i) {
		UserMatrix* matrix = &sys->matrices[i];
		if (matrix->shift.damping != 0 || matrix->shift.stiffness != 0) matrix->base.is_factored = false;
	}
	return JN_OK;
}

static double entry(const UserSystem* sys, JnShift shift, int k) {
	return shift.mass * sys->mass[k] + shift.damping * sys->damping[k] + shift.stiffness * sys->stiffness[k];
}

static JnStatus factor(UserMatrix* matrix) {
	UserSystem* sys = of(matrix->base.sys);
	const int n = sys->n;
	int info = 0;
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j) matrix->factor[j * n + i] = entry(sys, matrix->shift, i * n + j);
	++sys->base.report->factorizations;
	dgetrf_(&n, &n, matrix->factor, &n, matrix->pivots, &info);
	if (info != 0) return JN_INDEFINITE;
	matrix->base.is_factored = true;
	return JN_OK;
}

static JnStatus solve(JnMatrix* base, const double* rhs, JnVec out) {
	UserMatrix* matrix = (UserMatrix*)base;
	UserSystem* sys = of(base->sys);
	const int n = sys->n, one = 1;
	int info = 0;
	if (!base->is_factored) JN_TRY(factor(matrix));
	++sys->base.report->solves;
	if (out != rhs) memcpy(out, rhs, (size_t)n * sizeof *out);
	dgetrs_("N", &n, &one, matrix->factor, &n, matrix->pivots, out, &n, &info, 1);
	return JN_OK;
}

static void apply(JnMatrix* base, const double* in, JnVec out) {
	const UserMatrix* matrix = (const UserMatrix*)base;
	const UserSystem* sys = (const UserSystem*)base->sys;
	for (int i = 0; i < sys->n; ++i) {
		double sum = 0;
		for (int j = 0; j < sys->n; ++j) sum += entry(sys, matrix->shift, i * sys->n + j) * in[j];
		out[i] = sum;
	}
}

static const JnMatrixOps matrix_ops = {.apply = apply, .solve = solve};

static bool same_shift(JnShift a, JnShift b) {
	return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

static JnStatus matrix(JnSystem* base, JnShift shift, JnMatrix** out) {
	UserSystem* sys = of(base);
	UserMatrix* chosen = &sys->matrices[0];
	for (int i = 0; i < SLOTS; ++i) {
		UserMatrix* candidate = &sys->matrices[i];
		if (candidate->is_used && same_shift(candidate->shift, shift)) {
			chosen = candidate;
			break;
		}
		if (candidate->last_use < chosen->last_use) chosen = candidate;
	}
	if (!chosen->is_used || !same_shift(chosen->shift, shift)) {
		chosen->base = (JnMatrix){.ops = &matrix_ops, .sys = base, .refresh_cost = 4};
		chosen->shift = shift;
		chosen->is_used = true;
	}
	chosen->last_use = ++sys->uses;
	*out = &chosen->base;
	return JN_OK;
}

// Nothing is known of neighbours: each entry is a length of its own.
static double stretch(JnSystem* base, const JnState* from, const JnState* to) {
	double most = 0;
	for (int i = 0; i < of(base)->n; ++i) most = fmax(most, fabs(to->x[i] - from->x[i]));
	return most;
}

static const JnSystemOps system_ops = {.begin = begin,
									   .prescribe = prescribe,
									   .hold = hold,
									   .force = force,
									   .energy = energy,
									   .linearize = linearize,
									   .matrix = matrix,
									   .stretch = stretch};

static JnStatus take_mass(UserSystem* sys) {
	const int n = sys->n;
	const double* given = sys->def.mass;
	sys->base.mass_is_diagonal = true;
	for (int k = 0; k < n * n; ++k) {
		const bool is_diagonal = k / n == k % n;
		sys->mass[k] = given != NULL ? given[k] : is_diagonal ? 1 : 0;
		if (!isfinite(sys->mass[k])) return jn_error(JN_BAD_INPUT, "mass[%d][%d] is not finite", k / n, k % n);
		if (!is_diagonal && sys->mass[k] != 0) sys->base.mass_is_diagonal = false;
	}
	return JN_OK;
}

static JnStatus build(UserSystem* sys) {
	const size_t n = (size_t)sys->n;
	JnArena* arena = &sys->arena;
	JN_NEW(arena, sys->mass, n * n);
	JN_NEW(arena, sys->stiffness, n * n);
	JN_NEW(arena, sys->damping, n * n);
	JN_NEW(arena, sys->work, n);
	JN_NEW(arena, sys->shifted_x, n);
	JN_NEW(arena, sys->shifted_v, n);
	JN_NEW(arena, sys->plus, n);
	JN_NEW(arena, sys->minus, n);
	for (int i = 0; i < SLOTS; ++i) {
		JN_NEW(arena, sys->matrices[i].factor, n * n);
		JN_NEW(arena, sys->matrices[i].pivots, n);
	}
	sys->base.ops = &system_ops;
	sys->base.depends_on_time = sys->def.depends_on_time;
	sys->base.space = jn_host_space_create(n, 1);
	return sys->base.space != NULL ? take_mass(sys) : JN_OUT_OF_MEMORY;
}

JnStatus jn_user_system_create(const JnUserSystemDef* def, JnSystem** out) {
	*out = NULL;
	if (def->count < 1 || def->count > JN_USER_SYSTEM_LIMIT)
		return jn_error(JN_BAD_INPUT, "a system of %d unknowns; it must have 1 to %d", def->count,
						JN_USER_SYSTEM_LIMIT);
	if (def->force == NULL) return jn_error(JN_BAD_INPUT, "the system has no force callback");
	UserSystem* sys = calloc(1, sizeof *sys);
	if (sys == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: system");
	sys->def = *def;
	sys->n = def->count;
	const JnStatus status = build(sys);
	if (status == JN_OK)
		*out = &sys->base;
	else
		jn_user_system_destroy(&sys->base);
	return status;
}

void jn_user_system_destroy(JnSystem* base) {
	if (base == NULL) return;
	UserSystem* sys = of(base);
	jn_host_space_destroy(sys->base.space);
	jn_arena_free(&sys->arena);
	free(sys);
}
