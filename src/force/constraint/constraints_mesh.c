// A mesh of tetrahedra as constraints. A spring of length L stands for the volumes V of the cells at its edge,
//
//   k = stiffness sum of V / L^2,
//
// so that the body, and not its mesh, is what is stiff: the energy of the springs of a cell is 6 V/2 stiffness <strain^2>
// over its edges, and edges in all directions alike make that the energy of a solid with lambda = mu = 0.4 stiffness, hence
// with Young's modulus = stiffness, and with Poisson's ratio 1/4, which springs cannot but have.
#include <stddef.h>
#include <stdlib.h>

#include "force/constraint/constraints.h"
#include "force/constraint/rest.h"

typedef struct Edge {
	int low, high;
	double volume; // of the cells at it [m^3]
} Edge;

static int compare(const void* a, const void* b) {
	const Edge *e = a, *f = b;
	return e->low != f->low ? (e->low > f->low) - (e->low < f->low) : (e->high > f->high) - (e->high < f->high);
}

// Edges once, in the order of their nodes. Equal ones have equal volumes but for rounding: the order of sums is fixed.
static int list_edges(const JnMesh* mesh, Edge* edges) {
	int count = 0, kept = 0;
	for (int c = 0; c < mesh->cell_count; ++c)
		for (int i = 0; i < 4; ++i)
			for (int j = 0; j < i; ++j) {
				const int a = mesh->cells[4 * (ptrdiff_t)c + i], b = mesh->cells[4 * (ptrdiff_t)c + j];
				edges[count++] =
					(Edge){.low = a < b ? a : b, .high = a < b ? b : a, .volume = jn_mesh_cell_volume(mesh, c)};
			}
	qsort(edges, (size_t)count, sizeof *edges, compare);
	for (int k = 0; k < count; ++k)
		if (kept == 0 || compare(&edges[k], &edges[kept - 1]) != 0)
			edges[kept++] = edges[k];
		else
			edges[kept - 1].volume += edges[k].volume;
	return kept;
}

static JnStatus add_springs(const JnConstraintsFill* fill, JnGroups* out) {
	Edge* edges;
	JnConstraint* springs;
	JN_NEW(fill->scratch, edges, 6 * (size_t)fill->mesh->cell_count);
	const int count = list_edges(fill->mesh, edges);
	JN_NEW(fill->scratch, springs, count);
	for (int k = 0; k < count; ++k) {
		springs[k] = (JnConstraint){.nodes = {edges[k].low, edges[k].high}};
		const double L = jn_rest_length(fill->mesh, springs[k].nodes);
		jn_rest_strut(fill->mesh, springs[k].nodes, fill->def->stiffness * edges[k].volume / (L * L), springs[k].rest);
	}
	return jn_constraint_add(JN_CONSTRAINT_strut, count, springs, fill->first_node, fill->def->damping, fill->arena,
							 out);
}

static JnStatus add_volumes(const JnConstraintsFill* fill, JnGroups* out) {
	const JnConstraintsDef* def = fill->def;
	if (def->volume == 0 && def->collapse == 0) return JN_OK;
	JnConstraint* cells;
	JN_NEW(fill->scratch, cells, fill->mesh->cell_count);
	for (int c = 0; c < fill->mesh->cell_count; ++c) {
		for (int i = 0; i < 4; ++i) cells[c].nodes[i] = fill->mesh->cells[4 * (ptrdiff_t)c + i];
		jn_rest_volume(fill->mesh, cells[c].nodes, def->volume, def->collapse, cells[c].rest);
	}
	return jn_constraint_add(JN_CONSTRAINT_volume, fill->mesh->cell_count, cells, fill->first_node, def->damping,
							 fill->arena, out);
}

JnStatus jn_constraints_fill_mesh(const JnConstraintsFill* fill, JnGroups* out) {
	JN_TRY(add_springs(fill, out));
	return add_volumes(fill, out);
}
