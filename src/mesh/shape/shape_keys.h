/// @file shape_keys.h
/// Rows of keys that several generated shapes have.
#ifndef JN_MESH_SHAPE_SHAPE_KEYS_H
#define JN_MESH_SHAPE_SHAPE_KEYS_H

#include <math.h>
#include <stddef.h>

#include "mesh/shape/placement.h"
#include "mesh/shape/shape.h"

extern const char* const jn_element_names[]; ///< by JnShape
extern const char* const jn_axis_names[];    ///< x, y, z

#define JN_ELEMENT_KEY(type)                                                                                           \
	{                                                                                                                  \
		.name = "element", .kind = JN_CHOICE, .field = offsetof(type, element), .value = {JN_HEX8},                    \
		.names = jn_element_names, .meaning = "shape of the cells; each hexahedron is six tetrahedra for tet4, tet10"  \
	}

#define JN_AXIS_KEY(type, text)                                                                                        \
	{                                                                                                                  \
		.name = "axis", .kind = JN_CHOICE, .field = offsetof(type, axis), .value = {1}, .names = jn_axis_names,        \
		.meaning = text                                                                                                \
	}

/// A position, [0, 0, 0] by default.
#define JN_POSITION_KEY(type, field_name, text)                                                                        \
	{ .name = #field_name, .kind = JN_REAL3, .field = offsetof(type, field_name), .unit = "m", .meaning = text }

/// Turns as those of bodies from files (placement.h), but about the shape's middle.
#define JN_ROTATE_KEY(type)                                                                                            \
	{                                                                                                                  \
		.name = "rotate", .kind = JN_REAL3, .field = offsetof(type, rotate), .unit = "rad",                            \
		.meaning = "turns about x, then y, then z, right-handed about its middle, such as [0 deg, 90 deg, 0 deg]"      \
	}

/// A length > 0 that must be given.
#define JN_LENGTH_KEY(type, field_name, text)                                                                          \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(type, field_name), .high = INFINITY,                   \
		.open = JN_OPEN_LOW | JN_OPEN_HIGH, .required = true, .unit = "m", .meaning = text                             \
	}

/// Cells of a swept disk: around (a multiple of 4), rings, along.
#define JN_DISK_CELLS_KEY(type, around, rings, along, text)                                                            \
	{                                                                                                                  \
		.name = "cells", .kind = JN_INTEGER3, .field = offsetof(type, cells), .value = {around, rings, along},         \
		.low = 1, .high = 4096, .meaning = text                                                                        \
	}

/// X along the axis and in the plane across it, which follows cyclically: for z, across[0] along x and across[1] along y.
static inline void jn_shape_orient(int axis, const double center[3], const double across[2], double along,
								   double X[3]) {
	X[axis] = center[axis] + along;
	X[(axis + 1) % 3] = center[(axis + 1) % 3] + across[0];
	X[(axis + 2) % 3] = center[(axis + 2) % 3] + across[1];
}

#endif
