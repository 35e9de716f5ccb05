/// @file assembly_parts.h
/// What the files of the assembly share: chunks, maps and who owns which nodes.
#ifndef JN_MODEL_ASSEMBLY_PARTS_H
#define JN_MODEL_ASSEMBLY_PARTS_H

#include "base/parallel.h"
#include "model/assembly.h"
#include "model/scatter.h"

// Elements in a chunk: small enough that its forces or blocks stay in the cache between kernel and scatter, and a
// multiple of every batch width, so that chunks do not depend on it.
enum { FORCE_CHUNK = 64, TANGENT_CHUNK = 16, MOST_BLOCK_PAIRS = 55, MOST_NODES = 10 };

// Quadrature points that make another thread worth waking: a fork costs 50 to 100 us, a force 10 ns a point of a solid, a
// diagonal block 25 ns, a tangent 100 ns. Elements of other kinds count as a hexahedron's eight.
enum { FORCE_GRAIN = 16384, DIAGONAL_GRAIN = 8192, TANGENT_GRAIN = 4096, POINTS_OF_OTHERS = 8 };

typedef struct GroupMap {
	int pairs;  // local node pairs (i, j <= i)
	int* block; // [batches][pairs][W]: block of the pattern, ~block when transposed; NULL: matrix-free
	int* low;   // [batches]: lowest and highest node of a batch
	int* high;
} GroupMap;

struct JnAssembly {
	const JnModel* model;
	size_t points;    // quadrature points, by which work is measured
	GroupMap* maps;   // one a group
	double** buffers; // one a thread, of a tangent chunk
	double* chunk_energy;
};

static inline int batches_in(int elements, const JnGroup* group) {
	return elements / group->kernel->width;
}

static inline int lanes_in(const JnGroup* group, int batch) {
	const int rest = group->count - batch * group->kernel->width;
	return rest < group->kernel->width ? rest : group->kernel->width;
}

static inline int node_at(const JnGroup* group, int batch, int i, int lane) {
	const JnKernel* kernel = group->kernel;
	return group->nodes[((size_t)batch * (size_t)kernel->nodes + (size_t)i) * (size_t)kernel->width + (size_t)lane];
}

static inline bool touches(const GroupMap* map, int first, int last, JnNodeRange range) {
	for (int batch = first; batch < last; ++batch)
		if (map->low[batch] < range.high && map->high[batch] >= range.low) return true;
	return false;
}

// The nodes of thread `t` of `team`.
static inline JnNodeRange range_of(const JnAssembly* assembly, int t, int team) {
	const long nodes = assembly->model->node_count;
	return (JnNodeRange){.low = (int)(nodes * t / team), .high = (int)(nodes * (t + 1) / team), .is_all = team == 1};
}

// Threads that a pass over all elements is worth.
static inline int team_for(const JnAssembly* assembly, size_t grain) {
	return jn_threads_for(assembly->points, grain, assembly->model->threads);
}

#endif
