// A kick and a drift:  v+ = v + kick M^-1 f(t, x, v),  x+ = x + drift v+.  An explicit step consists of little else beside
// forces: its vectors are read and written once. What is held has an inverse mass of zero.
#include "model/advance.h"

#include "base/parallel.h"

enum { GRAIN = 16384 }; // entries that make another thread worth waking

// Weight and internal forces are added on the way; whatever else acts is summed up before.
static JnStatus find_forces(JnModelSystem* sys, const JnState* s, JnAdvance* by) {
	const JnModel* model = sys->model;
	bool is_plain = model->wind == NULL && sys->alpha_mass == NULL && (sys->damping == NULL || !sys->damping_acts);
	for (int i = 0; i < JN_LOAD_COUNT; ++i) is_plain &= sys->load[i] == NULL;
	by->force = is_plain ? sys->internal : sys->momenta;
	by->load = is_plain ? sys->external : NULL;
	return is_plain ? jn_model_internal(sys, s) : sys->base.ops->force(&sys->base, s, sys->momenta);
}

// first .. last are whole cache lines, as near as possible to equal parts.
static size_t part_of(size_t length, int t, int team) {
	return t == team ? length : length * (size_t)t / (size_t)team / 8 * 8;
}

static bool advance(const JnModelSystem* sys, const JnAdvance* by) {
	const size_t length = sys->base.space->length;
	const int team = jn_threads_for(length, GRAIN, sys->model->threads);
	if (team == 1) return sys->algebra->advance(0, length, by);
	bool is_finite = true;
#pragma omp parallel for schedule(static) num_threads(team) reduction(&& : is_finite)
	for (int t = 0; t < team; ++t)
		is_finite = sys->algebra->advance(part_of(length, t, team), part_of(length, t + 1, team), by) && is_finite;
	return is_finite;
}

JnStatus jn_model_advance(JnSystem* base, const JnState* from, double kick, double drift, JnState* to) {
	JnModelSystem* sys = (JnModelSystem*)base;
	JnSpace* space = base->space;
	JnAdvance by = {.kick = kick,
					.drift = drift,
					.inverse_mass = sys->inverse_mass,
					.x = from->x,
					.v = from->v,
					.x_out = to->x,
					.v_out = to->v};
	if (kick != 0) {
		JN_TRY(find_forces(sys, from, &by));
		const bool is_finite = advance(sys, &by);
		if (drift == 0 && from != to) space->ops->combine(space, to->x, 1, &(JnTerm){1, from->x});
		return is_finite ? JN_OK : JN_NOT_FINITE;
	}
	space->ops->combine(space, to->x, 2, (JnTerm[]){{1, from->x}, {drift, from->v}});
	if (from != to) space->ops->combine(space, to->v, 1, &(JnTerm){1, from->v});
	return JN_OK;
}
