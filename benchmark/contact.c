// Contact solvers on the problems that scenes make: a scene is stepped up to a moment, and the problems of the next step
// are solved by each solver, from no impulses at all and, in the rows "warm", from those of the step before, to the same
// residual. The factor of C, which `delassus` works on, is made anew in each sample.
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "pass/contact.h"

typedef struct Case {
	const char *name, *scene; ///< of the rows, and its file
	double t;                 ///< [s]
	const char* set;          ///< NULL: none
} Case;

static const Case cases[] = {
	{"ball", "ball", 0.76, NULL},
	{"slope", "slope", 0.1, NULL},
	{"squeeze", "squeeze", 1.3, NULL},
	{"stack", "stack", 0.05, "contact.friction=0"},
	{"stack_friction", "stack", 0.01, NULL},
	{"ducks", "ducks", 0.6, NULL}, // many islands, of a duck and a sheet or of a heap of ducks
};

static const double tolerance = 1e-7;
enum { MOST_PROBLEMS = 6 }; // of a step: islands come again at each further look at it

typedef struct Subject {
	const Bench* bench;
	const Case* c;
	int problems;
} Subject;

/// One solver on one problem.
typedef struct Trial {
	const JnContactProblem* problem;
	JnQp* qp;
	double *v, *lambda;
	const double* guess; ///< NULL: none
	JnQpReport report;
	JnStatus status;
} Trial;

static void run_trial(void* context) {
	Trial* trial = context;
	JnContactPass* pass = trial->problem->matrix.user;
	for (int b = 0; b < pass->model->body_count; ++b) pass->matrices.bodies[b].is_factored = false;
	const size_t bytes = 3 * (size_t)trial->problem->count * sizeof *trial->lambda;
	memset(trial->lambda, 0, bytes);
	if (trial->guess != NULL) memcpy(trial->lambda, trial->guess, bytes);
	trial->status = jn_qp_solve(trial->qp, trial->problem, trial->v, trial->lambda, &trial->report);
}

static int free_entries(const JnContactProblem* problem) {
	int count = 0;
	for (int k = 0; k < 3 * problem->nodes; ++k) count += !problem->held[k];
	return count;
}

static void report_trial(const Subject* s, const JnQpType* type, const Trial* trial, Timing seconds) {
	char name[96], size[64];
	snprintf(name, sizeof name, "%s.%s.%s%d", s->c->name, type->row.name, trial->guess != NULL ? "warm" : "",
			 s->problems);
	snprintf(size, sizeof size, "%d contacts %d unknowns", trial->problem->count, free_entries(trial->problem));
	Row row = {.group = "qp", .name = name, .size = size, .threads = 1, .width = jn_kernel_best_width()};
	row.value = timing_in(seconds, 1e-3, 1);
	row.unit = trial->status == JN_OK ? "ms" : "ms (not solved)";
	row.rate = jn_contact_residual_max(&trial->report.residual);
	row.rate_unit = "residual";
	bench_report(s->bench, &row);
}

static void run_trials(const Subject* s, const JnQpType* type, const JnContactProblem* problem, const double* guess) {
	const JnQpDef options = {.tolerance = tolerance, .max_iterations = 2000};
	Trial trial = {.problem = problem, .guess = guess};
	trial.v = calloc(3 * (size_t)problem->nodes, sizeof *trial.v);
	trial.lambda = calloc(3 * (size_t)problem->count + 1, sizeof *trial.lambda);
	if (trial.v != NULL && trial.lambda != NULL && jn_qp_create(type, &options, &trial.qp) == JN_OK)
		report_trial(s, type, &trial, measure(run_trial, &trial, 1, 1, 3));
	jn_qp_destroy(trial.qp);
	free(trial.v);
	free(trial.lambda);
}

static void observe(void* user, const JnContactProblem* problem, const double* guess) {
	static const JnQpType* const types[] = {&jn_qp_delassus, &jn_qp_admm};
	Subject* s = user;
	bool is_warm = false;
	for (int k = 0; k < 3 * problem->count; ++k) is_warm = is_warm || guess[k] != 0;
	if (++s->problems > MOST_PROBLEMS) return;
	for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
		run_trials(s, types[i], problem, NULL);
		if (is_warm) run_trials(s, types[i], problem, guess);
	}
}

static JnStatus step_up_to(JnSim* sim, double t) {
	while (jn_sim_state(sim)->t < t) JN_TRY(jn_sim_step(sim));
	return JN_OK;
}

static JnStatus measure_case(const Bench* bench, const Case* c) {
	char path[512];
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	Subject s = {.bench = bench, .c = c};
	int passes = 0;
	snprintf(path, sizeof path, "%s/scenes/%s.yaml", JN_SOURCE_DIR, c->scene);
	JN_TRY(jn_scene_load(path, c->set != NULL, &c->set, &scene));
	JnStatus status = jn_scene_build(scene, 1, &sim);
	if (status == JN_OK) status = step_up_to(sim, c->t);
	if (status == JN_OK) {
		jn_contact_observe(jn_sim_passes(sim, &passes)[0], observe, &s);
		status = jn_sim_step(sim);
	}
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status;
}

JnStatus bench_contact(const Bench* bench) {
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
		if (bench_wants(bench, "qp", cases[i].name, "")) JN_TRY(measure_case(bench, &cases[i]));
	return JN_OK;
}
