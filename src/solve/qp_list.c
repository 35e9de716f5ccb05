// The solvers of contact problems that scenes may name, and the keys that all of them have.
#include "solve/qp.h"

static const JnRow* const rows[] = {&jn_qp_auto.row, &jn_qp_delassus.row, &jn_qp_admm.row};

const JnRowList jn_qp_list = {.noun = "contact solver", .rows = rows, .count = sizeof rows / sizeof *rows};

const JnKey jn_qp_keys[] = {
	{.name = "tolerance",
	 .kind = JN_REAL,
	 .field = offsetof(JnQpDef, tolerance),
	 .value = {1e-7},
	 .low = 1e-12,
	 .high = 1e-2,
	 .meaning = "largest relative residual of the contact conditions"},
	{.name = "max_iterations",
	 .kind = JN_INTEGER,
	 .field = offsetof(JnQpDef, max_iterations),
	 .value = {2000},
	 .low = 1,
	 .high = 1000000,
	 .meaning = "iterations after which a solve counts as not converged"},
	{0},
};
