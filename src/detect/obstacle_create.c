#include "detect/obstacle_create.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "detect/obstacle.h"
#include "mesh/shape/shape_file.h"

const JnKey jn_obstacle_plane_keys[] = {
	{.name = "point",
	 .kind = JN_REAL3,
	 .field = offsetof(JnPlaneDef, point),
	 .unit = "m",
	 .meaning = "any point of the plane"},
	{.name = "normal",
	 .kind = JN_REAL3,
	 .field = offsetof(JnPlaneDef, normal),
	 .value = {0, 1, 0},
	 .meaning = "out of the obstacle, to where the bodies are; of any length"},
	{0},
};

const JnKey jn_obstacle_sphere_keys[] = {
	{.name = "center", .kind = JN_REAL3, .field = offsetof(JnSphereDef, center), .unit = "m", .meaning = "its middle"},
	{.name = "radius",
	 .kind = JN_REAL,
	 .field = offsetof(JnSphereDef, radius),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .remedy = "use a length above 0",
	 .meaning = "of the sphere"},
	{.name = "inside",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnSphereDef, inside),
	 .meaning = "keep bodies inside the sphere: all around it is solid"},
	{0},
};

const JnKey jn_obstacle_block_keys[] = {
	{.name = "center",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBlockOptions, center),
	 .unit = "m",
	 .meaning = "its middle"},
	{.name = "size",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBlockOptions, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .remedy = "use lengths above 0",
	 .meaning = "edge lengths, before it is turned"},
	{.name = "rotate",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBlockOptions, rotate),
	 .unit = "rad",
	 .meaning = "turns about x, then y, then z, right-handed about its middle, such as [0 deg, 0 deg, 30 deg]"},
	{0},
};

const JnKey jn_obstacle_capsule_keys[] = {
	{.name = "from",
	 .kind = JN_REAL3,
	 .field = offsetof(JnCapsuleDef, ends[0]),
	 .required = true,
	 .unit = "m",
	 .meaning = "one end of its axis"},
	{.name = "to",
	 .kind = JN_REAL3,
	 .field = offsetof(JnCapsuleDef, ends[1]),
	 .required = true,
	 .unit = "m",
	 .meaning = "the other end"},
	{.name = "radius",
	 .kind = JN_REAL,
	 .field = offsetof(JnCapsuleDef, radius),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .remedy = "use a length above 0",
	 .meaning = "distance of its surface from the axis"},
	{0},
};

const JnKey jn_obstacle_mesh_keys[] = {
	{.name = "path",
	 .kind = JN_PATH,
	 .field = offsetof(JnMeshOptions, path),
	 .required = true,
	 .meaning = "a closed surface (.obj .ply .stl .off .gltf .glb); from the scene file's folder"},
	JN_PLACEMENT_KEY_ROWS(JnMeshOptions, placement.),
	{0},
};

JnStatus jn_obstacle_create_same(const void* options, const char* what, JnArena* arena, const void** geometry) {
	(void)what, (void)arena;
	*geometry = options;
	return JN_OK;
}

/// The normal is scaled, so that no length of it is too large or too small to be squared.
JnStatus jn_obstacle_create_plane(const void* options, const char* what, JnArena* arena, const void** geometry) {
	JnPlaneDef* plane;
	JN_NEW(arena, plane, 1);
	*plane = *(const JnPlaneDef*)options;
	double* n = plane->normal;
	const double largest = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
	if (!(largest > 0)) return jn_error(JN_BAD_INPUT, "%s.normal: has no length; use [0, 1, 0] for a floor", what);
	for (int a = 0; a < 3; a++) n[a] /= largest;
	*geometry = plane;
	return JN_OK;
}

JnStatus jn_obstacle_create_block(const void* options, const char* what, JnArena* arena, const void** geometry) {
	const JnBlockOptions* def = options;
	JnBlockDef* block;
	JN_NEW(arena, block, 1);
	JnPlacementDef turn = {.scale = 1};
	memcpy(turn.rotate, def->rotate, sizeof turn.rotate);
	for (int a = 0; a < 3; a++) {
		block->center[a] = def->center[a];
		block->half[a] = def->size[a] / 2;
		block->axes[4 * a] = 1;
	}
	*geometry = block;
	return jn_placement_apply(&turn, what, 3, block->axes); // directions turn as points do
}

JnStatus jn_obstacle_create_mesh(const void* options, const char* what, JnArena* arena, const void** geometry) {
	const JnMeshOptions* def = options;
	const JnFileDef file = {.path = def->path, .placement = def->placement};
	JnFileMesh content;
	JN_TRY(jn_file_mesh(&file, what, arena, &content));
	if (content.has_volume)
		return jn_error(JN_BAD_INPUT, "%s.path: %s holds a volume; give a closed surface, such as an .obj file", what,
						def->path);
	char where[512];
	snprintf(where, sizeof where, "%s.path: %.400s", what, def->path);
	JN_TRY(jn_surface_check_closed(&content.surface, where));
	JnTriangleTree* tree;
	JnMeshDef* mesh;
	JN_NEW(arena, tree, 1);
	JN_NEW(arena, mesh, 1);
	JN_TRY(jn_triangle_tree_create(&content.surface, arena, tree));
	mesh->tree = tree;
	*geometry = mesh;
	return JN_OK;
}
