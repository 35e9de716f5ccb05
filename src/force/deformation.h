/// @file deformation.h
/// How far one element is from its rest, for messages about what went wrong: not for speed.
#ifndef JN_FORCE_DEFORMATION_H
#define JN_FORCE_DEFORMATION_H

#include "force/kernel.h"

/// The smallest volume ratio det dx/dX of a solid cell over its quadrature points, with x three numbers a node of the mesh;
/// below 0: inside out. NAN where x is, and for cells that are not solid.
double jn_cell_volume_ratio(const JnMesh* mesh, int cell, const double* x);

#endif
