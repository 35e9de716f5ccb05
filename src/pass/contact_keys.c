// The rows of `contact:` in a scene file.
#include "pass/friction.h"
#include "pass/pass.h"
#include "solve/qp.h"

static const char* const rules[] = {"approaching", "touching", NULL};
static const char* const dampings[] = {"auto", "no", "yes", NULL};
static const char* const predictions[] = {"auto", "carried", "iterated", "free", NULL};

const JnKey jn_contact_keys[] = {
	{.name = "rule",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnContactDef, rule),
	 .names = rules,
	 .meaning =
		 "approaching: surfaces that would meet within the step meet at its end and do not overlap; touching: as "
		 "in the paper, what touches at the start of a step may not come nearer, and fast bodies overlap for a "
		 "step"},
	{.name = "prediction",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnContactDef, prediction),
	 .names = predictions,
	 .meaning =
		 "contact forces that act while the integrator predicts: auto, carried where the method allows it; carried, "
		 "those of the last step, which keeps most energy at no cost; iterated, those of this step, by repeated "
		 "predictions, which never adds energy; free, none, as in the paper, whose corrector then loses like "
		 "Backward Euler"},
	{.name = "rounds",
	 .kind = JN_INTEGER,
	 .field = offsetof(JnContactDef, rounds),
	 .value = {8},
	 .low = 1,
	 .high = 1000,
	 .meaning = "predictions a step at most where they are iterated"},
	{.name = "margin",
	 .kind = JN_REAL,
	 .field = offsetof(JnContactDef, margin),
	 .low = 0,
	 .high = 1e6,
	 .open = JN_OPEN_LOW,
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning = "distance within which vertices are watched; a twentieth of the mean edge of the finest surface when "
				"absent"},
	{.name = "push_out",
	 .kind = JN_REAL,
	 .field = offsetof(JnContactDef, push_out),
	 .value = {0.5},
	 .low = 0,
	 .high = 1e6,
	 .unit = "m/s",
	 .meaning = "fastest separation of what overlaps"},
	{.name = "friction",
	 .kind = JN_REAL,
	 .field = offsetof(JnContactDef, friction),
	 .low = 0,
	 .high = 100,
	 .meaning = "coefficient of Coulomb friction where `pairs` names no other"},
	{.name = "pairs",
	 .kind = JN_LIST,
	 .field = offsetof(JnContactDef, pairs),
	 .keys = jn_friction_pair_keys,
	 .size = sizeof(JnContactPairDef),
	 .meaning = "friction of two surfaces"},
	{.name = "damping",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnContactDef, damping),
	 .names = dampings,
	 .meaning = "Rayleigh damping in the corrector too: auto, unless the prediction is free; the paper has it in the "
				"predictor alone, but carried forces would then feed what damping takes"},
	{.name = "solver",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnContactDef, solver),
	 .text = "auto",
	 .rows = &jn_qp_list,
	 .tag = "method",
	 .meaning = "of the quadratic program"},
	{0},
};
