// The equations that PETSc is given, and its kind of status.
#include "petsc.h"

#include <string.h>

PetscErrorCode petsc_check(JnStatus status) {
	return status == JN_OK ? 0 : PETSC_ERR_USER;
}

void petsc_add_held(const Petsc* p, double scale, const double* a, double* out) {
	memcpy(p->c, a, p->peer->n * sizeof(double));
	p->peer->sys->ops->hold(p->peer->sys, p->c);
	p->peer->sys->ops->hold(p->peer->sys, out);
	for (size_t i = 0; i < p->peer->n; ++i) out[i] += scale * (a[i] - p->c[i]);
}

// out = M a - f(t, x, v)
static PetscErrorCode residual(Petsc* p, double t, const double* x, const double* v, const double* a, double* out) {
	Peer* peer = p->peer;
	JnState s = {.t = t, .x = (double*)x, .v = (double*)v};
	jn_state_touch(peer->sys->space, &s);
	PetscCall(petsc_check(peer->sys->ops->force(peer->sys, &s, p->b)));
	JnMatrix* mass = peer_matrix(peer, 1, 0, 0);
	if (mass == NULL) return PETSC_ERR_USER;
	mass->ops->apply(mass, a, out);
	for (size_t i = 0; i < peer->n; ++i) out[i] -= p->b[i];
	petsc_add_held(p, 1, a, out);
	return 0;
}

static PetscErrorCode second_function(TS ts, PetscReal t, Vec X, Vec V, Vec A, Vec F, void* user) {
	(void)ts;
	const double *x, *v, *a;
	double* f;
	PetscCall(VecGetArrayRead(X, &x));
	PetscCall(VecGetArrayRead(V, &v));
	PetscCall(VecGetArrayRead(A, &a));
	PetscCall(VecGetArray(F, &f));
	PetscCall(residual(user, t, x, v, a, f));
	PetscCall(VecRestoreArrayRead(X, &x));
	PetscCall(VecRestoreArrayRead(V, &v));
	PetscCall(VecRestoreArrayRead(A, &a));
	return VecRestoreArray(F, &f);
}

static PetscErrorCode second_jacobian(TS ts, PetscReal t, Vec X, Vec V, Vec A, PetscReal v_shift, PetscReal a_shift,
									  Mat J, Mat P, void* user) {
	(void)ts, (void)A, (void)J;
	Petsc* p = user;
	const double *x, *v;
	PetscCall(VecGetArrayRead(X, &x));
	PetscCall(VecGetArrayRead(V, &v));
	PetscCall(petsc_check(peer_linearize(p->peer, t, x, v)));
	PetscCall(VecRestoreArrayRead(X, &x));
	PetscCall(VecRestoreArrayRead(V, &v));
	p->mass = a_shift;
	p->damping = v_shift;
	p->stiffness = 1;
	return petsc_fill_matrix(p, P);
}

static PetscErrorCode first_function(TS ts, PetscReal t, Vec Y, Vec Yt, Vec F, void* user) {
	(void)ts;
	Petsc* p = user;
	const size_t n = p->peer->n;
	const double *y, *yt;
	double* f;
	PetscCall(VecGetArrayRead(Y, &y));
	PetscCall(VecGetArrayRead(Yt, &yt));
	PetscCall(VecGetArray(F, &f));
	for (size_t i = 0; i < n; ++i) f[i] = yt[i] - y[n + i];
	PetscCall(residual(p, t, y, y + n, yt + n, f + n));
	PetscCall(VecRestoreArrayRead(Y, &y));
	PetscCall(VecRestoreArrayRead(Yt, &yt));
	return VecRestoreArray(F, &f);
}

static PetscErrorCode first_jacobian(TS ts, PetscReal t, Vec Y, Vec Yt, PetscReal shift, Mat J, Mat P, void* user) {
	(void)ts, (void)Yt, (void)J;
	Petsc* p = user;
	const double* y;
	PetscCall(VecGetArrayRead(Y, &y));
	PetscCall(petsc_check(peer_linearize(p->peer, t, y, y + p->peer->n)));
	PetscCall(VecRestoreArrayRead(Y, &y));
	p->shift = shift;
	p->mass = shift;
	p->damping = 1;
	p->stiffness = 1 / shift;
	return petsc_fill_matrix(p, P);
}

static PetscErrorCode explicit_function(TS ts, PetscReal t, Vec Y, Vec F, void* user) {
	(void)ts;
	Petsc* p = user;
	const size_t n = p->peer->n;
	const double* y;
	double* f;
	PetscCall(VecGetArrayRead(Y, &y));
	PetscCall(VecGetArray(F, &f));
	memcpy(f, y + n, n * sizeof(double));
	PetscCall(petsc_check(peer_acceleration(p->peer, t, y, y + n, f + n)));
	PetscCall(VecRestoreArrayRead(Y, &y));
	return VecRestoreArray(F, &f);
}

PetscErrorCode petsc_set_equations(Petsc* p, TS ts, Mat A) {
	if (p->is_second) {
		PetscCall(TSSetI2Function(ts, NULL, second_function, p));
		return TSSetI2Jacobian(ts, A, A, second_jacobian, p);
	}
	if (p->is_explicit) return TSSetRHSFunction(ts, NULL, explicit_function, p);
	PetscCall(TSSetIFunction(ts, NULL, first_function, p));
	return TSSetIJacobian(ts, A, A, first_jacobian, p);
}
