/// @file repair.h
/// Volumes as they come from files, made usable.
#ifndef JN_MESH_REPAIR_H
#define JN_MESH_REPAIR_H

#include "mesh/mesh.h"

/// Make a volume usable: cells that are inside out are turned (one warning says how many), nodes that no cell uses go.
/// JN_BAD_INPUT, with the first offenders, for node numbers out of range, cells with a node twice, cells without volume,
/// nodes at the same place, coordinates that are not finite.
JnStatus jn_mesh_repair(JnMesh* mesh, const char* what, JnArena* arena);

#endif
