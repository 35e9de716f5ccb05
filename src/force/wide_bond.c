// The loops over bonds, compiled once a vector width; see bond.h. With n = y / r, r = |y| and kappa = k / L,
//   f_0 = kappa (r - L) n,     K_00 = K_11 = -K_10 = kappa (w I + (1 - w) n n^T),  w = 1 - L / r,
// whose eigenvalues are kappa along the bond and kappa w across it: the definite tangent has w >= 0.
#include "force/bond.h"
#include "math/mat3.h"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

typedef struct Bonds {
	const int* nodes; // [2][W]
	Wide length, force, stretch;
	Wide y[3];
	Wide r; // |y|, and never 0
} Bonds;

// from[3 * node], + 1 and + 2 of each lane. Bonds of one point stand behind each other, so that most batches have a single
// first node.
JN_INLINE void gather3(const double* from, const int* nodes, Wide out[3]) {
	JN_UNROLL for (int a = 0; a < 3; a++) out[a] = wide_gather(from + a, 3, nodes);
}

JN_INLINE bool is_single(const int* nodes) {
	int differs = 0;
	JN_UNROLL for (int lane = 1; lane < JN_WIDE; lane++) differs |= nodes[lane] ^ nodes[0];
	return differs == 0;
}

JN_INLINE void gather3_first(const double* from, const int* nodes, Wide out[3]) {
	if (is_single(nodes)) {
		JN_UNROLL for (int a = 0; a < 3; a++) out[a] = wide_set(from[3 * (ptrdiff_t)nodes[0] + a]);
	} else {
		gather3(from, nodes, out);
	}
}

// out = those of the second nodes - those of the first.
JN_INLINE void gather_difference(const double* from, const int* nodes, Wide out[3]) {
	Wide first[3], second[3];
	gather3_first(from, nodes, first);
	gather3(from, nodes + JN_WIDE, second);
	JN_UNROLL for (int a = 0; a < 3; a++) out[a] = second[a] - first[a];
}

JN_INLINE Bonds load_bonds(const JnGroup* group, int batch, const double* x) {
	const double* rest = group->rest + (ptrdiff_t)batch * JN_BOND_REALS * JN_WIDE;
	Bonds b = {.nodes = group->nodes + (ptrdiff_t)batch * 2 * JN_WIDE,
			   .length = wide_load(rest + JN_BOND_LENGTH * JN_WIDE),
			   .force = wide_load(rest + JN_BOND_FORCE * JN_WIDE)};
	gather_difference(x, b.nodes, b.y);
	const Wide square = wide_dot3(b.y[0], b.y[0], b.y[1], b.y[1], b.y[2], b.y[2]);
	const Wide least = b.length * wide_set(1e-12); // two points at one place have no direction, and no force
	b.r = wide_sqrt(wide_max(square, least * least));
	return b;
}

static void energy(const JnGroup* group, int first, int last, const double* x, double* out) {
	for (int batch = first; batch < last; batch++) {
		const Bonds b = load_bonds(group, batch, x);
		const Wide longer = b.r - b.length;
		wide_store(out + (ptrdiff_t)(batch - first) * JN_WIDE, wide_set(0.5) * b.force / b.length * longer * longer);
	}
}

static void force(const JnGroup* group, int first, int last, const double* x, double* out) {
	for (int batch = first; batch < last; batch++) {
		const Bonds b = load_bonds(group, batch, x);
		const Wide scale = b.force * (b.r - b.length) / (b.length * b.r);
		double* to = out + (ptrdiff_t)(batch - first) * 6 * JN_WIDE;
		JN_UNROLL for (int a = 0; a < 3; a++) {
			const Wide f = scale * b.y[a];
			wide_store(to + a * JN_WIDE, f);
			wide_store(to + (3 + a) * JN_WIDE, -f);
		}
	}
}

// kappa w and kappa (1 - w) / r^2, so that K = across I + along y y^T, with a single division: 1 / (L r) has both inverses.
JN_INLINE void stiffness(const Bonds* b, bool definite, Wide* across, Wide* along) {
	const Wide inverse = wide_set(1) / (b->length * b->r), by_r = inverse * b->length;
	*across = b->force * (b->r - b->length) * inverse;
	*along = b->force * by_r * by_r * by_r;
	if (!definite) return;
	const WideMask is_short = *across < wide_set(0);
	*along = wide_select(is_short, b->force * inverse * by_r, *along);
	*across = wide_max(*across, wide_set(0));
}

static void tangent(const JnGroup* group, int first, int last, const double* x, bool definite, double* out) {
	for (int batch = first; batch < last; batch++) {
		const Bonds b = load_bonds(group, batch, x);
		Wide across, along;
		stiffness(&b, definite, &across, &along);
		double* to = out + (ptrdiff_t)(batch - first) * 27 * JN_WIDE;
		JN_UNROLL for (int k = 0; k < 9; k++) {
			Wide entry = along * b.y[k / 3] * b.y[k % 3];
			if (k % 4 == 0) entry += across;
			wide_store(to + k * JN_WIDE, entry);
			wide_store(to + (9 + k) * JN_WIDE, -entry);
			wide_store(to + (18 + k) * JN_WIDE, entry);
		}
	}
}

static void product(const JnGroup* group, int first, int last, const double* x, bool definite, const double* p,
					double* out) {
	for (int batch = first; batch < last; batch++) {
		const Bonds b = load_bonds(group, batch, x);
		Wide across, along, q[3];
		stiffness(&b, definite, &across, &along);
		gather_difference(p, b.nodes, q);
		const Wide on_line = along * wide_dot3(b.y[0], q[0], b.y[1], q[1], b.y[2], q[2]);
		double* to = out + (ptrdiff_t)(batch - first) * 6 * JN_WIDE;
		JN_UNROLL for (int a = 0; a < 3; a++) {
			const Wide sum = across * q[a] + on_line * b.y[a];
			wide_store(to + a * JN_WIDE, -sum);
			wide_store(to + (3 + a) * JN_WIDE, sum);
		}
	}
}

static bool is_doomed(const JnGroup* group, int batch, int lane, const bool* doomed) {
	const int* nodes = group->nodes + (ptrdiff_t)batch * 2 * JN_WIDE + lane;
	return doomed != NULL && (doomed[nodes[0]] || doomed[nodes[JN_WIDE]]);
}

// Elements of a batch, lane by lane: few bonds break, so that this is rarely reached.
JN_SHARED int break_lanes(JnGroup* group, int batch, const double longer[JN_WIDE], const bool* doomed, int* broken,
						  double* released) {
	double* rest = group->rest + (ptrdiff_t)batch * JN_BOND_REALS * JN_WIDE;
	int count = 0;
	for (int lane = 0; lane < JN_WIDE; lane++) {
		const double length = rest[JN_BOND_LENGTH * JN_WIDE + lane], most = rest[JN_BOND_STRETCH * JN_WIDE + lane];
		double* k = &rest[JN_BOND_FORCE * JN_WIDE + lane];
		if (*k == 0 || !(longer[lane] > most * length || is_doomed(group, batch, lane, doomed))) continue;
		*released += 0.5 * *k / length * longer[lane] * longer[lane];
		*k = 0;
		broken[count++] = batch * JN_WIDE + lane;
	}
	return count;
}

static int damage(JnGroup* group, int first, int last, const double* x, const bool* doomed, int* broken,
				  double* released) {
	int count = 0;
	for (int batch = first; batch < last; batch++) {
		const Bonds b = load_bonds(group, batch, x);
		const double* rest = group->rest + (ptrdiff_t)batch * JN_BOND_REALS * JN_WIDE;
		const Wide longer = b.r - b.length, most = wide_load(rest + JN_BOND_STRETCH * JN_WIDE) * b.length;
		if (doomed == NULL && !wide_any((longer > most) & (b.force != wide_set(0)))) continue;
		double lanes[JN_WIDE];
		wide_store(lanes, longer);
		count += break_lanes(group, batch, lanes, doomed, broken + count, released);
	}
	return count;
}

extern const JnKernel JOIN(jn_bond_kernel_, JN_WIDE);

const JnKernel JOIN(jn_bond_kernel_, JN_WIDE) = {
	.name = "bond",
	.width = JN_WIDE,
	.nodes = 2,
	.points = 1,
	.rest_reals = JN_BOND_REALS,
	.energy = energy,
	.force = force,
	.tangent = tangent,
	.product = product,
	.damage = damage,
};
