// The verbs of contact. The corrector of HO section 4 (equations 19 and 20, in the form that keeps the order of the
// predictor): with C = M + h D + h^2 K at the predicted end, K definite, h = theta dt,
//
//   min 1/2 (v - vp)' C (v - vp)  with  G v >= g,      x = xp + h (v - vp)
//
// Without impulses v = vp and x = xp, bit for bit, body by body.
//
// `prediction: free` is the paper's: theta = 1, the impulses act like forces in Backward Euler, whatever the integrator,
// and lose energy like it. `carried` lets the contact forces of the last step act in the prediction as a load, so that the
// integrator itself carries what lasts, and corrects the change alone: vp in the problem is vp - dt C^-1 load, so that the
// impulses stay the whole ones. With theta = 1/2 the change would act like a force in the midpoint rule, whose work is that
// of the contact's displacement and nothing else. But then what sticks keeps its velocity, with another sign each step, and
// the map of a linear bar in contact, load included, has a spectral radius of up to 1.24 with SDIRK2 (1.09 at 0.55, 1 from
// 0.6 on, over all steps). Methods that `overshoot` have no such theta: `auto` leaves them free.
// Methods of first order keep theta = 1, as forces act like that in them.
// `iterated` predicts again with the forces just found, until they change no more: the end is then the integrator's own.
#include "pass/contact.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"

static const double settled = 1e-3; // relative change of forces at which rounds end
static const double lever = 0.6;    // theta; see the top

static const double easy = 4; // margins that nodes may move within a step, where corrections have come to no end

static JnContactPass* of(JnPass* pass) {
	return (JnContactPass*)pass;
}

// What the method allows: see the top.
static JnStatus choose_prediction(JnContactPass* pass, const JnIntegratorType* method) {
	const int chosen = pass->def->prediction;
	pass->prediction = chosen;
	if (chosen == JN_PREDICTION_AUTO)
		pass->prediction = method->overshoots ? JN_PREDICTION_FREE : JN_PREDICTION_CARRIED;
	pass->theta = pass->prediction == JN_PREDICTION_FREE || method->order < 2 ? 1 : lever;
	if (pass->prediction == JN_PREDICTION_FREE || !method->overshoots) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"contact.prediction: %s forces would grow from step to step with %s; use auto or free",
					chosen == JN_PREDICTION_CARRIED ? "carried" : "iterated", method->row.name);
}

// The first round predicts with the forces of the last step; the others with those that `correct` has left in `tried`.
static JnStatus prepare(JnPass* base, const JnStep* step, int round) {
	JnContactPass* pass = of(base);
	if (round == 0) {
		JN_TRY(choose_prediction(pass, step->method));
		pass->is_loaded = pass->prediction != JN_PREDICTION_FREE && pass->total.pressing > 0;
		if (pass->is_loaded) memcpy(pass->tried, pass->load, jn_contact_entries(pass) * sizeof *pass->tried);
	}
	jn_model_system_set_load(pass->model, JN_LOAD_OF_CONTACT, pass->is_loaded ? pass->tried : NULL);
	return JN_OK;
}

// force = G' lambda / dt
static void find_forces(const JnContactPass* pass, double dt, double* force) {
	const JnContactRows* rows = &pass->now;
	const JnContactProblem problem = jn_contact_geometry(rows);
	memset(force, 0, jn_contact_entries(pass) * sizeof *force);
	for (int i = 0; i < rows->count; ++i)
		if (rows->lambda[i][0] > 0) jn_contact_add_impulse(&problem, i, rows->lambda[i], force);
	for (size_t k = 0; k < jn_contact_entries(pass); ++k) force[k] /= dt;
}

// The forces found differ from those that acted in the prediction.
static bool has_changed(const JnContactPass* pass, const double* force) {
	double change = 0, size = 0;
	for (size_t k = 0; k < jn_contact_entries(pass); ++k) {
		const double tried = pass->is_loaded ? pass->tried[k] : 0;
		change = fmax(change, fabs(force[k] - tried));
		size = fmax(size, fmax(fabs(force[k]), fabs(tried)));
	}
	return change > settled * size;
}

static JnStatus correct(JnPass* base, JnStep* step, int round, bool* edited, bool* again) {
	JnContactPass* pass = of(base);
	pass->has_failed = false;
	pass->passed = 0;
	pass->tally = (JnContactTally){.rounds = round + 1};
	JN_TRY(jn_contact_correct(pass, step));
	find_forces(pass, step->dt, pass->force);
	const bool may_go_on = pass->prediction == JN_PREDICTION_ITERATED && round + 1 < pass->def->rounds;
	if (may_go_on && has_changed(pass, pass->force)) {
		memcpy(pass->tried, pass->force, jn_contact_entries(pass) * sizeof *pass->tried);
		pass->is_loaded = true;
		*again = true;
		return JN_OK;
	}
	const bool acts = pass->tally.pressing > 0 || pass->is_loaded;
	double before = acts ? jn_contact_energy(pass, step->end) : 0;
	if (pass->is_loaded) before -= jn_contact_work(pass, pass->tried, step, false);
	*edited = jn_contact_move(pass, step);
	if (acts) jn_contact_tally(pass, step, before);
	return JN_OK;
}

// The contacts become those of the last step, and the arrays change places.
static void commit(JnPass* base, const JnStep* step) {
	JnContactPass* pass = of(base);
	const JnContactRows rows = pass->kept;
	jn_contact_find_gaps(pass, step);
	pass->kept = pass->now;
	pass->now = rows;
	memcpy(pass->load, pass->force, jn_contact_entries(pass) * sizeof *pass->load);
	jn_contact_tally_add(&pass->tally, &pass->total);
}

static void archive_contact(JnPass* base, JnArchive* archive) {
	JnContactPass* pass = of(base);
	jn_contact_rows_archive(&pass->kept, archive);
	jn_archive_reals(archive, "load", pass->load, jn_contact_entries(pass));
	jn_archive_reals(archive, "gap", pass->gap, (size_t)pass->model->node_count);
	jn_archive_bytes(archive, "contact_total", &pass->total, sizeof pass->total);
}

void jn_contact_observe(JnPass* base, JnContactObserver* observer, void* user) {
	of(base)->observer = observer;
	of(base)->observer_user = user;
}

static const char* name_of(const JnContactPass* pass, const JnContact* contact) {
	return contact->other_skin == JN_OBSTACLE_SKIN ? pass->model->obstacles[contact->other].name
												   : pass->model->bodies[pass->skins[contact->other_skin].body].name;
}

// Settings of the solver that the defaults beat.
static void advise_solver(const JnContactPass* pass, size_t size, char* remedy) {
	static const JnQpDef plenty = {.tolerance = 1e-7, .max_iterations = 2000};
	const JnQpDef* def = &pass->qp->options;
	const bool is_strict = def->tolerance < plenty.tolerance || def->max_iterations < plenty.max_iterations;
	if (is_strict || pass->qp->type != &jn_qp_auto)
		snprintf(remedy, size, "contact.solver: {method: auto, max_iterations: %d, tolerance: %g}",
				 plenty.max_iterations, plenty.tolerance);
}

static void explain(const JnPass* base, JnPassComplaint* out) {
	const JnContactPass* pass = (const JnContactPass*)base;
	if (!pass->has_failed) return;
	const JnContact* contact = &pass->worst;
	const JnSkin* skin = &pass->skins[contact->vertex_skin];
	out->node = skin->nodes[(ptrdiff_t)skin->carriers * contact->vertex];
	const int used = snprintf(out->cause, sizeof out->cause, "in contact of '%.40s' with '%.40s', ",
							  pass->model->bodies[skin->body].name, name_of(pass, contact));
	char* why = out->cause + used;
	const size_t size = sizeof out->cause - (size_t)used;
	if (pass->passed > 0) {
		snprintf(why, size, "which it would enter by %.2g m, more than the margin of %.2g m", pass->passed,
				 pass->margin);
		out->share = fmin(pass->margin / pass->passed, easy * pass->margin / pass->travel);
	} else if (isfinite(pass->tally.residual)) {
		snprintf(why, size, "where a relative residual of %.2g is left, above contact.solver.tolerance, %.2g",
				 pass->tally.residual, pass->qp->options.tolerance);
		advise_solver(pass, sizeof out->remedy, out->remedy);
	} else {
		snprintf(why, size, "whose impulses are beyond all bounds");
	}
}

const JnPassType jn_pass_contact = {
	.row = {.name = "contact",
			.doc = "predictor and corrector of bodies that meet each other and obstacles",
			.keys = jn_contact_keys,
			.options_size = sizeof(JnContactDef)},
	.definition = offsetof(JnSimDef, contact),
	.create = jn_contact_create,
	.destroy = jn_contact_destroy,
	.prepare = prepare,
	.correct = correct,
	.commit = commit,
	.explain = explain,
	.archive = archive_contact,
	.column_count = JN_CONTACT_COLUMNS,
	.columns = jn_contact_columns,
	.measure = jn_contact_measure,
	.field_count = JN_CONTACT_FIELDS,
	.fields = jn_contact_fields,
	.field = jn_contact_field,
};
