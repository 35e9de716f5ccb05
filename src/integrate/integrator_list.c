// All integrators: the order here is that of `jounce list`.
#include "integrate/dirk.h"
#include "integrate/integrator.h"

static const JnRow* const rows[] = {
	&jn_backward_euler.row, &jn_implicit_midpoint.row, &jn_trapezoid.row,  &jn_sdirk2.row,
	&jn_tr_bdf2.row,        &jn_tr_bdf2_b.row,         &jn_sdirk3.row,     &jn_sdirk_ncs23.row,
	&jn_sdirk_nc34.row,     &jn_sdirk_3345.row,        &jn_sdirk_4347.row, &jn_esdirk324.row,
	&jn_esdirk325.row,      &jn_esdirk436.row,
};

const JnRowList jn_integrator_list = {.noun = "integrator", .rows = rows, .count = sizeof rows / sizeof *rows};
