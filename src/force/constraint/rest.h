/// @file rest.h
/// The numbers at rest of constraint elements, from the nodes of a mesh, and the links of a thread: for the laws that fill
/// them. Node numbers are those of the mesh until jn_constraint_add.
#ifndef JN_FORCE_CONSTRAINT_REST_H
#define JN_FORCE_CONSTRAINT_REST_H

#include "force/constraint/constraint.h"
#include "force/constraint/link_parts.h"

/// Distance of two nodes at rest [m].
double jn_rest_length(const JnMesh* mesh, const int nodes[2]);

/// A strut of the stiffness k [N/m].
void jn_rest_strut(const JnMesh* mesh, const int nodes[2], double k, double* rest);

/// A tetrahedron whose volume resists as a solid with the moduli [Pa] resists: those of volume.h times its volume.
void jn_rest_volume(const JnMesh* mesh, const int nodes[4], double modulus, double nonlinear_modulus, double* rest);

/// A tetrahedron that resists only when its volume comes down to a `share` of that at rest, as the nonlinear part of a body that
/// has so much volume at rest.
void jn_rest_guard(const JnMesh* mesh, const int nodes[4], double share, double nonlinear_modulus, double* rest);

/// A triangle whose tension is `stiffness` [N/m] at a relative change of area of 1.
void jn_rest_area(const JnMesh* mesh, const int nodes[3], double stiffness, double* rest);

/// A line that turns at its node nodes[2], k [N m].
void jn_rest_angle(const JnMesh* mesh, const int nodes[3], double k, double* rest);

/// The twist between two frames, k [N m].
void jn_rest_torsion(const JnMesh* mesh, const int nodes[LINK_NODES], double k, double* rest);

/// The shear between two frames with a stiffness GA [N].
void jn_rest_skew(const JnMesh* mesh, const int nodes[LINK_NODES], double shear_stiffness, double* rest);

/// R, P and Q of the frames at both ends of a link.
void jn_link_nodes(const JnThread* thread, int link, int nodes[LINK_NODES]);

/// Distance between the points on the axis at both ends of a link [m].
double jn_link_length(const JnMesh* mesh, int link);

/// The density that gives the cells of a thread the mass of a round thread of its radius.
double jn_thread_density(const JnMesh* mesh, double density);

/// Put a group of `count` elements of a kernel behind those of `out`; none when there are no elements.
JnStatus jn_constraint_add(JnConstraintKernel which, int count, JnConstraint* elements, int first_node, double damping,
						   JnArena* arena, JnGroups* out);

/// The sides of the last section of a thread that is open, as struts: links have those of their first section alone.
JnStatus jn_thread_add_end(const JnMesh* mesh, double k, int first_node, double damping, JnArena* arena, JnGroups* out);

#endif
