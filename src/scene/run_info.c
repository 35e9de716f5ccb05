// What a run records: its columns, bodies and text, and the row of numbers of each step.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "detect/obstacle_surface.h"
#include "mesh/boundary.h"
#include "mesh/embed.h"
#include "model/model.h"
#include "model/system_list.h"
#include "scene/place.h"
#include "scene/run.h"
#include "solve/blas.h"

// The columns that every run has, in this order; then those of the system or of passes, and three for each probe.
static const JnColumn fixed_columns[] = {
	{"step", "", true},
	{"t", "s", false},
	{"dt", "s", false},
	{"kinetic", "J", false},
	{"elastic", "J", false},
	{"gravity", "J", false},
	{"total", "J", false},
	{"specific_error", "J/kg", false},
	{"newton", "", true},
	{"factorizations", "", true},
	{"solves", "", true},
	{"iterations", "", true},
	{"rejected", "", true},
	{"minimized", "", true},
	{"momentum.x", "kg m/s", false},
	{"momentum.y", "kg m/s", false},
	{"momentum.z", "kg m/s", false},
	{"angular.x", "kg m^2/s", false},
	{"angular.y", "kg m^2/s", false},
	{"angular.z", "kg m^2/s", false},
};
enum { FIXED_COLUMNS = sizeof fixed_columns / sizeof *fixed_columns };

// The built-in system that is simulated; NULL: a model is.
static const JnSystemType* system_of(const JnRun* run) {
	return (const JnSystemType*)run->scene->def.sim.system.row;
}

// Columns of passes, or of the system.
static int more_columns(const JnRun* run) {
	int passes, count = system_of(run) != NULL ? system_of(run)->column_count : 0;
	JnPass* const* list = jn_sim_passes(run->sim, &passes);
	for (int i = 0; i < passes; ++i) count += list[i]->type->column_count;
	return count;
}

static JnColumn* copy_columns(int count, const JnPassColumn* from, JnColumn* to) {
	for (int k = 0; k < count; ++k) *to++ = (JnColumn){from[k].name, from[k].unit, from[k].is_count};
	return to;
}

static void name_more_columns(const JnRun* run, JnColumn* columns) {
	int passes;
	const JnSystemType* system = system_of(run);
	JnPass* const* list = jn_sim_passes(run->sim, &passes);
	if (system != NULL) columns = copy_columns(system->column_count, system->columns, columns);
	for (int i = 0; i < passes; ++i)
		columns = copy_columns(list[i]->type->column_count, list[i]->type->columns, columns);
}

static JnStatus name_fields(JnRun* run) {
	int passes, count = 0;
	JnPass* const* list = jn_sim_passes(run->sim, &passes);
	JnField* fields;
	for (int i = 0; i < passes; ++i) count += list[i]->type->field_count;
	JN_NEW(&run->arena, fields, count + 1);
	JN_NEW(&run->arena, run->fields, count + 1);
	run->info.fields = fields;
	run->info.field_count = count;
	for (int i = 0; i < passes; ++i)
		for (int k = 0; k < list[i]->type->field_count; ++k) {
			const JnPassField* field = &list[i]->type->fields[k];
			*fields++ = (JnField){.name = field->name, .unit = field->unit, .components = field->components};
		}
	return JN_OK;
}

void jn_run_find_fields(JnRun* run) {
	int passes;
	JnPass* const* list = jn_sim_passes(run->sim, &passes);
	const double** fields = run->fields;
	for (int i = 0; i < passes; ++i)
		for (int k = 0; k < list[i]->type->field_count; ++k) *fields++ = list[i]->type->field(list[i], k);
}

static double* measure_more(const JnRun* run, double* values) {
	int passes;
	const JnSystemType* system = system_of(run);
	if (system != NULL) {
		system->measure(run->scene->def.sim.system.options, jn_sim_state(run->sim), values);
		values += system->column_count;
	}
	JnPass* const* list = jn_sim_passes(run->sim, &passes);
	for (int i = 0; i < passes; ++i) {
		list[i]->type->measure(list[i], values);
		values += list[i]->type->column_count;
	}
	return values;
}

static JnStatus find_probes(JnRun* run, const JnModel* model) {
	const JnItems* defs = &run->scene->def.probes;
	JnPlacing placing;
	JN_NEW(&run->arena, run->probes, defs->count + 1);
	jn_placing_begin(&placing, &run->scene->document);
	JnStatus status = JN_OK;
	for (int i = 0; i < defs->count && status == JN_OK; ++i)
		status = jn_probe_create((const JnProbeDef*)defs->data + i, i, model, &run->arena, &run->probes[i]);
	jn_placing_end(&placing);
	return status;
}

static JnStatus name_columns(JnRun* run) {
	const JnItems* probes = &run->scene->def.probes;
	JnColumn* columns;
	const int first_probe = FIXED_COLUMNS + more_columns(run);
	run->info.column_count = first_probe + 3 * probes->count;
	JN_NEW(&run->arena, columns, run->info.column_count);
	JN_NEW(&run->arena, run->values, run->info.column_count);
	memcpy(columns, fixed_columns, sizeof fixed_columns);
	name_more_columns(run, columns + FIXED_COLUMNS);
	for (int i = 0; i < probes->count; ++i) {
		const JnProbeDef* probe = (const JnProbeDef*)probes->data + i;
		for (int axis = 0; axis < 3; ++axis) {
			char name[256];
			snprintf(name, sizeof name, "probe.%s.%c", probe->name, 'x' + axis);
			JnColumn* column = &columns[first_probe + 3 * i + axis];
			*column = (JnColumn){.name = jn_arena_text(&run->arena, name), .unit = "m"};
			if (column->name == NULL) return JN_OUT_OF_MEMORY;
		}
	}
	run->info.columns = columns;
	return JN_OK;
}

// The surface that the cells carry along, or else the outer faces of the cells.
static JnStatus describe_surface(const JnBody* body, JnArena* arena, JnRecordBody* record) {
	record->embedding = body->mesh.embedding;
	if (record->embedding != NULL) {
		record->triangle_count = record->embedding->surface.triangle_count;
		record->triangles = record->embedding->surface.triangles;
		return JN_OK;
	}
	int* triangles = NULL;
	JN_TRY(jn_mesh_boundary(&body->mesh, arena, &record->triangle_count, &triangles));
	for (int i = 0; i < 3 * record->triangle_count; ++i) triangles[i] += body->first_node;
	record->triangles = triangles;
	return JN_OK;
}

static JnStatus list_bodies(JnRun* run, const JnModel* model) {
	JnRecordBody* bodies;
	JN_NEW(&run->arena, bodies, model->body_count);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		bodies[b] = (JnRecordBody){.name = body->name,
								   .shape = body->mesh.shape,
								   .first_node = body->first_node,
								   .node_count = body->mesh.node_count,
								   .cell_count = body->mesh.cell_count,
								   .cells = body->cells,
								   .thread = body->mesh.thread,
								   .volumes = body->mesh.volumes};
		JN_TRY(describe_surface(body, &run->arena, &bodies[b]));
	}
	run->info.body_count = model->body_count;
	run->info.bodies = bodies;
	return JN_OK;
}

static JnTreeBox box_of(const JnModel* model) {
	JnTreeBox box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
	for (int k = 0; k < 3 * model->node_count; ++k) {
		box.low[k % 3] = fmin(box.low[k % 3], model->rest[k]);
		box.high[k % 3] = fmax(box.high[k % 3], model->rest[k]);
	}
	return box;
}

static JnStatus list_obstacles(JnRun* run, const JnModel* model) {
	JnRecordObstacle* obstacles;
	const JnTreeBox box = box_of(model);
	JN_NEW(&run->arena, obstacles, model->obstacle_count);
	for (int i = 0; i < model->obstacle_count; ++i) {
		obstacles[i].name = model->obstacles[i].name;
		JN_TRY(jn_obstacle_surface(&model->obstacles[i].shape, &box, &run->arena, &obstacles[i].surface));
	}
	run->info.obstacle_count = model->obstacle_count;
	run->info.obstacles = obstacles;
	return JN_OK;
}

// The file's text with the overrides as comments at its end.
static JnStatus annotate_text(JnRun* run) {
	const JnScene* scene = run->scene;
	const size_t text_length = strlen(scene->document.text);
	const bool is_open = text_length > 0 && scene->document.text[text_length - 1] != '\n';
	size_t length = text_length + 2;
	for (int i = 0; i < scene->set_count; ++i) length += strlen(scene->sets[i]) + 16;
	char* text;
	JN_NEW(&run->arena, text, length);
	char* end = text + snprintf(text, length, "%s%s", scene->document.text, is_open ? "\n" : "");
	for (int i = 0; i < scene->set_count; ++i)
		end += snprintf(end, length - (size_t)(end - text), "# --set %s\n", scene->sets[i]);
	run->info.scene_text = text;
	return JN_OK;
}

static JnStatus describe_model(JnRun* run, const JnModel* model) {
	run->info.node_count = model->node_count;
	run->info.nodes = model->rest;
	memcpy(run->info.gravity, model->gravity, sizeof run->info.gravity);
	JN_TRY(list_bodies(run, model));
	JN_TRY(list_obstacles(run, model));
	return find_probes(run, model);
}

// Nodes without cells, which rest where they start.
static JnStatus describe_system(JnRun* run) {
	const JnSystemType* system = system_of(run);
	const size_t length = jn_sim_system(run->sim)->space->length;
	double *x, *v;
	JN_NEW(&run->arena, x, length);
	JN_NEW(&run->arena, v, length);
	system->start(run->scene->def.sim.system.options, x, v);
	run->info.node_count = (int)(length / 3);
	run->info.nodes = x;
	return JN_OK;
}

JnStatus jn_run_describe(JnRun* run) {
	char* blas;
	JN_NEW(&run->arena, blas, 96);
	jn_blas_name(blas, 96);
	run->info.directory = run->options->directory;
	run->info.scene_name = run->scene->def.name;
	run->info.scene_path = run->scene->document.path;
	run->info.method = run->scene->def.sim.integrator.row->name;
	run->info.wants_plots = run->scene->def.record.plots;
	run->info.total_mass = jn_sim_mass(run->sim);
	run->info.threads = jn_sim_threads(run->sim);
	run->info.simd_width = jn_kernel_best_width();
	run->info.blas = blas;
	JN_TRY(annotate_text(run));
	JN_TRY(system_of(run) != NULL ? describe_system(run) : describe_model(run, jn_sim_model(run->sim)));
	JN_TRY(name_fields(run));
	return name_columns(run);
}

JnStatus jn_run_measure(JnRun* run) {
	const JnReport* report = jn_sim_last_report(run->sim);
	const JnState* state = jn_sim_state(run->sim);
	const JnEnergies e = jn_sim_energies(run->sim);
	const double total = e.kinetic + e.elastic + e.gravity;
	const bool at_start = jn_sim_steps(run->sim) == 0;
	if (at_start) run->total_at_start = total;
	run->end.specific_error = fabs(total - run->total_at_start) / run->info.total_mass;
	run->end.specific_error_max = fmax(run->end.specific_error_max, run->end.specific_error);
	const double values[FIXED_COLUMNS] = {(double)jn_sim_steps(run->sim),
										  state->t,
										  jn_sim_last_dt(run->sim),
										  e.kinetic,
										  e.elastic,
										  e.gravity,
										  total,
										  run->end.specific_error,
										  at_start ? 0 : report->newton,
										  at_start ? 0 : report->factorizations,
										  at_start ? 0 : report->solves,
										  at_start ? 0 : report->iterations,
										  at_start ? 0 : report->rejected,
										  at_start ? 0 : report->minimized,
										  e.momentum[0],
										  e.momentum[1],
										  e.momentum[2],
										  e.angular[0],
										  e.angular[1],
										  e.angular[2]};
	memcpy(run->values, values, sizeof values);
	double* probes = measure_more(run, run->values + FIXED_COLUMNS);
	for (int i = 0; i < run->scene->def.probes.count; ++i) jn_probe_position(&run->probes[i], state->x, probes + 3 * i);
	return jn_sim_watch(run->sim, &e);
}
