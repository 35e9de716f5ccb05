// The exponential Rosenbrock-Euler method (Hochbruck, Ostermann, Schweitzer 2009) on y = (x, v), y' = g(t, y) = (v, M^-1 f):
//   y1 = y0 + h phi1(hJ) g + h^2 phi2(hJ) g_t,   J = [[0, I], [-M^-1 K, -M^-1 D]] at the start of the step.
// With the time as one more unknown, z = (x, v, t), both terms are one: z1 = z0 + h phi1(hA) (g, 1), A = [[J, g_t], [0, 0]].
// The product is taken from the Krylov space of A and b = (g, 1) (Saad 1992): A V = V H + next v e_m^T gives
//   h phi1(hA) b ~ h |b| V phi1(hH) e_1,   with the residual  h next |b| |e_m^T phi1(hH) e_1|.
//
// Lengths are measured by |z|^2 = omega^2 x.x + v.v + theta^2 t^2. For a single oscillator of the frequency omega, J is
// skew in that norm; theta = h |g_t| makes the last column of hA a unit vector.
//
// Held nodes are functions of time, as in rosenbrock.c: f stands for f - M a_held, and g_t is its derivative at fixed free
// x and v. All directions are zero at held nodes.
#include "integrate/exponential.h"

#include <math.h>
#include <string.h>

#include "base/space.h"
#include "integrate/integrator.h"

/// Work vectors, 126 of the system's length: f - M a_held, M^-1 of its time derivative, two for products; then x and v of each direction.
enum { FORCE, RATE, PRODUCT, FURTHER, DIRECTIONS, VECTORS = DIRECTIONS + 2 * (JN_MAX_SUBSPACE + 1) };

enum { LIMIT = JN_MAX_SUBSPACE, WIDE = LIMIT + 2, BATCH = 15 };

/// Distance of the states that give f_t, relative to the step: see rosenbrock.c.
static const double probe = 1e-3;

/// A direction whose new part is smaller than this share of A times the last one is rounding: the space is complete.
static const double complete = 1e-13;

typedef struct ExponentialDef {
	double tolerance;
	int subspace;
} ExponentialDef;

/// The Krylov space of a step; its directions are (x_i, v_i, t[i]) with the vectors of the integrator.
typedef struct Krylov {
	JnIntegrator* self;
	JnSystem* sys;
	JnMatrix *mass, *damping, *stiffness;
	double h, omega, theta; // [s], [1/s], [m/s^2]
	double length;          // |b|
	double floor;           // residual that rounding leaves
	double next;            // length of the new part of the last direction
	double t[LIMIT + 1];
	double H[LIMIT + 1][LIMIT];
	double phi1[LIMIT], phi2[LIMIT];
} Krylov;

// ---- phi functions of a dense matrix ----

static void multiply(int n, const double* a, const double* b, double* out) {
	memset(out, 0, (size_t)(n * n) * sizeof *out);
	for (int i = 0; i < n; ++i)
		for (int k = 0; k < n; ++k) {
			const double factor = a[i * n + k];
			if (factor == 0) continue;
			for (int j = 0; j < n; ++j) out[i * n + j] += factor * b[k * n + j];
		}
}

// b = a^-1 b by elimination. No pivots: the columns of `a` are dominated by their diagonals.
static void solve_dense(int n, double* a, double* b) {
	for (int k = 0; k < n; ++k)
		for (int i = k + 1; i < n; ++i) {
			const double factor = a[i * n + k] / a[k * n + k];
			if (factor == 0) continue;
			for (int j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
			for (int j = 0; j < n; ++j) b[i * n + j] -= factor * b[k * n + j];
		}
	for (int i = n - 1; i >= 0; --i) {
		for (int k = i + 1; k < n; ++k)
			for (int j = 0; j < n; ++j) b[i * n + j] -= a[i * n + k] * b[k * n + j];
		for (int j = 0; j < n; ++j) b[i * n + j] /= a[i * n + i];
	}
}

static double column_norm(int n, const double* a) {
	double most = 0;
	for (int j = 0; j < n; ++j) {
		double sum = 0;
		for (int i = 0; i < n; ++i) sum += fabs(a[i * n + j]);
		most = fmax(most, sum);
	}
	return most;
}

// a = exp(a) by scaling, the diagonal Pade approximant of degree 7 and squaring (Higham 2005: good to rounding for norms
// up to 0.95, where the denominator differs from I by at most 0.61).
static void exponential(int n, double* a) {
	static const double b[] = {17297280, 8648640, 1995840, 277200, 25200, 1512, 56, 1};
	double a2[WIDE * WIDE], a4[WIDE * WIDE], a6[WIDE * WIDE], odd[WIDE * WIDE];
	int squarings = 0;
	const double norm = column_norm(n, a);
	if (norm > 0.95) frexp(norm / 0.95, &squarings);
	for (int k = 0; k < n * n; ++k) a[k] = ldexp(a[k], -squarings);
	multiply(n, a, a, a2);
	multiply(n, a2, a2, a4);
	multiply(n, a4, a2, a6);
	for (int k = 0; k < n * n; ++k) {
		const double one = k % (n + 1) == 0, second = a2[k], fourth = a4[k], sixth = a6[k];
		a2[k] = b[7] * sixth + b[5] * fourth + b[3] * second + b[1] * one;
		a4[k] = b[6] * sixth + b[4] * fourth + b[2] * second + b[0] * one;
	}
	multiply(n, a, a2, odd);
	for (int k = 0; k < n * n; ++k) {
		a[k] = a4[k] + odd[k];
		a6[k] = a4[k] - odd[k];
	}
	solve_dense(n, a6, a);
	for (int i = 0; i < squarings; ++i) {
		multiply(n, a, a, a2);
		memcpy(a, a2, (size_t)(n * n) * sizeof *a);
	}
}

// exp [[A, e_1, 0], [0, 0, 1], [0, 0, 0]] = [[e^A, phi1(A) e_1, phi2(A) e_1], ...]   (Sidje 1998)
void jn_phi_columns(int n, const double* A, double* phi1, double* phi2) {
	double wide[WIDE * WIDE] = {0};
	const int m = n + 2;
	for (int i = 0; i < n; ++i) memcpy(wide + i * m, A + i * n, (size_t)n * sizeof *A);
	wide[n] = 1;
	wide[n * m + n + 1] = 1;
	exponential(m, wide);
	for (int i = 0; i < n; ++i) {
		phi1[i] = wide[i * m + n];
		phi2[i] = wide[i * m + n + 1];
	}
}

// ---- the Krylov space ----

static JnVec direction_x(const Krylov* k, int i) {
	return k->self->vectors[DIRECTIONS + 2 * i];
}

static JnVec direction_v(const Krylov* k, int i) {
	return k->self->vectors[DIRECTIONS + 2 * i + 1];
}

static double dot(const Krylov* k, int i, int j) {
	JnSpace* space = k->self->space;
	const double x = space->ops->dot(space, direction_x(k, i), direction_x(k, j));
	const double v = space->ops->dot(space, direction_v(k, i), direction_v(k, j));
	return k->omega * k->omega * x + v + k->theta * k->theta * k->t[i] * k->t[j];
}

static void scale(Krylov* k, int i, double factor) {
	JnSpace* space = k->self->space;
	space->ops->combine(space, direction_x(k, i), 1, &(JnTerm){factor, direction_x(k, i)});
	space->ops->combine(space, direction_v(k, i), 1, &(JnTerm){factor, direction_v(k, i)});
	k->t[i] *= factor;
}

// out += sum_{i < count} weight_i (x or v of direction i)
static void add_directions(const Krylov* k, JnVec (*part)(const Krylov*, int), int count, const double weight[],
						   JnVec out) {
	for (int first = 0; first < count; first += BATCH) {
		JnTerm terms[BATCH + 1] = {{1, out}};
		int n = 1;
		for (int i = first; i < count && i < first + BATCH; ++i) terms[n++] = (JnTerm){weight[i], part(k, i)};
		k->self->space->ops->combine(k->self->space, out, n, terms);
	}
}

// Direction i + 1 = A (direction i) = (v, t g_t - M^-1 (K x + D v), 0)
static JnStatus multiply_direction(Krylov* k, int i) {
	JnSpace* space = k->self->space;
	JnVec product = k->self->vectors[PRODUCT], also = k->self->vectors[FURTHER], v = direction_v(k, i + 1);
	k->stiffness->ops->apply(k->stiffness, direction_x(k, i), product);
	k->damping->ops->apply(k->damping, direction_v(k, i), also);
	space->ops->combine(space, product, 2, (JnTerm[]){{-1, product}, {-1, also}});
	k->sys->ops->hold(k->sys, product);
	JN_TRY(k->mass->ops->solve(k->mass, product, v));
	if (k->t[i] != 0) space->ops->combine(space, v, 2, (JnTerm[]){{1, v}, {k->t[i], k->self->vectors[RATE]}});
	space->ops->combine(space, direction_x(k, i + 1), 1, &(JnTerm){1, direction_v(k, i)});
	k->t[i + 1] = 0;
	return JN_OK;
}

// Make direction j + 1 orthogonal to all before it: Gram-Schmidt, twice, which is as good as orthogonal to rounding.
static void orthogonalize(Krylov* k, int j) {
	double weight[LIMIT];
	for (int i = 0; i <= j; ++i) k->H[i][j] = 0;
	for (int pass = 0; pass < 2; ++pass) {
		for (int i = 0; i <= j; ++i) {
			weight[i] = -dot(k, i, j + 1);
			k->H[i][j] -= weight[i];
		}
		add_directions(k, direction_x, j + 1, weight, direction_x(k, j + 1));
		add_directions(k, direction_v, j + 1, weight, direction_v(k, j + 1));
		for (int i = 0; i <= j; ++i) k->t[j + 1] += weight[i] * k->t[i];
	}
}

static JnStatus extend(Krylov* k, int j) {
	JN_TRY(multiply_direction(k, j));
	const double before = sqrt(dot(k, j + 1, j + 1));
	orthogonalize(k, j);
	k->next = sqrt(dot(k, j + 1, j + 1));
	if (!isfinite(k->next)) return JN_NOT_FINITE;
	if (k->next <= complete * before) k->next = 0;
	k->H[j + 1][j] = k->next;
	if (k->next > 0) scale(k, j + 1, 1 / k->next);
	return JN_OK;
}

// The residual of the space of m directions, relative to the step's change of z. The last entry of phi1 may vanish by
// chance, and so may all of it after a whole number of periods, but never that of phi2 at the same time.
static double residual(Krylov* k, int m) {
	double A[LIMIT * LIMIT], change = 0;
	for (int i = 0; i < m; ++i)
		for (int j = 0; j < m; ++j) A[i * m + j] = i > j + 1 ? 0 : k->h * k->H[i][j];
	jn_phi_columns(m, A, k->phi1, k->phi2);
	for (int i = 0; i < m; ++i) change += k->phi1[i] * k->phi1[i] + k->phi2[i] * k->phi2[i];
	return k->h * k->next * fmax(fabs(k->phi1[m - 1]), fabs(k->phi2[m - 1])) / sqrt(change);
}

// Grow the space until its residual is small; *count: directions. Tests come seldom, since each costs a dense exponential.
static JnStatus grow(Krylov* k, JnReport* report, int* count) {
	const ExponentialDef* def = k->self->options;
	const double enough = fmax(def->tolerance, k->floor / k->length);
	int test = 2;
	for (int m = 1; m <= def->subspace; ++m) {
		JN_TRY(extend(k, m - 1));
		if (m < test && m < def->subspace && k->next > 0) continue;
		test = m + 2 + m / 8;
		report->residual = residual(k, m);
		*count = m;
		if (isnan(report->residual)) return JN_NOT_FINITE;
		if (report->residual <= enough) return JN_OK;
	}
	return JN_NOT_CONVERGED;
}

// ---- the step ----

// out = f(s) - M a_held at free nodes, 0 at held ones.
static JnStatus free_force(Krylov* k, JnState* s, JnVec out) {
	JnSpace* space = k->self->space;
	JnVec a = direction_x(k, 0), inertia = k->self->vectors[PRODUCT];
	JN_TRY(k->sys->ops->force(k->sys, s, out));
	space->ops->combine(space, a, 0, NULL);
	k->sys->ops->prescribe(k->sys, s, a); // rewrites the held entries of s with the values that they have
	k->mass->ops->apply(k->mass, a, inertia);
	space->ops->combine(space, out, 2, (JnTerm[]){{1, out}, {-1, inertia}});
	k->sys->ops->hold(k->sys, out);
	return JN_OK;
}

// out = the force of the start with the time alone moved on by `ahead`.
static JnStatus later_force(Krylov* k, JnStep* step, double ahead, JnVec out) {
	JnState* s = step->end;
	jn_state_copy(k->self->space, step->start, s);
	s->t += ahead;
	k->sys->ops->prescribe(k->sys, s, NULL);
	jn_state_touch(k->self->space, s);
	return free_force(k, s, out);
}

// g_t = M^-1 f_t by (4 f(d) - f(2d) - 3 f(0)) / 2d. Both points lie within the step: motions may have kinks where steps
// meet.
static JnStatus find_rate(Krylov* k, JnStep* step) {
	JnSpace* space = k->self->space;
	const double distance = probe * step->dt;
	JnVec rate = k->self->vectors[RATE], further = k->self->vectors[FURTHER], here = k->self->vectors[FORCE];
	JN_TRY(later_force(k, step, distance, rate));
	JN_TRY(later_force(k, step, 2 * distance, further));
	const JnTerm terms[] = {{2 / distance, rate}, {-0.5 / distance, further}, {-1.5 / distance, here}};
	space->ops->combine(space, further, 3, terms);
	JN_TRY(k->mass->ops->solve(k->mass, further, rate));
	k->theta = k->h * sqrt(space->ops->dot(space, rate, rate));
	return JN_OK;
}

// omega from u = h v + h^2 a, about the step's displacement: its frequency by Rayleigh's quotient for M^-1 K squared, or
// 1/h if that is more.
static JnStatus find_omega(Krylov* k) {
	JnSpace* space = k->self->space;
	JnVec u = direction_x(k, 1), product = k->self->vectors[PRODUCT], a = direction_v(k, 1);
	space->ops->combine(space, u, 2, (JnTerm[]){{k->h, direction_x(k, 0)}, {k->h * k->h, direction_v(k, 0)}});
	k->stiffness->ops->apply(k->stiffness, u, product);
	k->sys->ops->hold(k->sys, product);
	JN_TRY(k->mass->ops->solve(k->mass, product, a));
	const double size = space->ops->dot(space, u, u), answer = space->ops->dot(space, a, a);
	k->omega = fmax(1 / k->h, size > 0 ? sqrt(sqrt(answer / size)) : 0);
	return isfinite(k->omega) ? JN_OK : JN_NOT_FINITE;
}

// The first direction, b = (v, M^-1 f, 1), not yet of length 1; all that A needs.
static JnStatus begin(Krylov* k, JnStep* step) {
	JnSystem* sys = k->sys;
	JnSpace* space = k->self->space;
	JnVec f = k->self->vectors[FORCE];
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1}, &k->mass));
	jn_state_copy(space, step->start, step->end); // the stamp comes along: forces at the start are known
	JN_TRY(free_force(k, step->end, f));
	if (sys->depends_on_time) JN_TRY(find_rate(k, step));
	JN_TRY(sys->ops->linearize(sys, step->start));
	JN_TRY(sys->ops->matrix(sys, (JnShift){.damping = 1}, &k->damping));
	JN_TRY(sys->ops->matrix(sys, (JnShift){.stiffness = 1}, &k->stiffness));
	space->ops->combine(space, direction_x(k, 0), 1, &(JnTerm){1, step->start->v});
	sys->ops->hold(sys, direction_x(k, 0));
	const double force = sqrt(space->ops->dot(space, f, f));
	if (force <= sys->force_floor) space->ops->combine(space, f, 0, NULL);
	JN_TRY(k->mass->ops->solve(k->mass, f, direction_v(k, 0)));
	JN_TRY(find_omega(k));
	k->t[0] = k->theta > 0 ? 1 : 0;
	k->length = sqrt(dot(k, 0, 0));
	const double a = sqrt(space->ops->dot(space, direction_v(k, 0), direction_v(k, 0)));
	k->floor = a > 0 ? sys->force_floor / force * a : 0;
	return isfinite(k->length) ? JN_OK : JN_NOT_FINITE;
}

// end = start + h |b| V phi1(hH) e_1, with held nodes where they belong.
static void place(Krylov* k, JnStep* step, int count) {
	JnState* s = step->end;
	double weight[LIMIT];
	jn_state_copy(k->self->space, step->start, s);
	for (int i = 0; i < count; ++i) weight[i] = k->h * k->length * k->phi1[i];
	add_directions(k, direction_x, count, weight, s->x);
	add_directions(k, direction_v, count, weight, s->v);
	s->t = step->start->t + step->dt;
	k->sys->ops->prescribe(k->sys, s, NULL);
	jn_state_touch(k->self->space, s);
}

static JnStatus exponential_step(JnIntegrator* self, JnStep* step) {
	Krylov k = {.self = self, .sys = step->sys, .h = step->dt};
	int count = 0;
	step->sys->report = &step->report;
	JN_TRY(begin(&k, step));
	if (k.length > 0) {
		scale(&k, 0, 1 / k.length);
		JN_TRY(grow(&k, &step->report, &count));
	}
	place(&k, step, count);
	return jn_state_check(self->space, step->end);
}

static const JnKey keys[] = {
	{.name = "tolerance",
	 .kind = JN_REAL,
	 .field = offsetof(ExponentialDef, tolerance),
	 .value = {1e-10},
	 .low = 1e-14,
	 .high = 1,
	 .meaning = "residual of the linearised problem at the end of a step, relative to the change in the step"},
	{.name = "subspace",
	 .kind = JN_INTEGER,
	 .field = offsetof(ExponentialDef, subspace),
	 .value = {JN_MAX_SUBSPACE},
	 .low = 1,
	 .high = JN_MAX_SUBSPACE,
	 .remedy = "smaller steps need fewer",
	 .meaning = "most directions of the Krylov space; a step that needs more has failed and is cut"},
	{0},
};

// force_weight: a constant force moves positions by h^2 phi2(0).
const JnIntegratorType jn_exponential_rosenbrock = {
	.row = {.name = "exponential_rosenbrock",
			.doc =
				"Hochbruck et al. 2009: exact where forces are linear, at any step; solves with M alone, and some ten "
				"products with K plus 1.6 for each radian of the highest frequency; damps stiff rotating bodies",
			.keys = keys,
			.options_size = sizeof(ExponentialDef)},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 0.5,
	.overshoots = true,
	.keeps_tangent = true,
	.vectors = VECTORS,
	.step = exponential_step,
};
