// Parts that no small scene reaches, each with every allocation refused once: quadratic elements in files, what Gmsh fills,
// reads and writes, meshes from surfaces, the coarsening of multigrid, UMFPACK.
#include <stdlib.h>

#include "mesh/embed.h"
#include "mesh/fill/cache.h"
#include "mesh/fill/isosurface.h"
#include "mesh/fill/quadratic.h"
#include "mesh/fill/resurface.h"
#include "mesh/fill/tetrahedra.h"
#include "mesh/fill/voxels.h"
#include "mesh/format/export.h"
#include "mesh/format/import.h"
#include "mesh/surface_case.h"
#include "model/system.h"
#include "solve/multigrid.h"
#include "support.h"
#include "support/model_case.h"
#include "support/random_cells.h"
#include "support/support.h"

enum { UNKNOWN_NODES = 40, UNKNOWN_CELLS = 30 };

static JnArena arena;
static char folder[256], cache[256];
static JnMesh tet10, tet4, hex8;
static JnSurface cube, sphere;

// ---- files

static const char* file_of(const char* name) {
	return path_join(folder, name);
}

static JnStatus read_file(const void* name) {
	JnArena own = {0};
	JnImport import;
	const JnStatus status = jn_import(file_of(name), &own, &import);
	jn_arena_free(&own);
	return status;
}

static JnStatus write_volume(const void* name) {
	const JnStatus status = jn_export_volume(&tet10, file_of(name));
	remove(file_of(name));
	return status;
}

static JnStatus write_surface(const void* name) {
	const JnStatus status = jn_export_surface(&sphere, file_of(name));
	remove(file_of(name));
	return status;
}

// ---- meshes

typedef JnStatus Fill(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh);

static JnStatus fill(Fill* way) {
	JnArena own = {0};
	JnMesh mesh;
	const JnStatus status = way(&cube, 0.5, "cube", &own, &mesh);
	jn_arena_free(&own);
	return status;
}

static JnStatus fill_anew(const void* unused) {
	(void)unused;
	return fill(jn_tetrahedra_fill);
}

static JnStatus fill_with_cubes(const void* unused) {
	(void)unused;
	return fill(jn_voxels_fill);
}

// Twice: made, and found again.
static JnStatus fill_from_cache(const void* unused) {
	(void)unused;
	JnArena own = {0};
	JnMesh mesh;
	JnStatus status = JN_OK;
	for (int i = 0; i < 2 && status == JN_OK; ++i) status = jn_cache_tetrahedra(&cube, 0.5, "cube", &own, &mesh, NULL);
	jn_arena_free(&own);
	folder_remove(cache);
	return status;
}

static JnStatus add_middles(const void* unused) {
	(void)unused;
	JnArena own = {0};
	JnMesh mesh;
	const JnStatus status = jn_mesh_add_middles(&tet4, &own, &mesh);
	jn_arena_free(&own);
	return status;
}

static JnStatus resurface(const void* unused) {
	(void)unused;
	JnArena own = {0};
	JnSurface out;
	const JnStatus status = jn_resurface_around(&cube, 0.4, "cube", &own, &out);
	jn_arena_free(&own);
	return status;
}

static JnStatus carry(const void* mesh) {
	JnArena own = {0};
	JnEmbedding* embedding;
	const JnStatus status = jn_embedding_create(&cube, mesh, "cube", &own, &embedding);
	jn_arena_free(&own);
	return status;
}

// ---- linear algebra

static Rig rig;
static JnOperator matrices;
static int slot;
static RandomCells cells;
static bool held[3 * UNKNOWN_NODES];

static void create_matrices(void) {
	ModelCase c;
	JnMatrix* matrix = NULL;
	case_box(&c, JN_HEX8, "stable_neo_hookean");
	for (int a = 0; a < 3; ++a) c.box.cells[a] = 7; // 512 nodes: the least that are coarsened at an infinite step
	rig_create(&rig, &c, 1);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	assert_int_equal(rig.sys->ops->matrix(rig.sys, (JnShift){.stiffness = 1}, &matrix), JN_OK);
	matrices = jn_model_matrix_operator((JnModelSystem*)rig.sys);
	slot = ((JnModelMatrix*)matrix)->slot;
	matrices.blocks(matrices.user, slot); // what the model makes then is not the solver's
	matrices.diagonal(matrices.user, slot);
	cells_create(&cells, UNKNOWN_NODES, UNKNOWN_CELLS, 3);
}

static JnStatus coarsen(const void* unused) {
	(void)unused;
	const JnPreconditionType* type = &jn_precondition_multigrid;
	const JnModel* model = ((const JnModelSystem*)rig.sys)->model;
	JnPrecondition* grid = NULL;
	JN_TRY(type->create(&model->pattern, model->held, 1, &matrices, &grid));
	const JnStatus status = type->update(grid, slot, true);
	assert_true(status != JN_OK || ((const JnMultigrid*)grid)->used > 1);
	type->destroy(grid);
	return status;
}

static JnStatus precondition(const void* type) {
	const JnPreconditionType* made = type;
	const JnModel* model = ((const JnModelSystem*)rig.sys)->model;
	JnPrecondition* precondition = NULL;
	JN_TRY(made->create(&model->pattern, model->held, 1, &matrices, &precondition));
	const JnStatus status = made->update(precondition, slot, true);
	made->destroy(precondition);
	return status;
}

// Twice in one slot, so that a factor takes another's place.
static JnStatus factor_unsymmetric(const void* unused) {
	(void)unused;
	const JnSolverType* type = &jn_solver_unsymmetric;
	const int places = cells.pattern.full_start[UNKNOWN_NODES];
	double* blocks = jn_arena_take(&cells.arena, (size_t)places, 9 * sizeof *blocks);
	if (blocks == NULL) return JN_OUT_OF_MEMORY;
	for (int node = 0; node < UNKNOWN_NODES; ++node)
		for (int k = cells.pattern.full_start[node]; k < cells.pattern.full_start[node + 1]; ++k)
			for (int e = 0; e < 9; ++e)
				blocks[9 * k + e] = cells.pattern.full_column[k] == node && e % 4 == 0 ? 60 : sin(k + e);
	JnSolver* solver = NULL;
	JN_TRY(type->create(NULL, &cells.pattern, held, 1, &solver));
	JnStatus status = type->factor(solver, 0, blocks);
	if (status == JN_OK) status = type->factor(solver, 0, blocks);
	type->destroy(solver);
	return status;
}

// ---- all

static const Work works[] = {
	{"reading quadratic .vtu", read_file, "tet10.vtu"},
	{"reading quadratic .msh", read_file, "tet10.msh"},
	{"reading .ply", read_file, "sphere.ply"},
	{"reading .obj", read_file, "sphere.obj"},
	{"writing quadratic .vtu", write_volume, "written.vtu"},
	{"writing quadratic .msh", write_volume, "written.msh"},
	{"writing .ply", write_surface, "written.ply"},
	{"filling with tetrahedra", fill_anew, NULL},
	{"filling with kept tetrahedra", fill_from_cache, NULL},
	{"filling with cubes", fill_with_cubes, NULL},
	{"adding middles", add_middles, NULL},
	{"resurfacing", resurface, NULL},
	{"carrying by tetrahedra", carry, &tet4},
	{"carrying by hexahedra", carry, &hex8},
	{"coarsening", coarsen, NULL},
	{"making diagonal blocks", precondition, &jn_precondition_block},
	{"making a factor that is carried along", precondition, &jn_precondition_kept},
	{"making an incomplete factor", precondition, &jn_precondition_incomplete},
	{"factoring an unsymmetric matrix", factor_unsymmetric, NULL},
	{NULL, NULL, NULL},
};

static void box_of(JnShape shape, JnMesh* mesh) {
	const JnBoxDef def = {.size = {1, 1, 1}, .cells = {2, 2, 2}, .element = shape};
	assert_int_equal(jn_generate_box(&def, &arena, mesh), JN_OK);
}

static int set_up(void** state) {
	(void)state;
	static int nodes[] = {0, 1, 2};
	static JnNodeSet set = {.name = "low", .count = 3, .nodes = nodes};
	if (folder_create(folder) != 0) return -1;
	snprintf(cache, sizeof cache, "%.240s/cache", folder);
	setenv("JOUNCE_CACHE", cache, 1);
	box_of(JN_TET10, &tet10);
	box_of(JN_TET4, &tet4);
	box_of(JN_HEX8, &hex8);
	tet10.sets = tet4.sets = &set;
	tet10.set_count = tet4.set_count = 1;
	cube = surface_cube(&arena, 0, 1);
	sphere = surface_sphere(&arena, 1, 6);
	jn_export_volume(&tet10, file_of("tet10.vtu"));
	jn_export_volume(&tet10, file_of("tet10.msh"));
	jn_export_surface(&sphere, file_of("sphere.ply"));
	jn_export_surface(&sphere, file_of("sphere.obj"));
	create_matrices();
	return 0;
}

static int tear_down(void** state) {
	(void)state;
	rig_destroy(&rig);
	jn_arena_free(&cells.arena);
	jn_arena_free(&arena);
	folder_remove(folder);
	return 0;
}

static void work_that_is_refused_memory_ends_in_a_clean_error(void** unused) {
	(void)unused;
	long runs = 0;
	for (const Work* work = works; work->name != NULL; ++work) {
		const bool is_small =
			work->run == precondition || work->run == factor_unsymmetric; // and asks where all others do
		const long more = allocation_sweep(work, is_small ? SWEEP_ALL : SWEEP_NEW_SITES);
		printf("%s: %ld failures\n", work->name, more);
		fflush(stdout);
		runs += more;
	}
	printf("%ld failures at %d sites\n", runs, allocation_site_count());
	assert_true(runs > 100);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(work_that_is_refused_memory_ends_in_a_clean_error),
	};
	return cmocka_run_group_tests_name("pieces", tests, set_up, tear_down);
}
