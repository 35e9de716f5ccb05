/// @file disk.h
/// The unit disk as five patches of quadrilaterals (an O-grid): a square with bulging sides inside a ring of four.
///
///        ________
///      / \ ring / \           around = 4 * side cells along the circumference,
///     |   +----+   |          rings layers between the square and the circle
///     |   |    |   |
///     |   +----+   |
///      \_/______\_/
#ifndef JN_MESH_SHAPE_DISK_H
#define JN_MESH_SHAPE_DISK_H

#include "mesh/shape/blocks.h"

enum { JN_DISK_PATCHES = 5, JN_DISK_SQUARE = 0 };

/// Point p[2] of the disk at (u, v) in [0, 1]^2 of a patch: 0 the square; 1 .. 4 the ring from -45 degrees on, u outward
/// and v along the circle.
void jn_disk_point(int patch, double u, double v, double p[2]);

/// Cells of a patch along u and v. `around` is a multiple of 4.
void jn_disk_cells(int patch, int around, int rings, int cells[2]);

/// JN_BAD_INPUT, after a message about `what`, unless `around` is a multiple of 4.
JnStatus jn_disk_check(int around, const char* what);

#endif
