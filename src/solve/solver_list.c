// The linear solvers that scenes may name.
#include "solve/solver.h"

static const JnRow* const rows[] = {&jn_solver_auto.row, &jn_solver_direct.row, &jn_solver_cg.row};

const JnRowList jn_solver_list = {.noun = "solver", .rows = rows, .count = sizeof rows / sizeof *rows};
