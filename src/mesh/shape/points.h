/// @file points.h
/// What shapes made of points share: a cubic lattice, one point in the middle of each cell, and its random disturbance.
#ifndef JN_MESH_SHAPE_POINTS_H
#define JN_MESH_SHAPE_POINTS_H

#include "jounce/extend.h"
#include "mesh/mesh.h"

/// A lattice of counts[0] x counts[1] x counts[2] cells.
typedef struct JnLattice {
	double low[3];     ///< lowest corner of the first cell [m]
	double spacing[3]; ///< edges of a cell [m]
	int counts[3];
} JnLattice;

/// Random displacement of points.
typedef struct JnJitterDef {
	double jitter; ///< largest displacement along each axis, as a share of the spacing
	int seed;      ///< the same seed gives the same displacements, on any machine
} JnJitterDef;

/// Rows for a table of keys; `path` is the place of a JnJitterDef in `type`.
#define JN_JITTER_KEY_ROWS(type, path)                                                                                 \
	{.name = "jitter",                                                                                                 \
	 .kind = JN_REAL,                                                                                                  \
	 .field = offsetof(type, path jitter),                                                                             \
	 .low = 0,                                                                                                         \
	 .high = 0.5,                                                                                                      \
	 .meaning = "largest random displacement of a point along each axis, as a share of the spacing; breaks the "       \
				"symmetry of the lattice, which cracks would follow"},                                                 \
	{                                                                                                                  \
		.name = "seed", .kind = JN_INTEGER, .field = offsetof(type, path seed), .value = {1}, .low = 0, .high = 2e9,   \
		.meaning = "of the displacements; the same seed gives the same ones, on any machine"                           \
	}

/// Lattices with more cells are refused: 2e7 points.
extern const double jn_lattice_most;

/// A point in the middle of each cell for which is_full[cell] is true (x fastest), or of every cell when it is NULL.
/// `is_layer`: the lattice is one cell thick along z and stays so.
JnStatus jn_lattice_points(const JnLattice* lattice, const bool* is_full, const JnJitterDef* jitter, bool is_layer,
						   JnArena* arena, JnMesh* mesh);

#endif
