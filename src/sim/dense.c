// States between steps. Positions follow the cubic that has the positions and velocities of both ends, velocities its
// derivative: with s = (t - t0) / h and r = 1 - s,
//   x = r^2 (1 + 2 s) x0 + s^2 (1 + 2 r) x1 + h s r (r v0 - s v1)               error O(h^4)
//   v = 6 s r (x1 - x0) / h + r (1 - 3 s) v0 + s (1 - 3 r) v1                   error O(h^3)
// Where a pass has edited the end, velocities jump within the step, and the cubic would swing beyond what contact allows:
// there both follow straight lines, so that two states above a plane have only such states between them.
#include <math.h>

#include "base/space.h"
#include "sim/simulation.h"

static void follow_cubic(JnSpace* space, const JnState* from, const JnState* to, double s, JnState* out) {
	const double r = 1 - s, h = to->t - from->t;
	const JnTerm x[] = {{r * r * (1 + 2 * s), from->x},
						{s * s * (1 + 2 * r), to->x},
						{h * s * r * r, from->v},
						{-h * s * s * r, to->v}};
	const JnTerm v[] = {
		{-6 * s * r / h, from->x}, {6 * s * r / h, to->x}, {r * (1 - 3 * s), from->v}, {s * (1 - 3 * r), to->v}};
	space->ops->combine(space, out->x, 4, x);
	space->ops->combine(space, out->v, 4, v);
}

static void follow_line(JnSpace* space, const JnState* from, const JnState* to, double s, JnState* out) {
	space->ops->combine(space, out->x, 2, (JnTerm[]){{1 - s, from->x}, {s, to->x}});
	space->ops->combine(space, out->v, 2, (JnTerm[]){{1 - s, from->v}, {s, to->v}});
}

void jn_sim_state_at(const JnSim* sim, double t, JnState* out) {
	JnSpace* space = sim->sys->space;
	const JnState *from = &sim->end, *to = &sim->start;
	if (sim->steps == 0 || t >= to->t) {
		jn_state_copy(space, to, out);
		return;
	}
	const double s = (t - from->t) / (to->t - from->t);
	(sim->was_edited ? follow_line : follow_cubic)(space, from, to, fmax(s, 0), out);
	out->t = t;
	sim->sys->ops->prescribe(sim->sys, out, NULL);
	jn_state_touch(space, out);
}
