// The faster of the two solvers: delassus, unless a body has so many rows that its dense matrix costs more than the
// splitting does. Where one does not converge, the other goes on; the better multipliers stay.
#include <string.h>

#include "solve/qp_rows.h"

enum {
	MANY_ROWS =
		3000, // on one body: soft bodies with friction favour the splitting, others not yet (docs/contact_solvers.md)
	MANY_SOLVES = 300,      // the same where the matrix has no halves
	SPLIT_ITERATIONS = 400, // where the splitting is the faster one it needs a hundred
	MOST_ROWS = 8000,       // on one body: dense matrices of 512 MB
};

typedef struct Auto {
	JnQp base;
	JnQp *delassus, *admm; // made when first needed
	JnNumbers kept;        // multipliers
} Auto;

// Rows on the body that has the most of those that press at first.
static JnStatus count_pressing(JnQp* qp, int* most) {
	const JnContactProblem* problem = qp->problem;
	const JnQpRows* rows = &qp->rows;
	const size_t bodies = problem->body_count > 0 ? (size_t)problem->body_count : 1;
	JN_TRY(jn_indices_reserve(&qp->marks, bodies));
	memset(qp->marks.at, 0, bodies * sizeof *qp->marks.at);
	*most = 0;
	for (int i = 0; i < rows->contacts; ++i) {
		const int row = rows->first[i], end = rows->first[i + 1];
		if (end == row || (rows->before[row] >= 0 && rows->lambda[row] <= 0)) continue;
		int last = -1;
		for (int k = problem->start[i]; k < problem->start[i + 1]; ++k) {
			const int body = jn_qp_body_of(problem, problem->node[k]);
			if (body != last) qp->marks.at[body] += end - row;
			*most = qp->marks.at[body] > *most ? qp->marks.at[body] : *most;
			last = body;
		}
	}
	return JN_OK;
}

static void add_costs(const JnQpReport* from, JnQpReport* to) {
	to->iterations += from->iterations;
	to->sweeps += from->sweeps;
	to->factorizations += from->factorizations;
	to->solves += from->solves;
	to->rows = from->rows;
}

// Let another solver work on the rows and vectors of this one.
static JnStatus delegate(JnQp* qp, const JnQpType* type, int iterations, JnQp** other) {
	if (*other == NULL) JN_TRY(jn_qp_create(type, &qp->options, other));
	JnQp* o = *other;
	o->options.max_iterations = iterations;
	o->problem = qp->problem;
	o->rows = qp->rows;
	o->rhs = qp->rhs;
	o->change = qp->change;
	o->work = qp->work;
	o->report = (JnQpReport){0};
	const JnStatus status = type->solve(o);
	add_costs(&o->report, &qp->report);
	return status;
}

// The splitting after delassus has failed: its multipliers count when it converges alone.
static JnStatus try_splitting(JnQp* qp) {
	Auto* a = (Auto*)qp;
	const size_t count = (size_t)qp->rows.count;
	JN_TRY(jn_numbers_reserve(&a->kept, count));
	memcpy(a->kept.at, qp->rows.lambda, count * sizeof *a->kept.at);
	const int most = qp->options.max_iterations < SPLIT_ITERATIONS ? qp->options.max_iterations : SPLIT_ITERATIONS;
	const JnStatus status = delegate(qp, &jn_qp_admm, most, &a->admm);
	if (status != JN_OK) memcpy(qp->rows.lambda, a->kept.at, count * sizeof *a->kept.at);
	return status > 0 ? JN_NOT_CONVERGED : status;
}

static JnStatus solve(JnQp* qp) {
	Auto* a = (Auto*)qp;
	const int most = qp->options.max_iterations;
	int rows;
	JN_TRY(count_pressing(qp, &rows));
	if (rows <= (qp->problem->matrix.half != NULL ? MANY_ROWS : MANY_SOLVES)) {
		const JnStatus status = delegate(qp, &jn_qp_delassus, most, &a->delassus);
		return status == JN_NOT_CONVERGED && qp->problem->matrix.blocks != NULL ? try_splitting(qp) : status;
	}
	const bool has_other = rows <= MOST_ROWS;
	const JnStatus status =
		delegate(qp, &jn_qp_admm, has_other && most > SPLIT_ITERATIONS ? SPLIT_ITERATIONS : most, &a->admm);
	return status == JN_NOT_CONVERGED && has_other ? delegate(qp, &jn_qp_delassus, most, &a->delassus) : status;
}

static void release(JnQp* qp) {
	Auto* a = (Auto*)qp;
	jn_qp_destroy(a->delassus);
	jn_qp_destroy(a->admm);
	free(a->kept.at);
}

const JnQpType jn_qp_auto = {
	.row = {.name = "auto",
			.doc = "delassus, or admm where a body has more than some 3000 rows in contact; the other where one fails",
			.keys = jn_qp_keys,
			.options_size = sizeof(JnQpDef)},
	.size = sizeof(Auto),
	.solve = solve,
	.release = release,
};
