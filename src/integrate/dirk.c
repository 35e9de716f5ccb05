// Diagonally implicit Runge-Kutta methods on M a = f(t, x, v) (HO section 3.2, equations 7 to 9).
//
// Stage i, with h = a_ii dt and stage derivatives U_i = dx/dt, V_i = dv/dt:
//   v~ = v + dt sum_{j<i} a_ij V_j,   x~ = x + dt sum_{j<i} a_ij U_j + h v~
//   M V_i = f(t + c_i dt, x~ + h^2 V_i, v~ + h V_i),   U_i = v~ + h V_i
// and  x+ = x + dt sum b_i U_i,  v+ = v + dt sum b_i V_i,  which is the last stage itself when b = last row of A.
#include "integrate/dirk.h"
#include "base/space.h"
#include "integrate/dirk_tableau.h"
#include "integrate/integrator.h"

/// Work vectors: x~, v~, then U_i and V_i of each stage.
enum { STAGE_X, STAGE_V, DERIVATIVES, VECTORS = DERIVATIVES + 2 * JN_MAX_STAGES };

static JnVec rate_x(const JnIntegrator* self, int i) {
	return self->vectors[DERIVATIVES + 2 * i];
}

static JnVec rate_v(const JnIntegrator* self, int i) {
	return self->vectors[DERIVATIVES + 2 * i + 1];
}

// out = base + dt sum_{j < count} weight_j rate_j + extra * also
static void add_rates(const JnIntegrator* self, JnVec (*rate)(const JnIntegrator*, int), const double* base, double dt,
					  int count, const double weight[], JnTerm also, JnVec out) {
	JnTerm terms[JN_MAX_STAGES + 2] = {{1, base}};
	int n = 1;
	for (int j = 0; j < count; ++j)
		if (weight[j] != 0) terms[n++] = (JnTerm){dt * weight[j], rate(self, j)};
	if (also.scale != 0) terms[n++] = also;
	self->space->ops->combine(self->space, out, n, terms);
}

static const JnTerm nothing = {0, NULL};

// The first stage, where it is the start itself: the stamp comes along, so that its forces are known.
static JnStatus explicit_stage(JnIntegrator* self, JnStep* step) {
	JnState* s = step->end;
	jn_state_copy(self->space, step->start, s);
	JN_TRY(jn_acceleration(self, step->sys, s, rate_v(self, 0)));
	self->space->ops->combine(self->space, rate_x(self, 0), 1, (JnTerm[]){{1, s->v}});
	return JN_OK;
}

static JnStatus implicit_stage(JnIntegrator* self, JnStep* step, int i) {
	const JnTableau* table = self->type->table;
	const double h = table->a[i][i] * step->dt;
	JnVec x = self->vectors[STAGE_X], v = self->vectors[STAGE_V], a = rate_v(self, i);
	add_rates(self, rate_v, step->start->v, step->dt, i, table->a[i], nothing, v);
	add_rates(self, rate_x, step->start->x, step->dt, i, table->a[i], (JnTerm){h, v}, x);
	const JnStage stage = {.t = step->start->t + table->c[i] * step->dt, .kx = h * h, .kv = h, .x = x, .v = v};
	JN_TRY(jn_stage_solve(self, step->sys, &stage, step->end, a, &step->report));
	self->space->ops->combine(self->space, rate_x(self, i), 1, (JnTerm[]){{1, step->end->v}});
	return JN_OK;
}

static bool ends_on_last_stage(const JnTableau* table) {
	for (int j = 0; j < table->stages; ++j)
		if (table->b[j] != table->a[table->stages - 1][j]) return false;
	return true;
}

// The largest entry of the embedded estimate of the error in position. Those of TR-BDF2 grow with stiffness: they are given
// as they are, not filtered.
static double estimate_error(JnIntegrator* self, const JnStep* step) {
	const JnTableau* table = self->type->table;
	JnTerm terms[JN_MAX_STAGES + 1];
	int count = 0;
	if (!table->has_embedded) return 0;
	if (table->has_start_estimate) terms[count++] = (JnTerm){step->dt * table->error_start, step->start->v};
	for (int i = 0; i < table->stages; ++i) {
		const double weight = table->has_start_estimate ? table->error_stage[i] : table->b[i] - table->b_embedded[i];
		terms[count++] = (JnTerm){step->dt * weight, rate_x(self, i)};
	}
	JnVec error = self->vectors[STAGE_X];
	self->space->ops->combine(self->space, error, count, terms);
	step->sys->ops->hold(step->sys, error); // held nodes are where they should be
	return self->space->ops->max(self->space, error);
}

static JnStatus dirk_step(JnIntegrator* self, JnStep* step) {
	const JnTableau* table = self->type->table;
	step->sys->report = &step->report;
	self->step_stamp = step->start->stamp;
	for (int i = 0; i < table->stages; ++i)
		JN_TRY(i == 0 && table->a[0][0] == 0 ? explicit_stage(self, step) : implicit_stage(self, step, i));
	if (!ends_on_last_stage(table)) {
		add_rates(self, rate_x, step->start->x, step->dt, table->stages, table->b, nothing, step->end->x);
		add_rates(self, rate_v, step->start->v, step->dt, table->stages, table->b, nothing, step->end->v);
	}
	step->end->t = step->start->t + step->dt;
	step->sys->ops->prescribe(step->sys, step->end, NULL);
	if (!ends_on_last_stage(table)) jn_state_touch(self->space, step->end);
	step->report.error = estimate_error(self, step);
	return jn_state_check(self->space, step->end);
}

static void dirk_properties(const void* table, JnTableauProperties* out) {
	*out = jn_tableau_properties(table);
}

// force_weight: a_ii^2 of the last implicit stage (math of the force-error controller, w for a method with that stage).
#define DIRK(method, p, diagonal, is_overshooting, words)                                                              \
	const JnIntegratorType jn_##method = {                                                                             \
		.row = {.name = #method, .doc = (words)},                                                                      \
		.needs = JN_NEEDS_TANGENT,                                                                                     \
		.order = (p),                                                                                                  \
		.force_weight = (diagonal) * (diagonal),                                                                       \
		.overshoots = (is_overshooting),                                                                               \
		.vectors = VECTORS,                                                                                            \
		.table = &jn_tableau_##method,                                                                                 \
		.properties = dirk_properties,                                                                                 \
		.step = dirk_step,                                                                                             \
	};

DIRK(backward_euler, 1, 1, false, "one solve; very robust, damps strongly")
DIRK(sdirk2, 2, 0.2928932188134525, false, "Alexander 1977: two solves, one matrix; the default for low damping")
DIRK(sdirk3, 3, 0.4358665215084590, false, "Alexander 1977: three solves, third order")
DIRK(tr_bdf2, 2, 0.2928932188134525, false, "Bank et al. 1985: two solves; keeps its order on stiff rotating bodies")
DIRK(tr_bdf2_b, 2, 1.0 / 3, false, "Bathe 2007: trapezoid then BDF2 at half the step; two matrices")
DIRK(sdirk_ncs23, 3, 0.7886751345948129, false, "Norsett, Crouzeix: two solves, third order, not stiffly accurate")
DIRK(sdirk_nc34, 4, 1.068579021301629, false, "Norsett, Crouzeix: three solves, fourth order, not stiffly accurate")
DIRK(sdirk_3345, 3, 1.068579021301629, false, "Franco, Gomez, Randez 1997: low dispersion, for smooth oscillations")
DIRK(sdirk_4347, 3, 1.280579761275305, false,
	 "Franco, Gomez, Randez 1997: lowest dissipation, for smooth oscillations at small steps")
DIRK(implicit_midpoint, 2, 0.5, false, "one solve; no numerical damping at all, symplectic")
DIRK(trapezoid, 2, 0.5, false, "one solve; no numerical damping, Newmark with beta = 1/4 and gamma = 1/2")
DIRK(esdirk324, 3, 0.4358665215084590, false, "Kennedy, Carpenter 2019: three solves, third order, stage order two")
DIRK(esdirk325, 3, 0.225, true, "Kennedy, Carpenter 2019: four solves, third order, small phase error")
DIRK(esdirk436, 4, 0.25, true, "Kennedy, Carpenter 2019: five solves, fourth order, the most accurate here per solve")
