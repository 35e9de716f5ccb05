// A slender elastic rod of round section, by its Young's modulus and Poisson's ratio, on the frames of a thread.
//
//   three lines along it, at rho = r/sqrt 2 from the axis     EA in stretch, EI = EA r^2/4 in bending, both exactly
//   torsion between neighbouring frames                       G J/L a link
//   shear of links against sections (skew.h)                  1/(1/(0.9 G A) + L^2/(12 E I))
//   struts along the sides of the sections                    keep those rigid: nothing of the above strains them
//   volumes of the cells, below 0.4 of those at rest          keep sections from folding over in sharp bends
//
// The second term of shear stands for the bending within a link, which frames at its ends cannot see: a straight rod that
// is loaded at its frames has the deflection of beam theory whatever the number of links (MacNeal 1978, "A simple
// quadrilateral shell element", residual bending flexibility). The masses, thirds at the three lines, have the moments of
// inertia of the round section.
#include <math.h>
#include <stddef.h>

#include "base/log.h"
#include "force/constraint/law.h"
#include "force/constraint/rest.h"
#include "force/constraint/skew.h"
#include "force/constraint/strut.h"
#include "force/constraint/torsion.h"
#include "force/constraint/volume.h"
#include "force/relax.h"

/// Keys of `material:`.
typedef struct RodDef {
	double density; // [kg/m^3]
	double young;   // [Pa]
	double poisson;
	double damping; // [s]
} RodDef;

static const double PI = 3.14159265358979323846, SHEAR_SHARE = 0.9; // of a round section
static const double GUARD = 0.4; // share of its volume at which a cell begins to resist: bends of a radius of about r
static const double GUARD_SHARE = 0.002; // of E: never stiffer than the lines, inside out neither (E b''/2 = 222 of it)

/// Stiffnesses of the rod that a thread is.
typedef struct Rod {
	double EA, EI, GA, GJ, young; // [N], [N m^2], [Pa]
} Rod;

static Rod rod_of(const RodDef* def, double radius) {
	const double A = PI * radius * radius, I = 0.25 * A * radius * radius, G = def->young / (2 * (1 + def->poisson));
	return (Rod){
		.EA = def->young * A, .EI = def->young * I, .GA = SHEAR_SHARE * G * A, .GJ = 2 * G * I, .young = def->young};
}

// Struts first, then volumes, torsion and skew, as in link.h.
static void fill_link(const Rod* rod, const JnMesh* mesh, int link, double side_k, JnConstraint* element) {
	const double L = jn_link_length(mesh, link);
	jn_link_nodes(mesh->thread, link, element->nodes);
	double* rest = element->rest;
	for (int k = 0; k < ROD_STRUTS; ++k, rest += STRUT_REALS) {
		const int nodes[2] = {element->nodes[link_struts[k][0]], element->nodes[link_struts[k][1]]};
		jn_rest_strut(mesh, nodes, k < LINK_SIDES ? side_k : rod->EA / (3 * jn_rest_length(mesh, nodes)), rest);
	}
	for (int i = 0; i < JN_LINK_CELLS; ++i, rest += VOLUME_REALS) {
		int cell[4];
		for (int n = 0; n < 4; ++n) cell[n] = element->nodes[link_cells[i][n]];
		jn_rest_guard(mesh, cell, GUARD, GUARD_SHARE * rod->young, rest);
	}
	jn_rest_torsion(mesh, element->nodes, rod->GJ / L, rest);
	jn_rest_skew(mesh, element->nodes, 1 / (1 / rod->GA + L * L / (12 * rod->EI)), rest + TORSION_REALS);
}

static JnStatus fill(const RodDef* def, const JnMesh* mesh, int first_node, JnArena* scratch, JnArena* arena,
					 JnGroups* out) {
	const int links = jn_thread_links(mesh->thread);
	const Rod rod = rod_of(def, mesh->thread->radius);
	const double side_k = rod.EA / (3 * jn_link_length(mesh, 0)); // as the lines: no mode is faster than theirs
	JnConstraint* elements;
	JN_NEW(scratch, elements, links);
	for (int link = 0; link < links; ++link) fill_link(&rod, mesh, link, side_k, &elements[link]);
	JN_TRY(jn_constraint_add(JN_CONSTRAINT_rod_link, links, elements, first_node, def->damping, arena, out));
	return jn_thread_add_end(mesh, side_k, first_node, def->damping, arena, out);
}

// A cell without volume has no share of it to keep.
static JnStatus check_cells(const JnMesh* mesh, const char* what) {
	const double radius = mesh->thread->radius;
	for (int link = 0; link < jn_thread_links(mesh->thread); ++link)
		for (int i = JN_LINK_CELLS * link; i < JN_LINK_CELLS * (link + 1); ++i)
			if (fabs(jn_mesh_cell_volume(mesh, i)) < 1e-6 * radius * radius * jn_link_length(mesh, link))
				return jn_error(
					JN_BAD_INPUT,
					"%s.shape: link %d turns or bends so far from frame to frame that a cell of it is flat; use "
					"more links, or less twist",
					what, link);
	return JN_OK;
}

static JnStatus check(const JnLaw* law, const JnMesh* mesh, const char* what) {
	const JnThread* thread = mesh->thread;
	if (thread == NULL)
		return jn_error(JN_BAD_INPUT, "%s.material.law: '%s' runs on threads alone; use `shape: {type: thread}`", what,
						law->row.name);
	for (int i = 0; i < JN_FRAME_NODES; ++i)
		if (fabs(thread->axis[i] - 1.0 / 3) > 1e-12)
			return jn_error(JN_BAD_INPUT,
							"%s.shape.section: '%s' needs frames about the axis of the thread; use centred", what,
							law->row.name);
	return check_cells(mesh, what);
}

static JnStatus build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
					  JnArena* arena, JnGroups* out) {
	const RodDef* def = options;
	JN_TRY(check(law, mesh, what));
	*out = (JnGroups){.density = jn_thread_density(mesh, def->density)};
	JN_NEW(arena, out->list, 2);
	JnArena scratch = {0};
	const JnStatus status = fill(def, mesh, first_node, &scratch, arena, out);
	jn_arena_free(&scratch);
	return status;
}

static const JnKey keys[] = {
	{.name = "density",
	 .kind = JN_REAL,
	 .field = offsetof(RodDef, density),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "kg/m^3",
	 .meaning = "mass a volume of the round thread"},
	{.name = "young",
	 .kind = JN_REAL,
	 .field = offsetof(RodDef, young),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "Pa",
	 .meaning = "Young's modulus: stiffness in stretch and bending"},
	{.name = "poisson",
	 .kind = JN_REAL,
	 .field = offsetof(RodDef, poisson),
	 .value = {0.3},
	 .low = -1,
	 .high = 0.5,
	 .open = JN_OPEN_LOW,
	 .meaning = "Poisson's ratio, which makes the shear modulus: stiffness in torsion"},
	{.name = "damping",
	 .kind = JN_REAL,
	 .field = offsetof(RodDef, damping),
	 .high = INFINITY,
	 .open = JN_OPEN_HIGH,
	 .unit = "s",
	 .meaning = "of all strains, as a time: force of a rate of strain over that of the strain"},
	{0},
};

const JnLaw jn_law_rod = {
	.row = {"rod", "A slender rod of round section, the radius of its thread: stretch, bending, shear and torsion.",
			keys, sizeof(RodDef)},
	.build = build,
	.relaxed = jn_relax_lines,
};
