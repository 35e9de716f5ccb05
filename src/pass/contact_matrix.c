// C = M + h D + h^2 K of the bodies in an island, as the contact solvers ask for it. Bodies are factored when a right-hand
// side first needs them.
#include <string.h>

#include "math/pattern.h"
#include "pass/contact.h"

enum { SLOT = 0 };

static bool is_zero(const double* x, size_t count) {
	for (size_t k = 0; k < count; ++k)
		if (x[k] != 0) return false;
	return true;
}

static void apply(void* user, const double* x, double* out) {
	JnContactPass* pass = user;
	for (int b = 0; b < pass->model->body_count; ++b) {
		const size_t first = jn_contact_first_entry(pass, b), count = jn_contact_entry_count(pass, b);
		const JnBodyMatrix* matrix = &pass->matrices.bodies[b];
		memset(out + first, 0, count * sizeof *out);
		if (pass->is_in[b] && !is_zero(x + first, count))
			jn_blocks_apply(&matrix->pattern, matrix->blocks, 1, x + first, out + first, pass->model->threads);
	}
}

static JnStatus solve(void* user, const double* rhs, double* out) {
	JnContactPass* pass = user;
	for (int b = 0; b < pass->model->body_count; ++b) {
		const size_t first = jn_contact_first_entry(pass, b), count = jn_contact_entry_count(pass, b);
		JnSolver* solver = pass->matrices.bodies[b].solver;
		memset(out + first, 0, count * sizeof *out);
		if (!pass->is_in[b] || solver == NULL || is_zero(rhs + first, count)) continue;
		JN_TRY(jn_body_matrix_factor(&pass->matrices, b));
		++pass->sys->base.report->solves;
		JN_TRY(solver->type->solve(solver, SLOT, rhs + first, out + first));
	}
	return JN_OK;
}

static JnStatus half(void* user, int body, const JnColumns* columns, JnHalf* out) {
	JnContactPass* pass = user;
	JnSolver* solver = pass->matrices.bodies[body].solver;
	if (solver == NULL) { // held as a whole: nothing moves it
		out->count += columns->count;
		return JN_OK;
	}
	JN_TRY(jn_body_matrix_factor(&pass->matrices, body));
	pass->sys->base.report->solves += columns->count;
	return solver->type->half(solver, SLOT, columns, out);
}

static void diagonal(void* user, double* out) {
	JnContactPass* pass = user;
	for (int b = 0; b < pass->model->body_count; ++b) {
		const JnBodyMatrix* matrix = &pass->matrices.bodies[b];
		double* own = out + jn_contact_first_entry(pass, b);
		for (int i = 0; pass->is_in[b] && i < matrix->pattern.nodes; ++i)
			for (int axis = 0; axis < 3; ++axis)
				own[3 * i + axis] = matrix->blocks[9 * (size_t)matrix->pattern.column_start[i] + 4 * (size_t)axis];
	}
}

JnContactMatrix jn_contact_matrix(JnContactPass* pass) {
	return (JnContactMatrix){.user = pass,
							 .apply = apply,
							 .solve = solve,
							 .diagonal = diagonal,
							 .pattern = &pass->model->pattern,
							 .blocks = pass->matrices.blocks,
							 .half = half};
}
