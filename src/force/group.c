// Builds element groups: rest data in batches, with J0 = sum_i X_i (x) dN_i/dxi at each quadrature point.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "force/element.h"
#include "force/kernel.h"
#include "math/mat3.h"

static const JnElement* const elements[JN_SOLID_SHAPE_COUNT] = {
	[JN_TET4] = &jn_element_tet4, [JN_TET10] = &jn_element_tet10, [JN_HEX8] = &jn_element_hex8};

/// J[a][r] = dX_a/dxi_r at point p of a cell.
static void rest_jacobian(const JnElement* element, const JnMesh* mesh, int cell, int p, double J[3][3]) {
	const int* nodes = mesh->cells + (ptrdiff_t)cell * element->nodes;
	const double* origin = mesh->nodes + 3 * (ptrdiff_t)nodes[element->nodes - 1];
	memset(J, 0, 9 * sizeof(double));
	for (int i = 0; i < element->nodes - 1; i++) {
		const double* X = mesh->nodes + 3 * (ptrdiff_t)nodes[i];
		for (int k = 0; k < 9; k++) J[k / 3][k % 3] += (X[k / 3] - origin[k / 3]) * element->gradient[p][i][k % 3];
	}
}

/// Rest data of a point: L = B Q lower triangular, with B = J^-1 and Q a rotation. F Q = (dx/dxi) L is as good as F = dx/dX
/// for laws that do not tell directions at rest apart; those that have axes keep Q in the group's memory.
typedef struct Rest {
	double determinant, L[6], Q[3][3];
} Rest;

static double dot(const double a[3], const double b[3]) {
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static Rest rest_of(double J[3][3]) {
	Rest rest;
	double B[3][3], q[3][3];
	rest.determinant = mat3_invert(J, B);
	const double length = sqrt(dot(B[0], B[0]));
	for (int c = 0; c < 3; c++) q[0][c] = B[0][c] / length;
	const double along = dot(B[1], q[0]);
	for (int c = 0; c < 3; c++) q[1][c] = B[1][c] - along * q[0][c];
	const double rest_length = sqrt(dot(q[1], q[1]));
	for (int c = 0; c < 3; c++) q[1][c] /= rest_length;
	for (int c = 0; c < 3; c++) q[2][c] = mat3_cofactor(q, 2, c);
	for (int r = 0, k = 0; r < 3; r++)
		for (int c = 0; c <= r; c++, k++) rest.L[k] = dot(B[r], q[c]);
	for (int k = 0; k < 9; k++) rest.Q[k / 3][k % 3] = q[k % 3][k / 3];
	return rest;
}

static JnStatus check_cell(const JnElement* element, const JnMesh* mesh, int cell, const char* what) {
	const double volume = jn_mesh_cell_volume(mesh, cell); // quadrature points alone miss exchanged corners of a tet10
	for (int p = 0; p < element->points; p++) {
		double J[3][3];
		rest_jacobian(element, mesh, cell, p, J);
		const Rest rest = rest_of(J);
		if (rest.determinant > 0 && volume > 0 && isfinite(rest.L[0])) continue;
		const double scale = mesh->shape == JN_HEX8 ? 512 : 1; // of a cube with edges of 2, as people know it
		return jn_error(
			JN_BAD_INPUT,
			"%s.shape: cell %d of the %s mesh is flat or inside out: its volume is %g m^3 and its Jacobian at "
			"quadrature point %d is %g, both must be > 0; check the order of its nodes, or make the shape "
			"less extreme",
			what, cell, jn_shape_info[mesh->shape].name, volume, p, rest.determinant / scale);
	}
	return JN_OK;
}

/// Whether each cell has the same Jacobian at all points, to what positions can tell.
static bool are_parallelepipeds(const JnElement* element, const JnMesh* mesh) {
	for (int cell = 0; cell < mesh->cell_count; cell++) {
		double first[3][3], J[3][3], size = 0;
		rest_jacobian(element, mesh, cell, 0, first);
		for (int k = 0; k < 9; k++) size = fmax(size, fabs(first[k / 3][k % 3]));
		for (int p = 1; p < element->points; p++) {
			rest_jacobian(element, mesh, cell, p, J);
			for (int k = 0; k < 9; k++)
				if (!(fabs(J[k / 3][k % 3] - first[k / 3][k % 3]) <= 1e-12 * size)) return false;
		}
	}
	return true;
}

static void fill_point(JnGroup* group, int slot, int p, const Rest* rest, double weight) {
	const int width = group->kernel->width, reals = group->kernel->rest_reals,
			  frozen_reals = group->kernel->frozen_reals;
	const int lane = slot % width;
	const ptrdiff_t batch = slot / width;
	if (frozen_reals > 0) { // F Q = Q at rest
		double* frozen = group->frozen + (batch * group->kernel->points + p) * frozen_reals * width + lane;
		for (int k = 0; k < frozen_reals; k++) frozen[k * width] = rest->Q[k / 3][k % 3];
	}
	if (p >= group->rest_points) return;
	double* to = group->rest + (batch * group->rest_points + p) * reals * width + lane;
	float* single = group->rest_single + (batch / 2 * group->rest_points + p) * 12 * width + batch % 2 * width + lane;
	for (int k = 0; k < 6; k++) {
		to[k * width] = rest->L[k];
		single[2 * k * width] = (float)(sqrt(weight) * rest->L[k]);
	}
	to[6 * width] = weight;
}

/// Fill one lane of the group with a cell. `share` is 1, or 0 in padding.
static void fill_lane(JnGroup* group, const JnMesh* mesh, int nodes_offset, int slot, int cell, double share) {
	const JnElement* element = elements[mesh->shape];
	const int width = group->kernel->width, lane = slot % width;
	const ptrdiff_t batch = slot / width;
	for (int i = 0; i < element->nodes; i++) {
		const int node = mesh->cells[(ptrdiff_t)cell * element->nodes + i];
		group->nodes[(batch * element->nodes + i) * width + lane] = node + nodes_offset;
	}
	for (int p = 0; p < element->points; p++) {
		double J[3][3];
		rest_jacobian(element, mesh, cell, p, J);
		const Rest rest = rest_of(J);
		fill_point(group, slot, p, &rest, share * element->weight * rest.determinant);
	}
}

/// A cell and its lowest node.
typedef struct CellAt {
	int lowest, cell;
} CellAt;

static int by_lowest_node(const void* a, const void* b) {
	const CellAt *left = a, *right = b;
	if (left->lowest != right->lowest) return left->lowest < right->lowest ? -1 : 1;
	return (left->cell > right->cell) - (left->cell < right->cell);
}

/// Which cell stands in which slot. Cells that lie about at random, as meshers leave them, are sorted by their lowest nodes,
/// so that neighbours find what they share in the cache; those of a grid stay as they are.
static JnStatus order_cells(const JnMesh* mesh, JnArena* arena, CellAt** out) {
	const int nodes = jn_shape_info[mesh->shape].nodes;
	double steps = 0;
	JN_NEW(arena, *out, mesh->cell_count);
	for (int cell = 0; cell < mesh->cell_count; cell++) {
		const int* at = mesh->cells + (ptrdiff_t)cell * nodes;
		int lowest = at[0];
		for (int i = 1; i < nodes; i++) lowest = at[i] < lowest ? at[i] : lowest;
		(*out)[cell] = (CellAt){lowest, cell};
		if (cell > 0) steps += fabs((double)lowest - (*out)[cell - 1].lowest);
	}
	const double far = mesh->node_count / 16.0; // random numbers are a third of their range apart
	if (steps > far * mesh->cell_count) qsort(*out, (size_t)mesh->cell_count, sizeof **out, by_lowest_node);
	return JN_OK;
}

static JnStatus fill_lanes(JnGroup* group, const JnMesh* mesh, int nodes_offset) {
	const int slots = group->batches * group->kernel->width;
	JnArena scratch = {0};
	CellAt* cells = NULL;
	const JnStatus status = order_cells(mesh, &scratch, &cells);
	for (int slot = 0; slot < slots && status == JN_OK; slot++) {
		const bool is_padding = slot >= mesh->cell_count;
		const int cell = cells[is_padding ? mesh->cell_count - 1 : slot].cell;
		fill_lane(group, mesh, nodes_offset, slot, cell, is_padding ? 0 : 1);
	}
	jn_arena_free(&scratch);
	return status;
}

JnStatus jn_group_create(const JnKernel* kernel, const JnMesh* mesh, int nodes_offset, const JnMaterialDef* material,
						 const char* what, JnArena* arena, JnGroup* group) {
	const int width = kernel->width, batches = (mesh->cell_count + width - 1) / width;
	const size_t slots = (size_t)batches * width, pairs = ((size_t)batches + 1) / 2;
	const JnElement* element = elements[mesh->shape];
	for (int cell = 0; cell < mesh->cell_count; cell++) JN_TRY(check_cell(element, mesh, cell, what));
	*group = (JnGroup){.kernel = kernel, .count = mesh->cell_count, .batches = batches};
	group->rest_points = are_parallelepipeds(element, mesh) ? 1 : kernel->points;
	kernel->law->prepare(material, group->constants);
	JN_NEW(arena, group->nodes, slots * kernel->nodes);
	JN_NEW(arena, group->rest, slots * group->rest_points * kernel->rest_reals);
	JN_NEW(arena, group->rest_single, 2 * pairs * width * group->rest_points * 6);
	if (kernel->frozen_reals > 0) JN_NEW(arena, group->frozen, slots * kernel->points * kernel->frozen_reals);
	return fill_lanes(group, mesh, nodes_offset);
}

JnStatus jn_solid_build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
						JnArena* arena, JnGroups* out) {
	const JnKernel* kernel = jn_kernel_find(mesh->shape, law, 0);
	if (kernel == NULL)
		return jn_error(JN_BAD_INPUT, "%s.material.law: '%s' does not run on %s elements", what, law->row.name,
						jn_shape_info[mesh->shape].name);
	const JnMaterialDef* material = options;
	*out = (JnGroups){.count = 1, .density = material->density};
	JN_NEW(arena, out->list, 1);
	return jn_group_create(kernel, mesh, first_node, material, what, arena, out->list);
}

/// integral of N_i N_j over a tetrahedron of volume 1, times 420: 6 and 1 between corners; 32, 16 and 8 between equal,
/// adjacent and opposite mid-edge nodes; -4 and -6 between a corner and an edge with and without it.
static double tet10_mass_420(int i, int j) {
	static const int ends[10][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
	const int *e = ends[i], *f = ends[j];
	const bool touch = e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
	if (i < 4 && j < 4) return i == j ? 6 : 1;
	if (i < 4 || j < 4) return touch ? -4 : -6;
	if (i == j) return 32;
	return touch ? 16 : 8;
}

/// Trilinear shape functions and gradients at xi.
static void hex8_functions(const double xi[3], double N[8], double dN[8][3]) {
	static const int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
									 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
	for (int i = 0; i < 8; i++) {
		double factor[3];
		for (int r = 0; r < 3; r++) factor[r] = 0.5 * (1 + corner[i][r] * xi[r]);
		N[i] = factor[0] * factor[1] * factor[2];
		for (int r = 0; r < 3; r++) dN[i][r] = 0.5 * corner[i][r] * factor[(r + 1) % 3] * factor[(r + 2) % 3];
	}
}

/// N_i N_j det J has degree 4 in each coordinate: three Gauss points, exact to degree 5.
static void hex8_mass(const JnMesh* mesh, int cell, double density, double* out) {
	const double points[3] = {-sqrt(0.6), 0, sqrt(0.6)}, weights[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
	memset(out, 0, 64 * sizeof(double));
	for (int point = 0; point < 27; point++) {
		const int k[3] = {point % 3, point / 3 % 3, point / 9};
		double N[8], dN[8][3], J[3][3] = {{0}};
		hex8_functions((const double[]){points[k[0]], points[k[1]], points[k[2]]}, N, dN);
		for (int i = 0; i < 8; i++) {
			const double* X = mesh->nodes + 3 * (ptrdiff_t)mesh->cells[(ptrdiff_t)cell * 8 + i];
			for (int m = 0; m < 9; m++) J[m / 3][m % 3] += X[m / 3] * dN[i][m % 3];
		}
		const double mass = density * weights[k[0]] * weights[k[1]] * weights[k[2]] * mat3_determinant(J);
		for (int m = 0; m < 64; m++) out[m] += mass * N[m / 8] * N[m % 8];
	}
}

void jn_group_cell_mass(const JnMesh* mesh, int cell, double density, double* out) {
	if (mesh->shape == JN_HEX8) {
		hex8_mass(mesh, cell, density, out);
		return;
	}
	const double mass = density * jn_mesh_cell_volume(mesh, cell);
	const int nodes = jn_shape_info[mesh->shape].nodes;
	for (int m = 0; m < nodes * nodes; m++) {
		const int i = m / nodes, j = m % nodes;
		out[m] = mesh->shape == JN_TET10 ? mass * tet10_mass_420(i, j) / 420
										 : mass * (i == j ? 2 : 1) / (nodes * (nodes + 1)); // linear on a simplex
	}
}
