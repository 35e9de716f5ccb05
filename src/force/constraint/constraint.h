/// @file constraint.h
/// Constraint elements: few nodes, one measure C of them and its value at rest, E = 1/2 k C^2 (Teschner et al. 2004), and
/// their kin in cloth. Each is a header of this folder; rows and tables are derived from the list below.
#ifndef JN_FORCE_CONSTRAINT_CONSTRAINT_H
#define JN_FORCE_CONSTRAINT_CONSTRAINT_H

#include "force/kernel.h"

/// X(name, nodes, rest_reals, weights): of the numbers that an element has, the last `weights` are what its energy is
/// proportional to, and 0 in padding. (Those of links stand in between: their padding repeats the last element, which
/// nobody reads.)
#define JN_CONSTRAINT_KERNELS(X)                                                                                       \
	X(spring, SPRING_NODES, SPRING_REALS, 1)                                                                           \
	X(strut, STRUT_NODES, STRUT_REALS, 1)                                                                              \
	X(stretch, STRAIN_NODES, STRETCH_REALS, 2)                                                                         \
	X(shear, STRAIN_NODES, SHEAR_REALS, 1)                                                                             \
	X(bend, BEND_NODES, BEND_REALS, 1)                                                                                 \
	X(angle, ANGLE_NODES, ANGLE_REALS, 1)                                                                              \
	X(area, AREA_NODES, AREA_REALS, 1)                                                                                 \
	X(volume, VOLUME_NODES, VOLUME_REALS, 2)                                                                           \
	X(torsion, TORSION_NODES, TORSION_REALS, 1)                                                                        \
	X(skew, SKEW_NODES, SKEW_REALS, 1)                                                                                 \
	X(thread_link, LINK_NODES, THREAD_LINK_REALS, 0)                                                                   \
	X(rod_link, LINK_NODES, ROD_LINK_REALS, 0)

#define JN_NAME_CONSTRAINT(name, nodes, reals, weights) JN_CONSTRAINT_##name,
typedef enum JnConstraintKernel { JN_CONSTRAINT_KERNELS(JN_NAME_CONSTRAINT) JN_CONSTRAINT_COUNT } JnConstraintKernel;
#undef JN_NAME_CONSTRAINT

enum { JN_CONSTRAINT_MOST_NODES = 6, JN_CONSTRAINT_MOST_REALS = 32 };

typedef JnKernel JnConstraintKernels[JN_CONSTRAINT_COUNT];
extern const JnConstraintKernels jn_constraint_kernels_2, jn_constraint_kernels_4, jn_constraint_kernels_8;

/// The kernel for `width` lanes, or for those that this processor likes best when that is 0; NULL where it lacks them.
const JnKernel* jn_constraint_kernel(JnConstraintKernel which, int width);

/// An element to be: model nodes, and numbers at rest as the kernel's header says.
typedef struct JnConstraint {
	int nodes[JN_CONSTRAINT_MOST_NODES];
	double rest[JN_CONSTRAINT_MOST_REALS];
} JnConstraint;

/// A group of `count` elements, from the arena. Elements of six nodes are two frames of a thread: nodes n, n + 1, n + 2 of
/// either.
JnStatus jn_constraint_group_create(const JnKernel* kernel, int count, const JnConstraint* elements, JnArena* arena,
									JnGroup* group);

#endif
