/// @file bond.h
/// Bonds: two nodes that attract or repel each other along the line between them, until the bond is stretched too far.
///
///   s = (|y| - L) / L with y = x_1 - x_0,   E = 1/2 k L s^2,   f_0 = -f_1 = k s y / |y|
///
/// For a peridynamic bond k = c V_0 V_1 times its corrections (Silling & Askari 2005, eqs. 20 and 23): a spring of the
/// stiffness k / L. A broken bond has k = 0.
#ifndef JN_FORCE_BOND_H
#define JN_FORCE_BOND_H

#include "force/kernel.h"

/// Rows of group->rest, each of W lanes.
typedef enum JnBondRest {
	JN_BOND_LENGTH,  ///< L [m]
	JN_BOND_FORCE,   ///< k: force for a stretch of 1 [N]; 0: broken, or padding
	JN_BOND_STRETCH, ///< above this stretch it breaks
	JN_BOND_REALS
} JnBondRest;

/// Entries of group->constants, of the material that the bonds are made of; 0: none.
typedef enum JnBondConstant {
	JN_BOND_MODULUS,   ///< c: force density a stretch [N/m^6]
	JN_BOND_HORIZON,   ///< delta [m]
	JN_BOND_SPACING,   ///< of the points [m]
	JN_BOND_STIFFNESS, ///< of a column of the material, one spacing wide and long [N/m]
} JnBondConstant;

/// The kernel for this processor, or for vectors of `width` doubles (8, 4 or 2) when that is not 0; NULL where the
/// processor lacks them.
const JnKernel* jn_bond_kernel(int width);

/// One bond, as whoever makes them knows it.
typedef struct JnBond {
	int nodes[2];
	double length, force, stretch; ///< as in JnBondRest
} JnBond;

/// A group of `count` bonds, each to be set with jn_bond_set.
JnStatus jn_bonds_create(int count, JnArena* arena, JnGroup* group);
void jn_bond_set(JnGroup* group, int bond, const JnBond* def);
JnBond jn_bond_get(const JnGroup* group, int bond);

/// Give the padding of the last batch the nodes of its last bond, and no stiffness. After all bonds are set.
void jn_bonds_pad(JnGroup* group);

#endif
