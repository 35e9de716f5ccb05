// Cloth as triangles that resist stretch along the threads, shear between them and bending across their edges: energies an
// area, so that the parameters are those of the fabric and not of the mesh.
//
//   stretch   1/2 k_u (|w_u| - 1)^2 + 1/2 k_v (|w_v| - 1)^2      k_u, k_v [N/m]     stretch.h
//   shear     1/2 k_s (w_u . w_v)^2                              k_s [N/m]          shear.h
//   bending   1/2 (B_u kappa_u^2 + B_v kappa_v^2)                B_u, B_v [N m]     bend.h
//
// A hinge of length L between triangles of the areas A_1 and A_2 has k = (B_u m_u^4 + B_v m_v^4) L^2/(A_1 + A_2), where m
// is the direction across it. On the alternating pattern of squares the edges then see kappa_u and kappa_v, the diagonals
// the twist alone, and the sum is the energy of a thin plate, 1/2 B |kappa|^2 for B_u = B_v: a roll in any direction.
#include <math.h>
#include <stddef.h>

#include "force/cloth/sheet.h"
#include "math/vec3.h"

// B of stretch.h: the inverse of the edges from node 2 in the frame u, v.
static void invert_edges(const JnSheet* sheet, int cell, double B[4]) {
	const int* nodes = sheet->mesh->cells + 3 * (ptrdiff_t)cell;
	double d[2][2]; // [u, v][edge]
	for (int i = 0; i < 2; ++i) {
		double edge[3];
		for (int a = 0; a < 3; ++a) edge[a] = jn_sheet_node(sheet, nodes[i])[a] - jn_sheet_node(sheet, nodes[2])[a];
		d[0][i] = vec3_dot(edge, sheet->cells[cell].u);
		d[1][i] = vec3_dot(edge, sheet->cells[cell].v);
	}
	const double determinant = d[0][0] * d[1][1] - d[0][1] * d[1][0];
	B[0] = d[1][1] / determinant;
	B[1] = -d[0][1] / determinant;
	B[2] = -d[1][0] / determinant;
	B[3] = d[0][0] / determinant;
}

// Stretch or shear: the numbers behind B are the stiffnesses times the area.
static JnStatus build_triangles(const JnSheet* sheet, JnConstraintKernel which, const double* stiffness, int first_node,
								JnArena* scratch, JnArena* arena, JnGroup* group) {
	const JnKernel* kernel = jn_constraint_kernel(which, 0);
	const int count = sheet->mesh->cell_count;
	JnConstraint* elements;
	JN_NEW(scratch, elements, count);
	for (int cell = 0; cell < count; ++cell) {
		for (int i = 0; i < 3; ++i) elements[cell].nodes[i] = first_node + sheet->mesh->cells[3 * (ptrdiff_t)cell + i];
		invert_edges(sheet, cell, elements[cell].rest);
		for (int k = 4; k < kernel->rest_reals; ++k)
			elements[cell].rest[k] = stiffness[k - 4] * sheet->cells[cell].area;
	}
	return jn_constraint_group_create(kernel, count, elements, arena, group);
}

// Sine and cosine of the angle between the wings at rest, as in bend.h.
static void measure_angle(const JnSheet* sheet, const JnSheetEdge* edge, double rest[2]) {
	const double* origin = jn_sheet_node(sheet, edge->nodes[0]);
	double e[3], t[2][3], n[3];
	for (int a = 0; a < 3; ++a) e[a] = jn_sheet_node(sheet, edge->nodes[1])[a] - origin[a];
	vec3_normalize(e);
	for (int w = 0; w < 2; ++w) {
		for (int a = 0; a < 3; ++a) t[w][a] = jn_sheet_node(sheet, edge->wings[w])[a] - origin[a];
		const double along = vec3_dot(t[w], e);
		for (int a = 0; a < 3; ++a) t[w][a] -= along * e[a];
		vec3_normalize(t[w]);
	}
	vec3_cross(e, t[0], n);
	rest[0] = vec3_dot(n, t[1]);
	rest[1] = -vec3_dot(t[0], t[1]);
}

static JnStatus build_hinges(const JnSheet* sheet, const double bend[2], int first_node, JnArena* scratch,
							 JnArena* arena, JnGroup* group) {
	JnConstraint* elements;
	int count = 0;
	JN_NEW(scratch, elements, sheet->edge_count);
	for (int i = 0; i < sheet->edge_count; ++i) {
		const JnSheetEdge* edge = &sheet->edges[i];
		if (edge->wings[0] < 0 || edge->wings[1] < 0) continue;
		JnConstraint* element = &elements[count++];
		const int nodes[4] = {edge->wings[0], edge->wings[1], edge->nodes[1], edge->nodes[0]};
		for (int k = 0; k < 4; ++k) element->nodes[k] = first_node + nodes[k];
		measure_angle(sheet, edge, element->rest);
		const double across_u = edge->along[1], across_v = edge->along[0]; // squares
		const double B = bend[0] * across_u * across_u + bend[1] * across_v * across_v;
		element->rest[2] = B * edge->length * edge->length / edge->area;
	}
	return jn_constraint_group_create(jn_constraint_kernel(JN_CONSTRAINT_bend, 0), count, elements, arena, group);
}

static JnStatus fill(const JnClothDef* def, const JnSheet* sheet, int first_node, JnArena* scratch, JnArena* arena,
					 JnGroups* out) {
	JnGroup* group = out->list;
	JN_TRY(build_triangles(sheet, JN_CONSTRAINT_stretch, def->stretch, first_node, scratch, arena, group));
	group++->damping = def->stretch_damping;
	if (def->shear > 0) {
		JN_TRY(build_triangles(sheet, JN_CONSTRAINT_shear, &def->shear, first_node, scratch, arena, group));
		group++->damping = def->shear_damping;
	}
	if ((def->bend[0] > 0 || def->bend[1] > 0) && sheet->mesh->cell_count > 1) {
		JN_TRY(build_hinges(sheet, def->bend, first_node, scratch, arena, group));
		if (group->count > 0) group++->damping = def->bend_damping;
	}
	out->count = (int)(group - out->list);
	return JN_OK;
}

static JnStatus build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
					  JnArena* arena, JnGroups* out) {
	return jn_cloth_build(fill, law, options, mesh, first_node, what, arena, out);
}

static const JnKey keys[] = {
	JN_CLOTH_KEYS("stiffness under tension along the threads u and v", "stiffness against shear between the threads",
				  "N m", "bending stiffness of the threads u and v: moment a width for a curvature of 1/m")};

const JnLaw jn_law_membrane = {
	.row = {"membrane",
			"Cloth as triangles: stretch along two directions of threads, shear between them (Baraff, Witkin 1998), "
			"bending at edges (Grinspun et al. 2003), each with a damping of its own.",
			keys, sizeof(JnClothDef)},
	.build = build,
};
