/// @file select.h
/// Sets of nodes by where they lie at rest, or by name.
#ifndef JN_MODEL_SELECT_H
#define JN_MODEL_SELECT_H

#include "jounce/model.h"
#include "mesh/mesh.h"

/// JN_BAD_INPUT, after a message that begins with `what`, unless exactly one way of choosing is given.
JnStatus jn_select_check(const JnSelectDef* def, const char* what);

/// Mark the mesh's nodes that `def` selects in chosen[node_count] (others are set to false). JN_BAD_INPUT when not
/// exactly one way of choosing is given, when no node is found, or when the mesh has no set of that name (the message
/// lists those it has); `what` names the entry in messages.
JnStatus jn_select_nodes(const JnSelectDef* def, const JnMesh* mesh, const char* what, bool* chosen);

/// Append the sets that `defs` (JnSetDef) describes to the mesh's own; later ones may refer to earlier ones. `what` is
/// the key path of the list. JN_BAD_INPUT like jn_select_nodes, and when a name is taken.
JnStatus jn_select_add_sets(const JnItems* defs, const char* what, JnArena* arena, JnMesh* mesh);

/// The point of `points[3 * count]` nearest to `point`; the first of equals.
int jn_select_nearest(const double* points, int count, const double point[3]);

#endif
