// SUNDIALS ARKODE on a model of ours: y = (x, v), y' = (v, M^-1 f(t, x, v)), our forces and our factors, its methods.
//
//   method=sdirk2          Alexander's two-stage method, the one that jounce calls so; steps of dt
//   method=NAME            one of its tables: trbdf2, sdirk5, esdirk324, esdirk436, esdirk547; erk2, erk3, erk4, erk5
//   dt=S                   fixed steps; without it, adaptive ones with relative=R and absolute=A
//   coefficient=C          of its test that Newton's iteration has converged: C times the error weights
//
// Its Newton matrix I - gamma df/dy is condensed onto the velocities: with K = -df/dx and D = -df/dv,
//   dx = b1 + gamma dv,   (M + gamma D + gamma^2 K) dv = M b2 - gamma K b1.
#include <arkode/arkode_arkstep.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"
#include "solve/blas.h"

typedef struct Table {
	const char* name;
	int implicit, explicit; ///< numbers of its tables; -1: none
} Table;

static const Table tables[] = {
	{"trbdf2", ARKODE_TRBDF2_3_3_2, -1},
	{"sdirk5", ARKODE_SDIRK_5_3_4, -1},
	{"esdirk324", ARKODE_ESDIRK324L2SA_4_2_3, -1},
	{"esdirk436", ARKODE_ESDIRK436L2SA_6_3_4, -1},
	{"esdirk547", ARKODE_ESDIRK547L2SA2_7_4_5, -1},
	{"erk2", -1, ARKODE_HEUN_EULER_2_1_2},
	{"erk3", -1, ARKODE_BOGACKI_SHAMPINE_4_2_3},
	{"erk4", -1, ARKODE_ZONNEVELD_5_3_4},
	{"erk5", -1, ARKODE_DORMAND_PRINCE_7_4_5},
};

/// What its callbacks are given; also the content of matrix and linear solver.
typedef struct Arkode {
	Peer* peer;
	double gamma;
	double *b, *mb; ///< n
} Arkode;

static int right_side(realtype t, N_Vector y, N_Vector out, void* user) {
	Arkode* a = user;
	const double* x = NV_DATA_S(y);
	memcpy(NV_DATA_S(out), x + a->peer->n, a->peer->n * sizeof(double));
	const JnStatus status = peer_acceleration(a->peer, t, x, x + a->peer->n, NV_DATA_S(out) + a->peer->n);
	return (int)status; // above 0: try a smaller step; below: stop, as ours
}

// Only gamma is new where its matrix of the last state still serves.
static int make_matrix(realtype t, N_Vector y, N_Vector fy, SUNMatrix A, SUNMatrix M, booleantype keep,
					   booleantype* is_new, realtype gamma, void* user, N_Vector t1, N_Vector t2, N_Vector t3) {
	(void)fy, (void)A, (void)M, (void)t1, (void)t2, (void)t3;
	Arkode* a = user;
	a->gamma = gamma;
	*is_new = !keep;
	if (keep) return 0;
	const double* x = NV_DATA_S(y);
	return (int)peer_linearize(a->peer, t, x, x + a->peer->n);
}

static int solve(SUNLinearSolver solver, SUNMatrix A, N_Vector out, N_Vector in, realtype tolerance) {
	(void)A, (void)tolerance;
	Arkode* a = solver->content;
	const size_t n = a->peer->n;
	const double *b1 = NV_DATA_S(in), *b2 = b1 + n;
	double *dx = NV_DATA_S(out), *dv = dx + n;
	JnMatrix *mass = peer_matrix(a->peer, 1, 0, 0), *stiffness = peer_matrix(a->peer, 0, 0, 1);
	if (mass == NULL || stiffness == NULL) return -1;
	mass->ops->apply(mass, b2, a->mb);
	stiffness->ops->apply(stiffness, b1, a->b);
	for (size_t i = 0; i < n; ++i) a->b[i] = a->mb[i] - a->gamma * a->b[i];
	JnMatrix* matrix = peer_matrix(a->peer, 1, a->gamma, a->gamma * a->gamma);
	if (matrix == NULL || matrix->ops->solve(matrix, a->b, a->mb) != JN_OK) return 1;
	for (size_t i = 0; i < n; ++i) {
		dx[i] = b1[i] + a->gamma * a->mb[i];
		dv[i] = a->mb[i];
	}
	return 0;
}

static SUNMatrix_ID matrix_id(SUNMatrix A) {
	(void)A;
	return SUNMATRIX_CUSTOM;
}

static SUNMatrix matrix_clone(SUNMatrix A) {
	return A;
}

static void matrix_destroy(SUNMatrix A) {
	(void)A;
}

static SUNLinearSolver_Type solver_type(SUNLinearSolver solver) {
	(void)solver;
	return SUNLINEARSOLVER_DIRECT;
}

static int solver_setup(SUNLinearSolver solver, SUNMatrix A) {
	(void)solver, (void)A;
	return 0;
}

// Alexander 1977, gamma = 1 - sqrt(1/2), with the weights of its first stage alone as an embedded method.
static ARKodeButcherTable alexander(void) {
	const double g = 1 - sqrt(0.5);
	double c[] = {g, 1}, A[] = {g, 0, 1 - g, g}, b[] = {1 - g, g}, d[] = {1, 0};
	return ARKodeButcherTable_Create(2, 2, 1, c, A, b, d);
}

static int choose_table(void* ark, const char* method) {
	if (strcmp(method, "sdirk2") == 0) return ARKStepSetTables(ark, 2, 1, alexander(), NULL);
	for (size_t i = 0; i < sizeof tables / sizeof *tables; ++i)
		if (strcmp(method, tables[i].name) == 0) return ARKStepSetTableNum(ark, tables[i].implicit, tables[i].explicit);
	fprintf(stderr, "method=%s is not known\n", method);
	return -1;
}

static int set_linear_solver(void* ark, Arkode* a, SUNContext context) {
	SUNMatrix A = SUNMatNewEmpty(context);
	SUNLinearSolver solver = SUNLinSolNewEmpty(context);
	if (A == NULL || solver == NULL) return -1;
	A->content = solver->content = a;
	A->ops->getid = matrix_id;
	A->ops->clone = matrix_clone;
	A->ops->destroy = matrix_destroy;
	solver->ops->gettype = solver_type;
	solver->ops->setup = solver_setup;
	solver->ops->solve = solve;
	if (ARKStepSetLinearSolver(ark, solver, A) != 0) return -1;
	return ARKStepSetLinSysFn(ark, make_matrix);
}

static int begin_step(realtype t, N_Vector y, void* user) {
	Arkode* a = user;
	return (int)peer_begin(a->peer, t, NV_DATA_S(y), NV_DATA_S(y) + a->peer->n);
}

static int set_options(void* ark, Arkode* a, SUNContext context, const char* method) {
	const Peer* peer = a->peer;
	const double dt = peer_number(peer, "dt", 0);
	int bad = ARKStepSetUserData(ark, a);
	bad |= ARKStepSStolerances(ark, peer_number(peer, "relative", 1e-4), peer_number(peer, "absolute", 1e-6));
	bad |= ARKStepSetMaxNumSteps(ark, 100000000);
	bad |= ARKStepSetPostprocessStepFn(ark, begin_step);
	if (dt > 0) bad |= ARKStepSetFixedStep(ark, dt);
	if (strncmp(method, "erk", 3) != 0) {
		bad |= set_linear_solver(ark, a, context);
		bad |= ARKStepSetDeduceImplicitRhs(ark, SUNTRUE);
		bad |= ARKStepSetNonlinConvCoef(ark, peer_number(peer, "coefficient", 0.1));
		bad |= ARKStepSetMaxNonlinIters(ark, (int)peer_number(peer, "iterations", 30));
		bad |= ARKStepSetPredictorMethod(ark, (int)peer_number(peer, "predictor", 0));
	}
	return bad | choose_table(ark, method);
}

static void print_counts(void* ark) {
	long steps = 0, newton = 0, failed = 0;
	ARKStepGetNumSteps(ark, &steps);
	ARKStepGetNumNonlinSolvIters(ark, &newton);
	ARKStepGetNumErrTestFails(ark, &failed);
	peer_print("steps", (double)steps);
	peer_print("newton", (double)newton);
	peer_print("rejected", (double)failed);
}

static int run(Arkode* a, void* ark, N_Vector y) {
	Peer* peer = a->peer;
	peer_resume(peer);
	for (int k = 1; k <= peer->samples; ++k) {
		realtype t = 0;
		const double end = peer->span * k / peer->samples;
		if (ARKStepSetStopTime(ark, end) != 0 || ARKStepEvolve(ark, end, y, &t, ARK_NORMAL) < 0) return 1;
		peer_write(peer, t, NV_DATA_S(y), NV_DATA_S(y) + peer->n);
	}
	peer_pause(peer);
	print_counts(ark);
	peer_finish(peer);
	return 0;
}

static int integrate(Arkode* a) {
	const Peer* peer = a->peer;
	const char* method = peer_word(peer, "method", "sdirk2");
	const bool is_explicit = strncmp(method, "erk", 3) == 0;
	SUNContext context = NULL;
	if (SUNContext_Create(NULL, &context) != 0) return 1;
	N_Vector y = N_VNew_Serial((sunindextype)(2 * peer->n), context);
	memcpy(NV_DATA_S(y), peer->state.x, peer->n * sizeof(double));
	memcpy(NV_DATA_S(y) + peer->n, peer->state.v, peer->n * sizeof(double));
	if (begin_step(0, y, a) != 0) return 1;
	void* ark = ARKStepCreate(is_explicit ? right_side : NULL, is_explicit ? NULL : right_side, 0, y, context);
	const int bad = ark == NULL || set_options(ark, a, context, method) != 0 || run(a, ark, y) != 0;
	if (ark != NULL) ARKStepFree(&ark);
	N_VDestroy(y);
	SUNContext_Free(&context);
	return bad;
}

int main(int count, char** arguments) {
	jn_blas_restart(arguments);
	Peer peer;
	int bad = peer_open(&peer, count, arguments) != JN_OK;
	Arkode a = {.peer = &peer};
	a.b = calloc(peer.n + 1, sizeof *a.b);
	a.mb = calloc(peer.n + 1, sizeof *a.mb);
	bad = bad || a.b == NULL || a.mb == NULL || integrate(&a) != 0;
	free(a.b);
	free(a.mb);
	peer_close(&peer);
	return bad;
}
