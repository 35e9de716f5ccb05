// Bonds that cross a notch. The parallelogram from + u a + v b, 0 <= u, v <= 1, lies in a plane with the normal
// n = a x b; a bond crosses it when its ends are on the two sides of the plane and its point on the plane is inside. A
// point on the plane itself counts as on its upper side, so that a cut along a row of points is one cut.
#include <math.h>

#include "base/log.h"
#include "force/peridynamic.h"
#include "math/vec3.h"

static const double EDGE = 1e-9; // of an edge: what rounding leaves

typedef struct Cut {
	double from[3], a[3], b[3], n[3];
	bool is_endless; // along b
} Cut;

static JnStatus make_cut(const JnPeridynamics* body, int index, Cut* cut) {
	const JnNotchDef* def = (const JnNotchDef*)body->def->notches.data + index;
	*cut = (Cut){.b = {0, 0, 1}, .is_endless = isnan(def->across[0])};
	for (int k = 0; k < 3; k++) {
		cut->from[k] = def->from[k];
		cut->a[k] = def->to[k] - def->from[k];
		if (!cut->is_endless) cut->b[k] = def->across[k];
	}
	vec3_cross(cut->a, cut->b, cut->n);
	if (vec3_length(cut->n) > EDGE * vec3_length(cut->a) * vec3_length(cut->b)) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s.material.notches[%d]: has no area; `from` and `to` must differ, and not by a multiple of `across` "
		"(along z when absent)",
		body->what, index);
}

static bool crosses(const Cut* cut, const double* x, const double* y) {
	double p[3], q[3], at[3], side[3];
	for (int k = 0; k < 3; k++) {
		p[k] = x[k] - cut->from[k];
		q[k] = y[k] - cut->from[k];
	}
	const double low = vec3_dot(p, cut->n), high = vec3_dot(q, cut->n);
	if ((low < 0) == (high < 0)) return false;
	const double share = low / (low - high), square = vec3_dot(cut->n, cut->n);
	for (int k = 0; k < 3; k++) at[k] = p[k] + share * (q[k] - p[k]);
	vec3_cross(at, cut->b, side); // (u a + v b) x b = u n
	const double u = vec3_dot(side, cut->n) / square;
	if (u < -EDGE || u > 1 + EDGE) return false;
	vec3_cross(cut->a, at, side); // a x (u a + v b) = v n
	const double v = vec3_dot(side, cut->n) / square;
	return cut->is_endless || (v >= -EDGE && v <= 1 + EDGE);
}

static int cut_pairs(const JnPeridynamics* body, const Cut* cut, bool* is_cut) {
	const double* X = body->mesh->nodes;
	int count = 0;
	for (int i = 0; i < body->mesh->node_count; i++)
		for (int p = body->pairs.starts[i]; p < body->pairs.starts[i + 1]; p++) {
			if (!crosses(cut, X + 3 * (ptrdiff_t)i, X + 3 * (ptrdiff_t)body->pairs.list[p])) continue;
			is_cut[p] = true;
			count++;
		}
	return count;
}

static JnStatus complain(const JnPeridynamics* body, int index) {
	double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (int k = 0; k < 3 * body->mesh->node_count; k++) {
		low[k % 3] = fmin(low[k % 3], body->mesh->nodes[k]);
		high[k % 3] = fmax(high[k % 3], body->mesh->nodes[k]);
	}
	return jn_error(
		JN_BAD_INPUT,
		"%s.material.notches[%d]: crosses no bond; place it in the body, whose points span [%g, %g] x [%g, %g] "
		"x [%g, %g] m at rest",
		body->what, index, low[0], high[0], low[1], high[1], low[2], high[2]);
}

JnStatus jn_peridynamic_cut(const JnPeridynamics* body, bool* is_cut) {
	for (int i = 0; i < body->def->notches.count; i++) {
		Cut cut;
		JN_TRY(make_cut(body, i, &cut));
		if (cut_pairs(body, &cut, is_cut) == 0) return complain(body, i);
	}
	return JN_OK;
}
