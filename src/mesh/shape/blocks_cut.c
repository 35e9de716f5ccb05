// A hexahedron as six tetrahedra: from its lowest node to the two halves of each of the three faces that lack this node.
#include "mesh/shape/blocks.h"

static int lowest_of(const int* nodes, const int* local, int count) {
	int low = 0;
	for (int i = 1; i < count; ++i)
		if (nodes[local != NULL ? local[i] : i] < nodes[local != NULL ? local[low] : low]) low = i;
	return low;
}

static bool has_corner(const int face[4], int corner) {
	return face[0] == corner || face[1] == corner || face[2] == corner || face[3] == corner;
}

/// Faces look outward, so that a half is turned to look at the tetrahedron's fourth node.
static int* put_half(int* out, const int* hex, const int face[4], int start, int half, int apex) {
	*out++ = hex[face[start]];
	*out++ = hex[face[(start + half + 1) % 4]];
	*out++ = hex[face[(start + half) % 4]];
	*out++ = hex[apex];
	return out;
}

static int* put_tetrahedra(int* out, const int hex[8]) {
	const int apex = lowest_of(hex, NULL, 8);
	for (int k = 0; k < 6; ++k) {
		const int* face = jn_shape_info[JN_HEX8].face + 4 * (size_t)k;
		if (has_corner(face, apex)) continue;
		const int start = lowest_of(hex, face, 4);
		out = put_half(out, hex, face, start, 1, apex);
		out = put_half(out, hex, face, start, 2, apex);
	}
	return out;
}

JnStatus jn_blocks_cut(const JnMesh* hexahedra, JnArena* arena, JnMesh* tetrahedra) {
	int* cells;
	JN_NEW(arena, cells, 24 * (size_t)hexahedra->cell_count);
	*tetrahedra = *hexahedra;
	tetrahedra->shape = JN_TET4;
	tetrahedra->cell_count = 6 * hexahedra->cell_count;
	tetrahedra->cells = cells;
	for (int cell = 0; cell < hexahedra->cell_count; ++cell)
		cells = put_tetrahedra(cells, hexahedra->cells + 8 * (size_t)cell);
	return JN_OK;
}
