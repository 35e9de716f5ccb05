// A thread as constraints (EX, "Deformable linear object model"): springs on all edges of its cells, the volumes of the cells,
// torsion between frames. All springs of the thread have one stiffness k, which lets explicit methods take the largest
// steps. A link has nine springs, and a frame nine coordinates: without volumes and torsion the springs are a statically
// determinate truss, in which the three lines along the thread alone carry its tension, so that
//
//   EA = 3 k L = stiffness pi r^2
//
// over links of length L, exactly, and a finer thread stretches alike.
#include <math.h>
#include <stddef.h>

#include "force/constraint/angle.h"
#include "force/constraint/constraints.h"
#include "force/constraint/rest.h"
#include "force/constraint/strut.h"
#include "force/constraint/torsion.h"
#include "force/constraint/volume.h"

static const double PI = 3.14159265358979323846;

static double stiffness_of_springs(const JnConstraintsFill* fill) {
	const double r = fill->mesh->thread->radius;
	return fill->def->stiffness * PI * r * r / (LINK_SIDES * jn_link_length(fill->mesh, 0));
}

static bool has_own_torsion(const JnConstraintsDef* def) {
	return def->torsion > 0 && !isnan(def->torsion_damping) && def->torsion_damping != def->damping;
}

// Struts, volumes and torsion, as in link.h.
static void fill_link(const JnConstraintsFill* fill, int link, double k, JnConstraint* element) {
	const JnConstraintsDef* def = fill->def;
	double* rest = element->rest;
	jn_link_nodes(fill->mesh->thread, link, element->nodes);
	for (int i = 0; i < LINK_STRUTS; ++i, rest += STRUT_REALS) {
		const int ends[2] = {element->nodes[link_struts[i][0]], element->nodes[link_struts[i][1]]};
		jn_rest_strut(fill->mesh, ends, k, rest);
	}
	for (int i = 0; i < JN_LINK_CELLS; ++i, rest += VOLUME_REALS) {
		int cell[4];
		for (int n = 0; n < 4; ++n) cell[n] = element->nodes[link_cells[i][n]];
		jn_rest_volume(fill->mesh, cell, def->volume, def->collapse, rest);
	}
	const double torsion = has_own_torsion(def) ? 0 : def->torsion;
	jn_rest_torsion(fill->mesh, element->nodes, torsion / jn_link_length(fill->mesh, link), rest);
}

static JnStatus add_links(const JnConstraintsFill* fill, JnGroups* out) {
	const int links = jn_thread_links(fill->mesh->thread);
	const double k = stiffness_of_springs(fill), damping = fill->def->damping;
	JnConstraint* elements;
	JN_NEW(fill->scratch, elements, links);
	for (int link = 0; link < links; ++link) fill_link(fill, link, k, &elements[link]);
	JN_TRY(jn_constraint_add(JN_CONSTRAINT_thread_link, links, elements, fill->first_node, damping, fill->arena, out));
	return jn_thread_add_end(fill->mesh, k, fill->first_node, damping, fill->arena, out);
}

// One damping serves all of a link: torsion with another stands by itself.
static JnStatus add_torsion(const JnConstraintsFill* fill, JnGroups* out) {
	const int links = jn_thread_links(fill->mesh->thread);
	if (!has_own_torsion(fill->def)) return JN_OK;
	JnConstraint* elements;
	JN_NEW(fill->scratch, elements, links);
	for (int link = 0; link < links; ++link) {
		jn_link_nodes(fill->mesh->thread, link, elements[link].nodes);
		jn_rest_torsion(fill->mesh, elements[link].nodes, fill->def->torsion / jn_link_length(fill->mesh, link),
						elements[link].rest);
	}
	return jn_constraint_add(JN_CONSTRAINT_torsion, links, elements, fill->first_node, fill->def->torsion_damping,
							 fill->arena, out);
}

// A line turns by the angle kappa L at each of its nodes: three of k = EI/(3 L) have EI/2 kappa^2 a length.
static JnStatus add_bending(const JnConstraintsFill* fill, JnGroups* out) {
	const JnThread* thread = fill->mesh->thread;
	const int links = jn_thread_links(thread), bends = thread->is_closed ? links : links - 1;
	if (fill->def->bending == 0 || bends == 0) return JN_OK;
	JnConstraint* elements;
	JN_NEW(fill->scratch, elements, JN_FRAME_NODES * bends);
	for (int e = 0; e < JN_FRAME_NODES * bends; ++e) {
		const int link = e / JN_FRAME_NODES, line = e % JN_FRAME_NODES, middle = jn_thread_end(thread, link);
		const int nodes[ANGLE_NODES] = {JN_FRAME_NODES * link + line,
										JN_FRAME_NODES * jn_thread_end(thread, middle) + line,
										JN_FRAME_NODES * middle + line};
		for (int i = 0; i < ANGLE_NODES; ++i) elements[e].nodes[i] = nodes[i];
		jn_rest_angle(fill->mesh, nodes, fill->def->bending / (3 * jn_link_length(fill->mesh, link)), elements[e].rest);
	}
	return jn_constraint_add(JN_CONSTRAINT_angle, JN_FRAME_NODES * bends, elements, fill->first_node,
							 fill->def->damping, fill->arena, out);
}

JnStatus jn_constraints_fill_thread(const JnConstraintsFill* fill, JnGroups* out) {
	JN_TRY(add_links(fill, out));
	JN_TRY(add_torsion(fill, out));
	return add_bending(fill, out);
}
