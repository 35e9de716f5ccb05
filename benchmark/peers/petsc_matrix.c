// The matrices that PETSc is given, and our factor as its preconditioner.
#include <string.h>

#include "petsc.h"

PetscErrorCode petsc_fill_matrix(Petsc* p, Mat P) {
	double* numbers;
	if (p->blocks.nodes > 0 && p->blocks.is_full) {
		PetscCall(MatSeqBAIJGetArray(P, &numbers));
		peer_fill_blocks(p->peer, &p->blocks, p->mass, p->stiffness, numbers);
		PetscCall(MatSeqBAIJRestoreArray(P, &numbers));
	} else if (p->blocks.nodes > 0) {
		PetscCall(MatSeqSBAIJGetArray(P, &numbers));
		peer_fill_blocks(p->peer, &p->blocks, p->mass, p->stiffness, numbers);
		PetscCall(MatSeqSBAIJRestoreArray(P, &numbers));
	}
	PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
	return MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY);
}

static PetscErrorCode multiply(Mat A, Vec In, Vec Out) {
	Petsc* p;
	const double* in;
	double* out;
	PetscCall(MatShellGetContext(A, &p));
	PetscCall(VecGetArrayRead(In, &in));
	PetscCall(VecGetArray(Out, &out));
	const size_t n = p->peer->n, at = p->is_second ? 0 : n;
	JnMatrix* matrix = peer_matrix(p->peer, p->mass, p->damping, p->is_second ? p->stiffness : 0);
	JnMatrix* K = peer_matrix(p->peer, 0, 0, 1);
	if (matrix == NULL || K == NULL) return PETSC_ERR_USER;
	matrix->ops->apply(matrix, in + at, out + at);
	if (!p->is_second) {
		K->ops->apply(K, in, p->b);
		for (size_t i = 0; i < n; ++i) {
			out[i] = p->shift * in[i] - in[n + i];
			out[n + i] += p->b[i];
		}
	}
	petsc_add_held(p, p->mass, in + at, out + at);
	PetscCall(VecRestoreArrayRead(In, &in));
	return VecRestoreArray(Out, &out);
}

static PetscErrorCode solve_condensed(Petsc* p, const double* in, double* out) {
	const size_t n = p->peer->n;
	const double* rhs = in;
	if (!p->is_second) {
		JnMatrix* K = peer_matrix(p->peer, 0, 0, 1);
		if (K == NULL) return PETSC_ERR_USER;
		K->ops->apply(K, in, p->b);
		for (size_t i = 0; i < n; ++i) p->b[i] = in[n + i] - p->b[i] / p->shift;
		rhs = p->b;
	}
	JnMatrix* matrix = peer_matrix(p->peer, p->mass, p->damping, p->stiffness);
	if (matrix == NULL) return PETSC_ERR_USER;
	double* solved = p->is_second ? out : out + n;
	PetscCall(petsc_check(matrix->ops->solve(matrix, rhs, solved)));
	for (size_t i = 0; i < n && !p->is_second; ++i) out[i] = (in[i] + out[n + i]) / p->shift;
	return 0;
}

PetscErrorCode petsc_apply_factor(PC pc, Vec In, Vec Out) {
	Petsc* p;
	const double* in;
	double* out;
	PetscCall(PCShellGetContext(pc, &p));
	PetscCall(VecGetArrayRead(In, &in));
	PetscCall(VecGetArray(Out, &out));
	PetscCall(solve_condensed(p, in, out));
	PetscCall(VecRestoreArrayRead(In, &in));
	return VecRestoreArray(Out, &out);
}

static PetscErrorCode make_shell(Petsc* p, Mat* out) {
	const PetscInt n = (PetscInt)(p->is_second ? p->peer->n : 2 * p->peer->n);
	PetscCall(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, p, out));
	return MatShellSetOperation(*out, MATOP_MULT, (void (*)(void))multiply);
}

// All blocks, or the upper triangle, with zeros.
static PetscErrorCode make_blocks(Petsc* p, bool is_full, Mat* out) {
	PetscCall(petsc_check(peer_blocks(p->peer, is_full, &p->blocks)));
	const PeerBlocks* blocks = &p->blocks;
	const PetscInt n = (PetscInt)p->peer->n;
	const double zeros[9] = {0};
	PetscInt* counts;
	PetscCall(PetscMalloc1((size_t)blocks->nodes, &counts));
	for (int i = 0; i < blocks->nodes; ++i) counts[i] = blocks->row_start[i + 1] - blocks->row_start[i];
	if (is_full)
		PetscCall(MatCreateSeqBAIJ(PETSC_COMM_SELF, 3, n, n, 0, counts, out));
	else
		PetscCall(MatCreateSeqSBAIJ(PETSC_COMM_SELF, 3, n, n, 0, counts, out));
	for (PetscInt i = 0; i < blocks->nodes; ++i)
		for (int k = blocks->row_start[i]; k < blocks->row_start[i + 1]; ++k)
			PetscCall(MatSetValuesBlocked(*out, 1, &i, 1, &blocks->column[k], zeros, INSERT_VALUES));
	PetscCall(PetscFree(counts));
	PetscCall(MatAssemblyBegin(*out, MAT_FINAL_ASSEMBLY));
	return MatAssemblyEnd(*out, MAT_FINAL_ASSEMBLY);
}

PetscErrorCode petsc_make_matrix(Petsc* p, const char* linear, Mat* out) {
	return strcmp(linear, "own") == 0 ? make_shell(p, out) : make_blocks(p, strcmp(linear, "pbjacobi") == 0, out);
}
