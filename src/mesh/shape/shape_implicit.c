// Toys given by signed distances: a rubber duck and a beach ball. Their zero sets become triangles, whose inside is
// filled with tetrahedra or surrounded with cubes. Both are described in their own units, which the key `size` scales.
#include "base/log.h"
#include "mesh/embed.h"
#include "mesh/fill/isosurface.h"
#include "mesh/fill/tetrahedra.h"
#include "mesh/fill/voxels.h"
#include "mesh/shape/distance.h"
#include "mesh/shape/shape_keys.h"

typedef struct ToyDef {
	double origin[3]; ///< where it stands: middle of the bounding box's bottom [m]
	double rotate[3]; ///< about the middle of the bounding box [rad]
	double size;      ///< largest edge of the bounding box [m]
	double cell;      ///< edge length of the cells [m]; NAN: a share of the size
	int mesh;         ///< 0 tetrahedra, 1 voxels
} ToyDef;

static const double DEFAULT_CELL = 1.0 / 18; ///< of the size
static const double MOST_CELL = 0.25;        ///< of the size
static const double VOXEL_SKIN = 0.5;        ///< edge of the triangles that voxels carry, in units of the cell

/// A toy in its own units.
typedef struct Toy {
	double (*at)(const double p[3]);
	double low[3], high[3]; ///< bounding box
} Toy;

/// It looks along +x.
static double duck_at(const double p[3]) {
	const double q[3] = {p[0], p[1], fabs(p[2])}; // left and right are alike
	double d = jn_distance_ellipsoid(q, (double[]){-0.04, 0.35, 0}, (double[]){0.58, 0.41, 0.45});
	const double breast = jn_distance_sphere(q, (double[]){0.24, 0.42, 0}, 0.36);
	const double tail = jn_distance_round_cone(q, (double[]){-0.34, 0.44, 0}, 0.27, (double[]){-0.69, 0.80, 0}, 0.06);
	const double wing =
		jn_distance_round_cone(q, (double[]){0.02, 0.42, 0.33}, 0.19, (double[]){-0.34, 0.54, 0.36}, 0.1);
	const double head = jn_distance_sphere(q, (double[]){0.25, 1.02, 0}, 0.35);
	const double beak = jn_distance_ellipsoid(q, (double[]){0.60, 0.95, 0}, (double[]){0.23, 0.085, 0.20});
	d = jn_distance_blend(d, breast, 0.15);
	d = jn_distance_blend(d, tail, 0.15);
	d = jn_distance_blend(d, wing, 0.05);
	d = jn_distance_blend(d, head, 0.12);
	d = jn_distance_blend(d, beak, 0.06);
	return jn_distance_carve(d, p[1], 0.05); // it stands on a flat bottom
}

/// Six panels around the axis y, with a groove between any two, and a button at each end.
static double beach_ball_at(const double p[3]) {
	const double radius = 0.5, width = 0.045, depth = 0.022, button = 0.1, panel = M_PI / 3;
	const double q[3] = {p[0], p[1] - radius, p[2]};
	const double around = hypot(q[0], q[2]), angle = remainder(atan2(q[2], q[0]) + panel / 2, panel);
	const double across = around * sin(angle) / width, out = around / button;
	return vec3_length(q) - radius + depth * exp(-across * across) * (1 - exp(-pow(out, 4)));
}

static const Toy duck = {duck_at, {-0.749, 0, -0.520}, {0.830, 1.370, 0.520}};
static const Toy beach_ball = {beach_ball_at, {-0.5, 0, -0.5}, {0.5, 1, 0.5}};

static double field_at(const void* shape, const double point[3]) {
	return ((const Toy*)shape)->at(point);
}

/// From the toy's units to metres, the middle of its bounding box at the zero point: so all toys of a size and cell have
/// the same mesh, and the tetrahedra are made once.
static void scale_about_middle(const Toy* toy, double scale, int count, double* nodes) {
	for (int i = 0; i < 3 * count; i++) nodes[i] = scale * (nodes[i] - 0.5 * (toy->low[i % 3] + toy->high[i % 3]));
}

/// Turn the mesh and what it carries about the zero point, and move it to where it stands.
static JnStatus place(const Toy* toy, const ToyDef* def, double scale, const char* what, JnMesh* mesh) {
	JnPlacementDef placement = {.scale = 1};
	for (int a = 0; a < 3; a++) {
		placement.rotate[a] = def->rotate[a];
		placement.translate[a] = def->origin[a] + (a == 1 ? 0.5 * scale * (toy->high[1] - toy->low[1]) : 0);
	}
	if (mesh->embedding != NULL) {
		const JnSurface* surface = &mesh->embedding->surface;
		JN_TRY(jn_placement_apply(&placement, what, surface->node_count, surface->nodes));
	}
	return jn_placement_apply(&placement, what, mesh->node_count, mesh->nodes);
}

static JnStatus fill(const JnSurface* surface, const ToyDef* def, double cell, const char* what, JnArena* arena,
					 JnMesh* mesh) {
	return def->mesh == 1 ? jn_voxels_fill(surface, cell, what, arena, mesh)
						  : jn_tetrahedra_inside(surface, cell, what, arena, mesh);
}

static JnStatus generate(const Toy* toy, const ToyDef* def, const char* what, JnArena* arena, JnMesh* mesh) {
	JnField field = {.at = field_at, .shape = toy};
	double largest = 0;
	for (int a = 0; a < 3; a++) {
		field.min[a] = toy->low[a];
		field.max[a] = toy->high[a];
		largest = fmax(largest, toy->high[a] - toy->low[a]);
	}
	const double scale = def->size / largest, cell = isnan(def->cell) ? DEFAULT_CELL * def->size : def->cell;
	const double triangle = def->mesh == 1 ? VOXEL_SKIN * cell : cell;
	if (cell > MOST_CELL * def->size)
		return jn_error(JN_BAD_INPUT, "%s.cell: %g m is too large for a toy of %g m; use %g m or less", what, cell,
						def->size, MOST_CELL * def->size);
	JnSurface surface;
	JN_TRY(jn_isosurface(&field, triangle / scale, what, arena, &surface));
	scale_about_middle(toy, scale, surface.node_count, surface.nodes);
	JN_TRY(fill(&surface, def, cell, what, arena, mesh));
	return place(toy, def, scale, what, mesh);
}

static const char* const mesh_names[] = {"tetrahedra", "voxels", NULL};

static const JnKey toy_keys[] = {
	JN_POSITION_KEY(ToyDef, origin, "where it stands: the middle of its bounding box's bottom"),
	JN_ROTATE_KEY(ToyDef),
	JN_LENGTH_KEY(ToyDef, size, "largest edge of the bounding box: the duck's length, the ball's diameter"),
	{.name = "cell",
	 .kind = JN_REAL,
	 .field = offsetof(ToyDef, cell),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning = "edge length of the cells; size / 18 when absent"},
	{.name = "mesh",
	 .kind = JN_CHOICE,
	 .field = offsetof(ToyDef, mesh),
	 .names = mesh_names,
	 .meaning = "tetrahedra (by Gmsh), or cubes that carry a finer surface along"},
	{0},
};

static JnStatus generate_duck(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	return generate(&duck, options, what, arena, mesh);
}

static JnStatus generate_beach_ball(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	return generate(&beach_ball, options, what, arena, mesh);
}

const JnShapeType jn_shape_duck = {
	.row = {"duck", "A rubber duck that looks along x; y is up.", toy_keys, sizeof(ToyDef)},
	.generate = generate_duck,
};

const JnShapeType jn_shape_beach_ball = {
	.row = {"beach_ball", "A ball of six panels with grooves between them, around the axis y.", toy_keys,
			sizeof(ToyDef)},
	.generate = generate_beach_ball,
};
