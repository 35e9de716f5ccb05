/// @file model.h
/// What a model is made of: definition structs, filled from a scene file or by hand, and the model built from them.
#ifndef JOUNCE_MODEL_H
#define JOUNCE_MODEL_H

#include "jounce/base.h"
#include "jounce/extend.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A box of space, for selecting nodes.
typedef struct JnRegionBoxDef {
	double min[3], max[3]; ///< corners [m]
} JnRegionBoxDef;

/// A ball of space, for selecting nodes.
typedef struct JnRegionSphereDef {
	double center[3]; ///< [m]
	double radius;    ///< [m]
} JnRegionSphereDef;

/// A plane, for selecting nodes.
typedef struct JnRegionPlaneDef {
	double point[3];  ///< any point of it [m]
	double normal[3]; ///< of any length > 0
	double within;    ///< distance that counts as on it [m]; NAN: 1e-6 of the body's size
	int side;         ///< 0 on it; 1 on it or above, where the normal points; 2 on it or below
} JnRegionPlaneDef;

/// Which nodes of a body, by their rest positions or by name. Exactly one of the fields is given.
typedef struct JnSelectDef {
	int face;                  ///< 0 none; 1 .. 6: side x- x+ y- y+ z- z+ of the body's bounding box; 7: all nodes
	JnRegionBoxDef* box;       ///< nodes inside or on it
	JnRegionSphereDef* sphere; ///< nodes inside or on it
	double nearest[3];         ///< the one node nearest to a point [m]; NAN when not given
	JnRegionPlaneDef* plane;   ///< nodes on it or to one side
	int corner;      ///< 0 none; 1 + bits: the node nearest to a corner of the bounding box, bit i: high along axis i
	const char* set; ///< a named set, of the mesh or of the body's `sets`; NULL: none
} JnSelectDef;

extern const JnKey jn_select_keys[]; ///< of JnSelectDef

/// A name for nodes of a body.
typedef struct JnSetDef {
	const char* name;
	JnSelectDef where; ///< may name sets of the mesh, and those before it in the list
} JnSetDef;

/// Nodes held at their rest position.
typedef struct JnFixDef {
	JnSelectDef where;
	const char* axes; ///< which coordinates: any of "x", "y", "z"
} JnFixDef;

/// Frames of a thread that run along a curve, each at its distance behind the head.
typedef struct JnAlongDef {
	JnVariant curve;  ///< row of the list of curves
	double origin[3]; ///< where the curve's own origin goes [m]
	double rotate[3]; ///< turns about x, then y, then z, about its own origin [rad]
	JnVariant head;   ///< row of jn_motion_list: arc length of the head [m]
	int leads;        ///< which end of the chosen frames is the head: 0 that nearer to the thread's start, 1 to its end
} JnAlongDef;

/// Nodes moved along prescribed paths: by `motion`, `along` or `input`.
typedef struct JnDriveDef {
	JnSelectDef where;
	JnVariant motion[3]; ///< displacement along x, y, z; row NULL: not driven along that axis
	int others;          ///< what the other axes do: 0 held, 1 free
	JnAlongDef* along;   ///< NULL: not along a curve
	const char* input;   ///< name of the input that sets their displacement; NULL: none
} JnDriveDef;

/// A constant force on nodes.
typedef struct JnLoadDef {
	JnSelectDef where;
	double force[3]; ///< on all of them together, shared in proportion to their masses [N]
} JnLoadDef;

/// Rayleigh damping D = alpha M + beta K.
typedef struct JnDampingDef {
	double alpha;  ///< [1/s]
	double beta;   ///< [s]
	int stiffness; ///< K taken at: 0 the start of the step, 1 rest, 2 the current state
	double start;  ///< steps that begin before this time have D = 0 [s]
} JnDampingDef;

/// A random displacement of every free node at the start, uniform in a ball; held axes stay.
typedef struct JnScatterDef {
	double amplitude; ///< radius of the ball [m]; 0: none
	int seed;         ///< the same seed gives the same displacements, on any machine
} JnScatterDef;

/// Gusts: the seeded sum of sine waves of model/wind_gust.h.
typedef struct JnGustDef {
	double strength;   ///< root mean square of their speed [m/s]
	double period;     ///< about which their periods lie, from half of it to twice [s]
	double wavelength; ///< of a gust of that period [m]; NAN: the same everywhere
	int seed;
	int components; ///< waves, 1 .. 64
} JnGustDef;

/// Air that moves past the bodies, and loads their surfaces.
typedef struct JnWindDef {
	double velocity[3]; ///< its constant part [m/s]
	double density;     ///< of the air [kg/m^3]
	JnGustDef* gusts;   ///< NULL: none
	int tangent;        ///< derivatives of the wind's force in K and D: 0 none, 1 exact
} JnWindDef;

/// How points of peridynamic bodies, rigid balls and plates keep each other away: springs that push, and never pull.
typedef struct JnRepulsionDef {
	double stiffness;  ///< of two points: force density a length, in micromoduli c over the horizon
	double reach;      ///< distance at which they meet, in half the sum of their spacings
	double rest_share; ///< and at most, in their distance at rest
	double margin;     ///< pairs this much farther apart are watched, in spacings
} JnRepulsionDef;

/// How a body takes part in contact.
typedef struct JnBodyContactDef {
	bool active;         ///< false: it passes through everything
	bool self;           ///< also against itself
	const char* surface; ///< name of its contact material, for friction; NULL: "default"
	double
		offset; ///< distance that its surface keeps from obstacles [m]; NAN: a twentieth of the mean edge of a cloth, 0 of others
} JnBodyContactDef;

/// A rigid thing that never moves, such as a floor.
typedef struct JnObstacleDef {
	const char* name;
	JnVariant shape;     ///< row of jn_obstacle_list
	const char* surface; ///< name of its contact material, for friction; NULL: "default"
} JnObstacleDef;

typedef struct JnBodyDef {
	const char* name;
	JnVariant shape;    ///< row of jn_shape_list
	JnVariant material; ///< row of jn_law_list
	int mass;           ///< 0 consistent, 1 lumped
	JnDampingDef damping;
	double drag;        ///< drag coefficient C_d of each triangle of the surface; 0: no wind on this body
	double velocity[3]; ///< of all free nodes at the start [m/s]
	double spin[3];     ///< angular velocity at the start, about the centre of mass at rest; added to velocity [rad/s]
	JnScatterDef scatter;
	JnBodyContactDef contact;
	JnItems sets;  ///< JnSetDef
	JnItems fix;   ///< JnFixDef
	JnItems drive; ///< JnDriveDef
	JnItems loads; ///< JnLoadDef
} JnBodyDef;

typedef struct JnModelDef {
	double gravity[3];         ///< [m/s^2]
	JnItems bodies;            ///< JnBodyDef
	JnItems obstacles;         ///< JnObstacleDef
	JnWindDef* wind;           ///< NULL: no air at all
	JnRepulsionDef* repulsion; ///< NULL: points pass through each other, and there is nothing rigid but obstacles
	JnVariant solver;          ///< row of the solver list
} JnModelDef;

/// The rows of JnModelDef in a scene file.
extern const JnKey jn_body_keys[];

extern const JnKey jn_body_contact_keys[]; ///< of JnBodyContactDef

/// The rows of JnObstacleDef in a scene file.
extern const JnKey jn_obstacle_keys[];

/// The rows of JnRepulsionDef in a scene file.
extern const JnKey jn_repulsion_keys[];

/// The rows of JnWindDef in a scene file.
extern const JnKey jn_wind_keys[];

/// Build meshes, elements, mass and constraints. `threads` >= 1. On failure *model is NULL and a message says why. The
/// options of motions and the names in `def` must outlive the model.
JnStatus jn_model_create(const JnModelDef* def, int threads, JnModel** model);
void jn_model_destroy(JnModel* model);

int jn_model_node_count(const JnModel* model);
double jn_model_mass(const JnModel* model);                        ///< total [kg]
const double* jn_model_rest(const JnModel* model);                 ///< rest positions, 3 * node_count [m]
int jn_model_nearest(const JnModel* model, const double point[3]); ///< node whose rest position is nearest

/// Energies [J] and momenta of a state.
typedef struct JnEnergies {
	double kinetic, elastic;
	double gravity;     ///< potential of gravity and of the bodies' loads, 0 at the rest positions
	double momentum[3]; ///< [kg m/s]
	double angular[3];  ///< about the origin [kg m^2/s]
} JnEnergies;

/// The model as a system M a = f(t, x, v); owned by the model.
JnSystem* jn_model_system(JnModel* model);

/// Put a state of the model's space at rest positions, scattered where the bodies say so, with the bodies' initial
/// velocities, at time t.
void jn_model_start(JnModel* model, double t, JnState* state);

JnEnergies jn_model_energies(JnModel* model, const JnState* state);

#ifdef __cplusplus
}
#endif
#endif
