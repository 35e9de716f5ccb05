/// @file model.h
/// The model as built: nodes, bodies, mass, constraints. Constant after jn_model_create.
#ifndef JN_MODEL_MODEL_H
#define JN_MODEL_MODEL_H

#include "detect/obstacle.h"
#include "force/kernel.h"
#include "jounce/model.h"
#include "math/pattern.h"
#include "model/motion.h"
#include "solve/solver.h"

typedef struct JnRepulsion JnRepulsion;
typedef struct JnWind JnWind;

typedef struct JnBody {
	const char* name;
	JnMesh mesh;    ///< cells with node numbers of their own, from 0; with the sets of the body
	int first_node; ///< number of the body's node 0 in the model
	int* cells;     ///< the same cells with the model's node numbers
	const JnLaw* law;
	int first_group, group_count; ///< in the model's groups
	double density;               ///< [kg/m^3]; of a surface [kg/m^2]
	JnDampingDef damping;
	int mass_form;      ///< 0 consistent, 1 lumped
	double drag;        ///< C_d
	double velocity[3]; ///< at the start [m/s]
	double spin[3];     ///< at the start [rad/s]
	JnScatterDef scatter;
	JnBodyContactDef contact; ///< its surface is never NULL
} JnBody;

typedef struct JnModelObstacle {
	const char* name;
	const char* surface; ///< name of its contact material, never NULL
	JnObstacle shape;
} JnModelObstacle;

/// One coordinate that does not follow the equations of motion.
typedef struct JnHeld {
	int entry;               ///< 3 * node + axis
	const JnVariant* motion; ///< NULL: stays at rest, or follows a guide or an input
} JnHeld;

struct JnModel {
	JnArena arena; ///< everything below
	int threads;
	int node_count;
	double* rest; ///< 3 * node_count [m]
	int body_count;
	JnBody* bodies;
	int group_count;
	JnGroup* groups; ///< body by body
	int obstacle_count;
	JnModelObstacle* obstacles;
	double gravity[3];
	bool* held; ///< 3 * node_count
	int held_count;
	JnHeld* held_list; ///< ascending entries
	int guide_count;
	struct JnGuide* guides; ///< guide.h
	int input_count;
	struct JnInput* inputs; ///< input.h
	bool is_matrix_free;    ///< K and D act by products; the pattern has the diagonal blocks alone
	JnPattern pattern;
	double* mass;       ///< one number a block of the pattern [kg]
	double* nodal_mass; ///< row sums of `mass`, node_count [kg]
	bool mass_is_diagonal;
	double* alpha_mass;     ///< sum of alpha M over bodies, one number a block [kg/s]; NULL when no body has alpha
	bool has_beta;          ///< some body has stiffness damping
	double total_mass;      ///< [kg]
	double* loads;          ///< constant forces, 3 * node_count [N]; NULL: none
	JnWind* wind;           ///< wind.h; NULL: none
	JnRepulsion* repulsion; ///< repulsion.h; NULL: none
	JnSystem* system;
	JnArena system_arena; ///< what the system is made of
};

/// beta of a group [s]: that of its body and its own.
double jn_group_beta(const JnModel* model, const JnBody* body, int group);

/// Does the body have stiffness damping?
bool jn_body_has_beta(const JnModel* model, const JnBody* body);

/// Write or read what changes in a model while it is simulated: which elements are broken, and where inputs move.
void jn_model_archive(JnModel* model, JnArchive* archive);

#endif
