#include "export.h"

#include <math.h>
#include <string.h>

#include "force/constraint/constraints.h"
#include "mesh/thread.h"
#include "model/model.h"

static void write_triple(FILE* out, const double* a) {
	fprintf(out, " %.17g %.17g %.17g", a[0], a[1], a[2]);
}

static void write_material(FILE* out, const JnBodyDef* def, const JnBody* body) {
	if (body->mesh.thread != NULL && strcmp(def->material.row->name, "constraints") == 0) {
		const JnConstraintsDef* m = def->material.options;
		const JnThread* thread = body->mesh.thread;
		fprintf(out, "thread %.17g %.17g %.17g %.17g", m->stiffness, m->density, thread->radius, m->damping);
		write_triple(out, thread->axis);
		fputs("\n", out);
	} else if (def->material.row->options_size == sizeof(JnMaterialDef)) {
		const JnMaterialDef* m = def->material.options;
		fprintf(out, "material %.17g %.17g %.17g\n", m->density, m->young, m->poisson);
	}
}

static void write_obstacles(FILE* out, const JnModel* model) {
	for (int i = 0; i < model->obstacle_count; ++i) {
		const JnObstacle* shape = &model->obstacles[i].shape;
		if (shape->type != &jn_obstacle_plane) continue;
		const JnPlaneDef* plane = shape->geometry;
		fputs("plane", out);
		write_triple(out, plane->point);
		write_triple(out, plane->normal);
		fputs("\n", out);
	}
}

static void write_nodes(FILE* out, const JnModel* model, const JnState* start) {
	for (int i = 0; i < model->node_count; ++i) {
		fputs("node", out);
		write_triple(out, model->rest + 3 * (size_t)i);
		write_triple(out, start->v + 3 * (size_t)i);
		fprintf(out, " %.17g\n", model->nodal_mass[i]);
	}
	for (int i = 0; i < model->held_count; ++i) fprintf(out, "held %d\n", model->held_list[i].entry);
}

static void write_cells(FILE* out, const JnBody* body) {
	const JnShapeInfo* shape = &jn_shape_info[body->mesh.shape];
	for (int c = 0; c < body->mesh.cell_count; ++c) {
		fputs(shape->name, out);
		for (int k = 0; k < shape->nodes; ++k)
			fprintf(out, " %d", body->cells[(size_t)c * (size_t)shape->nodes + (size_t)k]);
		fputs("\n", out);
	}
}

static void write_probes(FILE* out, const JnItems* probes, const JnModel* model) {
	const JnProbeDef* list = probes->data;
	for (int i = 0; i < probes->count; ++i)
		if (!isnan(list[i].at[0])) fprintf(out, "probe %s %d\n", list[i].name, jn_model_nearest(model, list[i].at));
}

JnStatus peer_export(Peer* peer, const char* path) {
	const JnSceneDef* def = jn_scene_def(peer->scene);
	const JnModel* model = jn_sim_model(peer->sim);
	if (model == NULL || model->body_count != 1) return fputs("scenes for peers have one body\n", stderr), JN_BAD_INPUT;
	FILE* out = fopen(path, "w");
	if (out == NULL) return perror(path), JN_IO_FAILED;
	fputs("gravity", out);
	write_triple(out, model->gravity);
	fputs("\n", out);
	write_material(out, def->sim.model.bodies.data, model->bodies);
	write_obstacles(out, model);
	write_nodes(out, model, jn_sim_state(peer->sim));
	write_cells(out, model->bodies);
	write_probes(out, &def->probes, model);
	return fclose(out) == 0 ? JN_OK : JN_IO_FAILED;
}
