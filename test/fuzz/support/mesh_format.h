/// @file mesh_format.h
/// A mesh file of one format, read, repaired and measured.
#ifndef JN_TEST_FUZZ_MESH_FORMAT_H
#define JN_TEST_FUZZ_MESH_FORMAT_H

#include <math.h>
#include <stdlib.h>

#include "fuzz.h"
#include "mesh/format/import.h"
#include "mesh/repair.h"

/// What is repaired is whole: its cells name nodes that are there, at places that are finite.
static inline void fuzz_check_mesh(const double* nodes, int node_count, const int* cells, ptrdiff_t entries) {
	for (ptrdiff_t i = 0; i < 3 * (ptrdiff_t)node_count; ++i)
		if (!isfinite(nodes[i])) abort();
	for (ptrdiff_t i = 0; i < entries; ++i)
		if (cells[i] < 0 || cells[i] >= node_count) abort();
}

static inline void fuzz_check_import(const JnImport* import) {
	const JnSurface* surface = &import->surface;
	const JnMesh* volume = &import->volume;
	if (!import->is_volume) {
		fuzz_check_mesh(surface->nodes, surface->node_count, surface->triangles,
						3 * (ptrdiff_t)surface->triangle_count);
		return;
	}
	const ptrdiff_t entries = (ptrdiff_t)volume->cell_count * jn_shape_info[volume->shape].nodes;
	fuzz_check_mesh(volume->nodes, volume->node_count, volume->cells, entries);
	for (int i = 0; i < volume->set_count; ++i)
		for (int k = 0; k < volume->sets[i].count; ++k)
			if (volume->sets[i].nodes[k] < 0 || volume->sets[i].nodes[k] >= volume->node_count) abort();
}

static inline int fuzz_mesh_format(const JnImportFormat* format, const uint8_t* data, size_t size) {
	JnArena arena = {0};
	JnImport import = {0};
	const char* path = fuzz_file(data, size);
	fuzz_listen();
	JnStatus status = format->read(path, &arena, &import);
	if (status == JN_OK)
		status =
			import.is_volume ? jn_mesh_repair(&import.volume, path, &arena) : jn_surface_repair(&import.surface, path);
	fuzz_judge(status);
	if (status == JN_OK) fuzz_check_import(&import);
	jn_arena_free(&arena);
	return 0;
}

#endif
