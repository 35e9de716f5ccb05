// With f_i the elastic forces on an element's nodes, the mean of its Cauchy stress over its volume v is
//
//   sigma = -1/v sum_i f_i (x) x_i        (virtual work of a uniform velocity gradient),
//
// so that a kernel's forces are all that is needed, whatever its law.
#include "view_elastic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "model/model.h"
#include "scene/scene.h"

enum { BATCHES = 32, MOST_SETS = 256 };

// ---- the model ----

// The overrides that a run has left as comments at the end of the text.
static JnStatus find_sets(JnArena* arena, const char* text, const char** sets, int* count) {
	static const char mark[] = "# --set ";
	*count = 0;
	for (const char* line = text; line != NULL && *count < MOST_SETS;) {
		const char* end = strchr(line, '\n');
		const bool is_set = strncmp(line, mark, sizeof mark - 1) == 0;
		if (!is_set && *line != '\0') *count = 0; // only those behind everything else are overrides
		if (is_set) {
			char* set = jn_arena_text(arena, line + sizeof mark - 1);
			if (set == NULL) return JN_OUT_OF_MEMORY;
			set[strcspn(set, "\n")] = '\0';
			sets[(*count)++] = set;
		}
		line = end != NULL ? end + 1 : NULL;
	}
	return JN_OK;
}

static JnStatus check_model(const JnModel* model, int node_count, const double* rest) {
	if (model == NULL) return jn_error(JN_BAD_INPUT, "the scene has no bodies");
	double size = 0, apart = 0;
	for (int i = 0; model->node_count == node_count && i < 3 * node_count; ++i) {
		size = fmax(size, fabs(rest[i]));
		apart = fmax(apart, fabs(rest[i] - model->rest[i]));
	}
	if (model->node_count == node_count && apart <= 1e-9 * size) return JN_OK; // rounding of another machine's meshes
	return jn_error(JN_BAD_INPUT, "the recorded scene gives another mesh now than the one that was recorded");
}

static JnStatus take_buffers(ViewElastic* elastic) {
	const JnModel* model = elastic->model;
	size_t most = 1;
	for (int g = 0; g < model->group_count; ++g) {
		const size_t batch = 3 * (size_t)model->groups[g].kernel->nodes * (size_t)model->groups[g].kernel->width;
		if (batch > most) most = batch;
	}
	JN_NEW(&elastic->arena, elastic->buffer, most * BATCHES);
	JN_NEW(&elastic->arena, elastic->sums, model->node_count + 1);
	JN_NEW(&elastic->arena, elastic->weights, model->node_count + 1);
	return JN_OK;
}

JnStatus view_elastic_open(ViewElastic* elastic, const char* path, const char* text, int node_count,
						   const double* rest) {
	const char** sets;
	int count;
	*elastic = (ViewElastic){0};
	JN_NEW(&elastic->arena, sets, MOST_SETS);
	JN_TRY(find_sets(&elastic->arena, text, sets, &count));
	JN_TRY(jn_scene_parse(path, text, count, sets, &elastic->scene));
	JN_TRY(jn_scene_build(elastic->scene, 1, &elastic->sim));
	elastic->model = jn_sim_model(elastic->sim);
	JN_TRY(check_model(elastic->model, node_count, rest));
	return take_buffers(elastic);
}

void view_elastic_close(ViewElastic* elastic) {
	jn_sim_destroy(elastic->sim);
	jn_scene_destroy(elastic->scene);
	jn_arena_free(&elastic->arena);
	*elastic = (ViewElastic){0};
}

// ---- sums over elements ----

static void clear(ViewElastic* elastic) {
	const size_t bytes = (size_t)elastic->model->node_count * sizeof(double);
	memset(elastic->sums, 0, bytes);
	memset(elastic->weights, 0, bytes);
}

static void divide(const ViewElastic* elastic, double* values) {
	for (int i = 0; i < elastic->model->node_count; ++i)
		values[i] = elastic->weights[i] > 0 ? elastic->sums[i] / elastic->weights[i] : VIEW_ABSENT;
}

typedef void MeetBatches(ViewElastic* elastic, const JnBody* body, JnGroup* group, int first, int last,
						 const double* x);

static void each_group(ViewElastic* elastic, const JnBody* body, const double* x, MeetBatches* meet) {
	for (int g = body->first_group; g < body->first_group + body->group_count; ++g) {
		JnGroup* group = &elastic->model->groups[g];
		for (int first = 0; first < group->batches; first += BATCHES) {
			const int last = first + BATCHES < group->batches ? first + BATCHES : group->batches;
			if (group->kernel->freeze != NULL) group->kernel->freeze(group, first, last, x);
			meet(elastic, body, group, first, last, x);
		}
	}
}

// ---- energy ----

static bool can_break(const JnModel* model, const JnBody* body) {
	for (int g = body->first_group; g < body->first_group + body->group_count; ++g)
		if (model->groups[g].kernel->damage != NULL) return true;
	return false;
}

static bool is_surface(const JnBody* body) {
	return body->mesh.shape == JN_TRI3;
}

// Each element gives its nodes equal shares.
static void add_energies(ViewElastic* elastic, const JnBody* body, JnGroup* group, int first, int last,
						 const double* x) {
	const int width = group->kernel->width, nodes = group->kernel->nodes;
	(void)body;
	group->kernel->energy(group, first, last, x, elastic->buffer);
	for (int e = first * width; e < last * width && e < group->count; ++e)
		for (int i = 0; i < nodes; ++i)
			elastic->sums[jn_group_node(group, e, i)] += elastic->buffer[e - first * width] / nodes;
}

// Volumes, or areas, at rest.
static void add_volumes(ViewElastic* elastic, const JnBody* body) {
	const int nodes = jn_shape_info[body->mesh.shape].nodes;
	for (int cell = 0; cell < body->mesh.cell_count; ++cell) {
		const double volume = fabs(jn_mesh_cell_volume(&body->mesh, cell));
		for (int i = 0; i < nodes; ++i) elastic->weights[body->cells[(ptrdiff_t)cell * nodes + i]] += volume / nodes;
	}
}

void view_elastic_energy(ViewElastic* elastic, const double* x, double* values) {
	const JnModel* model = elastic->model;
	bool has_solid = false;
	clear(elastic);
	for (int b = 0; b < model->body_count; ++b) has_solid |= !is_surface(&model->bodies[b]);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		if (body->mesh.shape == JN_POINT1 || can_break(model, body) || (has_solid && is_surface(body))) continue;
		each_group(elastic, body, x, add_energies);
		add_volumes(elastic, body);
	}
	divide(elastic, values);
}

// ---- stress ----

static double von_mises(double sigma[3][3]) {
	const double mean = (sigma[0][0] + sigma[1][1] + sigma[2][2]) / 3;
	double square = 0;
	for (int a = 0; a < 3; ++a)
		for (int b = 0; b < 3; ++b) {
			const double deviator = 0.5 * (sigma[a][b] + sigma[b][a]) - (a == b ? mean : 0);
			square += deviator * deviator;
		}
	return sqrt(1.5 * square);
}

// Forces sum to 0, so that positions may be taken from the first node: no digits are lost far from the origin.
static double element_stress(const JnGroup* group, int element, const double* forces, const double* x, double volume) {
	const int width = group->kernel->width;
	const double* origin = x + 3 * (ptrdiff_t)jn_group_node(group, element, 0);
	double sigma[3][3] = {0};
	for (int i = 1; i < group->kernel->nodes; ++i) {
		const double* at = x + 3 * (ptrdiff_t)jn_group_node(group, element, i);
		for (int a = 0; a < 3; ++a)
			for (int b = 0; b < 3; ++b) sigma[a][b] -= forces[(3 * i + a) * width] * (at[b] - origin[b]) / volume;
	}
	return von_mises(sigma);
}

// Elements need not stand in the order of the cells.
static double element_volume(const JnBody* body, const JnGroup* group, int element, const double* x) {
	enum { MOST_NODES = 10 };
	int cell[MOST_NODES];
	for (int i = 0; i < group->kernel->nodes; ++i) cell[i] = jn_group_node(group, element, i);
	return jn_mesh_cell_volume(&(JnMesh){.shape = body->mesh.shape, .nodes = (double*)x, .cells = cell}, 0);
}

static void add_stresses(ViewElastic* elastic, const JnBody* body, JnGroup* group, int first, int last,
						 const double* x) {
	const int width = group->kernel->width, nodes = group->kernel->nodes;
	if (group->kernel->law == NULL || group->count != body->mesh.cell_count) return;
	group->kernel->force(group, first, last, x, elastic->buffer);
	for (int e = first * width; e < last * width && e < group->count; ++e) {
		const double volume = element_volume(body, group, e, x);
		if (!(volume > 0)) continue;
		const double* forces = elastic->buffer + (ptrdiff_t)(e / width - first) * 3 * nodes * width + e % width;
		const double stress = element_stress(group, e, forces, x, volume);
		for (int i = 0; i < nodes; ++i) {
			elastic->sums[jn_group_node(group, e, i)] += volume * stress;
			elastic->weights[jn_group_node(group, e, i)] += volume;
		}
	}
}

void view_elastic_stress(ViewElastic* elastic, const double* x, double* values) {
	const JnModel* model = elastic->model;
	clear(elastic);
	for (int b = 0; b < model->body_count; ++b)
		if (model->bodies[b].mesh.shape < JN_SOLID_SHAPE_COUNT) each_group(elastic, &model->bodies[b], x, add_stresses);
	divide(elastic, values);
}
