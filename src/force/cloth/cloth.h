/// @file cloth.h
/// The kernels of cloth, from which rows and tables are derived, and how their groups are filled.
#ifndef JN_FORCE_CLOTH_CLOTH_H
#define JN_FORCE_CLOTH_CLOTH_H

#include "force/kernel.h"

/// X(name, nodes, rest_reals, weights): of the numbers that an element has, the last `weights` are what its energy is
/// proportional to, and 0 in padding.
#define JN_CLOTH_KERNELS(X)                                                                                            \
	X(spring, SPRING_NODES, SPRING_REALS, 1)                                                                           \
	X(stretch, STRAIN_NODES, STRETCH_REALS, 2)                                                                         \
	X(shear, STRAIN_NODES, SHEAR_REALS, 1)                                                                             \
	X(bend, BEND_NODES, BEND_REALS, 1)

#define JN_NAME_CLOTH(name, nodes, reals, weights) JN_CLOTH_##name,
typedef enum JnClothKernel { JN_CLOTH_KERNELS(JN_NAME_CLOTH) JN_CLOTH_COUNT } JnClothKernel;
#undef JN_NAME_CLOTH

enum { JN_CLOTH_MOST_REALS = 6 };

typedef JnKernel JnClothKernels[JN_CLOTH_COUNT];
extern const JnClothKernels jn_cloth_kernels_2, jn_cloth_kernels_4, jn_cloth_kernels_8;

/// The kernel for `width` lanes, or for those that this processor likes best when that is 0; NULL where it lacks them.
const JnKernel* jn_cloth_kernel(JnClothKernel which, int width);

/// An element to be: model nodes, and numbers at rest as the kernel's header says.
typedef struct JnClothElement {
	int nodes[4];
	double rest[JN_CLOTH_MOST_REALS];
} JnClothElement;

/// A group of `count` elements, from the arena.
JnStatus jn_cloth_group_create(const JnKernel* kernel, int count, const JnClothElement* elements, JnArena* arena,
							   JnGroup* group);

extern const JnLaw jn_law_mass_spring, jn_law_membrane;

#endif
