// Where D stands, and when it is made. D of products is known by its positions alone: it is made by copying them.
#include "model/damping.h"

#include <string.h>

#include "base/log.h"

static void assemble(JnModelSystem* sys, const double* x) {
	jn_assembly_tangent(sys->assembly, x, JN_DEFINITE, sys->beta, sys->damping);
	sys->damping_is_assembled = true;
	++sys->base.report->tangents;
}

static void make(JnModelSystem* sys, const double* x, uint64_t stamp) {
	if (sys->damping_x != NULL) memcpy(sys->damping_x, x, sys->base.space->length * sizeof *x);
	sys->damping_is_assembled = false;
	sys->damping_single_is_current = false;
	sys->damping_stamp = stamp;
	if (sys->damping_x == NULL) assemble(sys, x);
	jn_model_matrix_expire(sys);
}

const double* jn_damping_blocks(JnModelSystem* sys) {
	if (!sys->damping_acts || sys->damping == NULL) return NULL;
	if (!sys->damping_is_assembled) assemble(sys, sys->damping_x);
	return sys->damping;
}

const double* jn_damping_diagonal(JnModelSystem* sys) {
	const JnPattern* pattern = &sys->model->pattern;
	const JnTangentAt at = {.x = sys->damping_x, .definite = JN_DEFINITE, .weight = sys->beta};
	if (!sys->damping_acts || sys->damping == NULL) return NULL;
	if (sys->model->is_matrix_free) return jn_damping_blocks(sys);
	if (sys->damping_x != NULL) {
		jn_assembly_diagonal(sys->assembly, at, sys->damping_diagonal);
		return sys->damping_diagonal;
	}
	for (int node = 0; node < pattern->nodes; ++node)
		memcpy(sys->damping_diagonal + 9 * (size_t)node, sys->damping + 9 * (size_t)pattern->column_start[node],
			   9 * sizeof(double));
	return sys->damping_diagonal;
}

const JnStored* jn_damping_single(JnModelSystem* sys) {
	const JnTangentAt at = {.x = sys->damping_x, .definite = JN_DEFINITE, .weight = sys->beta};
	if (!sys->damping_acts || sys->damping_x == NULL) return NULL;
	if (!sys->damping_single_is_current)
		sys->damping_single_is_current = jn_assembly_store(sys->assembly, at, &sys->damping_single);
	return sys->damping_single_is_current ? &sys->damping_single : NULL;
}

void jn_damping_apply(const JnModelSystem* sys, double scale, const double* in, double* out) {
	const JnTangentAt at = {.x = sys->damping_x, .definite = JN_DEFINITE, .weight = sys->beta};
	if (!sys->damping_acts || sys->damping == NULL) return;
	if (sys->damping_x != NULL)
		jn_assembly_product(sys->assembly, at, scale, in, out);
	else
		jn_blocks_apply(&sys->model->pattern, sys->damping, scale, in, out, sys->model->threads);
}

void jn_damping_apply_mass(const JnModelSystem* sys, double scale, const double* in, double* out) {
	const JnModel* model = sys->model;
	if (sys->alpha_mass == NULL) return;
	if (sys->alpha_entries != NULL)
		sys->algebra->accumulate(sys->base.space->length, scale, sys->alpha_entries, in, out);
	else
		jn_scalars_apply(&model->pattern, sys->alpha_mass, scale, in, out, model->threads);
}

void jn_damping_follow(JnModelSystem* sys, const JnState* s) {
	if (sys->damping_is_current && sys->damping_acts && sys->damping_stamp != s->stamp) make(sys, s->x, s->stamp);
}

// Times are sums of steps: one that ought to begin at damping_start may begin a few roundings before it.
static void switch_on_or_off(JnModelSystem* sys, double t) {
	const bool acts = t >= sys->damping_start * (1 - 1e-9);
	if (acts == sys->damping_acts) return;
	sys->damping_acts = acts;
	sys->alpha_mass = acts ? sys->model->alpha_mass : NULL;
	sys->damping_stamp = 0;
	jn_model_matrix_expire(sys);
}

void jn_damping_begin(JnModelSystem* sys, const JnState* start) {
	switch_on_or_off(sys, start->t);
	const bool has_blocks = sys->damping_acts && sys->damping != NULL;
	if (sys->damping_at_rest && has_blocks && sys->damping_stamp == 0) {
		jn_assembly_freeze(sys->assembly, sys->model->rest);
		make(sys, sys->model->rest, start->stamp);
	}
	const bool follows = has_blocks && !sys->damping_at_rest;
	if (jn_assembly_freeze(sys->assembly, start->x)) {
		sys->internal_stamp = 0;
		sys->stiffness_stamp = 0;
		if (follows) sys->damping_stamp = 0;
	}
	if (follows && sys->damping_stamp != start->stamp) make(sys, start->x, start->stamp);
}

// One damping matrix serves all bodies, so that they must agree on where K is taken.
static JnStatus check_stiffness(JnModelSystem* sys) {
	int chosen = -1;
	for (int b = 0; b < sys->model->body_count; ++b) {
		const JnDampingDef* damping = &sys->model->bodies[b].damping;
		if (!jn_body_has_beta(sys->model, &sys->model->bodies[b])) continue;
		if (chosen >= 0 && chosen != damping->stiffness)
			return jn_error(JN_BAD_INPUT,
							"bodies[%d].damping.stiffness: differs from that of an earlier body; use one for all", b);
		chosen = damping->stiffness;
	}
	sys->damping_at_rest = chosen == 1;
	sys->damping_is_current = chosen == 2;
	return JN_OK;
}

// Nor do the sums of all bodies tell when each of them begins.
static JnStatus check_start(JnModelSystem* sys) {
	bool is_chosen = false;
	for (int b = 0; b < sys->model->body_count; ++b) {
		const JnDampingDef* damping = &sys->model->bodies[b].damping;
		if (damping->alpha == 0 && !jn_body_has_beta(sys->model, &sys->model->bodies[b])) continue;
		if (is_chosen && sys->damping_start != damping->start)
			return jn_error(JN_BAD_INPUT,
							"bodies[%d].damping.start: differs from that of an earlier body; use one for all", b);
		sys->damping_start = damping->start;
		is_chosen = true;
	}
	return JN_OK;
}

// Products are those of the present moment: they serve where nothing that they depend on but x changes after D was made.
static bool has_products(const JnModelSystem* sys) {
	for (int g = 0; g < sys->model->group_count; ++g) {
		const JnKernel* kernel = sys->model->groups[g].kernel;
		if (sys->beta[g] == 0) continue;
		if (kernel->product == NULL || kernel->freeze != NULL) return false;
		if (kernel->damage != NULL && sys->damping_at_rest && !sys->model->is_matrix_free) return false;
	}
	return true;
}

// The diagonal is all that there is where M is diagonal.
static JnStatus spread_alpha(JnModelSystem* sys) {
	JnModel* model = sys->model;
	if (model->alpha_mass == NULL || !model->mass_is_diagonal) return JN_OK;
	JN_NEW(&model->arena, sys->alpha_entries, sys->base.space->length);
	for (int k = 0; k < 3 * model->node_count; ++k)
		sys->alpha_entries[k] = model->alpha_mass[model->pattern.column_start[k / 3]];
	return JN_OK;
}

JnStatus jn_damping_create(JnModelSystem* sys) {
	JnModel* model = sys->model;
	JN_TRY(spread_alpha(sys));
	JN_TRY(check_stiffness(sys));
	JN_TRY(check_start(sys));
	JN_NEW(&model->arena, sys->beta, model->group_count + 1);
	for (int b = 0; b < model->body_count; ++b)
		for (int g = 0; g < model->bodies[b].group_count; ++g)
			sys->beta[model->bodies[b].first_group + g] = jn_group_beta(model, &model->bodies[b], g);
	if (model->has_beta) JN_NEW(&model->arena, sys->damping, 9 * (size_t)model->pattern.blocks);
	if (model->has_beta) JN_NEW(&model->arena, sys->damping_diagonal, 9 * (size_t)model->node_count);
	if (model->has_beta && has_products(sys)) JN_NEW(&model->arena, sys->damping_x, sys->base.space->length);
	switch_on_or_off(sys, 0);
	return JN_OK;
}
