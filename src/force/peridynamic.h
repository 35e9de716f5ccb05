/// @file peridynamic.h
/// Bond-based peridynamics: the prototype microelastic brittle material. Silling, J. Mech. Phys. Solids 48 (2000);
/// Silling & Askari, Computers and Structures 83 (2005), whose equations are cited.
///
/// Points closer than the horizon delta attract each other by a bond: the force density is c s, s the stretch of the
/// bond, so that the force between two points is c s V_i V_j. With E and Poisson's ratio 1/4 (a body) or 1/3 (a plate
/// under plane stress, of thickness t),
///
///   c  = 18 k / (pi delta^4),   k = E / (3 (1 - 2/4)) = 2 E / 3        c  = 9 E / (pi t delta^3)
///   s0 = sqrt(5 G0 / (9 k delta))                                      s0 = sqrt(4 pi G0 / (9 E delta))
#ifndef JN_FORCE_PERIDYNAMIC_H
#define JN_FORCE_PERIDYNAMIC_H

#include "detect/neighbours.h"
#include "force/kernel.h"

/// A cut that is there from the start: bonds that cross it are not made.
typedef struct JnNotchDef {
	double from[3], to[3]; ///< one edge of a flat parallelogram [m]
	double across[3];      ///< its other edge, a vector [m]; NAN: along z through the whole body
} JnNotchDef;

/// Where bonds never break: a box of rest positions that holds one of their points.
typedef struct JnUnbreakableDef {
	double min[3], max[3]; ///< [m]
} JnUnbreakableDef;

/// Keys of `material: {law: peridynamic}`.
typedef struct JnPeridynamicDef {
	double density;          ///< [kg/m^3]
	double young;            ///< E [Pa]
	double horizon;          ///< delta [m]; NAN: from horizon_spacings
	double horizon_spacings; ///< delta as a multiple of the spacing; NAN: 3, unless horizon is given
	double critical_stretch; ///< s0; NAN: from fracture_energy
	double fracture_energy;  ///< G0 [J/m^2]; NAN: critical_stretch is given
	int volume;              ///< JnVolumeCorrection
	int surface;             ///< JnSurfaceCorrection
	JnItems notches;         ///< JnNotchDef
	JnItems unbreakable;     ///< JnUnbreakableDef
} JnPeridynamicDef;

/// What becomes of points whose cells the rim of a horizon cuts.
typedef enum JnVolumeCorrection { JN_VOLUME_NONE, JN_VOLUME_PARTIAL } JnVolumeCorrection;

/// What becomes of points near a surface, which miss a part of their horizon.
typedef enum JnSurfaceCorrection { JN_SURFACE_NONE, JN_SURFACE_VOLUME, JN_SURFACE_ENERGY } JnSurfaceCorrection;

/// A body while its bonds are made.
typedef struct JnPeridynamics {
	const JnPeridynamicDef* def;
	const JnMesh* mesh;
	const char* what; ///< key path of the body
	int dimensions;   ///< 2: one layer under plane stress
	double spacing;   ///< of the points [m]
	double horizon;   ///< delta [m]
	double modulus;   ///< c [N/m^6]
	double stretch;   ///< s0
	JnNeighbours pairs;
} JnPeridynamics;

/// The share of a point that counts in a pair `length` apart: volume of its cell inside the horizon over its whole
/// volume, linear in the distance to the rim (Hu, Ha & Bobaru, Int. J. Fract. 165, 2010).
double jn_peridynamic_share(const JnPeridynamics* body, double length);

/// The factor of every bond that makes up for the missing horizon of points near a surface; scale[pair], of all pairs.
JnStatus jn_peridynamic_correct(const JnPeridynamics* body, JnArena* scratch, double* scale);

/// is_cut[pair] = a notch crosses it. JN_BAD_INPUT when a notch crosses none.
JnStatus jn_peridynamic_cut(const JnPeridynamics* body, bool* is_cut);

/// JnLaw.build of `peridynamic`: one group of bonds.
JnStatus jn_peridynamic_build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node,
							  const char* what, JnArena* arena, JnGroups* out);

extern const JnLaw jn_law_peridynamic;

#endif
