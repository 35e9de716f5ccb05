#include "mesh/shape/points.h"

#include "base/random.h"

const double jn_lattice_most = 2e7;

static int count_full(size_t cells, const bool* is_full) {
	if (is_full == NULL) return (int)cells;
	int count = 0;
	for (size_t c = 0; c < cells; c++) count += is_full[c];
	return count;
}

static void place_point(const JnLattice* lattice, size_t cell, double x[3]) {
	const size_t nx = (size_t)lattice->counts[0], ny = (size_t)lattice->counts[1];
	const size_t at[3] = {cell % nx, cell / nx % ny, cell / nx / ny};
	for (int a = 0; a < 3; a++) x[a] = lattice->low[a] + lattice->spacing[a] * ((double)at[a] + 0.5);
}

JnStatus jn_lattice_points(const JnLattice* lattice, const bool* is_full, const JnJitterDef* jitter, bool is_layer,
						   JnArena* arena, JnMesh* mesh) {
	const size_t cells = (size_t)lattice->counts[0] * (size_t)lattice->counts[1] * (size_t)lattice->counts[2];
	const double volume = lattice->spacing[0] * lattice->spacing[1] * lattice->spacing[2];
	const int count = count_full(cells, is_full), axes = is_layer ? 2 : 3;
	double* volumes;
	*mesh = (JnMesh){.shape = JN_POINT1, .node_count = count, .cell_count = count};
	JN_NEW(arena, mesh->nodes, 3 * (size_t)count);
	JN_NEW(arena, mesh->cells, count);
	JN_NEW(arena, volumes, count);
	mesh->volumes = volumes;
	mesh->thickness = is_layer ? lattice->spacing[2] : 0;
	JnRandom random = {(uint64_t)jitter->seed};
	int point = 0;
	for (size_t cell = 0; cell < cells; cell++) {
		if (is_full != NULL && !is_full[cell]) continue;
		double* x = mesh->nodes + 3 * (size_t)point;
		place_point(lattice, cell, x);
		for (int a = 0; a < axes && jitter->jitter > 0; a++)
			x[a] += jitter->jitter * lattice->spacing[a] * (2 * jn_random_uniform(&random) - 1);
		volumes[point] = volume;
		mesh->cells[point] = point;
		point++;
	}
	return JN_OK;
}
