// Relaxation (EX, "Simulation update logic"; Macklin, Mueller, Chentanez: XPBD, 2016): positions move onto the lengths at
// rest, element by element, as Gauss-Seidel. With the measure C of an element, its gradient g_i by node i, w_i = 1/m_i and
// alpha' = alpha / dt^2, a projection is (equations 17 and 18)
//
//   d = (-C - alpha' lambda) / (sum w_i |g_i|^2 + alpha'),   lambda += d,   x_i += w_i g_i d,
//
// with lambda summed over the sweeps of a step. The gradients of an element sum to zero and do not change when it turns, so
// that sum m_i dx_i and sum x_i x m_i dx_i vanish: momentum and angular momentum stay as they are. Held coordinates have
// w = 0.
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "force/relax.h"
#include "model/model.h"
#include "pass/pass.h"

enum { FOLLOW, KEEP };          // velocity
enum { BEFORE, AFTER };         // order
enum { STRAIN_CHUNK = 64 * 8 }; // elements whose strains are looked at together

typedef struct RelaxGroup {
	JnGroup group;
	double* lambda; // [batches][W]
	bool is_length; // C is a length, and alpha acts; volumes are rigid
} RelaxGroup;

// What a correction came to.
typedef struct Tally {
	double before, after; // largest stretch [-]
	double moved;         // largest displacement of a node [m]
} Tally;

typedef struct Relax {
	JnPass base;
	JnArena arena; // everything, this struct included
	const JnRelaxDef* def;
	JnModel* model;
	int group_count;
	RelaxGroup* groups;
	double* inverse_mass; // 3 * nodes [1/kg]
	double* predicted;    // 3 * nodes [m]
	Tally tried, kept;    // of the attempt; of the last accepted step
} Relax;

static const JnPassColumn columns[] = {
	{"relax.stretch_before", "", false}, {"relax.stretch_after", "", false}, {"relax.displacement", "m", false}};

enum { COLUMNS = sizeof columns / sizeof *columns };

static Relax* of(JnPass* base) {
	return (Relax*)base;
}

static double largest_strain(const RelaxGroup* relaxed, const double* x) {
	const JnGroup* group = &relaxed->group;
	const int step = STRAIN_CHUNK / group->kernel->width;
	double most = 0, strain[STRAIN_CHUNK];
	for (int first = 0; first < group->batches; first += step) {
		const int last = first + step < group->batches ? first + step : group->batches;
		group->kernel->strain(group, first, last, x, strain);
		for (int k = 0; k < (last - first) * group->kernel->width; ++k) most = strain[k] > most ? strain[k] : most;
	}
	return most;
}

static double largest_stretch(const Relax* pass, const double* x) {
	double most = 0;
	for (int g = 0; g < pass->group_count; ++g)
		if (pass->groups[g].is_length) most = fmax(most, largest_strain(&pass->groups[g], x));
	return most;
}

static void sweep(Relax* pass, double dt, double* x) {
	for (int g = 0; g < pass->group_count; ++g) {
		RelaxGroup* relaxed = &pass->groups[g];
		const JnGroup* group = &relaxed->group;
		const JnRelaxation how = {.inverse_mass = pass->inverse_mass,
								  .compliance = relaxed->is_length ? pass->def->compliance / (dt * dt) : 0,
								  .factor = pass->def->factor};
		group->kernel->relax(group, 0, group->batches, &how, x, relaxed->lambda);
	}
}

static void clear_lambda(Relax* pass) {
	for (int g = 0; g < pass->group_count; ++g) {
		const JnGroup* group = &pass->groups[g].group;
		memset(pass->groups[g].lambda, 0, (size_t)group->batches * (size_t)group->kernel->width * sizeof(double));
	}
}

static double largest_move(const Relax* pass, const double* x) {
	double most = 0;
	for (int node = 0; node < pass->model->node_count; ++node) {
		double square = 0;
		for (int k = 3 * node; k < 3 * node + 3; ++k) square += pow(x[k] - pass->predicted[k], 2);
		most = fmax(most, square);
	}
	return sqrt(most);
}

// Over the step that was wanted: what is left of earlier steps moves in a step that was cut short, too, and would give it
// speeds without bounds.
static void follow(const Relax* pass, const JnStep* step) {
	const double dt = fmax(step->dt, step->wanted);
	JnState* end = step->end;
	for (int k = 0; k < 3 * pass->model->node_count; ++k) end->v[k] += (end->x[k] - pass->predicted[k]) / dt;
}

static JnStatus correct(JnPass* base, JnStep* step, int round, bool* edited, bool* again) {
	Relax* pass = of(base);
	JnState* end = step->end;
	(void)round;
	(void)again;
	memcpy(pass->predicted, end->x, 3 * (size_t)pass->model->node_count * sizeof *end->x);
	pass->tried.before = largest_stretch(pass, end->x);
	clear_lambda(pass);
	for (int i = 0; i < pass->def->sweeps; ++i) sweep(pass, step->dt, end->x);
	pass->tried.after = largest_stretch(pass, end->x);
	pass->tried.moved = largest_move(pass, end->x);
	*edited = pass->tried.moved > 0;
	if (!*edited) return JN_OK;
	if (pass->def->velocity == FOLLOW) follow(pass, step);
	jn_state_touch(step->sys->space, end);
	return JN_OK;
}

static void commit(JnPass* base, const JnStep* step) {
	(void)step;
	of(base)->kept = of(base)->tried;
}

static void measure(const JnPass* base, double* values) {
	const Tally* kept = &((const Relax*)base)->kept;
	const double all[COLUMNS] = {kept->before, kept->after, kept->moved};
	memcpy(values, all, sizeof all);
}

static void archive_tally(JnPass* base, JnArchive* archive) {
	jn_archive_bytes(archive, "relax", &of(base)->kept, sizeof of(base)->kept);
}

static void destroy(JnPass* base) {
	JnArena arena = of(base)->arena;
	jn_arena_free(&arena);
}

// ---- building ----

static unsigned kinds_of(const JnRelaxDef* def) {
	return (def->springs ? JN_RELAXED_SPRINGS : 0u) | (def->axis ? JN_RELAXED_AXIS : 0u) |
		   (def->volumes ? JN_RELAXED_VOLUMES : 0u);
}

static JnStatus add_body(Relax* pass, const JnBody* body) {
	JnGroups made;
	if (body->law->relaxed == NULL) return JN_OK;
	JN_TRY(body->law->relaxed(kinds_of(pass->def), &body->mesh, body->first_node, &pass->arena, &made));
	for (int g = 0; g < made.count; ++g) {
		RelaxGroup* relaxed = &pass->groups[pass->group_count++];
		relaxed->group = made.list[g];
		relaxed->is_length = strcmp(made.list[g].kernel->name, "volume") != 0;
		JN_NEW(&pass->arena, relaxed->lambda, (size_t)made.list[g].batches * (size_t)made.list[g].kernel->width);
	}
	return JN_OK;
}

// With consistent mass, w is that of the row sums: relaxation needs a number a node.
static JnStatus weigh(Relax* pass) {
	const JnModel* model = pass->model;
	JN_NEW(&pass->arena, pass->inverse_mass, 3 * (size_t)model->node_count);
	for (int k = 0; k < 3 * model->node_count; ++k)
		pass->inverse_mass[k] = model->held[k] || model->nodal_mass[k / 3] <= 0 ? 0 : 1 / model->nodal_mass[k / 3];
	return JN_OK;
}

static JnStatus build(Relax* pass) {
	const JnModel* model = pass->model;
	if (kinds_of(pass->def) == 0)
		return jn_error(JN_BAD_INPUT,
						"relax.axis: neither axis nor springs nor volumes are to relax; set one of them to yes, "
						"or take 'relax' out");
	JN_NEW(&pass->arena, pass->groups, JN_RELAX_COUNT * (size_t)model->body_count);
	for (int b = 0; b < model->body_count; ++b) JN_TRY(add_body(pass, &model->bodies[b]));
	if (pass->group_count == 0)
		return jn_error(JN_BAD_INPUT,
						"relax: no body has what is to relax; threads of law constraints or rod have an axis, and "
						"bodies of those laws springs and volumes: set relax.springs to yes, or take 'relax' "
						"out");
	JN_NEW(&pass->arena, pass->predicted, 3 * (size_t)model->node_count);
	return weigh(pass);
}

static JnStatus create(const JnRelaxDef* def, const JnPassType* type, JnModel* model, JnPass** out) {
	JnArena arena = {0};
	Relax* pass;
	*out = NULL;
	JN_NEW(&arena, pass, 1);
	pass->arena = arena;
	pass->base.type = type;
	pass->def = def;
	pass->model = model;
	const JnStatus status = build(pass);
	if (status == JN_OK)
		*out = &pass->base;
	else
		destroy(&pass->base);
	return status;
}

static JnStatus create_before(const void* options, JnModel* model, JnPass** out) {
	const JnRelaxDef* def = options;
	return def->order == BEFORE ? create(def, &jn_pass_relax_before, model, out) : JN_OK;
}

static JnStatus create_after(const void* options, JnModel* model, JnPass** out) {
	const JnRelaxDef* def = options;
	return def->order == AFTER ? create(def, &jn_pass_relax_after, model, out) : JN_OK;
}

static const char* const velocity_names[] = {"follow", "keep", NULL};
static const char* const order_names[] = {"before", "after", NULL};

const JnKey jn_relax_keys[] = {
	{.name = "sweeps",
	 .kind = JN_INTEGER,
	 .field = offsetof(JnRelaxDef, sweeps),
	 .value = {10},
	 .low = 1,
	 .high = 10000,
	 .meaning = "times that all elements are relaxed after a step, one behind the other; more of them stretch less"},
	{.name = "axis",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnRelaxDef, axis),
	 .value = {1},
	 .meaning = "relax the lengths of threads along their axis, which leaves bending to the springs"},
	{.name = "springs",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnRelaxDef, springs),
	 .meaning = "relax the lengths of all springs, as in the paper; with many sweeps they hold a thread rigid, bending "
				"included"},
	{.name = "volumes",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnRelaxDef, volumes),
	 .meaning = "relax the volumes of tetrahedra, after the lengths in each sweep; without compliance"},
	{.name = "compliance",
	 .kind = JN_REAL,
	 .field = offsetof(JnRelaxDef, compliance),
	 .high = INFINITY,
	 .open = JN_OPEN_HIGH,
	 .unit = "m/N",
	 .meaning = "what lengths give in relaxation, the inverse of a stiffness; 0: as much as the sweeps leave"},
	{.name = "factor",
	 .kind = JN_REAL,
	 .field = offsetof(JnRelaxDef, factor),
	 .value = {1},
	 .high = 2,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .remedy = "use 1, or some 1.5 for few sweeps on long threads",
	 .meaning = "every correction is multiplied by this (over-relaxation)"},
	{.name = "velocity",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnRelaxDef, velocity),
	 .names = velocity_names,
	 .meaning =
		 "follow: velocities change by the displacement over the step; keep: they stay as the integrator left them, "
		 "which lets a hanging thread gain speed without end"},
	{.name = "order",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnRelaxDef, order),
	 .names = order_names,
	 .meaning = "before: integrate, relax, then contact, as in the paper; after: contact first"},
	{0},
};

#define RELAX_TYPE(creator)                                                                                            \
	{                                                                                                                  \
		.row = {.name = "relax",                                                                                       \
				.doc = "moves positions onto lengths and volumes at rest after every step",                            \
				.keys = jn_relax_keys,                                                                                 \
				.options_size = sizeof(JnRelaxDef)},                                                                   \
		.definition = offsetof(JnSimDef, relax), .create = (creator), .destroy = destroy, .correct = correct,          \
		.commit = commit, .archive = archive_tally, .column_count = COLUMNS, .columns = columns, .measure = measure,   \
	}

const JnPassType jn_pass_relax_before = RELAX_TYPE(create_before);
const JnPassType jn_pass_relax_after = RELAX_TYPE(create_after);
