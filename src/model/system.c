// The verbs of a model. Stamps tell what is already known: internal forces and K are made once a state.
#include "model/system.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "base/space.h"
#include "model/load.h"
#include "model/repulsion.h"
#include "model/stretch.h"
#include "model/wind.h"

static JnModelSystem* of(JnSystem* sys) {
	return (JnModelSystem*)sys;
}

static void make_damping(JnModelSystem* sys, const double* x, uint64_t stamp) {
	if (sys->damping == NULL) return;
	jn_assembly_tangent(sys->assembly, x, JN_DEFINITE, sys->beta, sys->damping);
	if (sys->damping_x != NULL) memcpy(sys->damping_x, x, sys->base.space->length * sizeof *x);
	sys->damping_stamp = stamp;
	++sys->base.report->tangents;
	jn_model_matrix_expire(sys);
}

static JnStatus update_internal(JnModelSystem* sys, const JnState* s) {
	if (sys->internal_stamp == s->stamp) return JN_OK;
	memset(sys->internal, 0, sys->base.space->length * sizeof *sys->internal);
	jn_assembly_force(sys->assembly, s->x, sys->internal);
	if (sys->model->repulsion != NULL) JN_TRY(jn_repulsion_force(sys->model->repulsion, s->x, sys->internal));
	sys->internal_stamp = s->stamp;
	++sys->base.report->forces;
	return JN_OK;
}

// Typical forces: the weight, or what acts inside, or the wind, or (at rest without weight) those of a strain of 1e-6.
static double typical_force(JnModelSystem* sys) {
	JnSpace* space = sys->base.space;
	const double weight = sqrt(space->ops->dot(space, sys->external, sys->external));
	const double inside = sqrt(space->ops->dot(space, sys->internal, sys->internal));
	const double outside = sys->model->wind != NULL ? sys->model->wind->typical_force : 0;
	return fmax(fmax(fmax(weight, inside), outside), 1e-6 / DBL_EPSILON * sys->base.force_floor);
}

// Times are sums of steps: one that ought to begin at damping_start may begin a few roundings before it.
static void switch_damping(JnModelSystem* sys, double t) {
	const bool acts = t >= sys->damping_start * (1 - 1e-9);
	double* const damping = acts ? sys->damping_store : NULL;
	double* const alpha_mass = acts ? sys->model->alpha_mass : NULL;
	if (damping == sys->damping && alpha_mass == sys->alpha_mass) return;
	sys->damping = damping;
	sys->alpha_mass = alpha_mass;
	sys->damping_stamp = 0;
	jn_model_matrix_expire(sys);
}

static JnStatus begin(JnSystem* base, const JnState* start) {
	JnModelSystem* sys = of(base);
	switch_damping(sys, start->t);
	if (sys->damping_at_rest && sys->damping != NULL && sys->damping_stamp == 0) {
		jn_assembly_freeze(sys->assembly, sys->model->rest);
		make_damping(sys, sys->model->rest, start->stamp);
	}
	const bool damping_follows = sys->damping != NULL && !sys->damping_at_rest;
	if (jn_assembly_freeze(sys->assembly, start->x)) {
		sys->internal_stamp = 0;
		sys->stiffness_stamp = 0;
		if (damping_follows) sys->damping_stamp = 0;
	}
	if (damping_follows && sys->damping_stamp != start->stamp) make_damping(sys, start->x, start->stamp);
	if (base->force_scale == 0) JN_TRY(update_internal(sys, start));
	if (sys->internal_stamp == start->stamp)
		base->force_scale = typical_force(sys); // else as before: no force for this alone
	return JN_OK;
}

static void prescribe(JnSystem* base, JnState* s, JnVec a) {
	const JnModel* model = of(base)->model;
	for (int i = 0; i < model->held_count; ++i) {
		const JnHeld* held = &model->held_list[i];
		JnMotionValue value = {0};
		if (held->motion != NULL) value = ((const JnMotionType*)held->motion->row)->at(held->motion->options, s->t);
		s->x[held->entry] = model->rest[held->entry] + value.x;
		s->v[held->entry] = value.v;
		if (a != NULL) a[held->entry] = value.a;
	}
}

static void hold(JnSystem* base, JnVec r) {
	const JnModel* model = of(base)->model;
	for (int i = 0; i < model->held_count; ++i) r[model->held_list[i].entry] = 0;
}

static JnStatus force(JnSystem* base, const JnState* s, JnVec f) {
	JnModelSystem* sys = of(base);
	const JnModel* model = sys->model;
	JN_TRY(update_internal(sys, s));
	const JnTerm terms[] = {{1, sys->internal}, {1, sys->external}, {1, sys->load}};
	base->space->ops->combine(base->space, f, sys->load != NULL ? 3 : 2, terms);
	if (model->wind != NULL) jn_wind_force(model->wind, s, f);
	if (sys->alpha_mass != NULL) jn_scalars_apply(&model->pattern, sys->alpha_mass, -1, s->v, f, model->threads);
	if (sys->damping_is_current && sys->damping_stamp != s->stamp) make_damping(sys, s->x, s->stamp);
	jn_model_apply_damping(sys, -1, s->v, f);
	return JN_OK;
}

static double gravity_potential(const JnModel* model, const double* x) {
	double sum = 0;
	for (int node = 0; node < model->node_count; ++node) {
		double work = 0;
		for (int axis = 0; axis < 3; ++axis) {
			const size_t k = 3 * (size_t)node + (size_t)axis;
			work += model->gravity[axis] * (x[k] - model->rest[k]);
		}
		sum -= model->nodal_mass[node] * work;
	}
	return sum + jn_loads_potential(model, x);
}

// Potential of the load: -load . (x - X).
static double load_potential(const JnModelSystem* sys, const double* x) {
	double sum = 0;
	for (size_t k = 0; sys->load != NULL && k < sys->base.space->length; ++k)
		sum -= sys->load[k] * (x[k] - sys->model->rest[k]);
	return sum;
}

// Of strain and of repulsion.
static double elastic_energy(const JnModelSystem* sys, const double* x) {
	const double strain = jn_assembly_energy(sys->assembly, x);
	return sys->model->repulsion != NULL ? strain + jn_repulsion_energy(sys->model->repulsion, x) : strain;
}

static double energy(JnSystem* base, const JnState* s) {
	JnModelSystem* sys = of(base);
	return elastic_energy(sys, s->x) + gravity_potential(sys->model, s->x) + load_potential(sys, s->x);
}

void jn_model_system_set_load(JnModel* model, const double* load) {
	of(model->system)->load = load;
}

// Pairs that meet have no place in a pattern that is made once.
static JnStatus linearize_repulsion(JnModelSystem* sys, const double* x) {
	if (!sys->model->is_matrix_free)
		return jn_error(JN_BAD_INPUT, "repulsion: implicit methods need it as products; set solver.method: cg, and "
									  "solver.matrix: auto");
	JN_TRY(jn_repulsion_linearize(sys->model->repulsion, x));
	jn_repulsion_add_diagonal(sys->model->repulsion, JN_EXACT, sys->stiffness);
	return JN_OK;
}

static JnStatus linearize(JnSystem* base, const JnState* s) {
	JnModelSystem* sys = of(base);
	if (sys->damping_is_current && sys->damping_stamp != s->stamp) make_damping(sys, s->x, s->stamp);
	if (sys->unsymmetric != NULL && jn_wind_linearize(sys->model->wind, s)) jn_model_matrix_expire(sys);
	const bool is_constant = base->is_linear_in_step && sys->stiffness_stamp != 0;
	if (sys->stiffness_stamp == s->stamp || is_constant) return JN_OK;
	jn_assembly_tangent(sys->assembly, s->x, JN_EXACT, NULL, sys->stiffness);
	if (sys->model->repulsion != NULL) JN_TRY(linearize_repulsion(sys, s->x));
	memcpy(sys->linear_x, s->x, base->space->length * sizeof *sys->linear_x);
	sys->stiffness_stamp = s->stamp;
	++base->report->tangents;
	jn_model_matrix_expire(sys);
	return JN_OK;
}

static JnStatus matrix(JnSystem* base, JnShift shift, JnMatrix** out) {
	return jn_model_matrix(of(base), shift, out);
}

static double stretch(JnSystem* base, const JnState* from, const JnState* to) {
	return jn_model_stretch(of(base)->model, from->x, to->x);
}

static const JnSystemOps system_ops = {
	.begin = begin,
	.prescribe = prescribe,
	.hold = hold,
	.force = force,
	.energy = energy,
	.linearize = linearize,
	.matrix = matrix,
	.stretch = stretch,
};

// What rounding of positions leaves in a force: stiffness times the spacing of doubles at the model's coordinates.
static double rounding_force(JnModelSystem* sys) {
	const JnModel* model = sys->model;
	JnSpace* space = sys->base.space;
	const double reach = space->ops->max(space, model->rest);
	double sum = 0;
	for (int node = 0; node < model->node_count; ++node)
		for (int axis = 0; axis < 3; ++axis) {
			const double k = sys->stiffness[9 * (size_t)model->pattern.column_start[node] + 4 * (size_t)axis];
			sum += model->held[3 * node + axis] ? 0 : k * k;
		}
	return DBL_EPSILON * reach * sqrt(sum);
}

static JnStatus allocate(JnModelSystem* sys) {
	JnModel* model = sys->model;
	JnArena* arena = &model->arena;
	const size_t n = 3 * (size_t)model->node_count, entries = 9 * (size_t)model->pattern.blocks;
	JN_NEW(arena, sys->external, n);
	JN_NEW(arena, sys->internal, n);
	JN_NEW(arena, sys->linear_x, n);
	JN_NEW(arena, sys->momenta, n);
	JN_NEW(arena, sys->stiffness, entries);
	JN_NEW(arena, sys->scratch, entries);
	if (model->has_beta) JN_NEW(arena, sys->damping_store, entries);
	if (model->has_beta && model->is_matrix_free) JN_NEW(arena, sys->damping_x, n);
	JN_NEW(arena, sys->beta, model->group_count + 1);
	for (int k = 0; k < 3 * model->node_count; ++k) {
		sys->external[k] = model->nodal_mass[k / 3] * model->gravity[k % 3];
		if (model->loads != NULL) sys->external[k] += model->loads[k];
	}
	sys->base.is_linear_in_step = model->wind == NULL && model->repulsion == NULL;
	sys->base.depends_on_time = model->wind != NULL && jn_gusts_blow(&model->wind->gusts);
	sys->base.has_potential = model->wind == NULL;
	sys->base.mass_is_diagonal = model->mass_is_diagonal;
	for (int i = 0; i < model->held_count; ++i) sys->base.depends_on_time |= model->held_list[i].motion != NULL;
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		sys->base.is_linear_in_step &= body->law->is_linear_in_step;
		sys->damping_is_current |= jn_body_has_beta(model, body) && body->damping.stiffness == 2;
		for (int g = 0; g < body->group_count; ++g) sys->beta[body->first_group + g] = jn_group_beta(model, body, g);
	}
	sys->base.has_potential &= !sys->damping_is_current;
	return JN_OK;
}

// The derivatives of the wind's force are not symmetric.
static JnStatus create_unsymmetric(JnModelSystem* sys) {
	JnModel* model = sys->model;
	if (model->wind == NULL || model->wind->tangent == NULL) return JN_OK;
	JN_NEW(&model->arena, sys->full, 9 * (size_t)model->pattern.full_start[model->node_count]);
	return jn_solver_unsymmetric.create(NULL, &model->pattern, model->held, model->threads, &sys->unsymmetric);
}

// One damping matrix serves all bodies, so that they must agree on where K is taken.
static JnStatus check_damping(JnModelSystem* sys) {
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
	return JN_OK;
}

// Nor do the sums of all bodies tell when each of them begins.
static JnStatus check_damping_start(JnModelSystem* sys) {
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
	switch_damping(sys, 0);
	return JN_OK;
}

JnStatus jn_model_system_create(JnModel* model, const JnVariant* solver) {
	JnModelSystem* sys;
	JN_NEW(&model->arena, sys, 1);
	sys->base.ops = &system_ops;
	sys->model = model;
	model->system = &sys->base;
	sys->base.space = jn_host_space_create(3 * (size_t)model->node_count, model->threads);
	if (sys->base.space == NULL) return JN_OUT_OF_MEMORY;
	sys->base.space->node_entries = 3;
	JN_TRY(jn_assembly_create(model, &sys->assembly));
	JN_TRY(allocate(sys));
	JN_TRY(check_damping(sys));
	JN_TRY(check_damping_start(sys));
	const JnSolverType* type = (const JnSolverType*)solver->row;
	JN_TRY(type->create(solver->options, &model->pattern, model->held, model->threads, &sys->solver));
	if (model->is_matrix_free)
		type->attach(sys->solver, (JnOperator){jn_model_matrix_product, sys, &sys->base.force_floor});
	JN_TRY(create_unsymmetric(sys));
	jn_assembly_freeze(sys->assembly, model->rest);
	jn_assembly_tangent(sys->assembly, model->rest, JN_EXACT, NULL, sys->stiffness);
	sys->base.force_floor = rounding_force(sys);
	return JN_OK;
}

void jn_model_system_destroy(JnModel* model) {
	JnModelSystem* sys = of(model->system);
	if (sys == NULL) return;
	if (sys->solver != NULL) sys->solver->type->destroy(sys->solver);
	if (sys->unsymmetric != NULL) sys->unsymmetric->type->destroy(sys->unsymmetric);
	jn_host_space_destroy(sys->base.space);
	model->system = NULL;
}

// Linear and angular momentum from the nodal momenta p = M v.
static void add_momenta(const double* x, const double* p, JnEnergies* out) {
	out->momentum[0] += p[0];
	out->momentum[1] += p[1];
	out->momentum[2] += p[2];
	out->angular[0] += x[1] * p[2] - x[2] * p[1];
	out->angular[1] += x[2] * p[0] - x[0] * p[2];
	out->angular[2] += x[0] * p[1] - x[1] * p[0];
}

JnEnergies jn_model_energies(JnModel* model, const JnState* state) {
	JnModelSystem* sys = of(model->system);
	JnSpace* space = sys->base.space;
	JnMatrix* mass = NULL;
	JnEnergies out = {.elastic = elastic_energy(sys, state->x), .gravity = gravity_potential(model, state->x)};
	jn_model_matrix(sys, (JnShift){.mass = 1}, &mass);
	double* p = sys->momenta;
	mass->ops->apply(mass, state->v, p);
	out.kinetic = 0.5 * space->ops->dot(space, state->v, p);
	for (int node = 0; node < model->node_count; ++node)
		add_momenta(state->x + 3 * (size_t)node, p + 3 * (size_t)node, &out);
	return out;
}
