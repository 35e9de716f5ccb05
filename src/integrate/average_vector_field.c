// Average vector field (Quispel, McLaren 2008):  x1 = x0 + dt (v0 + v1) / 2,  M (v1 - v0) = dt int_0^1 f(x0 + s (x1 - x0)) ds.
// The work of the averaged force is the difference of the potential, so that energy is kept to the error of the quadrature
// (Gauss, `nodes` points: exact for polynomials of degree 2 nodes - 1 in s) and of the Newton iteration.
//
// With a = (v1 - v0) / dt the points are  x = x0 + s (dt v0 + dt^2/2 a),  v = v0 + s dt a.
#include "integrate/average_vector_field.h"

#include <math.h>
#include <stddef.h>

#include "integrate/integrator.h"

enum { MOST_NODES = 8 };

/// Work vectors: a, accelerations of the held entries, then x of each point.
enum { A, HELD, X, VECTORS = X + MOST_NODES };

typedef struct AverageDef {
	int nodes;
} AverageDef;

// Gauss-Legendre nodes and weights on [0, 1]: roots of P_n by Newton from the usual first guess.
static void gauss(int n, double node[], double weight[]) {
	const double pi = 3.14159265358979323846;
	for (int i = 0; i < n; ++i) {
		double z = cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
		for (int iteration = 0; iteration < 10; ++iteration) {
			double p = 1, before = 0;
			for (int k = 1; k <= n; ++k) {
				const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
				before = p;
				p = next;
			}
			slope = n * (z * p - before) / (z * z - 1);
			z -= p / slope;
		}
		node[i] = 0.5 * (1 - z);
		weight[i] = 1 / ((1 - z * z) * slope * slope);
	}
}

// held = (v(t1) - v(t0)) / dt of the held entries, 0 elsewhere; uses the end state as work.
static void average_held(JnIntegrator* self, JnStep* step) {
	JnSpace* space = self->space;
	JnVec held = self->vectors[HELD], free_part = self->vectors[A];
	step->end->t = step->start->t + step->dt;
	space->ops->combine(space, step->end->v, 1, (JnTerm[]){{1, step->start->v}});
	step->sys->ops->prescribe(step->sys, step->end, NULL);
	const double rate = 1 / step->dt;
	space->ops->combine(space, held, 2, (JnTerm[]){{rate, step->end->v}, {-rate, step->start->v}});
	space->ops->combine(space, free_part, 1, (JnTerm[]){{1, held}});
	step->sys->ops->hold(step->sys, free_part);
	space->ops->combine(space, held, 2, (JnTerm[]){{1, held}, {-1, free_part}});
}

static JnStatus average_step(JnIntegrator* self, JnStep* step) {
	const int count = ((const AverageDef*)self->options)->nodes;
	const JnState* start = step->start;
	JnSpace* space = self->space;
	const double dt = step->dt;
	double node[MOST_NODES], weight[MOST_NODES];
	JnStage points[MOST_NODES];
	step->sys->report = &step->report;
	self->step_stamp = start->stamp;
	gauss(count, node, weight);
	average_held(self, step);
	for (int i = 0; i < count; ++i) {
		JnVec x = self->vectors[X + i];
		space->ops->combine(space, x, 2, (JnTerm[]){{1, start->x}, {node[i] * dt, start->v}});
		points[i] = (JnStage){.t = start->t + node[i] * dt,
							  .kx = 0.5 * node[i] * dt * dt,
							  .kv = node[i] * dt,
							  .x = x,
							  .v = start->v,
							  .weight = weight[i],
							  .held = self->vectors[HELD],
							  .next = i + 1 < count ? &points[i + 1] : NULL};
	}
	JnVec a = self->vectors[A];
	JnState* end = step->end;
	JN_TRY(jn_stage_solve(self, step->sys, &points[0], end, a, &step->report));
	space->ops->combine(space, end->x, 3, (JnTerm[]){{1, start->x}, {dt, start->v}, {0.5 * dt * dt, a}});
	space->ops->combine(space, end->v, 2, (JnTerm[]){{1, start->v}, {dt, a}});
	end->t = start->t + dt;
	step->sys->ops->prescribe(step->sys, end, NULL);
	jn_state_touch(space, end);
	return jn_state_check(space, end);
}

static const JnKey keys[] = {
	{.name = "nodes",
	 .kind = JN_INTEGER,
	 .field = offsetof(AverageDef, nodes),
	 .value = {4},
	 .low = 1,
	 .high = MOST_NODES,
	 .meaning =
		 "Gauss points at which the force is averaged; 2 are exact for quartic energies, 1 is the implicit midpoint"},
	{0},
};

const JnIntegratorType jn_average_vector_field = {
	.row = {.name = "average_vector_field",
			.doc = "Quispel, McLaren 2008: one solve, keeps the energy exactly, for any step that Newton can solve",
			.keys = keys,
			.options_size = sizeof(AverageDef)},
	.needs = JN_NEEDS_TANGENT,
	.order = 2,
	.force_weight = 0.25,
	.vectors = VECTORS,
	.step = average_step,
};
