// Fracture: elements whose strain is too large break when a step is accepted, and only then, so that an attempt that is
// thrown away breaks nothing. The energy they held at that moment leaves the elastic energy and is counted. What the
// system knew about forces and K at the end of the step, and the integrator about its history, is then out of date: the
// state is given a new stamp.
#include <string.h>

#include "base/parallel.h"
#include "model/model.h"
#include "pass/fragments.h"
#include "pass/pass.h"

enum { CHUNK = 4096, GRAIN = 8192 }; // elements: of a chunk, and those that make another thread worth waking

// What is known of the elements of one group.
typedef struct Elements {
	JnGroup* group;
	bool* is_broken;
	int chunks;
	int* count;       // broken in a chunk by the last step
	double* released; // their energy [J]
} Elements;

typedef struct Fracture {
	JnPass base;
	JnArena arena; // everything, this struct included
	const JnFractureDef* def;
	JnModel* model;
	int group_count;
	Elements* groups; // those that can break
	int* list;        // numbers of broken elements, chunk by chunk
	bool* is_member;  // of a node: some element that can break has it
	int *made, *lost; // elements of a node: at the start, and broken since
	double* damage;   // lost / made
	bool* is_debris;  // it has lost so much that the rest goes as well
	JnFragments fragments;
	bool are_fragments_old;
	long last_count, count; // elements broken by the last step, and in all
	int damaged_count;      // nodes that lost one
	double released;        // energy of all that broke [J]
} Fracture;

static const JnPassColumn columns[] = {{"fracture.broken", "", true},          {"fracture.broken_total", "", true},
									   {"fracture.energy", "J", false},        {"fracture.damaged_points", "", true},
									   {"fracture.fragments", "", true},       {"fracture.loose_points", "", true},
									   {"fracture.largest_fragment", "", true}};
static const JnPassField fields[] = {{"damage", "", 1}, {"fragment", "", 1}};

enum { COLUMNS = sizeof columns / sizeof *columns, FIELDS = sizeof fields / sizeof *fields };

static Fracture* of(JnPass* base) {
	return (Fracture*)base;
}

static void break_chunks(Elements* elements, const double* x, const bool* doomed, int threads, int* list) {
	JnGroup* group = elements->group;
	const int step = CHUNK / group->kernel->width;
	const int team = jn_threads_for((size_t)group->count, GRAIN, threads);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int c = 0; c < elements->chunks; ++c) {
		const int first = c * step, last = first + step < group->batches ? first + step : group->batches;
		elements->released[c] = 0;
		elements->count[c] =
			group->kernel->damage(group, first, last, x, doomed, list + (ptrdiff_t)c * CHUNK, &elements->released[c]);
	}
}

static void lose(Fracture* pass, int node) {
	pass->damaged_count += pass->lost[node] == 0;
	++pass->lost[node];
	pass->damage[node] = (double)pass->lost[node] / pass->made[node];
}

static void count_broken(Fracture* pass, Elements* elements) {
	const JnKernel* kernel = elements->group->kernel;
	for (int c = 0; c < elements->chunks; ++c) {
		pass->released += elements->released[c];
		pass->last_count += elements->count[c];
		for (int k = 0; k < elements->count[c]; ++k) {
			const int element = pass->list[(ptrdiff_t)c * CHUNK + k];
			elements->is_broken[element] = true;
			for (int i = 0; i < kernel->nodes; ++i) lose(pass, jn_group_node(elements->group, element, i));
		}
	}
}

// A point that hangs on by a bond or two, and spins, would set the steps of the whole body. True when more are found.
static bool find_debris(Fracture* pass) {
	bool is_more = false;
	if (pass->def->debris >= 1) return false;
	for (int node = 0; node < pass->model->node_count; ++node) {
		if (pass->is_debris[node] || pass->made[node] == 0 || pass->damage[node] < pass->def->debris) continue;
		pass->is_debris[node] = true;
		is_more |= pass->lost[node] < pass->made[node];
	}
	return is_more;
}

static void break_groups(Fracture* pass, const double* x, const bool* doomed) {
	for (int g = 0; g < pass->group_count; ++g) {
		break_chunks(&pass->groups[g], x, doomed, pass->model->threads, pass->list);
		count_broken(pass, &pass->groups[g]);
	}
}

static void commit(JnPass* base, const JnStep* step) {
	Fracture* pass = of(base);
	pass->last_count = 0;
	if (step->end->t < pass->def->start * (1 - 1e-9)) return;
	break_groups(pass, step->end->x, NULL);
	while (pass->last_count > 0 && find_debris(pass)) break_groups(pass, step->end->x, pass->is_debris);
	pass->count += pass->last_count;
	if (pass->last_count == 0) return;
	pass->are_fragments_old = true;
	jn_state_touch(step->sys->space, step->end);
}

static void find_fragments(Fracture* pass) {
	if (!pass->are_fragments_old) return;
	jn_fragments_begin(&pass->fragments);
	for (int g = 0; g < pass->group_count; ++g)
		jn_fragments_join(&pass->fragments, pass->groups[g].group, pass->groups[g].is_broken);
	jn_fragments_count(&pass->fragments, pass->is_member);
	pass->are_fragments_old = false;
}

static void measure(const JnPass* base, double* values) {
	Fracture* pass = of((JnPass*)base);
	find_fragments(pass);
	const double all[COLUMNS] = {(double)pass->last_count, (double)pass->count,   pass->released,
								 pass->damaged_count,      pass->fragments.count, pass->fragments.loose_count,
								 pass->fragments.largest};
	memcpy(values, all, sizeof all);
}

static const double* field(const JnPass* base, int index) {
	Fracture* pass = of((JnPass*)base);
	if (index == 0) return pass->damage;
	find_fragments(pass);
	return pass->fragments.number;
}

// Which elements are broken the model remembers: they have no force any more.
static void archive_fracture(JnPass* base, JnArchive* archive) {
	Fracture* pass = of(base);
	const size_t nodes = (size_t)pass->model->node_count;
	for (int g = 0; g < pass->group_count; ++g)
		jn_archive_bytes(archive, "is_broken", pass->groups[g].is_broken, (size_t)pass->groups[g].group->count);
	jn_archive_bytes(archive, "lost", pass->lost, nodes * sizeof *pass->lost);
	jn_archive_reals(archive, "damage", pass->damage, nodes);
	jn_archive_bytes(archive, "is_debris", pass->is_debris, nodes * sizeof *pass->is_debris);
	jn_archive_long(archive, "last_count", &pass->last_count);
	jn_archive_long(archive, "broken", &pass->count);
	jn_archive_integer(archive, "damaged", &pass->damaged_count);
	jn_archive_real(archive, "released", &pass->released);
	pass->are_fragments_old = true;
}

static void destroy(JnPass* base) {
	JnArena arena = of(base)->arena;
	jn_arena_free(&arena);
}

static JnStatus add_group(Fracture* pass, JnGroup* group) {
	Elements* elements = &pass->groups[pass->group_count++];
	*elements = (Elements){.group = group, .chunks = (group->count + CHUNK - 1) / CHUNK};
	JN_NEW(&pass->arena, elements->is_broken, group->count);
	JN_NEW(&pass->arena, elements->count, elements->chunks);
	JN_NEW(&pass->arena, elements->released, elements->chunks);
	for (int e = 0; e < group->count; ++e)
		for (int i = 0; i < group->kernel->nodes; ++i) {
			const int node = jn_group_node(group, e, i);
			pass->is_member[node] = true;
			++pass->made[node];
		}
	return JN_OK;
}

static JnStatus build(Fracture* pass) {
	JnModel* model = pass->model;
	int largest = 0;
	JN_NEW(&pass->arena, pass->groups, model->group_count);
	JN_NEW(&pass->arena, pass->is_member, model->node_count);
	JN_NEW(&pass->arena, pass->made, model->node_count);
	JN_NEW(&pass->arena, pass->lost, model->node_count);
	JN_NEW(&pass->arena, pass->damage, model->node_count);
	JN_NEW(&pass->arena, pass->is_debris, model->node_count);
	JN_TRY(jn_fragments_create(model->node_count, &pass->arena, &pass->fragments));
	for (int g = 0; g < model->group_count; ++g) {
		if (model->groups[g].kernel->damage == NULL) continue;
		JN_TRY(add_group(pass, &model->groups[g]));
		largest = model->groups[g].count > largest ? model->groups[g].count : largest;
	}
	JN_NEW(&pass->arena, pass->list, largest + 1);
	pass->are_fragments_old = true;
	return JN_OK;
}

static bool can_break(const JnModel* model) {
	for (int g = 0; g < model->group_count; ++g)
		if (model->groups[g].kernel->damage != NULL) return true;
	return false;
}

static JnStatus create(const void* options, JnModel* model, JnPass** out) {
	JnArena arena = {0};
	Fracture* pass;
	*out = NULL;
	if (!can_break(model)) return JN_OK;
	JN_NEW(&arena, pass, 1);
	pass->arena = arena;
	pass->base.type = &jn_pass_fracture;
	pass->def = options;
	pass->model = model;
	const JnStatus status = build(pass);
	if (status == JN_OK)
		*out = &pass->base;
	else
		destroy(&pass->base);
	return status;
}

const JnKey jn_fracture_keys[] = {
	{.name = "start",
	 .kind = JN_REAL,
	 .field = offsetof(JnFractureDef, start),
	 .low = 0,
	 .high = 1e9,
	 .unit = "s",
	 .meaning = "nothing breaks before this time, so that bodies can be loaded first"},
	{.name = "debris",
	 .kind = JN_REAL,
	 .field = offsetof(JnFractureDef, debris),
	 .value = {1},
	 .low = 0,
	 .high = 1,
	 .open = JN_OPEN_LOW,
	 .remedy = "use 1 to keep all bonds that do not break by themselves, or some 0.8",
	 .meaning =
		 "points that have lost this share of their bonds lose the rest and fly on as dust: one that hangs on by a "
		 "bond or two, and spins, sets the steps of all; 1: none"},
	{0},
};

const JnPassType jn_pass_fracture = {
	.row = {.name = "fracture",
			.doc = "breaks what accepted steps strain too much, such as bonds of peridynamic bodies",
			.keys = jn_fracture_keys,
			.options_size = sizeof(JnFractureDef)},
	.definition = offsetof(JnSimDef, fracture),
	.is_always = true,
	.create = create,
	.destroy = destroy,
	.commit = commit,
	.archive = archive_fracture,
	.column_count = COLUMNS,
	.columns = columns,
	.measure = measure,
	.field_count = FIELDS,
	.fields = fields,
	.field = field,
};
