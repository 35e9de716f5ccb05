// No elements at all: what moves a rigid body is its weight and what it touches.
#include "force/rigid.h"

#include <math.h>
#include <stddef.h>

#include "base/log.h"
#include "mesh/rigid.h"

#define POSITIVE_KEY(field_name, unit_text, words)                                                                     \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(JnRigidDef, field_name), .high = INFINITY,             \
		.open = JN_OPEN_LOW | JN_OPEN_HIGH, .absent_allowed = true, .unit = (unit_text), .meaning = (words)            \
	}

static const JnKey keys[] = {
	POSITIVE_KEY(mass, "kg", "of the whole; or give density"),
	POSITIVE_KEY(density, "kg/m^3", "mass a volume; or give mass"),
	POSITIVE_KEY(stiffness, "N/m",
				 "force a length of overlap, on each point; when absent that of a column of the points' material, one "
				 "spacing wide and long"),
	{0},
};

static JnStatus build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
					  JnArena* arena, JnGroups* out) {
	const JnRigidDef* def = options;
	(void)first_node, (void)arena;
	if (mesh->rigid == NULL)
		return jn_error(JN_BAD_INPUT, "%s.material.law: '%s' is for the shapes rigid_sphere and rigid_plate", what,
						law->row.name);
	if (isnan(def->mass) == isnan(def->density))
		return jn_error(JN_BAD_INPUT, "%s.material: give exactly one of mass and density", what);
	if (isnan(def->mass) && jn_rigid_is_endless(mesh->rigid))
		return jn_error(JN_BAD_INPUT,
						"%s.material.density: a plate without end has no volume; give mass, or shape.size", what);
	*out = (JnGroups){.density = isnan(def->mass) ? def->density : def->mass / mesh->volumes[0]};
	return JN_OK;
}

const JnLaw jn_law_rigid = {
	.row = {"rigid", "A rigid ball or plate, which moves by its weight and by what it touches.", keys,
			sizeof(JnRigidDef)},
	.build = build,
	.is_linear_in_step = true,
};
