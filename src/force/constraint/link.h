/// @file link.h
/// All that acts between two neighbouring frames of a thread in one element, so that its 18 coordinates are gathered once
/// and its forces scattered once: composed of the elements of the other headers, with no formula of its own.
///
///      Q_0 ------------- Q_1       struts: the three sides of the first section, the three lines along the thread and,
///     / |               / |        of a thread link, one diagonal a side; those of the last section of an open thread
///   R_0-|------------ R_1 |        are elements by themselves
///     \ |               \ |        cells: the three tetrahedra of mesh/thread.h
///      P_0 ------------- P_1
///
///   thread link   9 struts, 3 volumes, torsion       rod link   6 struts, 3 volumes, torsion, skew
///
/// Nodes: R_0 P_0 Q_0 R_1 P_1 Q_1. Numbers at rest: those of the parts in the order of the line above.
#ifndef JN_FORCE_CONSTRAINT_LINK_H
#define JN_FORCE_CONSTRAINT_LINK_H

#include "force/constraint/link_parts.h"
#include "force/constraint/skew.h"
#include "force/constraint/strut.h"
#include "force/constraint/torsion.h"
#include "force/constraint/volume.h"

/// What a link is made of: a compile-time constant of the functions below.
typedef struct LinkKind {
	int struts, cells;
	bool has_skew;
} LinkKind;

static const LinkKind thread_link_kind = {.struts = LINK_STRUTS, .cells = JN_LINK_CELLS};
static const LinkKind rod_link_kind = {.struts = ROD_STRUTS, .cells = JN_LINK_CELLS, .has_skew = true};

enum {
	LINK_EDGES = LINK_NODES - 1,
	THREAD_LINK_REALS = LINK_STRUTS * STRUT_REALS + JN_LINK_CELLS * VOLUME_REALS + TORSION_REALS,
	ROD_LINK_REALS = ROD_STRUTS * STRUT_REALS + JN_LINK_CELLS * VOLUME_REALS + TORSION_REALS + SKEW_REALS
};

/// Edges of a part, from its last node.
JN_INLINE void link_edges(Wide edges[][3], const int* nodes, int count, Wide out[][3]) {
	const int last = nodes[count - 1];
	JN_UNROLL for (int i = 0; i < count - 1; i++) {
		JN_UNROLL for (int a = 0; a < 3; a++) {
			const Wide from = last == LINK_EDGES ? wide_set(0) : edges[last][a];
			out[i][a] = (nodes[i] == LINK_EDGES ? wide_set(0) : edges[nodes[i]][a]) - from;
		}
	}
}

/// Add the forces of a part to those of the link.
JN_INLINE void link_add(Wide part[][3], const int* nodes, int count, Wide out[][3]) {
	const int last = nodes[count - 1];
	JN_UNROLL for (int i = 0; i < count - 1; i++) {
		JN_UNROLL for (int a = 0; a < 3; a++) {
			if (nodes[i] != LINK_EDGES) out[nodes[i]][a] += part[i][a];
			if (last != LINK_EDGES) out[last][a] -= part[i][a];
		}
	}
}

/// Add `factor` times an edge to the forces of a strut.
JN_INLINE void link_add_along(Wide factor, const Wide d[3], const int nodes[2], Wide out[][3]) {
	JN_UNROLL for (int a = 0; a < 3; a++) {
		if (nodes[0] != LINK_EDGES) out[nodes[0]][a] = wide_fma(factor, d[a], out[nodes[0]][a]);
		if (nodes[1] != LINK_EDGES) out[nodes[1]][a] = wide_fma(-factor, d[a], out[nodes[1]][a]);
	}
}

JN_INLINE void link_add_all(Wide part[][3], Wide out[][3]) {
	JN_UNROLL for (int k = 0; k < 3 * LINK_EDGES; k++) out[k / 3][k % 3] += part[k / 3][k % 3];
}

JN_INLINE const double* link_cell_rest(const LinkKind* kind, const double* rest, int cell) {
	return rest + (kind->struts * STRUT_REALS + cell * VOLUME_REALS) * JN_WIDE;
}

JN_INLINE const double* link_torsion_rest(const LinkKind* kind, const double* rest) {
	return link_cell_rest(kind, rest, kind->cells);
}

JN_INLINE const double* link_skew_rest(const LinkKind* kind, const double* rest) {
	return link_torsion_rest(kind, rest) + TORSION_REALS * JN_WIDE;
}

/// Whether a part has a stiffness in any lane, so that its work can be left out.
JN_INLINE bool link_has(const double* stiffness) {
	return wide_any(wide_load(stiffness) != 0.0);
}

JN_INLINE bool link_has_cell(const double* rest) {
	return link_has(rest + VOLUME_STIFFNESS * JN_WIDE) || link_has(rest + VOLUME_NONLINEAR * JN_WIDE);
}

JN_INLINE bool link_has_torsion(const double* rest) {
	return link_has(rest + TORSION_STIFFNESS * JN_WIDE);
}

JN_INLINE Wide link_energy(const LinkKind* kind, const double* rest, Wide edges[][3]) {
	Wide sum = wide_set(0), part[LINK_EDGES][3];
	JN_UNROLL for (int k = 0; k < kind->struts; k++) {
		link_edges(edges, link_struts[k], 2, part);
		sum += strut_energy(rest + k * STRUT_REALS * JN_WIDE, part);
	}
	JN_UNROLL for (int k = 0; k < kind->cells; k++) {
		link_edges(edges, link_cells[k], 4, part);
		sum += volume_energy(link_cell_rest(kind, rest, k), part);
	}
	sum += torsion_energy(link_torsion_rest(kind, rest), edges);
	return kind->has_skew ? sum + skew_energy(link_skew_rest(kind, rest), edges) : sum;
}

JN_INLINE void link_force(const LinkKind* kind, const double* rest, Wide edges[][3], Wide force[][3]) {
	Wide part[LINK_EDGES][3], pull[LINK_EDGES][3];
	JN_UNROLL for (int k = 0; k < 3 * LINK_EDGES; k++) force[k / 3][k % 3] = wide_set(0);
	JN_UNROLL for (int k = 0; k < kind->struts; k++) {
		link_edges(edges, link_struts[k], 2, part);
		link_add_along(strut_pull(rest + k * STRUT_REALS * JN_WIDE, part), part[0], link_struts[k], force);
	}
	JN_UNROLL for (int k = 0; k < kind->cells; k++) {
		const double* cell = link_cell_rest(kind, rest, k);
		if (!link_has_cell(cell)) continue;
		link_edges(edges, link_cells[k], 4, part);
		volume_force(cell, part, pull);
		link_add(pull, link_cells[k], 4, force);
	}
	const double* torsion = link_torsion_rest(kind, rest);
	if (link_has_torsion(torsion)) {
		torsion_force(torsion, edges, pull);
		link_add_all(pull, force);
	}
	if (!kind->has_skew) return;
	skew_force(link_skew_rest(kind, rest), edges, pull);
	link_add_all(pull, force);
}

typedef struct Link {
	Strut struts[LINK_STRUTS];
	Volume cells[JN_LINK_CELLS];
	Torsion torsion;
	Skew skew;
	bool has_cell[JN_LINK_CELLS], has_torsion;
} Link;

JN_INLINE void link_load(const LinkKind* kind, const double* rest, Wide edges[][3], bool definite, Link* s) {
	Wide part[LINK_EDGES][3];
	JN_UNROLL for (int k = 0; k < kind->struts; k++) {
		link_edges(edges, link_struts[k], 2, part);
		strut_load(rest + k * STRUT_REALS * JN_WIDE, part, definite, &s->struts[k]);
	}
	JN_UNROLL for (int k = 0; k < kind->cells; k++) {
		s->has_cell[k] = link_has_cell(link_cell_rest(kind, rest, k));
		if (!s->has_cell[k]) continue;
		link_edges(edges, link_cells[k], 4, part);
		volume_load(link_cell_rest(kind, rest, k), part, &s->cells[k]);
	}
	s->has_torsion = link_has_torsion(link_torsion_rest(kind, rest));
	if (s->has_torsion) torsion_load(link_torsion_rest(kind, rest), edges, &s->torsion);
	if (kind->has_skew) skew_load(link_skew_rest(kind, rest), edges, &s->skew);
}

JN_INLINE void link_multiply(const LinkKind* kind, const Link* s, bool definite, Wide p[][3], Wide out[][3]) {
	Wide moved[LINK_EDGES][3], pull[LINK_EDGES][3];
	JN_UNROLL for (int k = 0; k < 3 * LINK_EDGES; k++) out[k / 3][k % 3] = wide_set(0);
	JN_UNROLL for (int k = 0; k < kind->struts; k++) {
		link_edges(p, link_struts[k], 2, moved);
		strut_multiply(&s->struts[k], moved, pull);
		link_add(pull, link_struts[k], 2, out);
	}
	JN_UNROLL for (int k = 0; k < kind->cells; k++) {
		if (!s->has_cell[k]) continue;
		link_edges(p, link_cells[k], 4, moved);
		volume_multiply(&s->cells[k], definite, moved, pull);
		link_add(pull, link_cells[k], 4, out);
	}
	if (s->has_torsion) {
		torsion_multiply(&s->torsion, definite, p, pull);
		link_add_all(pull, out);
	}
	if (!kind->has_skew) return;
	skew_multiply(&s->skew, definite, p, pull);
	link_add_all(pull, out);
}

#define JN_DEFINE_LINK(name)                                                                                           \
	JN_INLINE Wide name##_energy(const double* rest, Wide edges[][3]) {                                                \
		return link_energy(&name##_kind, rest, edges);                                                                 \
	}                                                                                                                  \
	JN_INLINE void name##_force(const double* rest, Wide edges[][3], Wide force[][3]) {                                \
		link_force(&name##_kind, rest, edges, force);                                                                  \
	}                                                                                                                  \
	JN_INLINE void name##_multiply(const void* state, bool definite, Wide p[][3], Wide out[][3]) {                     \
		link_multiply(&name##_kind, state, definite, p, out);                                                          \
	}                                                                                                                  \
	JN_INLINE void name##_tangent(const double* rest, Wide edges[][3], bool definite, double* blocks) {                \
		Link s;                                                                                                        \
		link_load(&name##_kind, rest, edges, definite, &s);                                                            \
		columns_of(&s, definite, LINK_EDGES, name##_multiply, blocks);                                                 \
	}                                                                                                                  \
	JN_INLINE void name##_product(const double* rest, Wide edges[][3], bool definite, Wide p[][3], Wide out[][3]) {    \
		Link s;                                                                                                        \
		link_load(&name##_kind, rest, edges, definite, &s);                                                            \
		link_multiply(&name##_kind, &s, definite, p, out);                                                             \
	}
JN_DEFINE_LINK(thread_link)
JN_DEFINE_LINK(rod_link)
#undef JN_DEFINE_LINK

#endif
