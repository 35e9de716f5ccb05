// The laws as scene files name them: keys, doc strings, and their constants from Young's modulus and Poisson's ratio.
#include <math.h>
#include <stddef.h>

#include "force/cloth/cloth.h"
#include "force/constraint/law.h"
#include "force/material/law.h"
#include "force/material/stable_neo_hookean.h"
#include "force/peridynamic.h"
#include "force/rigid.h"
#include "force/solid.h"

static const JnKey material_keys[] = {
	{.name = "density",
	 .kind = JN_REAL,
	 .field = offsetof(JnMaterialDef, density),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "kg/m^3",
	 .meaning = "mass a volume at rest"},
	{.name = "young",
	 .kind = JN_REAL,
	 .field = offsetof(JnMaterialDef, young),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "Pa",
	 .meaning = "Young's modulus: stiffness under tension"},
	{.name = "poisson",
	 .kind = JN_REAL,
	 .field = offsetof(JnMaterialDef, poisson),
	 .high = 0.5,
	 .open = JN_OPEN_HIGH,
	 .required = true,
	 .remedy = "use 0.49 for nearly incompressible",
	 .meaning = "Poisson's ratio: how much it narrows when stretched"},
	{.name = NULL},
};

static void prepare_lame(const JnMaterialDef* def, double constants[JN_LAW_CONSTANTS]) {
	const double E = def->young, nu = def->poisson;
	for (int i = 0; i < JN_LAW_CONSTANTS; i++) constants[i] = 0;
	constants[JN_LAW_MU] = E / (2 * (1 + nu));
	constants[JN_LAW_LAMBDA] = E * nu / ((1 + nu) * (1 - 2 * nu));
}

static void prepare_stable(const JnMaterialDef* def, double constants[JN_LAW_CONSTANTS]) {
	prepare_lame(def, constants);
	const double mu = constants[JN_LAW_MU], lambda = constants[JN_LAW_LAMBDA];
	const double m = 4.0 / 3.0 * mu, l = lambda + 5.0 / 6.0 * mu;
	constants[STABLE_M] = m;
	constants[STABLE_L] = l;
	constants[STABLE_ALPHA] = 1 + m / l - m / (4 * l);
}

#define LAW_ROW(law_name, prepare_constants, is_linear, words)                                                         \
	const JnLaw jn_law_##law_name = {                                                                                  \
		.row = {#law_name, words, material_keys, sizeof(JnMaterialDef)},                                               \
		.build = jn_solid_build,                                                                                       \
		.prepare = (prepare_constants),                                                                                \
		.is_linear_in_step = (is_linear),                                                                              \
	};

LAW_ROW(linear, prepare_lame, true, "Linear elasticity (Hooke): small displacements and rotations only.")
LAW_ROW(st_venant_kirchhoff, prepare_lame, false,
		"St Venant-Kirchhoff: Hooke's law on the Green strain; large rotations, but softens when compressed.")
LAW_ROW(neo_hookean, prepare_lame, false,
		"Neo-Hookean with the logarithm of volume: infinitely stiff against collapse, undefined when inverted.")
LAW_ROW(stable_neo_hookean, prepare_stable, false,
		"Stable Neo-Hookean (Smith et al. 2018): rubber and flesh at any deformation, inverted elements included.")
LAW_ROW(corotated_frozen, prepare_lame, true,
		"Corotated linear elasticity, rotations held over each step: linear within a step.")
LAW_ROW(corotated, prepare_lame, false,
		"Corotated linear elasticity with the rotation followed exactly: large rotations, moderate strains.")

static const JnRow* const law_rows[] = {
#define LAW_POINTER(law, frozen_reals, is_convex) &jn_law_##law.row,
	JN_SOLID_LAWS(LAW_POINTER) & jn_law_mass_spring.row,
	&jn_law_membrane.row,
	&jn_law_constraints.row,
	&jn_law_rod.row,
	&jn_law_peridynamic.row,
	&jn_law_rigid.row,
};

const JnRowList jn_law_list = {"material", law_rows, sizeof law_rows / sizeof *law_rows};
