// Cloth as springs (Provot 1995): structural ones along the edges of the mesh that follow the threads, shear ones along the
// others and along the second diagonal of their squares, bend ones between nodes two apart along a thread.
//
// The parameters are those of an area, so that the cloth stays the same on finer meshes. A spring that stands for the area
// A at rest has E = 1/2 k A ((l - L)/L)^2: A is that of the triangles at its edge. Squares sheared by gamma stretch one
// diagonal by gamma/2 and shorten the other, hence the springs of shear have 2 k_s, so that E = 1/2 k_s A gamma^2. Bend springs
// resist through the shortening of chords, as much as the angle to the fourth power: k_b is a stiffness [N/m] of
// these springs, not a bending stiffness.
#include <math.h>
#include <stddef.h>

#include "force/cloth/sheet.h"
#include "math/vec3.h"

static const double STRAIGHT = 0.97; // squared cosine of 10 degrees: edges that follow a thread; threads that go on

/// 0 along u, 1 along v, 2 neither.
static int direction_of(const JnSheetEdge* edge) {
	if (edge->along[0] > STRAIGHT) return 0;
	return edge->along[1] > STRAIGHT ? 1 : 2;
}

static JnConstraint spring_between(const JnSheet* sheet, int a, int b, double stiffness, double area) {
	const double length = vec3_distance(jn_sheet_node(sheet, a), jn_sheet_node(sheet, b));
	return (JnConstraint){.nodes = {a, b}, .rest = {length, stiffness * area / (length * length)}};
}

static int list_structural(const JnSheet* sheet, const JnClothDef* def, JnConstraint* out) {
	int count = 0;
	for (int i = 0; i < sheet->edge_count; ++i) {
		const JnSheetEdge* edge = &sheet->edges[i];
		const int direction = direction_of(edge);
		if (direction == 2) continue;
		out[count++] = spring_between(sheet, edge->nodes[0], edge->nodes[1], def->stretch[direction], edge->area);
	}
	return count;
}

static int list_shear(const JnSheet* sheet, const JnClothDef* def, JnConstraint* out) {
	int count = 0;
	for (int i = 0; i < sheet->edge_count; ++i) {
		const JnSheetEdge* edge = &sheet->edges[i];
		if (direction_of(edge) != 2) continue;
		out[count++] = spring_between(sheet, edge->nodes[0], edge->nodes[1], 2 * def->shear, edge->area);
		if (edge->wings[0] >= 0 && edge->wings[1] >= 0)
			out[count++] = spring_between(sheet, edge->wings[0], edge->wings[1], 2 * def->shear, edge->area);
	}
	return count;
}

/// The edges at each node: list[start[node]] up to list[start[node + 1] - 1].
typedef struct Fans {
	int *start, *list;
} Fans;

static JnStatus list_fans(const JnSheet* sheet, JnArena* scratch, Fans* fans) {
	const int nodes = sheet->mesh->node_count;
	JN_NEW(scratch, fans->start, nodes + 2);
	JN_NEW(scratch, fans->list, 2 * (size_t)sheet->edge_count);
	for (int k = 0; k < 2 * sheet->edge_count; ++k) fans->start[sheet->edges[k / 2].nodes[k % 2] + 2]++;
	for (int node = 0; node < nodes; ++node) fans->start[node + 2] += fans->start[node + 1];
	for (int k = 0; k < 2 * sheet->edge_count; ++k)
		fans->list[fans->start[sheet->edges[k / 2].nodes[k % 2] + 1]++] = k / 2;
	return JN_OK;
}

static int far_end(const JnSheetEdge* edge, int node) {
	return edge->nodes[0] == node ? edge->nodes[1] : edge->nodes[0];
}

// Whether two edges at a node are one thread.
static bool goes_on(const JnSheet* sheet, int node, const JnSheetEdge* first, const JnSheetEdge* second) {
	if (direction_of(first) == 2 || direction_of(first) != direction_of(second)) return false;
	const double *X = jn_sheet_node(sheet, node), *a = jn_sheet_node(sheet, far_end(first, node)),
				 *b = jn_sheet_node(sheet, far_end(second, node));
	double product = 0;
	for (int k = 0; k < 3; ++k) product += (a[k] - X[k]) * (b[k] - X[k]);
	return product < -0.9 * first->length * second->length;
}

static int list_bend(const JnSheet* sheet, const JnClothDef* def, const Fans* fans, JnConstraint* out) {
	int count = 0;
	for (int node = 0; node < sheet->mesh->node_count; ++node)
		for (int i = fans->start[node]; i < fans->start[node + 1]; ++i)
			for (int k = i + 1; k < fans->start[node + 1]; ++k) {
				const JnSheetEdge *first = &sheet->edges[fans->list[i]], *second = &sheet->edges[fans->list[k]];
				const double stiffness = def->bend[direction_of(first) == 1];
				if (stiffness == 0 || !goes_on(sheet, node, first, second)) continue;
				out[count++] = spring_between(sheet, far_end(first, node), far_end(second, node), stiffness,
											  0.5 * (first->area + second->area));
			}
	return count;
}

static JnStatus add_group(int count, JnConstraint* elements, int first_node, double damping, JnArena* arena,
						  JnGroups* out) {
	if (count == 0) return JN_OK;
	for (int i = 0; i < count; ++i)
		for (int k = 0; k < 2; ++k) elements[i].nodes[k] += first_node;
	JnGroup* group = &out->list[out->count++];
	JN_TRY(jn_constraint_group_create(jn_constraint_kernel(JN_CONSTRAINT_spring, 0), count, elements, arena, group));
	group->damping = damping;
	return JN_OK;
}

static JnStatus fill(const JnClothDef* def, const JnSheet* sheet, int first_node, JnArena* scratch, JnArena* arena,
					 JnGroups* out) {
	Fans fans;
	JnConstraint* list;
	JN_TRY(list_fans(sheet, scratch, &fans));
	size_t pairs = 0; // of edges at a node: no thread goes on in more
	for (int node = 0; node < sheet->mesh->node_count; ++node) {
		const size_t fan = (size_t)(fans.start[node + 1] - fans.start[node]);
		pairs += fan * fan / 2;
	}
	JN_NEW(scratch, list, pairs + 2 * (size_t)sheet->edge_count);
	int count = list_structural(sheet, def, list);
	JN_TRY(add_group(count, list, first_node, def->stretch_damping, arena, out));
	count = def->shear > 0 ? list_shear(sheet, def, list) : 0;
	JN_TRY(add_group(count, list, first_node, def->shear_damping, arena, out));
	count = list_bend(sheet, def, &fans, list);
	return add_group(count, list, first_node, def->bend_damping, arena, out);
}

static JnStatus build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
					  JnArena* arena, JnGroups* out) {
	return jn_cloth_build(fill, law, options, mesh, first_node, what, arena, out);
}

static const JnKey keys[] = {JN_CLOTH_KEYS("stiffness of the structural springs along u and v",
										   "stiffness against shear, by the springs of diagonals", "N/m",
										   "stiffness of the springs between nodes two apart along u and v")};

const JnLaw jn_law_mass_spring = {
	.row = {"mass_spring",
			"Cloth as springs (Provot 1995): structural, shear and bend ones, each with a damping of its own.", keys,
			sizeof(JnClothDef)},
	.build = build,
};
