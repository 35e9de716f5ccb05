// The root keys of a scene file, and loading.
#include "jounce/scene.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"
#include "model/system_list.h"
#include "pass/pass.h"
#include "scene/place.h"
#include "scene/probe.h"
#include "scene/scene.h"
#include "sim/sim_keys.h"
#include "solve/solver.h"

static const JnKey record_keys[] = {
	{.name = "interval",
	 .kind = JN_REAL,
	 .field = offsetof(JnRecordDef, interval),
	 .value = {1.0 / 30},
	 .low = 0,
	 .high = 1e6,
	 .unit = "s",
	 .meaning = "simulated time between frames of positions and velocities; 0 for every step"},
	{.name = "exact_times",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnRecordDef, exact_times),
	 .meaning = "steps are shortened to end on the times of frames; otherwise frames between steps are interpolated"},
	{.name = "plots",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnRecordDef, plots),
	 .value = {1},
	 .meaning = "draw plots of energy, energy error, step size and Newton iterations at the end"},
	{0},
};

static const JnKey checkpoint_keys[] = {
	{.name = "every",
	 .kind = JN_REAL,
	 .field = offsetof(JnCheckpointDef, every),
	 .low = 0,
	 .high = 1e9,
	 .unit = "s",
	 .meaning =
		 "simulated time between saved states, each with a file of its own; 0: after 50 to 10000 steps, fewer for "
		 "larger models, and a file every ten seconds at most"},
	{.name = "keep",
	 .kind = JN_INTEGER,
	 .field = offsetof(JnCheckpointDef, keep),
	 .value = {2},
	 .low = 1,
	 .high = 1000,
	 .meaning = "newest files that stay, in case that one is damaged"},
	{0},
};

const JnKey jn_scene_keys[] = {
	{.name = "name",
	 .kind = JN_TEXT,
	 .field = offsetof(JnSceneDef, name),
	 .meaning = "of the scene and of its folder of results; the file's name when absent"},
	{.name = "description", .kind = JN_TEXT, .field = offsetof(JnSceneDef, description), .meaning = "free text"},
	{.name = "gravity",
	 .kind = JN_REAL3,
	 .field = offsetof(JnSceneDef, sim.model.gravity),
	 .value = {0, -9.81, 0},
	 .unit = "m/s^2",
	 .meaning = "acceleration of gravity; y is up"},
	{.name = "bodies",
	 .kind = JN_LIST,
	 .field = offsetof(JnSceneDef, sim.model.bodies),
	 .keys = jn_body_keys,
	 .size = sizeof(JnBodyDef),
	 .meaning = "the deformable bodies; required unless there is a system"},
	{.name = "system",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnSceneDef, sim.system),
	 .rows = &jn_system_list,
	 .tag = "type",
	 .meaning = "equations that are simulated in place of bodies"},
	{.name = "obstacles",
	 .kind = JN_LIST,
	 .field = offsetof(JnSceneDef, sim.model.obstacles),
	 .keys = jn_obstacle_keys,
	 .size = sizeof(JnObstacleDef),
	 .meaning = "rigid things that never move, such as a floor"},
	{.name = "wind",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSceneDef, sim.model.wind),
	 .keys = jn_wind_keys,
	 .size = sizeof(JnWindDef),
	 .meaning = "air that moves past the bodies and loads their surfaces; without it there is no air"},
	{.name = "repulsion",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSceneDef, sim.model.repulsion),
	 .keys = jn_repulsion_keys,
	 .size = sizeof(JnRepulsionDef),
	 .meaning = "how points of peridynamic bodies and rigid bodies keep each other away; without it they pass through"},
	{.name = "contact",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSceneDef, sim.contact),
	 .keys = jn_contact_keys,
	 .size = sizeof(JnContactDef),
	 .meaning = "how bodies meet each other and the obstacles; without it they pass through"},
	{.name = "collision",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSceneDef, sim.collision),
	 .keys = jn_collision_keys,
	 .size = sizeof(JnCollisionDef),
	 .meaning = "how threads meet themselves, each other, bodies and obstacles; without it they pass through"},
	{.name = "suture",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSceneDef, sim.suture),
	 .keys = jn_suture_keys,
	 .size = sizeof(JnSutureDef),
	 .meaning = "a thread whose tip goes through the surface of a body, and the sites where it does"},
	{.name = "relax",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSceneDef, sim.relax),
	 .keys = jn_relax_keys,
	 .size = sizeof(JnRelaxDef),
	 .meaning =
		 "moves bodies of constraints back onto their lengths at rest after every step; without it they stretch as "
		 "their springs let them"},
	{.name = "fracture",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnSceneDef, sim.fracture),
	 .keys = jn_fracture_keys,
	 .meaning = "when bodies that can break may do so; peridynamic ones always can"},
	JN_SIM_KEY_ROWS(JnSceneDef, sim.),
	{.name = "solver",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnSceneDef, sim.model.solver),
	 .text = "auto",
	 .rows = &jn_solver_list,
	 .tag = "method",
	 .meaning = "the linear solver"},
	{.name = "probes",
	 .kind = JN_LIST,
	 .field = offsetof(JnSceneDef, probes),
	 .keys = jn_probe_keys,
	 .size = sizeof(JnProbeDef),
	 .meaning = "points whose positions go into the series"},
	{.name = "record",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnSceneDef, record),
	 .keys = record_keys,
	 .meaning = "what is recorded"},
	{.name = "checkpoint",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnSceneDef, checkpoint),
	 .keys = checkpoint_keys,
	 .meaning = "when the run saves its state, for `jounce resume`"},
	{0},
};

enum { NAME_LIMIT = 64 }; // bytes

static bool is_name_character(char c) {
	return isalnum((unsigned char)c) || c == '_' || c == '-';
}

// Names become parts of paths, columns and HDF5 groups.
static JnStatus check_name(const char* what, const char* name) {
	if (*name == '\0') return jn_error(JN_BAD_INPUT, "%s: is empty; use letters, digits, _ and -", what);
	if (strlen(name) > NAME_LIMIT)
		return jn_error(JN_BAD_INPUT, "%s: '%.20s...' is longer than %d letters; shorten it", what, name, NAME_LIMIT);
	for (const char* c = name; *c != '\0'; ++c)
		if (!is_name_character(*c))
			return jn_error(JN_BAD_INPUT, "%s: '%s' is no plain name; use only letters, digits, _ and -", what, name);
	return JN_OK;
}

static const char* body_name(const JnItems* items, int index) {
	return ((const JnBodyDef*)items->data)[index].name;
}

static const char* obstacle_name(const JnItems* items, int index) {
	return ((const JnObstacleDef*)items->data)[index].name;
}

static const char* probe_name(const JnItems* items, int index) {
	return ((const JnProbeDef*)items->data)[index].name;
}

// All names of a list are plain and differ.
static JnStatus check_list(const char* list, const JnItems* items, const char* (*name)(const JnItems*, int)) {
	char what[64];
	for (int i = 0; i < items->count; ++i) {
		snprintf(what, sizeof what, "%s[%d].name", list, i);
		JN_TRY(check_name(what, name(items, i)));
		for (int j = 0; j < i; ++j)
			if (strcmp(name(items, i), name(items, j)) == 0)
				return jn_error(JN_BAD_INPUT, "%s: '%s' is the name of %s[%d] already; use another", what,
								name(items, i), list, j);
	}
	return JN_OK;
}

static JnStatus check_names(const JnSceneDef* def) {
	JN_TRY(check_name("name", def->name));
	JN_TRY(check_list("bodies", &def->sim.model.bodies, body_name));
	JN_TRY(check_list("obstacles", &def->sim.model.obstacles, obstacle_name));
	return check_list("probes", &def->probes, probe_name);
}

// A scene without name is called after its file: without folder and extension, and what no name may hold becomes '_'.
static const char* stem(const char* path, JnArena* arena) {
	const char* slash = strrchr(path, '/');
	char* name = jn_arena_text(arena, slash != NULL ? slash + 1 : path);
	char* dot = name != NULL ? strrchr(name, '.') : NULL;
	if (dot != NULL && dot != name) *dot = '\0';
	for (char* c = name; c != NULL && *c != '\0'; ++c)
		if (!is_name_character(*c)) *c = '_';
	if (name != NULL && strlen(name) > NAME_LIMIT) name[NAME_LIMIT] = '\0';
	return name;
}

// `text` NULL: it is in the file.
static JnStatus load(JnScene* scene, const char* path, const char* text, int set_count, const char* const sets[]) {
	JN_TRY(text != NULL ? jn_document_parse(path, text, &scene->arena, &scene->document)
						: jn_document_read(path, &scene->arena, &scene->document));
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
	JnPlacing placing;
	jn_placing_begin(&placing, &scene->document);
	JnStatus status = check_names(&scene->def);
	if (status == JN_OK) status = jn_probes_check(&scene->def);
	jn_placing_end(&placing);
	return status;
}

JnStatus jn_scene_parse(const char* path, const char* text, int set_count, const char* const sets[], JnScene** out) {
	*out = NULL;
	JnScene* scene = calloc(1, sizeof *scene);
	if (scene == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: scene");
	const JnStatus status = load(scene, path, text, set_count, sets);
	if (status == JN_OK)
		*out = scene;
	else
		jn_scene_destroy(scene);
	return status;
}

JnStatus jn_scene_load(const char* path, int set_count, const char* const sets[], JnScene** scene) {
	return jn_scene_parse(path, NULL, set_count, sets, scene);
}

JnStatus jn_scene_build(const JnScene* scene, int threads, JnSim** sim) {
	JnPlacing placing;
	jn_placing_begin(&placing, &scene->document);
	const JnStatus status = jn_sim_create(&scene->def.sim, threads, sim);
	jn_placing_end(&placing);
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
