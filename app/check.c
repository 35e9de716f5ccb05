// jounce check: everything that `run` does before its first step, without writing anything.
#include <stdio.h>

#include "app.h"
#include "jounce/scene.h"
#include "options.h"

static const char help[] =
	"usage: jounce check SCENE [--set key=value ...]\n\n"
	"Reads the scene, builds meshes, elements and constraints, and reports what it would simulate. Runs nothing.";

static JnStatus check(const SceneOptions* options) {
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	JN_TRY(jn_scene_load(options->scene, options->set_count, options->sets, &scene));
	const JnSceneDef* def = jn_scene_def(scene);
	const JnStatus status = jn_sim_create(&def->sim, options->threads, &sim);
	if (status == JN_OK) {
		const JnModel* model = jn_sim_model(sim);
		printf("%s: ok: '%s', %d bodies, %d nodes, %.6g kg, %s over %g s\n", options->scene, def->name,
			   def->sim.model.bodies.count, jn_model_node_count(model), jn_model_mass(model),
			   def->sim.integrator.row->name, def->sim.duration);
	}
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status;
}

int app_check(int count, char** arguments) {
	SceneOptions options;
	int status = scene_options_read("check", count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE)
		status = app_exit_status(check(&options));
	scene_options_free(&options);
	return status;
}
