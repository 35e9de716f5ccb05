// The law of bodies made of constraints (EX, "Constrained object animation"): checks, keys, and what threads and other meshes
// share.
#include "force/constraint/constraints.h"

#include <math.h>
#include <stddef.h>

#include "base/log.h"
#include "force/constraint/law.h"
#include "force/constraint/rest.h"
#include "force/relax.h"
#include "mesh/boundary.h"

static JnStatus add_skin(const JnConstraintsFill* fill, JnGroups* out) {
	if (fill->def->area == 0) return JN_OK;
	int count = 0, *triangles = NULL;
	JnConstraint* elements;
	JN_TRY(jn_mesh_boundary(fill->mesh, fill->scratch, &count, &triangles));
	JN_NEW(fill->scratch, elements, count);
	for (int e = 0; e < count; ++e) {
		for (int i = 0; i < 3; ++i) elements[e].nodes[i] = triangles[3 * (ptrdiff_t)e + i];
		jn_rest_area(fill->mesh, elements[e].nodes, fill->def->area, elements[e].rest);
	}
	return jn_constraint_add(JN_CONSTRAINT_area, count, elements, fill->first_node, fill->def->damping, fill->arena,
							 out);
}

static JnStatus fill_body(const JnConstraintsFill* fill, JnGroups* out) {
	JN_TRY(fill->mesh->thread != NULL ? jn_constraints_fill_thread(fill, out) : jn_constraints_fill_mesh(fill, out));
	return add_skin(fill, out);
}

static JnStatus check_thread_key(double value, const char* name, const JnMesh* mesh, const char* what) {
	if (value == 0 || mesh->thread != NULL) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.material.%s: %g N m^2, but only threads have it; remove it, or use `shape: {type: "
					"thread}`",
					what, name, value);
}

static JnStatus check(const JnLaw* law, const JnConstraintsDef* def, const JnMesh* mesh, const char* what) {
	if (mesh->shape != JN_TET4)
		return jn_error(JN_BAD_INPUT, "%s.material.law: '%s' does not run on %s elements; use tet4, or a thread", what,
						law->row.name, jn_shape_info[mesh->shape].name);
	for (int c = 0; c < mesh->cell_count; ++c)
		if (!(jn_mesh_cell_volume(mesh, c) > 0))
			return jn_error(JN_BAD_INPUT,
							"%s: cell %d of its mesh has the volume %g m^3, which must be > 0; turn or "
							"remove it",
							what, c, jn_mesh_cell_volume(mesh, c));
	JN_TRY(check_thread_key(def->torsion, "torsion", mesh, what));
	return check_thread_key(def->bending, "bending", mesh, what);
}

static JnStatus build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
					  JnArena* arena, JnGroups* out) {
	const JnConstraintsDef* def = options;
	JN_TRY(check(law, def, mesh, what));
	*out = (JnGroups){.density = mesh->thread != NULL ? jn_thread_density(mesh, def->density) : def->density};
	JN_NEW(arena, out->list, JN_CONSTRAINTS_GROUPS);
	JnArena scratch = {0};
	const JnConstraintsFill fill = {
		.def = def, .mesh = mesh, .first_node = first_node, .scratch = &scratch, .arena = arena};
	const JnStatus status = fill_body(&fill, out);
	jn_arena_free(&scratch);
	return status;
}

// A number > 0 that must be given, or one >= 0 that is 0 without.
#define REQUIRED(field_name, unit_text, text)                                                                          \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(JnConstraintsDef, field_name), .high = INFINITY,       \
		.open = JN_OPEN_LOW | JN_OPEN_HIGH, .required = true, .unit = (unit_text), .meaning = (text)                   \
	}
#define OPTIONAL(field_name, unit_text, text)                                                                          \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(JnConstraintsDef, field_name), .high = INFINITY,       \
		.open = JN_OPEN_HIGH, .unit = (unit_text), .meaning = (text)                                                   \
	}

static const JnKey keys[] = {
	REQUIRED(density, "kg/m^3", "mass a volume at rest; of a thread, of a round one of its radius"),
	REQUIRED(
		stiffness, "Pa",
		"of all springs together, about Young's modulus; a thread has the tension of pi r^2 times it at a strain of 1"),
	OPTIONAL(volume, "Pa", "resistance of the cells to changes of volume: what they add to the bulk modulus"),
	OPTIONAL(collapse, "Pa",
			 "nonlinear resistance of cells that lose volume, ever harder as it vanishes, and inside out"),
	OPTIONAL(area, "N/m", "resistance of the triangles of the surface: tension at a relative change of area of 1"),
	OPTIONAL(torsion, "N m^2", "of a thread: torque at a twist of 1 rad/m, GJ"),
	OPTIONAL(bending, "N m^2", "of a thread: moment at a curvature of 1/m, EI, beside what its springs resist"),
	OPTIONAL(damping, "s", "of all parts, as a time: force of a rate of strain over that of the strain"),
	{.name = "torsion_damping",
	 .kind = JN_REAL,
	 .field = offsetof(JnConstraintsDef, torsion_damping),
	 .absent_allowed = true,
	 .high = INFINITY,
	 .open = JN_OPEN_HIGH,
	 .unit = "s",
	 .meaning = "of the torsion of a thread; as damping when absent"},
	{0},
};

const JnLaw jn_law_constraints = {
	.row = {"constraints",
			"Springs on all edges of a mesh of tetrahedra, or of a thread, and what keeps volumes, areas and twist.",
			keys, sizeof(JnConstraintsDef)},
	.build = build,
	.relaxed = jn_relax_edges,
};
