// The surface is that of a cube whose faces are grids, blown up to a ball and pulled apart along the rectangle.
#include "mesh/rigid.h"

#include <math.h>
#include <string.h>

#include "mesh/embed.h"

enum { SIDE = 8, FACES = 6, FACE_NODES = (SIDE + 1) * (SIDE + 1), NODES = FACES * FACE_NODES };

// A direction from the middle, over the grid of a face; even numbers of cells keep the eighths of the ball apart.
static void direction(int face, int i, int j, double out[3]) {
	const double quarter_pi = 0.78539816339744830962;
	const int axis = face / 2;
	out[axis] = face % 2 == 0 ? -1 : 1;
	out[(axis + 1) % 3] = tan(quarter_pi * (2.0 * i / SIDE - 1));
	out[(axis + 2) % 3] = tan(quarter_pi * (2.0 * j / SIDE - 1));
	const double length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
	for (int a = 0; a < 3; a++) out[a] /= length;
}

static double sign_of(double number) {
	return fabs(number) < 1e-12 ? 0 : copysign(1, number);
}

static void offset_of(const JnRigid* rigid, double shown, const double d[3], double out[3]) {
	for (int a = 0; a < 3; a++) out[a] = 0;
	for (int k = 0; k < 3; k++) {
		const double half = isinf(rigid->half[k]) ? shown : rigid->half[k];
		for (int a = 0; a < 3; a++) out[a] += rigid->axes[k][a] * (rigid->radius * d[k] + half * sign_of(d[k]));
	}
}

static int* add_square(int face, int i, int j, int* to) {
	const int first = face * FACE_NODES + i * (SIDE + 1) + j, next = first + SIDE + 1;
	const int square[2][6] = {{first, next + 1, next, first, first + 1, next + 1},
							  {first, next, next + 1, first, next + 1, first + 1}};
	memcpy(to, square[face % 2], sizeof square[0]);
	return to + 6;
}

static JnStatus make_surface(const JnRigid* rigid, const double center[3], double shown, JnArena* arena,
							 JnEmbedding* out) {
	JnSurface* surface = &out->surface;
	double *offsets, *weights;
	int *carriers, *to;
	*surface = (JnSurface){.node_count = NODES, .triangle_count = 2 * FACES * SIDE * SIDE};
	out->cell_nodes = 1;
	JN_NEW(arena, surface->nodes, 3 * NODES);
	JN_NEW(arena, surface->triangles, 3 * (size_t)surface->triangle_count);
	JN_NEW(arena, offsets, 3 * NODES);
	JN_NEW(arena, weights, NODES);
	JN_NEW(arena, carriers, NODES);
	to = surface->triangles;
	for (int n = 0; n < NODES; n++) {
		const int face = n / FACE_NODES, i = n % FACE_NODES / (SIDE + 1), j = n % (SIDE + 1);
		double d[3];
		direction(face, i, j, d);
		offset_of(rigid, shown, d, offsets + 3 * n);
		for (int a = 0; a < 3; a++) surface->nodes[3 * n + a] = center[a] + offsets[3 * n + a];
		weights[n] = 1;
		if (i < SIDE && j < SIDE) to = add_square(face, i, j, to);
	}
	out->nodes = carriers;
	out->weights = weights;
	out->offsets = offsets;
	return JN_OK;
}

// Without end there is no volume: 1 stands for it, so that a density is a mass.
static double volume_of(const JnRigid* rigid) {
	if (jn_rigid_is_endless(rigid)) return 1;
	const double pi = 3.14159265358979323846, r = rigid->radius;
	const double* h = rigid->half;
	const double area = 4 * (h[0] * h[1] + h[1] * h[2] + h[2] * h[0]), edges = 2 * (h[0] + h[1] + h[2]);
	return 8 * h[0] * h[1] * h[2] + 2 * r * area + pi * r * r * edges + 4.0 / 3 * pi * r * r * r;
}

JnStatus jn_rigid_mesh(const JnRigid* rigid, const double center[3], double shown, JnArena* arena, JnMesh* mesh) {
	JnRigid* copy;
	JnEmbedding* embedding;
	double* volumes;
	*mesh = (JnMesh){.shape = JN_POINT1, .node_count = 1, .cell_count = 1};
	JN_NEW(arena, mesh->nodes, 3);
	JN_NEW(arena, mesh->cells, 1);
	JN_NEW(arena, volumes, 1);
	JN_NEW(arena, copy, 1);
	JN_NEW(arena, embedding, 1);
	memcpy(mesh->nodes, center, 3 * sizeof *center);
	*copy = *rigid;
	volumes[0] = volume_of(rigid);
	mesh->volumes = volumes;
	mesh->rigid = copy;
	mesh->embedding = embedding;
	return make_surface(rigid, center, shown, arena, embedding);
}
