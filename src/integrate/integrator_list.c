// All integrators: the order here is that of `jounce list`.
#include "integrate/average_vector_field.h"
#include "integrate/bdf.h"
#include "integrate/composition.h"
#include "integrate/dirk.h"
#include "integrate/explicit_runge_kutta.h"
#include "integrate/exponential.h"
#include "integrate/integrator.h"
#include "integrate/newmark.h"
#include "integrate/rosenbrock.h"

// clang-format off
static const JnRow* const rows[] = {
	// diagonally implicit Runge-Kutta
	&jn_backward_euler.row,
	&jn_implicit_midpoint.row,
	&jn_trapezoid.row,
	&jn_sdirk2.row,
	&jn_tr_bdf2.row,
	&jn_tr_bdf2_b.row,
	&jn_sdirk3.row,
	&jn_sdirk_ncs23.row,
	&jn_sdirk_nc34.row,
	&jn_sdirk_3345.row,
	&jn_sdirk_4347.row,
	&jn_esdirk324.row,
	&jn_esdirk325.row,
	&jn_esdirk436.row,
	// Rosenbrock
	&jn_linearized_euler.row,
	&jn_linearized_midpoint.row,
	&jn_ros2.row,
	&jn_ros3p.row,
	&jn_ros3pl.row,
	&jn_ros3prl2.row,
	&jn_ros34pw2.row,
	&jn_ros34pw3.row,
	&jn_rodas3.row,
	&jn_rodas4.row,
	// structural dynamics
	&jn_newmark.row,
	&jn_linearized_newmark.row,
	&jn_hht_alpha.row,
	&jn_generalized_alpha.row,
	&jn_bdf2.row,
	&jn_average_vector_field.row,
	&jn_exponential_rosenbrock.row,
	// explicit and semi-implicit
	&jn_explicit_euler.row,
	&jn_symplectic_euler.row,
	&jn_midpoint.row,
	&jn_modified_midpoint.row,
	&jn_half_step.row,
	&jn_modified_half_step.row,
	&jn_verlet.row,
	&jn_ruth3.row,
	&jn_forest_ruth.row,
	&jn_pefrl.row,
	&jn_rk4.row,
};
// clang-format on

const JnRowList jn_integrator_list = {.noun = "integrator", .rows = rows, .count = sizeof rows / sizeof *rows};
