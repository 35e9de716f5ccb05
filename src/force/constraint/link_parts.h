/// @file link_parts.h
/// Which nodes of a link, R_0 P_0 Q_0 R_1 P_1 Q_1, its parts join: for the kernels and for the laws that fill them.
#ifndef JN_FORCE_CONSTRAINT_LINK_PARTS_H
#define JN_FORCE_CONSTRAINT_LINK_PARTS_H

#include "mesh/thread.h"

enum {
	LINK_NODES = 6,
	LINK_SIDES = 3,                       ///< of a section
	ROD_STRUTS = 2 * LINK_SIDES,          ///< and the lines along the thread
	LINK_STRUTS = ROD_STRUTS + LINK_SIDES ///< and the diagonals
};

static const int link_struts[LINK_STRUTS][2] = {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 4}, {2, 5}, {3, 1}, {3, 2}, {5, 1}};
static const int link_cells[JN_LINK_CELLS][4] = {{3, 1, 2, 0}, {3, 5, 2, 1}, {3, 1, 4, 5}};

#endif
