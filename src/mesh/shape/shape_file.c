// Shapes from files: how they are read, placed and filled, and their keys.
#include "mesh/shape/shape_file.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/log.h"
#include "mesh/fill/cache.h"
#include "mesh/fill/quadratic.h"
#include "mesh/fill/voxels.h"
#include "mesh/format/import.h"

static const char* const orders[] = {"tet4", "tet10", NULL};

static const JnKey tetrahedra_keys[] = {
	{.name = "size",
	 .kind = JN_REAL,
	 .field = offsetof(JnTetrahedraDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .meaning = "edge length that is aimed at"},
	{.name = "element",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnTetrahedraDef, order),
	 .names = orders,
	 .meaning = "straight tetrahedra with four nodes, or with middle nodes as well"},
	{0},
};

static const JnKey voxel_keys[] = {
	{.name = "size",
	 .kind = JN_REAL,
	 .field = offsetof(JnVoxelsDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .required = true,
	 .unit = "m",
	 .meaning = "edge length of the cubes"},
	{0},
};

const JnKey jn_file_keys[] = {
	{.name = "path",
	 .kind = JN_PATH,
	 .field = offsetof(JnFileDef, path),
	 .required = true,
	 .meaning =
		 "a surface (.obj .ply .stl .off .gltf .glb), or a volume (.msh .vtk .vtu); from the scene file's folder"},
	JN_PLACEMENT_KEY_ROWS(JnFileDef, placement.),
	{.name = "tetrahedra",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnFileDef, tetrahedra),
	 .keys = tetrahedra_keys,
	 .size = sizeof(JnTetrahedraDef),
	 .meaning = "fill a surface with tetrahedra, by Gmsh"},
	{.name = "voxels",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnFileDef, voxels),
	 .keys = voxel_keys,
	 .size = sizeof(JnVoxelsDef),
	 .meaning = "surround a surface with cubes that carry it along: coarse and fast"},
	{.name = "triangles",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnFileDef, triangles),
	 .meaning = "take the triangles of a surface as they are, for laws of cloth"},
	{0},
};

static JnStatus fill_tetrahedra(const JnFileDef* def, const char* what, JnArena* arena, JnFileMesh* out) {
	JN_TRY(jn_surface_check_closed(&out->surface, def->path));
	JnMesh tet4 = {0};
	JN_TRY(jn_cache_tetrahedra(&out->surface, def->tetrahedra->size, what, arena, &tet4, &out->was_kept));
	if (def->tetrahedra->order == 1) return jn_mesh_add_middles(&tet4, arena, &out->volume);
	out->volume = tet4;
	return JN_OK;
}

static JnStatus fill(const JnFileDef* def, const char* what, JnArena* arena, JnFileMesh* out) {
	if (def->tetrahedra != NULL && def->voxels != NULL)
		return jn_error(JN_BAD_INPUT, "%s.voxels: tetrahedra are asked for as well; give one of them", what);
	if (def->tetrahedra == NULL && def->voxels == NULL) return JN_OK;
	if (out->has_volume)
		return jn_error(JN_BAD_INPUT, "%s.%s: %s holds cells already; leave this key out", what,
						def->voxels != NULL ? "voxels" : "tetrahedra", def->path);
	out->has_volume = true;
	if (def->tetrahedra != NULL) return fill_tetrahedra(def, what, arena, out);
	JN_TRY(jn_surface_check_closed(&out->surface, def->path));
	return jn_voxels_fill(&out->surface, def->voxels->size, what, arena, &out->volume);
}

static JnStatus check_exists(const JnFileDef* def, const char* what) {
	if (access(def->path, R_OK) == 0) return JN_OK;
	const bool is_model = strstr(def->path, "models/") != NULL;
	return jn_error(JN_BAD_INPUT, "%s.path: %s cannot be read: %s%s", what, def->path, strerror(errno),
					is_model ? "; tools/fetch_models brings armadillo, bunny and elephant into models/" : "");
}

JnStatus jn_file_mesh(const JnFileDef* def, const char* what, JnArena* arena, JnFileMesh* out) {
	*out = (JnFileMesh){0};
	JN_TRY(check_exists(def, what));
	JnImport import = {0};
	JN_TRY(jn_import(def->path, arena, &import));
	out->has_volume = import.is_volume;
	out->volume = import.volume;
	out->surface = import.surface;
	const int count = import.is_volume ? out->volume.node_count : out->surface.node_count;
	JN_TRY(jn_placement_apply(&def->placement, what, count, import.is_volume ? out->volume.nodes : out->surface.nodes));
	return fill(def, what, arena, out);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const JnFileDef* def = options;
	JnFileMesh file;
	JN_TRY(jn_file_mesh(def, what, arena, &file));
	if (def->triangles && file.has_volume)
		return jn_error(JN_BAD_INPUT, "%s.triangles: %s is a volume, or filled to be one; leave this key out", what,
						def->path);
	if (!file.has_volume && !def->triangles)
		return jn_error(
			JN_BAD_INPUT,
			"%s: %s holds a surface; fill it: `tetrahedra: {size: 2 cm}` or `voxels: {size: 5 cm}`, or take "
			"it as cloth: `triangles: true`",
			what, def->path);
	if (def->triangles) {
		*mesh = (JnMesh){.shape = JN_TRI3,
						 .node_count = file.surface.node_count,
						 .nodes = file.surface.nodes,
						 .cell_count = file.surface.triangle_count,
						 .cells = file.surface.triangles};
		return JN_OK;
	}
	*mesh = file.volume;
	return JN_OK;
}

const JnShapeType jn_shape_file = {
	.row = {"file", "A mesh from a file: a volume, or a surface that is filled with cells or taken as cloth.",
			jn_file_keys, sizeof(JnFileDef)},
	.generate = generate,
};
