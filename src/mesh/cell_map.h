/// @file cell_map.h
/// Where a point stands inside a tet4 or hex8 cell, by the cell's shape functions.
#ifndef JN_MESH_CELL_MAP_H
#define JN_MESH_CELL_MAP_H

#include "mesh/mesh.h"

/// Nodes of the cells that can be asked, at most.
enum { JN_CELL_MAP_NODES = 8 };

/// Natural coordinates of a point: X(xi) = point. Inside a tet4 they are not negative and sum to at most 1, inside a
/// hex8 they are between 0 and 1. False when they cannot be found, as may be for a point far outside a skew hex8.
bool jn_cell_natural(const JnMesh* mesh, int cell, const double point[3], double xi[3]);

/// Move natural coordinates into the cell, hex8 ones each to the nearest end of its range; returns the largest
/// distance that one of them was outside.
double jn_cell_clamp(JnShape shape, double xi[3]);

/// Weights of the cell's nodes at a point, by the shape functions and their slope at xi:
///     w_i = N_i(xi) + grad N_i(xi) . (point - X(xi)).
/// They sum to 1 and give the point back when applied to the nodes at rest, and so do under any affine motion, also
/// outside of the cell. False when the cell has no volume at xi.
bool jn_cell_weights(const JnMesh* mesh, int cell, const double xi[3], const double point[3],
					 double weights[JN_CELL_MAP_NODES]);

#endif
