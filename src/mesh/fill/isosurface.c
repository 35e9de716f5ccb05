// Marching tetrahedra (Doi, Koide 1991): each cube of a grid is cut into six tetrahedra along its main diagonal, and each
// of these by the plane through the zeros on its edges. Neighbours agree on their common faces, so that the surface is
// closed and a manifold whatever the function does. Remeshing then makes its triangles equal.
//
// Layers of the grid are passed from low to high z; two are kept.
#include "mesh/fill/isosurface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/fill/remesh.h"

static const double GRID_STEP = 0.6;        ///< of the grid, in units of the size
static const double MOST_POINTS = 3e7;      ///< of the grid
static const double LEAST_SHARE = 0.02;     ///< of an edge, between a zero and a grid point: no triangle is flat
static const double DIFFERENCE_STEP = 1e-3; ///< for gradients, in units of the size
enum { DIRECTIONS = 7 };                    ///< an edge runs from its lowest grid point along 1..7, bits x y z

/// Grid points as bits x y z of a cube, from its lowest corner to its highest one; positive volumes.
static const int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
									 {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}};

/// For each set of inner corners, as bits: an even order of the corners, the one or two that are cut off first.
static const int orders[16][4] = {{0},          {0, 1, 2, 3}, {1, 0, 3, 2}, {0, 1, 2, 3}, {2, 3, 0, 1}, {0, 2, 3, 1},
								  {1, 2, 0, 3}, {3, 2, 1, 0}, {3, 2, 1, 0}, {0, 3, 1, 2}, {1, 3, 2, 0}, {2, 3, 0, 1},
								  {2, 3, 0, 1}, {1, 0, 3, 2}, {0, 1, 2, 3}, {0}};

typedef struct Extract {
	const JnField* field;
	double low[3], step; ///< of the grid [m]
	int points[3];       ///< along the axes
	double* values[2];   ///< of the layers k and k + 1: points[0] * points[1]
	int* edge_nodes[2];  ///< DIRECTIONS numbers a grid point of those layers: node + 1, or 0
	int node_room, triangle_room;
	JnSurface surface; ///< grown with realloc
} Extract;

static void locate(const Extract* ex, const int at[3], double x[3]) {
	for (int a = 0; a < 3; a++) x[a] = ex->low[a] + ex->step * at[a];
}

static void fill_layer(Extract* ex, int k, double* values) {
	for (int j = 0; j < ex->points[1]; j++) {
		for (int i = 0; i < ex->points[0]; i++) {
			const int at[3] = {i, j, k};
			double x[3];
			locate(ex, at, x);
			const double value = ex->field->at(ex->field->shape, x);
			const bool is_rim = i == 0 || j == 0 || k == 0 || i == ex->points[0] - 1 || j == ex->points[1] - 1 ||
								k == ex->points[2] - 1;
			values[j * ex->points[0] + i] = is_rim ? fmax(value, 0) : value;
		}
	}
}

/// Where between two points the function is zero, by linear interpolation, twice.
static void find_zero(const Extract* ex, const double a[3], double fa, const double b[3], double fb, double x[3]) {
	double low = 0, high = 1, f_low = fa, f_high = fb, share = 0.5;
	for (int round = 0; round < 3; round++) {
		share = low + (high - low) * (f_low == f_high ? 0.5 : f_low / (f_low - f_high));
		share = fmin(fmax(share, LEAST_SHARE), 1 - LEAST_SHARE);
		for (int i = 0; i < 3; i++) x[i] = a[i] + share * (b[i] - a[i]);
		if (round == 2) break;
		const double f = ex->field->at(ex->field->shape, x);
		if ((f < 0) == (f_low < 0))
			low = share, f_low = f;
		else
			high = share, f_high = f;
	}
}

static JnStatus add_node(Extract* ex, const double x[3], int* number) {
	JnSurface* surface = &ex->surface;
	if (surface->node_count == ex->node_room) {
		ex->node_room = 2 * ex->node_room + 1024;
		double* nodes = realloc(surface->nodes, 3 * (size_t)ex->node_room * sizeof *nodes);
		if (nodes == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: %d surface nodes", ex->node_room);
		surface->nodes = nodes;
	}
	memcpy(surface->nodes + 3 * (ptrdiff_t)surface->node_count, x, 3 * sizeof(double));
	*number = surface->node_count++;
	return JN_OK;
}

static JnStatus add_triangle(Extract* ex, int a, int b, int c) {
	JnSurface* surface = &ex->surface;
	if (surface->triangle_count == ex->triangle_room) {
		ex->triangle_room = 2 * ex->triangle_room + 2048;
		int* triangles = realloc(surface->triangles, 3 * (size_t)ex->triangle_room * sizeof *triangles);
		if (triangles == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: %d triangles", ex->triangle_room);
		surface->triangles = triangles;
	}
	int* corner = surface->triangles + 3 * (ptrdiff_t)surface->triangle_count++;
	corner[0] = a, corner[1] = b, corner[2] = c;
	return JN_OK;
}

static double value_at(const Extract* ex, const int cube[3], int corner) {
	const int i = cube[0] + (corner & 1), j = cube[1] + (corner >> 1 & 1);
	return ex->values[corner >> 2][j * ex->points[0] + i];
}

/// The node on the edge between two corners of a cube, made when it is first asked for.
static JnStatus edge_node(Extract* ex, const int cube[3], int a, int b, int* node) {
	const int low = a & b, direction = (a | b) - low;
	const int i = cube[0] + (low & 1), j = cube[1] + (low >> 1 & 1);
	int* kept = &ex->edge_nodes[low >> 2][(ptrdiff_t)(j * ex->points[0] + i) * DIRECTIONS + direction - 1];
	if (*kept == 0) {
		double xa[3], xb[3], x[3];
		const int first[3] = {i, j, cube[2] + (low >> 2)};
		const int last[3] = {i + (direction & 1), j + (direction >> 1 & 1), first[2] + (direction >> 2)};
		locate(ex, first, xa);
		locate(ex, last, xb);
		find_zero(ex, xa, value_at(ex, cube, low), xb, value_at(ex, cube, low | direction), x);
		JN_TRY(add_node(ex, x, kept));
		++*kept;
	}
	*node = *kept - 1;
	return JN_OK;
}

static JnStatus cut_tetrahedron(Extract* ex, const int cube[3], const int corners[4]) {
	int inner = 0, count = 0, n[4];
	for (int i = 0; i < 4; i++) {
		const int bit = value_at(ex, cube, corners[i]) < 0;
		inner |= bit << i;
		count += bit;
	}
	if (count == 0 || count == 4) return JN_OK;
	const int* o = orders[inner];
	const int p = corners[o[0]], q = corners[o[1]], r = corners[o[2]], s = corners[o[3]];
	if (count == 2) {
		JN_TRY(edge_node(ex, cube, p, r, &n[0]));
		JN_TRY(edge_node(ex, cube, p, s, &n[1]));
		JN_TRY(edge_node(ex, cube, q, s, &n[2]));
		JN_TRY(edge_node(ex, cube, q, r, &n[3]));
		JN_TRY(add_triangle(ex, n[0], n[1], n[2]));
		return add_triangle(ex, n[0], n[2], n[3]);
	}
	JN_TRY(edge_node(ex, cube, p, q, &n[0]));
	JN_TRY(edge_node(ex, cube, p, r, &n[1]));
	JN_TRY(edge_node(ex, cube, p, s, &n[2]));
	return count == 1 ? add_triangle(ex, n[0], n[1], n[2]) : add_triangle(ex, n[0], n[2], n[1]);
}

static JnStatus cut_layer(Extract* ex, int k) {
	for (int j = 0; j + 1 < ex->points[1]; j++) {
		for (int i = 0; i + 1 < ex->points[0]; i++) {
			const int cube[3] = {i, j, k};
			for (int t = 0; t < 6; t++) JN_TRY(cut_tetrahedron(ex, cube, tetrahedra[t]));
		}
	}
	return JN_OK;
}

/// The next layer takes the place of the lower one.
static void advance(Extract* ex, size_t layer) {
	double* values = ex->values[0];
	int* nodes = ex->edge_nodes[0];
	ex->values[0] = ex->values[1];
	ex->edge_nodes[0] = ex->edge_nodes[1];
	ex->values[1] = values;
	ex->edge_nodes[1] = nodes;
	memset(nodes, 0, layer * DIRECTIONS * sizeof *nodes);
}

static JnStatus march(Extract* ex, JnArena* arena) {
	const size_t layer = (size_t)ex->points[0] * (size_t)ex->points[1];
	for (int i = 0; i < 2; i++) {
		JN_NEW(arena, ex->values[i], layer);
		JN_NEW(arena, ex->edge_nodes[i], layer * DIRECTIONS);
	}
	fill_layer(ex, 0, ex->values[0]);
	for (int k = 0; k + 1 < ex->points[2]; k++) {
		fill_layer(ex, k + 1, ex->values[1]);
		JN_TRY(cut_layer(ex, k));
		advance(ex, layer);
	}
	return JN_OK;
}

typedef struct Guide {
	const JnField* field;
	double size; ///< [m]
} Guide;

/// Newton's method along the gradient.
static void project(const void* shape, double point[3]) {
	const Guide* guide = shape;
	const JnField* field = guide->field;
	const double step = DIFFERENCE_STEP * guide->size;
	for (int round = 0; round < 3; round++) {
		const double f = field->at(field->shape, point);
		if (fabs(f) < 1e-6 * guide->size) return;
		double gradient[3];
		for (int a = 0; a < 3; a++) {
			double low[3] = {point[0], point[1], point[2]}, high[3] = {point[0], point[1], point[2]};
			low[a] -= step;
			high[a] += step;
			gradient[a] = (field->at(field->shape, high) - field->at(field->shape, low)) / (2 * step);
		}
		const double square = fmax(vec3_dot(gradient, gradient), 1e-4);
		const double move = fmin(fabs(f) / sqrt(square), 0.5 * guide->size) / sqrt(square);
		for (int a = 0; a < 3; a++) point[a] -= copysign(move, f) * gradient[a];
	}
}

static JnStatus smooth(const JnField* field, const JnSurface* raw, double size, const char* what, JnArena* arena,
					   JnSurface* surface) {
	const Guide shape = {.field = field, .size = size};
	const JnGuide guide = {.project = project, .shape = &shape};
	JnHalfEdges mesh;
	JN_TRY(jn_half_edges_create(raw, what, &mesh));
	JnStatus status = jn_remesh(&mesh, size, &guide);
	if (status == JN_OK) status = jn_half_edges_surface(&mesh, arena, surface);
	jn_half_edges_free(&mesh);
	return status;
}

static JnStatus set_grid(Extract* ex, double size, const char* what) {
	double count = 1;
	ex->step = GRID_STEP * size;
	for (int a = 0; a < 3; a++) {
		const double extent = ex->field->max[a] - ex->field->min[a], points = ceil(extent / ex->step) + 4;
		count *= points;
		ex->points[a] = points < 1e9 ? (int)points : 0;
		ex->low[a] = ex->field->min[a] - 0.5 * (ex->step * (points - 1) - extent);
	}
	if (count <= MOST_POINTS) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s: triangles of %g m need a grid of %.3g points, more than %.0g; ask for larger ones", what, size,
					count, MOST_POINTS);
}

JnStatus jn_isosurface(const JnField* field, double size, const char* what, JnArena* arena, JnSurface* surface) {
	Extract ex = {.field = field};
	JN_TRY(set_grid(&ex, size, what));
	JnArena scratch = {0};
	JnStatus status = march(&ex, &scratch);
	if (status == JN_OK && ex.surface.triangle_count == 0)
		status = jn_error(JN_BAD_INPUT, "%s: nothing of it is as large as %g m, the edge length asked for", what, size);
	if (status == JN_OK) status = smooth(field, &ex.surface, size, what, arena, surface);
	free(ex.surface.nodes);
	free(ex.surface.triangles);
	jn_arena_free(&scratch);
	return status;
}
