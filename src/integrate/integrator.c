#include "integrate/integrator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "integrate/stage.h"

static int vector_count(const JnIntegratorType* type) {
	return type->vectors + JN_STAGE_VECTORS;
}

JnStatus jn_integrator_accepts(const JnIntegratorType* type, const JnSystem* sys) {
	if ((type->needs & JN_NEEDS_DIAGONAL_MASS) != 0 && !sys->mass_is_diagonal)
		return jn_error(JN_BAD_INPUT,
						"integrator.method: %s is explicit and needs a diagonal mass matrix; set mass: lumped in every "
						"body (--set bodies[0].mass=lumped), or choose an implicit method",
						type->row.name);
	if ((type->needs & JN_NEEDS_TANGENT) != 0 && (sys->ops->linearize == NULL || sys->ops->matrix == NULL))
		return jn_error(
			JN_BAD_INPUT,
			"integrator.method: %s needs the tangent of the forces, which this system does not give; choose "
			"an explicit method",
			type->row.name);
	return JN_OK;
}

JnIntegrator* jn_integrator_create(const JnVariant* choice, const JnNewtonDef* newton, JnSpace* space) {
	JnIntegrator* self = calloc(1, sizeof *self);
	if (self == NULL) {
		jn_error(JN_OUT_OF_MEMORY, "out of memory: integrator");
		return NULL;
	}
	self->type = (const JnIntegratorType*)choice->row;
	self->options = choice->options;
	self->newton = *newton;
	self->space = space;
	const int count = vector_count(self->type);
	self->vectors = calloc((size_t)count, sizeof *self->vectors);
	if (self->type->memory_size > 0) self->memory = calloc(1, self->type->memory_size);
	bool is_complete = self->vectors != NULL && (self->memory != NULL || self->type->memory_size == 0);
	if (!is_complete) jn_error(JN_OUT_OF_MEMORY, "out of memory: integrator %s", self->type->row.name);
	for (int i = 0; is_complete && i < count; ++i) {
		self->vectors[i] = space->ops->create(space);
		is_complete = self->vectors[i] != NULL;
	}
	if (is_complete) return self;
	jn_integrator_destroy(self);
	return NULL;
}

void jn_integrator_destroy(JnIntegrator* self) {
	if (self == NULL) return;
	for (int i = 0; self->vectors != NULL && i < vector_count(self->type); ++i)
		self->space->ops->destroy(self->space, self->vectors[i]);
	free(self->vectors);
	free(self->memory);
	free(self);
}

void jn_integrator_forget(JnIntegrator* self) {
	self->linearized = 0;
	self->curvature = 0;
	self->recent_count = 0;
	memset(self->guess_error, 0, sizeof self->guess_error);
}

void jn_integrator_reset(JnIntegrator* self) {
	if (self->memory != NULL) memset(self->memory, 0, self->type->memory_size);
}

// Solutions that first guesses are made of, the latest first.
static void archive_recent(JnIntegrator* self, JnArchive* archive) {
	JnVec* recent = self->vectors + self->type->vectors + JN_STAGE_RECENT;
	self->recent_count = jn_archive_count(archive, "recent", self->recent_count, 0);
	if (self->recent_count > JN_RECENT_COUNT) {
		self->recent_count = 0;
		jn_archive_refuse(archive, "recent", "is more than there can be");
	}
	for (int i = 0; i < self->recent_count; ++i)
		jn_archive_reals(archive, "acceleration", recent[i], self->space->length);
	jn_archive_reals(archive, "recent_t", self->recent_t, JN_RECENT_COUNT);
	jn_archive_reals(archive, "recent_dot", self->recent_dot[0], (size_t)JN_RECENT_COUNT * JN_RECENT_COUNT);
	jn_archive_reals(archive, "guess_error", self->guess_error, sizeof self->guess_error / sizeof *self->guess_error);
	jn_archive_real(archive, "curvature", &self->curvature);
}

void jn_integrator_archive(JnIntegrator* self, JnArchive* archive) {
	const bool has_history = self->memory != NULL;
	if (has_history) jn_archive_bytes(archive, "history", self->memory, self->type->memory_size);
	for (int i = 0; has_history && i < self->type->vectors; ++i)
		jn_archive_reals(archive, "vector", self->vectors[i], self->space->length);
	if ((self->type->needs & JN_NEEDS_TANGENT) != 0) archive_recent(self, archive);
	if (archive->is_reading) self->linearized = 0;
}

JnStatus jn_acceleration(JnIntegrator* self, JnSystem* sys, JnState* s, JnVec a) {
	JnSpace* space = sys->space;
	JnVec* work = self->vectors + self->type->vectors;
	JnVec f = work[JN_STAGE_RESIDUAL], inertia = work[JN_STAGE_MASS], free_part = work[JN_STAGE_STEP];
	JnMatrix* mass = NULL;
	JN_TRY(sys->ops->matrix(sys, (JnShift){.mass = 1}, &mass));
	JN_TRY(sys->ops->force(sys, s, f));
	if (sys->mass_is_diagonal) {
		JN_TRY(mass->ops->solve(mass, f, a));
		sys->ops->prescribe(sys, s, a); // rewrites the held entries of s with the values that they have
		return isfinite(space->ops->max(space, a)) ? JN_OK : JN_NOT_FINITE;
	}
	space->ops->combine(space, a, 0, NULL);
	sys->ops->prescribe(sys, s, a);
	mass->ops->apply(mass, a, inertia);
	space->ops->combine(space, f, 2, (JnTerm[]){{1, f}, {-1, inertia}});
	sys->ops->hold(sys, f);
	JN_TRY(mass->ops->solve(mass, f, free_part));
	space->ops->combine(space, a, 2, (JnTerm[]){{1, a}, {1, free_part}});
	return isfinite(space->ops->max(space, a)) ? JN_OK : JN_NOT_FINITE;
}

const double* jn_integrator_residual(const JnIntegrator* self) {
	return self->vectors[self->type->vectors + JN_STAGE_RESIDUAL];
}

JnStatus jn_state_check(JnSpace* space, const JnState* s) {
	const bool is_finite = isfinite(space->ops->max(space, s->x)) && isfinite(space->ops->max(space, s->v));
	return is_finite ? JN_OK : JN_NOT_FINITE;
}

static const char* const modes[] = {"root", "linear", "minimize", "auto", NULL};
static const char* const reuses[] = {"auto", "never", NULL};
static const char* const guesses[] = {"zero", "last", "linear", "parallel", "auto", NULL};

const JnKey jn_newton_keys[] = {
	{.name = "mode",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnNewtonDef, mode),
	 .names = modes,
	 .value = {3},
	 .meaning =
		 "root: Newton on the residual with a line search; linear: one Newton step from zero acceleration; minimize: "
		 "Newton on the energy of the step, for hard states; auto: root, and minimize where that stalls"},
	{.name = "tolerance",
	 .kind = JN_REAL,
	 .field = offsetof(JnNewtonDef, tolerance),
	 .value = {1e-8},
	 .low = 0,
	 .high = 1,
	 .open = JN_OPEN_LOW,
	 .meaning = "residual norm at which a stage is solved, relative to the weight or the internal forces"},
	{.name = "max_iterations",
	 .kind = JN_INTEGER,
	 .field = offsetof(JnNewtonDef, max_iterations),
	 .value = {200},
	 .low = 1,
	 .high = 10000,
	 .meaning =
		 "iterations a stage; as many once more before the step counts as failed: by minimize in mode auto, from "
		 "zero with a tangent each in mode root"},
	{.name = "reuse",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnNewtonDef, reuse),
	 .names = reuses,
	 .meaning = "auto: keep a tangent and its factor while they serve (quasi-Newton); never: a new one an iteration"},
	{.name = "guess",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnNewtonDef, guess),
	 .names = guesses,
	 .value = {4},
	 .meaning =
		 "first guess of a stage's acceleration: zero; the last one found; the line through the last two; parallel: "
		 "that of the same stage a step ago, moved as the last one has moved since a step ago; auto: whichever of "
		 "these was nearest of late"},
	{0},
};
