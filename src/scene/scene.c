// The root keys of a scene file, and loading.
#include "jounce/scene.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"
#include "control/controller.h"
#include "integrate/integrator.h"
#include "scene/scene.h"
#include "solve/solver.h"

static const JnKey probe_keys[] = {
	{.name = "name",
	 .kind = JN_TEXT,
	 .field = offsetof(JnProbeDef, name),
	 .required = true,
	 .meaning = "names the columns probe.<name>.x, .y, .z"},
	{.name = "at",
	 .kind = JN_REAL3,
	 .field = offsetof(JnProbeDef, at),
	 .required = true,
	 .unit = "m",
	 .meaning = "rest position; the nearest node is followed"},
	{0},
};

static const JnKey record_keys[] = {
	{.name = "interval",
	 .kind = JN_REAL,
	 .field = offsetof(JnRecordDef, interval),
	 .value = {1.0 / 30},
	 .low = 0,
	 .high = 1e6,
	 .unit = "s",
	 .meaning = "simulated time between frames of positions and velocities; 0 for every step"},
	{.name = "plots",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnRecordDef, plots),
	 .value = {1},
	 .meaning = "draw plots of energy, energy error, step size and Newton iterations at the end"},
	{0},
};

const JnKey jn_scene_keys[] = {
	{.name = "name",
	 .kind = JN_TEXT,
	 .field = offsetof(JnSceneDef, name),
	 .meaning = "of the scene; the file's name when absent"},
	{.name = "description", .kind = JN_TEXT, .field = offsetof(JnSceneDef, description), .meaning = "free text"},
	{.name = "duration",
	 .kind = JN_REAL,
	 .field = offsetof(JnSceneDef, sim.duration),
	 .required = true,
	 .low = 0,
	 .high = 1e9,
	 .open = JN_OPEN_LOW,
	 .unit = "s",
	 .meaning = "simulated time"},
	{.name = "gravity",
	 .kind = JN_REAL3,
	 .field = offsetof(JnSceneDef, sim.model.gravity),
	 .value = {0, -9.81, 0},
	 .unit = "m/s^2",
	 .meaning = "acceleration of gravity; y is up"},
	{.name = "bodies",
	 .kind = JN_LIST,
	 .field = offsetof(JnSceneDef, sim.model.bodies),
	 .required = true,
	 .keys = jn_body_keys,
	 .size = sizeof(JnBodyDef),
	 .meaning = "the deformable bodies"},
	{.name = "integrator",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnSceneDef, sim.integrator),
	 .text = "sdirk2",
	 .rows = &jn_integrator_list,
	 .tag = "method",
	 .meaning = "the time integration method"},
	{.name = "newton",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnSceneDef, sim.newton),
	 .keys = jn_newton_keys,
	 .meaning = "how implicit stages are solved"},
	{.name = "step",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnSceneDef, sim.step),
	 .text = "fixed",
	 .rows = &jn_controller_list,
	 .tag = "controller",
	 .meaning = "the time step and who chooses it"},
	{.name = "solver",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnSceneDef, sim.model.solver),
	 .text = "direct",
	 .rows = &jn_solver_list,
	 .tag = "method",
	 .meaning = "the linear solver"},
	{.name = "probes",
	 .kind = JN_LIST,
	 .field = offsetof(JnSceneDef, probes),
	 .keys = probe_keys,
	 .size = sizeof(JnProbeDef),
	 .meaning = "points whose positions go into the series"},
	{.name = "record",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnSceneDef, record),
	 .keys = record_keys,
	 .meaning = "what is recorded"},
	{0},
};

// Names become parts of paths, columns and HDF5 groups.
static JnStatus check_name(const char* path, const char* what, const char* name) {
	for (const char* c = name; *c != '\0'; ++c)
		if (!isalnum((unsigned char)*c) && *c != '_' && *c != '-')
			return jn_error(JN_BAD_INPUT, "%s: %s: '%s' has the character '%c'; use letters, digits, _ and -", path,
							what, name, *c);
	return *name != '\0' ? JN_OK : jn_error(JN_BAD_INPUT, "%s: %s: empty; give it a name", path, what);
}

static JnStatus check_names(const char* path, const JnSceneDef* def) {
	JN_TRY(check_name(path, "name", def->name));
	const JnBodyDef* bodies = def->sim.model.bodies.data;
	for (int i = 0; i < def->sim.model.bodies.count; ++i) JN_TRY(check_name(path, "bodies.name", bodies[i].name));
	const JnProbeDef* probes = def->probes.data;
	for (int i = 0; i < def->probes.count; ++i) {
		JN_TRY(check_name(path, "probes.name", probes[i].name));
		for (int j = 0; j < i; ++j)
			if (strcmp(probes[i].name, probes[j].name) == 0)
				return jn_error(JN_BAD_INPUT, "%s: probes[%d].name: '%s' is taken by probes[%d]; use another", path, i,
								probes[i].name, j);
	}
	return JN_OK;
}

// The file's name without folder and extension.
static const char* stem(const char* path, JnArena* arena) {
	const char* slash = strrchr(path, '/');
	char* name = jn_arena_text(arena, slash != NULL ? slash + 1 : path);
	char* dot = name != NULL ? strrchr(name, '.') : NULL;
	if (dot != NULL && dot != name) *dot = '\0';
	return name;
}

static JnStatus load(JnScene* scene, const char* path, int set_count, const char* const sets[]) {
	JN_TRY(jn_document_read(path, &scene->arena, &scene->document));
	for (int i = 0; i < set_count; ++i) JN_TRY(jn_document_set(&scene->document, sets[i]));
	JN_NEW(&scene->arena, scene->sets, set_count + 1);
	for (int i = 0; i < set_count; ++i) {
		scene->sets[i] = jn_arena_text(&scene->arena, sets[i]);
		if (scene->sets[i] == NULL) return JN_OUT_OF_MEMORY;
	}
	scene->set_count = set_count;
	JN_TRY(jn_keys_read(jn_scene_keys, scene->document.root, "", &scene->arena, &scene->def));
	if (scene->def.name == NULL) scene->def.name = stem(path, &scene->arena);
	if (scene->def.name == NULL) return JN_OUT_OF_MEMORY;
	return check_names(path, &scene->def);
}

JnStatus jn_scene_load(const char* path, int set_count, const char* const sets[], JnScene** out) {
	*out = NULL;
	JnScene* scene = calloc(1, sizeof *scene);
	if (scene == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: scene");
	const JnStatus status = load(scene, path, set_count, sets);
	if (status == JN_OK)
		*out = scene;
	else
		jn_scene_destroy(scene);
	return status;
}

void jn_scene_destroy(JnScene* scene) {
	if (scene == NULL) return;
	jn_arena_free(&scene->arena);
	free(scene);
}

const JnSceneDef* jn_scene_def(const JnScene* scene) {
	return &scene->def;
}

const char* jn_scene_path(const JnScene* scene) {
	return scene->document.path;
}
