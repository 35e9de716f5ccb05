// Semismooth Newton on Coulomb's law (Alart and Curnier 1991; Hueeber, Stadler and Wohlmuth 2008). With w the relative
// velocity less its bound, x = lambda_t - rho w_t, d = x / |x| and e at right angles to d, a contact is
//   open    lambda_n <= rho w_n:    lambda = 0
//   stuck   |x| <= mu (lambda_n - rho w_n):   w = 0   3 unknowns: the changes of lambda
//   sliding                         w_n = 0,  lambda_t = mu lambda_n d      2 unknowns: n and s, with
//                                   change of lambda_t = mu (lambda_n + n) d - (d . lambda_t) d + s e
// and with c = mu (lambda_n - rho w_n) / |x| the linearised law across the slip is
//   (1 - c) s / rho + c e . (change of w_t) = -e . w_t.
// Redundant contacts make W singular: eps times its diagonal is added in the matrix of the step alone, so that the solution
// is not changed.
#include <math.h>
#include <string.h>

#include "math/lapack.h"
#include "solve/qp_cone.h"
#include "solve/qp_delassus.h"

// eps: the first serves but where steps along redundant contacts grow out of hand
static const double proximities[] = {1e-9, 1e-6, 1e-4};
enum { LEVELS = sizeof proximities / sizeof *proximities, STEPS = 24 };
enum { PATIENCE = 5 }; // steps without progress; but for the first, those that go uphill are halved

static const double quick = 1e-4; // to that the merit, a square, falls where the factor may serve again

// An unknown y changes the multipliers of a contact by y `push`; its equation is aim . w + stiffness y = target.
typedef struct Unknown {
	int first, count; // slots of the contact
	int row;          // within the blocks of its group
	int axis;         // that it pushes alone and aims at, or -1
	double push[3], aim[3], stiffness, target;
} Unknown;

typedef struct Newton {
	JnDelassus* d;
	int count;         // unknowns
	bool is_symmetric; // no contact slides
	bool has_factor;   // of the matrix of an earlier step
	double proximity;  // eps
	Unknown* unknown;
	double *best, *change; // the best lambda so far, and the change of a step, by slots
	double *effect, *rhs;  // of a change on all w
	int* first;            // of a working contact, its first unknown; one more for the end
	int* factored;         // `first` of the step whose factor there is
	int* size;             // unknowns of a group
} Newton;

static double steepness(const JnDelassus* d, int k) {
	return d->diagonal[d->start[k]];
}

// Sum of squares of the natural map, in velocities.
static double merit(const JnDelassus* d) {
	double sum = 0;
	for (int k = 0; k < d->working_count; ++k) {
		const int first = d->start[k];
		const double steep = steepness(d, k);
		double w[3] = {0}, l[3] = {0}, rest[3];
		memcpy(w, d->after + first, (size_t)(d->start[k + 1] - first) * sizeof *w);
		memcpy(l, d->lambda + first, (size_t)(d->start[k + 1] - first) * sizeof *l);
		if (steep <= 0) continue;
		jn_coulomb_residual(d->mu[k], 1 / steep, w, l, rest);
		for (int axis = 0; axis < 3; ++axis) sum += steep * rest[axis] * steep * rest[axis];
	}
	return sum;
}

static JnStatus reserve(Newton* n) {
	const size_t slots = (size_t)n->d->slots, unknown = sizeof(Unknown) / sizeof(double);
	JN_TRY(jn_numbers_reserve(&n->d->numbers, (4 + unknown) * slots));
	JN_TRY(jn_indices_reserve(&n->d->marks, 2 * ((size_t)n->d->working_count + 1) + (size_t)n->d->group_count));
	n->best = n->d->numbers.at;
	n->change = n->best + slots;
	n->effect = n->change + slots;
	n->rhs = n->effect + slots;
	n->unknown = (Unknown*)(n->rhs + slots);
	n->first = n->d->marks.at;
	n->factored = n->first + n->d->working_count + 1;
	n->size = n->factored + n->d->working_count + 1;
	return JN_OK;
}

static void add_unknown(Newton* n, int k, const double push[3], const double aim[3], double stiffness, double target,
						int axis) {
	Unknown* u = &n->unknown[n->count++];
	*u = (Unknown){.first = n->d->start[k],
				   .count = jn_delassus_row_count(n->d, k),
				   .row = n->size[n->d->group_of[k]]++,
				   .axis = axis,
				   .stiffness = stiffness,
				   .target = target};
	memcpy(u->push, push, sizeof u->push);
	memcpy(u->aim, aim, sizeof u->aim);
}

static void add_stuck(Newton* n, int k) {
	static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	for (int a = 0; a < jn_delassus_row_count(n->d, k); ++a)
		add_unknown(n, k, axes[a], axes[a], n->proximity * steepness(n->d, k), 0, a);
}

// x is longer than the radius of the disk.
static void add_sliding(Newton* n, int k, const double x[2], double length, double radius) {
	const double *l = n->d->lambda + n->d->start[k], *w = n->d->after + n->d->start[k];
	const double mu = n->d->mu[k], steep = steepness(n->d, k), c = radius / length;
	const double along[2] = {x[0] / length, x[1] / length}, side[2] = {-along[1], along[0]};
	const double normal[3] = {1, 0, 0}, push[3] = {1, mu * along[0], mu * along[1]};
	const double across[3] = {0, side[0], side[1]}, aim[3] = {0, c * side[0], c * side[1]};
	const double missing = mu * l[0] - along[0] * l[1] - along[1] * l[2];
	for (int a = 0; a < 2; ++a) n->change[n->d->start[k] + 1 + a] = missing * along[a];
	add_unknown(n, k, push, normal, n->proximity * steep, 0, -1);
	add_unknown(n, k, across, aim, steep * (1 - c), -(1 - c) * (side[0] * w[1] + side[1] * w[2]), -1);
	n->is_symmetric = false;
}

// The unknowns, and the changes that are known: open contacts go to 0.
static void list_unknowns(Newton* n) {
	const JnDelassus* d = n->d;
	n->count = 0;
	n->is_symmetric = true;
	memset(n->size, 0, (size_t)d->group_count * sizeof *n->size);
	memset(n->change, 0, (size_t)d->slots * sizeof *n->change);
	for (int k = 0; k < d->working_count; ++k) {
		const int first = d->start[k], count = d->start[k + 1] - first;
		const double *l = d->lambda + first, *w = d->after + first, steep = steepness(d, k);
		n->first[k] = n->count;
		if (steep <= 0 || l[0] - w[0] / steep <= 0) {
			for (int a = 0; a < count; ++a) n->change[first + a] = -l[a];
			continue;
		}
		const double x[2] = {count == 3 ? l[1] - w[1] / steep : 0, count == 3 ? l[2] - w[2] / steep : 0};
		const double length = hypot(x[0], x[1]), radius = d->mu[k] * fmax(0, l[0] - w[0] / steep);
		if (count == 1 || length <= radius || length == 0)
			add_stuck(n, k);
		else
			add_sliding(n, k, x, length, radius);
	}
	n->first[d->working_count] = n->count;
}

static double along_aim(const Unknown* u, const double* w) {
	double sum = 0;
	for (int a = 0; a < u->count; ++a) sum += u->aim[a] * w[a];
	return sum;
}

// Groups that touch the same body meet.
static JnStatus analyze(Newton* n) {
	JnBlockFactor* f = &n->d->factor;
	JN_TRY(jn_block_begin(f, n->d->group_count));
	memcpy(f->size, n->size, (size_t)n->d->group_count * sizeof *f->size);
	jn_delassus_meet(n->d);
	JN_TRY(jn_block_analyze(f, n->is_symmetric));
	return jn_block_clear(f);
}

// What an unknown of a contact, whose effect is given, does to those of another.
static void add_effect(const Newton* n, JnBlock block, int column, const JnTouch* to, const double* effect) {
	double* at = block.at + (size_t)column * (size_t)block.stride;
	for (int i = n->first[to->contact]; i < n->first[to->contact + 1]; ++i) {
		const Unknown* u = &n->unknown[i];
		at[u->row] += u->axis >= 0 ? effect[to->local + u->axis] : along_aim(u, effect + to->local);
	}
}

// A column of the body's part of W, or what a push along several does.
static const double* effect_of(Newton* n, const JnDelassusBody* body, const JnTouch* from, const Unknown* u) {
	const double one = 1, zero = 0;
	const int stride = (int)body->stride, step = 1;
	const double* columns = body->w + (size_t)from->local * body->stride;
	if (u->axis >= 0) return columns + (size_t)u->axis * body->stride;
	dgemv_("N", &body->rows, &u->count, &one, columns, &stride, u->push, &step, &zero, n->effect, &step, 1);
	return n->effect;
}

// What the unknowns of a contact do to those of all contacts that touch the same body.
static void add_touch(Newton* n, const JnDelassusBody* body, const JnTouch* from) {
	const int group = n->d->group_of[from->contact];
	for (int j = n->first[from->contact]; j < n->first[from->contact + 1]; ++j) {
		const Unknown* u = &n->unknown[j];
		JnBlock block = {0};
		int last = -1;
		const double* effect = effect_of(n, body, from, u);
		for (const JnTouch* to = jn_touch_at(n->d, body->first); to != NULL; to = jn_touch_at(n->d, to->next)) {
			const int other = n->d->group_of[to->contact];
			if (other != last) block = jn_block_at(&n->d->factor, other, group);
			last = other;
			if (block.at != NULL) add_effect(n, block, u->row, to, effect);
		}
	}
}

static void gather_rhs(Newton* n) {
	const JnBlockFactor* f = &n->d->factor;
	jn_delassus_multiply(n->d, n->change, n->effect);
	for (int k = 0; k < n->d->working_count; ++k)
		for (int i = n->first[k]; i < n->first[k + 1]; ++i) {
			const Unknown* u = &n->unknown[i];
			n->rhs[f->first[f->place[n->d->group_of[k]]] + u->row] =
				u->target - along_aim(u, n->d->after + u->first) - along_aim(u, n->effect + u->first);
		}
}

static void gather_matrix(Newton* n) {
	for (int k = 0; k < n->d->working_count; ++k) {
		const int group = n->d->group_of[k];
		for (int i = n->first[k]; i < n->first[k + 1]; ++i) {
			const Unknown* u = &n->unknown[i];
			const JnBlock block = jn_block_at(&n->d->factor, group, group);
			block.at[(size_t)u->row * (size_t)(block.stride + 1)] = u->stiffness;
		}
	}
	for (int b = 0; b < n->d->body_count; ++b)
		for (const JnTouch* t = jn_touch_at(n->d, n->d->bodies[b].first); t != NULL; t = jn_touch_at(n->d, t->next))
			add_touch(n, &n->d->bodies[b], t);
}

static JnStatus factorize(Newton* n, bool* is_regular) {
	JN_TRY(analyze(n));
	gather_matrix(n);
	++n->d->base.report.factorizations;
	return jn_block_factorize(&n->d->factor, is_regular);
}

// The unknowns, in the order of the factor, as changes of the multipliers.
static void add_changes(Newton* n) {
	const JnBlockFactor* f = &n->d->factor;
	for (int k = 0; k < n->d->working_count; ++k)
		for (int i = n->first[k]; i < n->first[k + 1]; ++i) {
			const Unknown* u = &n->unknown[i];
			const double y = n->rhs[f->first[f->place[n->d->group_of[k]]] + u->row];
			for (int a = 0; a < u->count; ++a) n->change[u->first + a] += y * u->push[a];
		}
}

// Whether the same contacts are open, stuck and sliding as when the factor was made.
static bool is_factored(const Newton* n) {
	const size_t bytes = ((size_t)n->d->working_count + 1) * sizeof *n->first;
	return n->has_factor && memcmp(n->first, n->factored, bytes) == 0;
}

// One full step; where the contacts do the same as in the step before, with its factor: only directions of slip differ, and
// it costs a fifth. *worked is false when the matrix is singular.
static JnStatus step(Newton* n, bool* worked) {
	list_unknowns(n);
	*worked = true;
	if (!is_factored(n)) JN_TRY(factorize(n, worked));
	n->has_factor = *worked;
	memcpy(n->factored, n->first, ((size_t)n->d->working_count + 1) * sizeof *n->first);
	if (!*worked) return JN_OK;
	gather_rhs(n);
	jn_block_solve(&n->d->factor, n->rhs);
	add_changes(n);
	const size_t bytes = (size_t)n->d->slots * sizeof *n->effect;
	memcpy(n->effect, n->d->after, bytes);
	for (int s = 0; s < n->d->slots; ++s) n->d->lambda[s] += n->change[s];
	jn_delassus_velocities(n->d);
	for (int s = 0; s < n->d->slots; ++s) n->effect[s] = n->d->after[s] - n->effect[s];
	return JN_OK;
}

static void move(Newton* n, double share) {
	for (int s = 0; s < n->d->slots; ++s) {
		n->d->lambda[s] += share * n->change[s];
		n->d->after[s] += share * n->effect[s];
	}
}

// Go back half a step: contacts that stick and slide by turns would go on like that for ever.
static double shorten(Newton* n) {
	move(n, -0.5);
	return merit(n->d);
}

static void restore(Newton* n) {
	memcpy(n->d->lambda, n->best, (size_t)n->d->slots * sizeof *n->best);
	jn_delassus_velocities(n->d);
}

// Steps with one proximity until the residual is small or PATIENCE of them have brought nothing; *least: the merit of `best`.
static JnStatus take_steps(Newton* n, double tolerance, double* least, int* steps) {
	bool is_regular = true;
	int uphill = 0;
	double last = *least;
	n->has_factor = false;
	for (int idle = 0; idle < PATIENCE && *steps < STEPS && !(jn_delassus_residual(n->d) <= tolerance); ++idle) {
		++*steps;
		JN_TRY(step(n, &is_regular));
		if (!is_regular) return JN_OK;
		double now = merit(n->d);
		const bool is_uphill = !(now < last);
		if (is_uphill && uphill++ > 0) now = shorten(n);
		n->has_factor = n->has_factor && now < quick * last;
		last = now;
		if (!(now < *least)) continue;
		*least = now;
		idle = -1;
		memcpy(n->best, n->d->lambda, (size_t)n->d->slots * sizeof *n->best);
	}
	return JN_OK;
}

JnStatus jn_delassus_newton(JnDelassus* d, double tolerance, bool* worked) {
	Newton n = {.d = d};
	JN_TRY(reserve(&n));
	memcpy(n.best, d->lambda, (size_t)d->slots * sizeof *n.best);
	const double before = merit(d);
	double least = before;
	int steps = 0;
	for (int level = 0; level < LEVELS && !(jn_delassus_residual(d) <= tolerance); ++level) {
		n.proximity = proximities[level];
		JN_TRY(take_steps(&n, tolerance, &least, &steps));
		restore(&n);
	}
	jn_delassus_clip(d);
	jn_delassus_velocities(d);
	*worked = least < 0.01 * before || jn_delassus_residual(d) <= tolerance;
	return JN_OK;
}
