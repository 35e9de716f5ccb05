/// @file constraints.h
/// What the law `constraints` is given, and how it fills a mesh of tetrahedra and a thread with elements.
#ifndef JN_FORCE_CONSTRAINT_CONSTRAINTS_H
#define JN_FORCE_CONSTRAINT_CONSTRAINTS_H

#include "force/constraint/constraint.h"

/// Keys of `material:`. Parameters of the body, not of its mesh.
typedef struct JnConstraintsDef {
	double density;         ///< [kg/m^3]
	double stiffness;       ///< of the springs together, as Young's modulus [Pa]
	double volume;          ///< bulk modulus that the volume terms add [Pa]
	double collapse;        ///< and their nonlinear part, against collapse [Pa]
	double area;            ///< of the skin: tension for a relative change of area of 1 [N/m]
	double torsion;         ///< GJ of a thread [N m^2]
	double bending;         ///< EI that a thread has beside what its springs resist [N m^2]
	double damping;         ///< of all parts, as a time [s]
	double torsion_damping; ///< NAN: as the others [s]
} JnConstraintsDef;

enum { JN_CONSTRAINTS_GROUPS = 5 }; ///< at most

/// What a fill works with: temporary memory, and the arena of the groups.
typedef struct JnConstraintsFill {
	const JnConstraintsDef* def;
	const JnMesh* mesh;
	int first_node;
	JnArena *scratch, *arena;
} JnConstraintsFill;

/// Springs on all edges, and volumes of all cells.
JnStatus jn_constraints_fill_mesh(const JnConstraintsFill* fill, JnGroups* out);
/// Links, their torsion and bending.
JnStatus jn_constraints_fill_thread(const JnConstraintsFill* fill, JnGroups* out);

#endif
