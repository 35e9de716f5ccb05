// The inside of given triangles by Gmsh: a discrete surface, a volume within it, Delaunay insertion and two optimisers.
// It runs in a child process, since recovering a boundary may crash or never end, and so that nothing is left from an
// earlier mesh: the same triangles give the same cells.
#include <limits.h>
#include <stdio.h>

#include "base/guard.h"
#include "base/log.h"
#include "mesh/fill/tetrahedra.h"
#include "mesh/format/gmsh_library.h"
#include "mesh/format/gmsh_model.h"

#ifdef JN_GMSH_LIBRARY

/// What comes back: this, the inner nodes, the cells.
typedef struct Counts {
	size_t inner_nodes, cells;
} Counts;

typedef struct Job {
	const JnSurface* surface;
	double size;
	const char* what;
	JnArena* scratch;
} Job;

static JnStatus set_options(const JnGmsh* gmsh, const Job* job) {
	const struct {
		const char* name;
		double value;
	} options[] = {
		{"Mesh.RandomSeed", 1},  {"Mesh.MeshSizeMax", job->size},
		{"Mesh.MeshSizeMin", 0}, {"Mesh.MeshSizeExtendFromBoundary", 1},
		{"Mesh.Algorithm3D", 1}, {"Mesh.Optimize", 1},
	};
	int error = 0;
	for (size_t i = 0; i < sizeof options / sizeof options[0] && error == 0; i++)
		gmsh->OptionSetNumber(options[i].name, options[i].value, &error);
	return jn_gmsh_check(gmsh, error, job->what, "take its options");
}

static JnStatus give_surface(const JnGmsh* gmsh, const Job* job) {
	const JnSurface* surface = job->surface;
	const size_t nodes = (size_t)surface->node_count, triangles = (size_t)surface->triangle_count;
	size_t *tags, *corners, none[1] = {0};
	JN_NEW(job->scratch, tags, nodes);
	JN_NEW(job->scratch, corners, 3 * triangles);
	for (size_t i = 0; i < nodes; i++) tags[i] = i + 1;
	for (size_t i = 0; i < 3 * triangles; i++) corners[i] = (size_t)surface->triangles[i] + 1;
	int error = 0, loop[1] = {1};
	gmsh->ModelAdd("", &error);
	gmsh->ModelAddDiscreteEntity(2, 1, NULL, 0, &error);
	if (error == 0) gmsh->ModelMeshAddNodes(2, 1, tags, nodes, surface->nodes, 3 * nodes, NULL, 0, &error);
	if (error == 0) gmsh->ModelMeshAddElementsByType(1, JN_GMSH_TRIANGLE, none, 0, corners, 3 * triangles, &error);
	if (error == 0) gmsh->ModelGeoAddSurfaceLoop(loop, 1, 1, &error);
	if (error == 0) gmsh->ModelGeoAddVolume(loop, 1, 1, &error);
	if (error == 0) gmsh->ModelGeoSynchronize(&error);
	return jn_gmsh_check(gmsh, error, job->what, "take the surface");
}

/// Inner nodes have the tags behind those of the surface; `number` tells their places.
static JnStatus write_nodes(const JnGmsh* gmsh, const Job* job, Counts* counts, int** number, FILE* result) {
	size_t *tags = NULL, count = 0, size = 0, unused = 0, most = (size_t)job->surface->node_count;
	double *places = NULL, *parameters = NULL;
	int error = 0;
	gmsh->ModelMeshGetNodes(&tags, &count, &places, &size, &parameters, &unused, 3, 1, 0, 0, &error);
	JN_TRY(jn_gmsh_check(gmsh, error, job->what, "list its nodes"));
	counts->inner_nodes = count;
	for (size_t i = 0; i < count; i++) most = tags[i] > most ? tags[i] : most;
	JN_NEW(job->scratch, *number, most + 1);
	for (int i = 0; i < job->surface->node_count; i++) (*number)[i + 1] = i;
	for (size_t i = 0; i < count; i++) (*number)[tags[i]] = job->surface->node_count + (int)i;
	fwrite(counts, sizeof *counts, 1, result);
	fwrite(places, sizeof *places, size, result);
	return JN_OK;
}

static JnStatus write_mesh(const JnGmsh* gmsh, const Job* job, FILE* result) {
	size_t *tags = NULL, *corners = NULL, count = 0;
	int error = 0, *number;
	Counts counts;
	gmsh->ModelMeshGetElementsByType(JN_GMSH_TET4, &tags, &counts.cells, &corners, &count, 1, 0, 1, &error);
	JN_TRY(jn_gmsh_check(gmsh, error, job->what, "list its cells"));
	JN_TRY(write_nodes(gmsh, job, &counts, &number, result));
	for (size_t i = 0; i < count; i++) fwrite(&number[corners[i]], sizeof *number, 1, result);
	return ferror(result) ? jn_error(JN_OUT_OF_MEMORY, "%s: out of memory: %zu cells", job->what, counts.cells) : JN_OK;
}

static JnStatus fill_in_child(void* user, FILE* result) {
	const Job* job = user;
	JnGmsh gmsh;
	int error = 0;
	JN_TRY(jn_gmsh_open(job->what, &gmsh));
	JN_TRY(set_options(&gmsh, job));
	JN_TRY(give_surface(&gmsh, job));
	gmsh.ModelMeshGenerate(3, &error);
	JN_TRY(jn_gmsh_check(&gmsh, error, job->what, "fill the surface with tetrahedra"));
	return write_mesh(&gmsh, job, result);
}

/// Gmsh's cells have positive volumes; one that has not would be a fault of ours.
static JnStatus check_cells(const JnMesh* mesh, const char* what) {
	for (int cell = 0; cell < mesh->cell_count; cell++)
		if (!(jn_mesh_cell_volume(mesh, cell) > 0))
			return jn_error(JN_BAD_INPUT, "%s: Gmsh made a cell without volume (%d of %d); try another size", what,
							cell, mesh->cell_count);
	return mesh->cell_count > 0 ? JN_OK : jn_error(JN_BAD_INPUT, "%s: Gmsh made no cells", what);
}

static JnStatus read_mesh(FILE* stream, const Job* job, JnArena* arena, JnMesh* mesh) {
	const JnSurface* surface = job->surface;
	const size_t outer = (size_t)surface->node_count;
	Counts counts;
	const bool has_counts = fread(&counts, sizeof counts, 1, stream) == 1;
	if (!has_counts || counts.inner_nodes > INT_MAX / 3 - outer || counts.cells > INT_MAX / 4)
		return jn_error(JN_BAD_INPUT, "%s: Gmsh made more cells than jounce can number", job->what);
	*mesh =
		(JnMesh){.shape = JN_TET4, .node_count = (int)(outer + counts.inner_nodes), .cell_count = (int)counts.cells};
	JN_NEW(arena, mesh->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, mesh->cells, 4 * counts.cells);
	for (size_t i = 0; i < 3 * outer; i++) mesh->nodes[i] = surface->nodes[i];
	const bool is_whole =
		fread(mesh->nodes + 3 * outer, 3 * sizeof(double), counts.inner_nodes, stream) == counts.inner_nodes &&
		fread(mesh->cells, 4 * sizeof(int), counts.cells, stream) == counts.cells;
	return is_whole ? check_cells(mesh, job->what) : jn_error(JN_IO_FAILED, "%s: the cells are not whole", job->what);
}

JnStatus jn_tetrahedra_inside(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh) {
	const size_t gigabyte = (size_t)1 << 30;
	const double cells = 8.5 * jn_surface_volume(surface) / (size * size * size) + surface->triangle_count;
	const JnGuardLimits limits = {.memory = 4 * gigabyte + (size_t)(2000 * cells), .seconds = 120 + (int)(cells / 1e3)};
	JnArena scratch = {0};
	Job job = {.surface = surface, .size = size, .what = what, .scratch = &scratch};
	FILE* result;
	JN_TRY(jn_guard_run(what, limits, fill_in_child, &job, &result));
	const JnStatus status = read_mesh(result, &job, arena, mesh);
	fclose(result);
	return status;
}

#else

JnStatus jn_tetrahedra_inside(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh) {
	(void)surface, (void)size, (void)arena;
	JnGmsh gmsh;
	*mesh = (JnMesh){0};
	return jn_gmsh_open(what, &gmsh);
}

#endif
