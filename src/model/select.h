/// @file select.h
/// Sets of nodes by where they lie at rest.
#ifndef JN_MODEL_SELECT_H
#define JN_MODEL_SELECT_H

#include "jounce/model.h"
#include "mesh/mesh.h"

/// Mark the mesh's nodes that `def` selects in chosen[node_count] (others are set to false). JN_BAD_INPUT when not
/// exactly one way of choosing is given or when no node is found; `what` names the entry in messages.
JnStatus jn_select_nodes(const JnSelectDef* def, const JnMesh* mesh, const char* what, bool* chosen);

/// The point of `points[3 * count]` nearest to `point`; the first of equals.
int jn_select_nearest(const double* points, int count, const double point[3]);

#endif
