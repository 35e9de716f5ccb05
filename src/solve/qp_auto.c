// The faster of the two solvers, by the number of rows that press at first: a row costs the Delassus matrix a solve, while
// the splitting pays for a factorisation and some thirty solves however many there are. The splitting is slow where bodies
// are stiff; after a while its multipliers are then a guess for the other.
#include "solve/qp_rows.h"

enum {
	FEW_ROWS = 300,         // at which both take the same time on soft bodies (docs/contact_solvers.md)
	SPLIT_ITERATIONS = 200, // three times what the splitting needs where it is the faster one
	MOST_ROWS = 8000,       // dense matrices of 512 MB
};

typedef struct Auto {
	JnQp base;
	JnQp *delassus, *admm; // made when first needed
} Auto;

static int count_pressing(const JnQpRows* rows) {
	int count = 0;
	for (int i = 0; i < rows->contacts; ++i) {
		const int row = rows->first[i], end = rows->first[i + 1];
		if (end > row && (rows->before[row] < 0 || rows->lambda[row] > 0)) count += end - row;
	}
	return count;
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

static JnStatus solve(JnQp* qp) {
	Auto* a = (Auto*)qp;
	const int most = qp->options.max_iterations;
	if (count_pressing(&qp->rows) <= FEW_ROWS) return delegate(qp, &jn_qp_delassus, most, &a->delassus);
	const bool has_other = qp->rows.count <= MOST_ROWS;
	const int share = has_other && most > SPLIT_ITERATIONS ? SPLIT_ITERATIONS : most;
	const JnStatus status = delegate(qp, &jn_qp_admm, share, &a->admm);
	if (status != JN_NOT_CONVERGED || !has_other) return status;
	return delegate(qp, &jn_qp_delassus, most, &a->delassus);
}

static void release(JnQp* qp) {
	jn_qp_destroy(((Auto*)qp)->delassus);
	jn_qp_destroy(((Auto*)qp)->admm);
}

const JnQpType jn_qp_auto = {
	.row = {.name = "auto",
			.doc = "delassus up to some 300 rows in contact, else admm, and delassus after it where that is slow",
			.keys = jn_qp_keys,
			.options_size = sizeof(JnQpDef)},
	.size = sizeof(Auto),
	.solve = solve,
	.release = release,
};
