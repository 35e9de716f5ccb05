/// @file tableau.c
/// What a Butcher tableau says about its method: order by rooted trees (Hairer, Norsett and Wanner I, II.2), stage order,
/// stability function, A- and L-stability by the E-polynomial E(y^2) = |Q(iy)|^2 - |P(iy)|^2 (Hairer and Wanner II, IV.3),
/// dispersion and dissipation of x'' = -w^2 x (van der Houwen and Sommeijer 1987).
#include "integrate/tableau.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
	TREES = 17, // rooted trees with up to MAX_ORDER nodes: 1 + 1 + 2 + 4 + 9
	MAX_ORDER = 5,
	COEFFICIENTS = JN_MAX_STAGES + 1, // of a polynomial of degree JN_MAX_STAGES
	SERIES = 2 * JN_MAX_STAGES + 2,   // R agrees with exp to order 2 stages at most
	SAMPLES_PER_DECADE = 64,
};
static const double ORDER_TOLERANCE = 1e-13;
static const double ROUNDING = 64 * DBL_EPSILON; // of a polynomial coefficient, relative to the sum of its |terms|
static const double SERIES_ROUNDING = 1e-11;     // of a coefficient of log R: its recursion adds up to SERIES terms

/// A tree is a smaller tree `trunk` with another one, `branch`, grafted onto its root. The single node comes first.
static const struct {
	int trunk, branch;
} TREE[TREES] = {
	{0, 0},                         // a node
	{0, 0},                         // c
	{1, 0}, {0, 1},                 // c^2, Ac
	{2, 0}, {1, 1}, {0, 2}, {0, 3}, // c^3, c Ac, Ac^2, A^2 c
	{4, 0}, {2, 1}, {3, 1}, {1, 2}, {1, 3}, {0, 4}, {0, 5}, {0, 6}, {0, 7},
};

/// R = P / Q with, for each coefficient, the sum of the absolute values of its terms.
typedef struct Stability {
	double p[COEFFICIENTS], q[COEFFICIENTS], p_bound[COEFFICIENTS], q_bound[COEFFICIENTS];
} Stability;

/// E(w) = sum e[k] w^k, w = y^2; coefficients within their rounding are zero.
typedef struct Envelope {
	double e[COEFFICIENTS], bound[COEFFICIENTS];
	int lowest, highest; // the first and last coefficient other than zero; highest = -1 when E = 0, that is |R(iy)| = 1
} Envelope;

/// Violation |sum_i b_i phi_i - 1 / density| of one condition, relative to the sum of |b_i phi_i| where that is above 1.
static double condition_residual(const JnTableau* tableau, const double phi[], double density) {
	double sum = 0, bound = 0;
	for (int i = 0; i < tableau->stages; i++) {
		sum += tableau->b[i] * phi[i];
		bound += fabs(tableau->b[i] * phi[i]);
	}
	return fabs(sum - 1 / density) / fmax(bound, 1);
}

/// Elementary weights grow with the trees: phi(trunk . branch) = phi(trunk) * (A phi(branch)), and
/// density(trunk . branch) = density(trunk) density(branch) nodes / nodes(trunk). residual[n] is the worst of n nodes.
static void order_residuals(const JnTableau* tableau, double residual[MAX_ORDER + 1]) {
	double phi[TREES][JN_MAX_STAGES] = {0}, density[TREES] = {1};
	int nodes[TREES] = {1};
	for (int i = 0; i < tableau->stages; i++) phi[0][i] = 1;
	for (int n = 0; n <= MAX_ORDER; n++) residual[n] = 0;
	for (int t = 0; t < TREES; t++) {
		const int trunk = TREE[t].trunk, branch = TREE[t].branch;
		if (t > 0) {
			nodes[t] = nodes[trunk] + nodes[branch];
			density[t] = density[trunk] * density[branch] * nodes[t] / nodes[trunk];
		}
		for (int i = 0; t > 0 && i < tableau->stages; i++) {
			double grafted = 0;
			for (int j = 0; j <= i; j++) grafted += tableau->a[i][j] * phi[branch][j];
			phi[t][i] = phi[trunk][i] * grafted;
		}
		residual[nodes[t]] = fmax(residual[nodes[t]], condition_residual(tableau, phi[t], density[t]));
	}
}

static void find_order(const JnTableau* tableau, JnTableauProperties* out) {
	double residual[MAX_ORDER + 1];
	order_residuals(tableau, residual);
	while (out->order < MAX_ORDER && residual[out->order + 1] <= ORDER_TOLERANCE) {
		out->order++;
		out->order_residual = fmax(out->order_residual, residual[out->order]);
	}
}

/// C(k): sum_j a_ij c_j^(k-1) = c_i^k / k in every stage.
static bool stages_have_order(const JnTableau* tableau, int k) {
	for (int i = 0; i < tableau->stages; i++) {
		double sum = 0, bound = 1;
		for (int j = 0; j <= i; j++) {
			const double term = tableau->a[i][j] * (k == 1 ? 1 : pow(tableau->c[j], k - 1));
			sum += term;
			bound += fabs(term);
		}
		if (fabs(sum - pow(tableau->c[i], k) / k) > ORDER_TOLERANCE * bound) return false;
	}
	return true;
}

/// For x' = z x, x = 1: stage j has the value numerator_j / prod_(k <= j) (1 - a_kk z). The next value has the numerator
/// out = prod_k (1 - a_kk z) + z sum_j weight_j numerator_j prod_(k > j) (1 - a_kk z), products over k < count,
/// summed by Horner's rule over the stages.
static void combine_stages(const JnTableau* tableau, int count, const double weight[], double numerator[][COEFFICIENTS],
						   double out[COEFFICIENTS]) {
	memset(out, 0, COEFFICIENTS * sizeof out[0]);
	out[0] = 1;
	for (int j = 0; j < count; j++)
		for (int k = COEFFICIENTS - 1; k > 0; k--)
			out[k] += weight[j] * numerator[j][k - 1] - tableau->a[j][j] * out[k - 1];
}

static void expand(const JnTableau* tableau, double p[COEFFICIENTS], double q[COEFFICIENTS]) {
	double numerator[JN_MAX_STAGES][COEFFICIENTS];
	const double zero[JN_MAX_STAGES] = {0};
	for (int i = 0; i < tableau->stages; i++) combine_stages(tableau, i, tableau->a[i], numerator, numerator[i]);
	combine_stages(tableau, tableau->stages, tableau->b, numerator, p);
	combine_stages(tableau, tableau->stages, zero, numerator, q);
}

/// The bounds are the polynomials of the tableau whose terms all add up: |a_ij|, |b_j|, and -|a_ii| on the diagonal.
static Stability find_stability(const JnTableau* tableau) {
	JnTableau majorant = *tableau;
	for (int i = 0; i < tableau->stages; i++) {
		for (int j = 0; j < i; j++) majorant.a[i][j] = fabs(tableau->a[i][j]);
		majorant.a[i][i] = -fabs(tableau->a[i][i]);
		majorant.b[i] = fabs(tableau->b[i]);
	}
	Stability r = {0};
	expand(tableau, r.p, r.q);
	expand(&majorant, r.p_bound, r.q_bound);
	for (int k = 0; k < COEFFICIENTS; k++)
		if (fabs(r.p[k]) <= ROUNDING * r.p_bound[k]) r.p[k] = 0;
	return r;
}

void jn_tableau_stability(const JnTableau* tableau, double p[JN_MAX_STAGES + 1], double q[JN_MAX_STAGES + 1]) {
	const Stability r = find_stability(tableau);
	memcpy(p, r.p, sizeof r.p);
	memcpy(q, r.q, sizeof r.q);
}

/// |Q(iy)|^2 = sum_(m, n) q_m q_n i^(m - n) y^(m + n); odd m + n cancel, and i^(m - n) = (-1)^(m - k) for m + n = 2k.
static Envelope find_envelope(const Stability* r) {
	Envelope envelope = {.lowest = COEFFICIENTS, .highest = -1};
	for (int k = 0; k < COEFFICIENTS; k++) {
		double sum = 0, bound = 0;
		for (int m = 0; m <= 2 * k; m++) {
			const int n = 2 * k - m;
			if (m >= COEFFICIENTS || n >= COEFFICIENTS) continue;
			sum += ((m - k) % 2 ? -1 : 1) * (r->q[m] * r->q[n] - r->p[m] * r->p[n]);
			bound += r->q_bound[m] * r->q_bound[n] + r->p_bound[m] * r->p_bound[n];
		}
		envelope.bound[k] = bound;
		if (fabs(sum) <= ROUNDING * bound) continue;
		envelope.e[k] = sum;
		envelope.highest = k;
		if (envelope.lowest == COEFFICIENTS) envelope.lowest = k;
	}
	return envelope;
}

/// E >= 0 for all w >= 0. The outer coefficients decide small and large w, samples what lies between.
static bool is_nonnegative(const Envelope* envelope) {
	if (envelope->highest < 0) return true;
	if (envelope->e[envelope->lowest] < 0 || envelope->e[envelope->highest] < 0) return false;
	for (int sample = -8 * SAMPLES_PER_DECADE; sample <= 8 * SAMPLES_PER_DECADE; sample++) {
		const double w = pow(10, (double)sample / SAMPLES_PER_DECADE);
		double value = 0, bound = 0;
		for (int k = envelope->highest; k >= envelope->lowest; k--) {
			value = value * w + envelope->e[k];
			bound = bound * w + envelope->bound[k];
		}
		if (value < -ROUNDING * bound) return false;
	}
	return true;
}

/// Poles 1 / a_ii in the right half-plane and |R| <= 1 on the imaginary axis: the maximum principle gives the rest.
static void find_damping(const JnTableau* tableau, const Stability* r, JnTableauProperties* out) {
	bool poles_right = true;
	for (int i = 0; i < tableau->stages; i++) poles_right = poles_right && tableau->a[i][i] >= 0;
	int degree = COEFFICIENTS - 1;
	while (r->p[degree] == 0) degree--;
	const int poles = out->implicit_solves;
	out->r_infinity = degree > poles ? INFINITY : r->p[poles] / r->q[poles];
	const Envelope envelope = find_envelope(r);
	out->a_stable = poles_right && degree <= poles && is_nonnegative(&envelope);
	out->l_stable = out->a_stable && out->r_infinity == 0;
	if (envelope.highest < 0) return;
	// 1 - |R|^2 = E / |Q|^2 and 1 - |R|^2 = (1 - |R|) (1 + |R|), so 1 - |R| = e[k] / 2 nu^(2k) + ...
	out->dissipation_order = 2 * envelope.lowest - 1;
	out->dissipation = envelope.e[envelope.lowest] / 2;
}

/// out = log of the polynomial 1 + p_1 z + ..., from p (log p)' = p'.
static void log_series(const double p[COEFFICIENTS], double out[SERIES]) {
	out[0] = 0;
	for (int n = 1; n < SERIES; n++) {
		double sum = n < COEFFICIENTS ? n * p[n] : 0;
		for (int k = 1; k < n; k++)
			if (n - k < COEFFICIENTS) sum -= k * out[k] * p[n - k];
		out[n] = sum / n;
	}
}

/// arg R(i nu) = Im log R(i nu) = sum over odd k of (-1)^((k-1)/2) l_k nu^k.
static void find_dispersion(const Stability* r, JnTableauProperties* out) {
	double log_p[SERIES], log_q[SERIES];
	log_series(r->p, log_p);
	log_series(r->q, log_q);
	for (int k = 1; k < SERIES; k += 2) {
		const double error = (k == 1 ? 1 : 0) - (log_p[k] - log_q[k]);
		if (fabs(error) <= SERIES_ROUNDING * (1 + fabs(log_p[k]) + fabs(log_q[k]))) continue;
		out->dispersion_order = k - 1;
		out->dispersion = k % 4 == 1 ? error : -error;
		return;
	}
}

JnTableauProperties jn_tableau_properties(const JnTableau* tableau) {
	JnTableauProperties out = {
		.stages = tableau->stages, .stiffly_accurate = true, .first_explicit = tableau->a[0][0] == 0};
	const int last = tableau->stages - 1;
	for (int i = 0; i <= last; i++) {
		if (tableau->a[i][i] != 0) out.implicit_solves++;
		if (fabs(tableau->b[i] - tableau->a[last][i]) > ORDER_TOLERANCE) out.stiffly_accurate = false;
	}
	find_order(tableau, &out);
	while (out.stage_order < out.order && stages_have_order(tableau, out.stage_order + 1)) out.stage_order++;
	const int lower = tableau->embedded_order < out.order ? tableau->embedded_order : out.order;
	if (tableau->has_embedded) out.error_order = tableau->has_start_estimate ? 3 : lower + 1;
	const Stability r = find_stability(tableau);
	find_damping(tableau, &r, &out);
	find_dispersion(&r, &out);
	return out;
}
