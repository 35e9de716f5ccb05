// The verbs of a model. Stamps tell what is already known: internal forces and K are made once a state.
#include "model/system.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "base/space.h"
#include "model/advance.h"
#include "model/damping.h"
#include "model/load.h"
#include "model/repulsion.h"
#include "model/stiffness.h"
#include "model/stretch.h"
#include "model/wind.h"

static JnModelSystem* of(JnSystem* sys) {
	return (JnModelSystem*)sys;
}

JnStatus jn_model_internal(JnModelSystem* sys, const JnState* s) {
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
	const double inside = sqrt(space->ops->dot(space, sys->internal, sys->internal));
	const double outside = sys->model->wind != NULL ? sys->model->wind->typical_force : 0;
	return fmax(fmax(fmax(sys->weight, inside), outside), 1e-6 / DBL_EPSILON * sys->base.force_floor);
}

static JnStatus begin(JnSystem* base, const JnState* start) {
	JnModelSystem* sys = of(base);
	jn_damping_begin(sys, start);
	if (base->force_scale == 0) JN_TRY(jn_model_internal(sys, start));
	const bool is_judged = sys->has_linearized || base->force_scale == 0; // explicit methods leave no residuals
	if (is_judged && sys->internal_stamp == start->stamp)
		base->force_scale = typical_force(sys); // else as before: no force for this alone
	return JN_OK;
}

static void prescribe(JnSystem* base, JnState* s, JnVec a) {
	JnModelSystem* sys = of(base);
	const JnModel* model = sys->model;
	const JnMotionValue* values = jn_hold_at(model, &sys->hold, s->t);
	for (int i = 0; i < model->held_count; ++i) {
		const int entry = model->held_list[i].entry;
		s->x[entry] = values[i].x;
		s->v[entry] = values[i].v;
		if (a != NULL) a[entry] = values[i].a;
	}
}

static void hold(JnSystem* base, JnVec r) {
	const JnModel* model = of(base)->model;
	for (int i = 0; i < model->held_count; ++i) r[model->held_list[i].entry] = 0;
}

static JnStatus force(JnSystem* base, const JnState* s, JnVec f) {
	JnModelSystem* sys = of(base);
	const JnModel* model = sys->model;
	JN_TRY(jn_model_internal(sys, s));
	JnTerm terms[2 + JN_LOAD_COUNT] = {{1, sys->internal}, {1, sys->external}};
	int count = 2;
	for (int i = 0; i < JN_LOAD_COUNT; ++i)
		if (sys->load[i] != NULL) terms[count++] = (JnTerm){1, sys->load[i]};
	base->space->ops->combine(base->space, f, count, terms);
	if (model->wind != NULL) jn_wind_force(model->wind, s, f);
	jn_damping_apply_mass(sys, -1, s->v, f);
	jn_damping_follow(sys, s);
	jn_damping_apply(sys, -1, s->v, f);
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

// Potential of the loads: -load . (x - X).
static double load_potential(const JnModelSystem* sys, const double* x) {
	double sum = 0;
	for (int i = 0; i < JN_LOAD_COUNT; ++i)
		for (size_t k = 0; sys->load[i] != NULL && k < sys->base.space->length; ++k)
			sum -= sys->load[i][k] * (x[k] - sys->model->rest[k]);
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

void jn_model_system_set_load(JnModel* model, JnLoadOf who, const double* load) {
	of(model->system)->load[who] = load;
}

// Pairs that meet have no place in a pattern that is made once.
static JnStatus linearize_repulsion(JnModelSystem* sys, const double* x) {
	if (!sys->model->is_matrix_free)
		return jn_error(JN_BAD_INPUT, "repulsion: implicit methods need it as products; set solver.method: cg, and "
									  "solver.matrix: auto");
	return jn_repulsion_linearize(sys->model->repulsion, x);
}

static JnStatus linearize(JnSystem* base, const JnState* s) {
	JnModelSystem* sys = of(base);
	sys->has_linearized = true;
	jn_damping_follow(sys, s);
	if (sys->unsymmetric != NULL && jn_wind_linearize(sys->model->wind, s)) jn_model_matrix_expire(sys);
	const bool is_constant = base->is_linear_in_step && sys->stiffness_stamp != 0;
	if (sys->stiffness_stamp == s->stamp || is_constant) return JN_OK;
	if (sys->model->repulsion != NULL) JN_TRY(linearize_repulsion(sys, s->x));
	jn_stiffness_set(sys, s->x);
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
	.advance = jn_model_advance,
};

// What rounding of positions leaves in a force: stiffness times the spacing of doubles at the model's coordinates.
static double rounding_force(JnModelSystem* sys) {
	const JnModel* model = sys->model;
	JnSpace* space = sys->base.space;
	jn_stiffness_set(sys, model->rest);
	const double* diagonal = jn_stiffness_diagonal(sys, JN_EXACT);
	const double reach = space->ops->max(space, model->rest);
	double sum = 0;
	for (int node = 0; node < model->node_count; ++node)
		for (int axis = 0; axis < 3; ++axis) {
			const double k = diagonal[9 * (size_t)node + 4 * (size_t)axis];
			sum += model->held[3 * node + axis] ? 0 : k * k;
		}
	return DBL_EPSILON * reach * sqrt(sum);
}

static JnStatus allocate(JnModelSystem* sys) {
	JnModel* model = sys->model;
	JnArena* arena = &model->arena;
	const size_t n = 3 * (size_t)model->node_count;
	JN_NEW(arena, sys->external, n);
	JN_NEW(arena, sys->internal, n);
	JN_NEW(arena, sys->momenta, n);
	if (model->mass_is_diagonal) JN_NEW(arena, sys->inverse_mass, n);
	for (int k = 0; k < 3 * model->node_count; ++k) {
		if (sys->inverse_mass != NULL) sys->inverse_mass[k] = model->held[k] ? 0 : 1 / model->nodal_mass[k / 3];
		sys->external[k] = model->nodal_mass[k / 3] * model->gravity[k % 3];
		if (model->loads != NULL) sys->external[k] += model->loads[k];
	}
	sys->weight = sqrt(sys->base.space->ops->dot(sys->base.space, sys->external, sys->external));
	sys->base.is_linear_in_step = model->wind == NULL && model->repulsion == NULL;
	sys->base.depends_on_time = model->wind != NULL && jn_gusts_blow(&model->wind->gusts);
	sys->base.has_potential = model->wind == NULL;
	sys->base.mass_is_diagonal = model->mass_is_diagonal;
	sys->base.depends_on_time |= model->guide_count > 0 || model->input_count > 0;
	for (int i = 0; i < model->held_count; ++i) sys->base.depends_on_time |= model->held_list[i].motion != NULL;
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		sys->base.is_linear_in_step &= body->law->is_linear_in_step;
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

static JnStatus create(JnModel* model, const JnVariant* solver) {
	JnModelSystem* sys;
	JN_NEW(&model->arena, sys, 1);
	sys->base.ops = &system_ops;
	sys->algebra = jn_algebra_best();
	sys->model = model;
	model->system = &sys->base;
	sys->base.space = jn_host_space_create(3 * (size_t)model->node_count, model->threads);
	if (sys->base.space == NULL) return JN_OUT_OF_MEMORY;
	sys->base.space->node_entries = 3;
	JN_TRY(jn_assembly_create(model, &sys->assembly));
	JN_TRY(jn_hold_create(model, &sys->hold));
	JN_TRY(jn_damping_create(sys));
	JN_TRY(allocate(sys));
	JN_TRY(jn_stiffness_create(sys));
	const JnSolverType* type = (const JnSolverType*)solver->row;
	JN_TRY(type->create(solver->options, &model->pattern, model->held, model->threads, &sys->solver));
	if (type->attach != NULL) type->attach(sys->solver, jn_model_matrix_operator(sys));
	JN_TRY(create_unsymmetric(sys));
	jn_assembly_freeze(sys->assembly, model->rest);
	sys->base.force_floor = rounding_force(sys);
	return JN_OK;
}

// Its parts take their memory from the model's arena, which is another one meanwhile: they can be freed before the rest.
JnStatus jn_model_system_create(JnModel* model, const JnVariant* solver) {
	const JnArena arena = model->arena;
	model->arena = (JnArena){0};
	const JnStatus status = create(model, solver);
	model->system_arena = model->arena;
	model->arena = arena;
	return status;
}

void jn_model_system_destroy(JnModel* model) {
	JnModelSystem* sys = of(model->system);
	if (sys != NULL) {
		if (sys->solver != NULL) sys->solver->type->destroy(sys->solver);
		if (sys->unsymmetric != NULL) sys->unsymmetric->type->destroy(sys->unsymmetric);
		jn_stiffness_destroy(sys);
		jn_host_space_destroy(sys->base.space);
	}
	model->system = NULL;
	jn_arena_free(&model->system_arena);
}

// What is kept by stamps that the old space has handed out is forgotten too.
JnStatus jn_model_system_renew(JnModel* model, const JnVariant* solver) {
	jn_model_system_destroy(model);
	if (model->repulsion != NULL) jn_repulsion_forget(model->repulsion);
	if (model->wind != NULL) model->wind->stamp = 0;
	return jn_model_system_create(model, solver);
}

void jn_system_archive(JnSystem* sys, JnArchive* archive) {
	jn_archive_real(archive, "force_scale", &sys->force_scale);
	jn_archive_real(archive, "force_floor", &sys->force_floor);
}

void jn_model_inputs_begin(JnModel* model, double t, double dt) {
	if (model->input_count == 0) return;
	for (int i = 0; i < model->input_count; ++i) jn_input_begin(&model->inputs[i], t, dt);
	of(model->system)->hold.t = NAN;
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
