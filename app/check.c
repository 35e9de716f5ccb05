// jounce check: everything that `run` does before its first step, without writing anything.
#include <math.h>
#include <stdio.h>

#include "app.h"
#include "control/fixed.h"
#include "jounce/scene.h"
#include "model/model.h"
#include "options.h"

static const char help[] =
	"usage: jounce check SCENE [--set key=value ...] [--threads N]\n\n"
	"Reads the scene, builds meshes, elements and constraints, and reports what it would simulate. Runs nothing,\n"
	"writes nothing.";

static void print_bodies(const JnModelDef* def, const JnModel* model) {
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		const JnBodyDef* body_def = (const JnBodyDef*)def->bodies.data + b;
		printf("  body        %s: %d %s elements, %d nodes, %s\n", body->name, body->mesh.cell_count,
			   jn_shape_info[body->mesh.shape].name, body->mesh.node_count, body_def->material.row->name);
	}
	printf("  in all      %d nodes, %.6g kg, %d of %d coordinates fixed or driven\n", model->node_count,
		   model->total_mass, model->held_count, 3 * model->node_count);
}

static void print_obstacles(const JnModel* model) {
	for (int i = 0; i < model->obstacle_count; ++i) {
		const JnModelObstacle* obstacle = &model->obstacles[i];
		printf("  obstacle    %s: %s, surface %s\n", obstacle->name, obstacle->shape.type->row.name, obstacle->surface);
	}
}

// The first step is the only one that every controller knows beforehand; `fixed` keeps to it.
static void print_steps(const JnSimDef* def, const JnSim* sim) {
	const double dt = jn_sim_next_dt(sim);
	if (def->step.row == &jn_controller_fixed.row)
		printf("  steps       %.0f of %g s, to t = %g s\n", fmax(1, ceil(def->duration / dt - 1e-9)), dt,
			   def->duration);
	else
		printf("  steps       chosen by '%s', the first %g s, to t = %g s\n", def->step.row->name, dt, def->duration);
}

static void print_findings(const SceneOptions* options, const JnSceneDef* def, JnSim* sim) {
	const JnModel* model = jn_sim_model(sim);
	printf("%s: ok\n  scene       %s%s%s\n", options->scene, def->name, def->description != NULL ? ": " : "",
		   def->description != NULL ? def->description : "");
	if (model != NULL) {
		print_bodies(&def->sim.model, model);
		print_obstacles(model);
	} else {
		printf("  system      %s: %s\n", def->sim.system.row->name, def->sim.system.row->doc);
	}
	printf("  integrator  %s\n", def->sim.integrator.row->name);
	print_steps(&def->sim, sim);
}

static JnStatus check(const SceneOptions* options) {
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	JN_TRY(jn_scene_load(options->scene, options->set_count, options->sets, &scene));
	JnStatus status = jn_scene_build(scene, options->threads, &sim);
	if (status == JN_OK) print_findings(options, jn_scene_def(scene), sim);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status;
}

int app_check(int count, char** arguments) {
	SceneOptions options;
	int status = scene_options_read("check", count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE && (options.directory != NULL || options.is_quiet))
		status = app_usage_error("check", "check writes nothing and takes neither --output nor --quiet");
	else if (status == EXIT_DONE)
		status = app_exit_status(check(&options));
	scene_options_free(&options);
	return status;
}
