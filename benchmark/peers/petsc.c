// PETSc's TS on a model of ours: our forces, its methods, and either our factors or its own iterative solvers.
//
//   method=alpha2         generalised alpha for M a = f, radius=R of 1 by default: Newmark's average acceleration
//   method=NAME           for y = (x, v): cn, bdf2, arkimex, rosw; rk3bs, rk4, rk5dp, which are explicit
//   dt=S                  size of steps; adapt=1 lets them vary with relative=R and absolute=A
//   tolerance=R           of Newton's iteration: norm of the residual over that of the forces at the start
//   linear=own|pbjacobi|icc     our factor of the condensed matrix; or, with alpha2, its conjugate gradients
//   options=TEXT          what else PETSc understands, such as -snes_lag_jacobian
#include <math.h>
#include <string.h>

#include "petsc.h"
#include "solve/blas.h"

enum { TEXT = 256 };

typedef struct Method {
	const char *name, *type, *kind; ///< as TS names them; kind: of TSARKIMEX, TSROSW, TSRK
	bool is_explicit;
} Method;

static const Method methods[] = {
	{"alpha2", TSALPHA2, NULL, false},  {"cn", TSCN, NULL, false},          {"bdf2", TSBDF, NULL, false},
	{"arkimex", TSARKIMEX, "4", false}, {"rosw", TSROSW, "ra34pw2", false}, {"rk3bs", TSRK, "3bs", true},
	{"rk4", TSRK, "4", true},           {"rk5dp", TSRK, "5dp", true},
};

static PetscErrorCode begin_step(TS ts) {
	Petsc* p;
	Vec X, V = NULL;
	const double *x, *v = NULL;
	PetscReal t;
	PetscCall(TSGetApplicationContext(ts, &p));
	PetscCall(TSGetTime(ts, &t));
	if (p->is_second)
		PetscCall(TS2GetSolution(ts, &X, &V));
	else
		PetscCall(TSGetSolution(ts, &X));
	PetscCall(VecGetArrayRead(X, &x));
	if (V != NULL) PetscCall(VecGetArrayRead(V, &v));
	PetscCall(petsc_check(peer_begin(p->peer, t, x, v != NULL ? v : x + p->peer->n)));
	if (V != NULL) PetscCall(VecRestoreArrayRead(V, &v));
	return VecRestoreArrayRead(X, &x);
}

static PetscErrorCode monitor(TS ts, PetscInt step, PetscReal t, Vec X, void* user) {
	(void)step;
	Petsc* p = user;
	Peer* peer = p->peer;
	if (fabs(t - peer->interval * (p->written + 1)) > 1e-7 * peer->interval) return 0;
	Vec V = NULL, Ignored;
	const double *x, *v = NULL;
	if (p->is_second) {
		PetscCall(TS2GetSolution(ts, &Ignored, &V));
		PetscCall(VecGetArrayRead(V, &v));
	}
	PetscCall(VecGetArrayRead(X, &x));
	peer_write(peer, t, x, v != NULL ? v : x + peer->n);
	++p->written;
	PetscCall(VecRestoreArrayRead(X, &x));
	return V != NULL ? VecRestoreArrayRead(V, &v) : 0;
}

static PetscErrorCode set_solvers(Petsc* p, TS ts, const char* linear) {
	SNES snes;
	KSP ksp;
	PC pc;
	PetscCall(TSGetSNES(ts, &snes));
	PetscCall(SNESGetKSP(snes, &ksp));
	PetscCall(KSPGetPC(ksp, &pc));
	const bool is_own = strcmp(linear, "own") == 0;
	PetscCall(KSPSetType(ksp, is_own ? KSPPREONLY : KSPCG));
	PetscCall(KSPSetTolerances(ksp, peer_number(p->peer, "rough", 1e-3), PETSC_DEFAULT, PETSC_DEFAULT, 2000));
	PetscCall(PCSetType(pc, is_own ? PCSHELL : strcmp(linear, "icc") == 0 ? PCICC : PCPBJACOBI));
	if (is_own) {
		PetscCall(PCShellSetContext(pc, p));
		PetscCall(PCShellSetApply(pc, petsc_apply_factor));
	}
	JnSystem* sys = p->peer->sys;
	PetscCall(petsc_check(sys->ops->force(sys, &p->peer->state, p->b)));
	sys->ops->hold(sys, p->b);
	const double scale = sqrt(sys->space->ops->dot(sys->space, p->b, p->b));
	PetscCall(SNESSetTolerances(snes, peer_number(p->peer, "tolerance", 1e-8) * scale, 1e-30, 0, 200, -1));
	return 0;
}

static PetscErrorCode set_kind(Petsc* p, TS ts, const Method* method) {
	PetscCall(TSSetType(ts, method->type));
	if (p->is_second) PetscCall(TSAlpha2SetRadius(ts, peer_number(p->peer, "radius", 1)));
	if (strcmp(method->type, TSRK) == 0) PetscCall(TSRKSetType(ts, method->kind));
	if (strcmp(method->type, TSROSW) == 0) PetscCall(TSRosWSetType(ts, method->kind));
	if (strcmp(method->type, TSBDF) == 0) PetscCall(TSBDFSetOrder(ts, 2));
	if (strcmp(method->type, TSARKIMEX) == 0) {
		PetscCall(TSARKIMEXSetType(ts, method->kind));
		PetscCall(TSARKIMEXSetFullyImplicit(ts, PETSC_TRUE));
	}
	return 0;
}

static PetscErrorCode set_steps(Petsc* p, TS ts) {
	const Peer* peer = p->peer;
	const bool adapts = peer_number(peer, "adapt", 0) != 0;
	TSAdapt adapt;
	PetscReal times[TEXT];
	PetscCall(TSSetTimeStep(ts, peer_number(peer, "dt", 5e-3)));
	PetscCall(TSSetMaxTime(ts, peer->span));
	PetscCall(TSSetMaxSteps(ts, 100000000));
	PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
	PetscCall(TSGetAdapt(ts, &adapt));
	PetscCall(TSAdaptSetType(adapt, adapts ? TSADAPTBASIC : TSADAPTNONE));
	PetscCall(
		TSSetTolerances(ts, peer_number(peer, "absolute", 1e-6), NULL, peer_number(peer, "relative", 1e-4), NULL));
	if (!adapts || peer->samples >= TEXT) return 0;
	for (int k = 0; k <= peer->samples; ++k) times[k] = peer->span * k / peer->samples;
	return TSSetTimeSpan(ts, peer->samples + 1, times);
}

static PetscErrorCode solve(Petsc* p, TS ts, Vec X, Vec V) {
	PetscInt steps, newton, linear, rejected;
	PetscCall(TSSetUp(ts));
	peer_resume(p->peer);
	if (p->is_second) PetscCall(TS2SetSolution(ts, X, V));
	PetscCall(TSSolve(ts, p->is_second ? NULL : X));
	peer_pause(p->peer);
	PetscCall(TSGetStepNumber(ts, &steps));
	PetscCall(TSGetSNESIterations(ts, &newton));
	PetscCall(TSGetKSPIterations(ts, &linear));
	PetscCall(TSGetStepRejections(ts, &rejected));
	p->peer->report.iterations = linear;
	peer_print("steps", steps);
	peer_print("newton", newton);
	peer_print("rejected", rejected);
	peer_finish(p->peer);
	return p->written == p->peer->samples ? 0 : PETSC_ERR_NOT_CONVERGED;
}

static PetscErrorCode integrate(Petsc* p, const Method* method) {
	Peer* peer = p->peer;
	const char* linear = peer_word(peer, "linear", "own");
	TS ts;
	Mat A = NULL;
	Vec X, V;
	double* values;
	const PetscInt n = (PetscInt)peer->n;
	PetscCall(VecCreateSeq(PETSC_COMM_SELF, p->is_second ? n : 2 * n, &X));
	PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &V));
	PetscCall(VecGetArray(X, &values));
	memcpy(values, peer->state.x, peer->n * sizeof *values);
	if (!p->is_second) memcpy(values + n, peer->state.v, peer->n * sizeof *values);
	PetscCall(VecRestoreArray(X, &values));
	PetscCall(VecGetArray(V, &values));
	memcpy(values, peer->state.v, peer->n * sizeof *values);
	PetscCall(VecRestoreArray(V, &values));
	PetscCall(TSCreate(PETSC_COMM_SELF, &ts));
	PetscCall(TSSetApplicationContext(ts, p));
	PetscCall(set_kind(p, ts, method));
	if (!p->is_explicit) PetscCall(petsc_make_matrix(p, linear, &A));
	PetscCall(petsc_set_equations(p, ts, A));
	if (p->is_second)
		PetscCall(TS2SetSolution(ts, X, V));
	else
		PetscCall(TSSetSolution(ts, X));
	if (!p->is_explicit) PetscCall(set_solvers(p, ts, linear));
	PetscCall(set_steps(p, ts));
	PetscCall(TSSetPreStep(ts, begin_step));
	PetscCall(TSMonitorSet(ts, monitor, p, NULL));
	PetscCall(TSSetFromOptions(ts));
	PetscCall(solve(p, ts, X, V));
	PetscCall(TSDestroy(&ts));
	PetscCall(MatDestroy(&A));
	PetscCall(VecDestroy(&X));
	return VecDestroy(&V);
}

int main(int count, char** arguments) {
	jn_blas_restart(arguments);
	Peer peer;
	int bad = peer_open(&peer, count, arguments) != JN_OK;
	Petsc p = {.peer = &peer};
	const Method* method = NULL;
	const char* name = bad ? "" : peer_word(&peer, "method", "alpha2");
	for (size_t i = 0; i < sizeof methods / sizeof *methods; ++i)
		if (strcmp(methods[i].name, name) == 0) method = &methods[i];
	p.is_second = method == methods;
	p.is_explicit = method != NULL && method->is_explicit;
	bad = bad || method == NULL || PetscInitialize(NULL, NULL, NULL, NULL) != 0;
	if (bad) return fputs("the arguments make no run\n", stderr), 1;
	bad = PetscMalloc2(peer.n, &p.b, peer.n, &p.c) != 0 ||
		  PetscOptionsInsertString(NULL, peer_word(&peer, "options", "")) != 0 || integrate(&p, method) != 0;
	PetscFree2(p.b, p.c);
	PetscFinalize();
	peer_close(&peer);
	return bad;
}
