#include "support/golden.h"

#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/hash.h"
#include "base/processor.h"
#include "solve/blas.h"
#include "support/coarse_scene.h"
#include "support/support.h"

enum { STEPS = 8, MOST_CHANGES = 3 };

/// What makes something happen within few steps: things that fall start close to what they will meet.
typedef struct Change {
	const char* scene;
	int steps; ///< 0: STEPS
	const char* sets[MOST_CHANGES];
} Change;

static const Change changes[] = {
	{"armadillo", 2, {NULL}}, // hundreds of iterations a stage
	{"ball", 0, {"bodies[0].shape.center=[0, 0.502, 0]"}},
	{"coil", 20, {"bodies[0].shape.origin=[0, 0.006, 0]", "bodies[0].shape.links=200"}},
	{"drape", 0, {"bodies[0].shape.origin=[-0.45, 0.4005, -0.45]"}},
	{"knot", 40, {NULL}},
	{"needle", 20, {NULL}},
	{"notch", 30, {"bodies[0].shape.spacing=2 mm"}},
	{"pudding", 12, {"bodies[0].shape.origin=[0, 0.001, 0]"}},
	{"shatter", 30, {"bodies[1].shape.center=[0.013, 0.007, 0.026]"}},
	{"suture", 20, {NULL}},
	{"thread_bar", 25, {"obstacles[0].shape.from=[0, -0.026, -1]", "obstacles[0].shape.to=[0, -0.026, 1]"}},
};

static void add_changes(const char* scene, int* steps, Sets* sets) {
	*steps = STEPS;
	for (size_t i = 0; i < sizeof changes / sizeof *changes; ++i) {
		if (strcmp(changes[i].scene, scene) != 0) continue;
		if (changes[i].steps > 0) *steps = changes[i].steps;
		for (int k = 0; k < MOST_CHANGES && changes[i].sets[k] != NULL; ++k) add_set(sets, "%s", changes[i].sets[k]);
	}
}

void golden_prepare(char** arguments) {
	if (getenv("JN_THREAD_GRAIN") != NULL && getenv("OMP_WAIT_POLICY") != NULL) return;
	setenv("JN_THREAD_GRAIN", "1", 0);
	setenv("OMP_WAIT_POLICY", "passive", 0);
	execv("/proc/self/exe", arguments);
}

char** golden_scenes(const char* folder) {
	enum { MOST_SCENES = 256 };
	static glob_t found; // frees the paths that are left out, too
	static char* kept[MOST_SCENES + 1];
	char pattern[512];
	size_t count = 0;
	globfree(&found);
	snprintf(pattern, sizeof pattern, "%s/*.yaml", folder);
	if (glob(pattern, 0, NULL, &found) != 0) fail_msg("there are no scenes in %s", folder);
	for (size_t i = 0; i < found.gl_pathc && count < MOST_SCENES; ++i)
		if (strstr(found.gl_pathv[i], "_large.yaml") == NULL) kept[count++] = found.gl_pathv[i];
	kept[count] = NULL;
	return kept;
}

static void name_scene(const char* path, char name[32]) {
	const char* slash = strrchr(path, '/');
	snprintf(name, 32, "%s", slash != NULL ? slash + 1 : path);
	*strstr(name, ".yaml") = '\0';
}

static void take_bits(JnSim* sim, char text[33]) {
	const JnState* state = jn_sim_state(sim);
	const size_t length = jn_sim_system(sim)->space->length;
	for (size_t k = 0; k < length; ++k)
		if (!isfinite(state->x[k]) || !isfinite(state->v[k])) fail_msg("entry %zu is not finite", k);
	JnHash hash = jn_hash_add(jn_hash_start(), &state->t, sizeof state->t);
	hash = jn_hash_add(hash, state->x, length * sizeof *state->x);
	jn_hash_text(jn_hash_add(hash, state->v, length * sizeof *state->v), text);
}

static bool advance(JnSim* sim, int steps, GoldenRow* row) {
	take_bits(sim, row->start);
	while (jn_sim_steps(sim) < steps && !jn_sim_is_done(sim)) {
		const JnStatus status = jn_sim_step(sim);
		if (status != JN_OK) fail_msg("%s, %s: %s: %s", row->scene, row->solver, jn_status_name(status), log_text());
	}
	row->steps = jn_sim_steps(sim);
	take_bits(sim, row->end);
	return true;
}

// Functions that models and controllers call; their last bits differ with the version of the C library, and with whether the
// processor has fused products and sums.
static void name_libm(char text[17]) {
	static double (*const one[])(double) = {sin, cos, exp2, log, log10, cbrt};
	static double (*const two[])(double, double) = {atan2, pow, hypot};
	char whole[33];
	JnHash hash = jn_hash_start();
	for (int i = 1; i < 2000; ++i) {
		const double a = 0.00390625 * i, b = 8 - a;
		double value[sizeof one / sizeof *one + sizeof two / sizeof *two];
		size_t count = 0;
		for (size_t f = 0; f < sizeof one / sizeof *one; ++f) value[count++] = one[f](a);
		for (size_t f = 0; f < sizeof two / sizeof *two; ++f) value[count++] = two[f](a, b);
		hash = jn_hash_add(hash, value, sizeof value);
	}
	jn_hash_text(hash, whole);
	memcpy(text, whole, 16);
	text[16] = '\0';
}

bool golden_run(const char* path, GoldenSolver solver, int threads, int part, GoldenRow* row) {
	static const char* const names[] = {"file", "cg"};
	Plan plan;
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	int steps;
	*row = (GoldenRow){.solver = names[solver]};
	name_scene(path, row->scene);
	make_plan(path, &plan);
	add_changes(row->scene, &steps, &plan.coarse);
	if (solver == GOLDEN_CG) add_set(&plan.coarse, "solver={method: cg, precondition: block}");
	log_capture();
	if (jn_scene_load(path, plan.coarse.count, plan.coarse.list, &scene) != JN_OK) fail_msg("%s", log_text());
	drop_bodies(scene);
	const JnStatus status = jn_scene_build(scene, threads, &sim);
	if (status != JN_OK && solver == GOLDEN_FILE) fail_msg("%s", log_text());
	jn_blas_prepare();
	jn_blas_name(row->blas, sizeof row->blas);
	name_libm(row->libm);
	const bool is_run = status == JN_OK && advance(sim, (steps + part - 1) / part, row);
	log_release();
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return is_run;
}

void golden_print_header(FILE* out) {
	fputs("scene,solver,blas,libm,steps,start,end\n", out);
}

void golden_print(FILE* out, const GoldenRow* row) {
	fprintf(out, "%s,%s,%s,%s,%ld,%s,%s\n", row->scene, row->solver, row->blas, row->libm, row->steps, row->start,
			row->end);
	fflush(out);
}

bool golden_is_same(const GoldenRow* a, const GoldenRow* b) {
	return a->steps == b->steps && strcmp(a->start, b->start) == 0 && strcmp(a->end, b->end) == 0;
}

void golden_check_threads(int threads, int part) {
	for (char** path = golden_scenes(JN_SOURCE_DIR "/scenes"); *path != NULL; ++path)
		for (int solver = 0; solver < GOLDEN_SOLVERS; ++solver) {
			GoldenRow one, more;
			if (!golden_run(*path, (GoldenSolver)solver, 1, part, &one)) continue;
			golden_run(*path, (GoldenSolver)solver, threads, part, &more);
			if (!golden_is_same(&one, &more))
				fail_msg("%s, solver %s: %d threads differ from one", one.scene, one.solver, threads);
		}
}

static bool is_wanted(const char* path, char** words) {
	const char* name = strrchr(path, '/');
	if (*words == NULL) return true;
	for (; *words != NULL; ++words)
		if (strstr(name, *words) != NULL) return true;
	return false;
}

int golden_main(int count, char** arguments) {
	const char* folder = JN_SOURCE_DIR "/scenes";
	int threads = 1, next = 2;
	for (; next + 1 < count && strncmp(arguments[next], "--", 2) == 0; next += 2) {
		if (strcmp(arguments[next], "--threads") == 0) threads = atoi(arguments[next + 1]);
		if (strcmp(arguments[next], "--scenes") == 0) folder = arguments[next + 1];
	}
	printf("# %d lanes\n", jn_processor_width());
	golden_print_header(stdout);
	for (char** path = golden_scenes(folder); *path != NULL; ++path)
		for (int solver = 0; is_wanted(*path, arguments + next) && solver < GOLDEN_SOLVERS; ++solver) {
			GoldenRow row;
			if (golden_run(*path, (GoldenSolver)solver, threads, 1, &row)) golden_print(stdout, &row);
		}
	return 0;
}
