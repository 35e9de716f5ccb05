/// @file system.h
/// A model as the system M a = f(t, x, v) that integrators see, and the numbers it keeps between calls.
#ifndef JN_MODEL_SYSTEM_H
#define JN_MODEL_SYSTEM_H

#include "base/algebra.h"
#include "model/assembly_single.h"
#include "model/hold.h"

typedef struct JnModelSystem JnModelSystem;

/// mass M + damping D + stiffness K, with a factor that is kept until K changes.
typedef struct JnModelMatrix {
	JnMatrix base;
	JnShift shift;
	int slot; ///< of the solver
	bool is_used;
	bool is_definite;  ///< its factor is of the definite form of K
	uint64_t last_use; ///< order of use, for replacing the oldest
} JnModelMatrix;

/// Who may have forces act during a step.
typedef enum JnLoadOf { JN_LOAD_OF_CONTACT, JN_LOAD_OF_COLLISION, JN_LOAD_COUNT } JnLoadOf;

struct JnModelSystem {
	JnSystem base;
	JnModel* model;
	JnAssembly* assembly;
	JnSolver* solver;
	JnSolver* unsymmetric; ///< for matrices with the wind's derivatives; NULL: those are ignored, or there is no wind
	double* full;          ///< 9 a place of the pattern's full rows, for that solver

	double* external;                  ///< gravity and loads [N], 3 * nodes
	const double* load[JN_LOAD_COUNT]; ///< further forces, constant over a step [N]; NULL: none
	double* internal;                  ///< internal forces at the state of internal_stamp [N]
	uint64_t internal_stamp;
	double weight;            ///< norm of external
	bool has_linearized;      ///< someone has asked for K
	uint64_t stiffness_stamp; ///< state at which K is; 0: not yet
	double* linear_x;         ///< its positions, at which stiffness.h makes what is asked for
	double* stiffness;        ///< K, 9 a block, where stiffness_is_assembled; exact
	bool stiffness_is_assembled;
	bool has_products;  ///< every law gives K p
	JnStored single[2]; ///< what products in single precision need of the exact and of the definite K
	bool single_is_current[2];
	JnStored damping_single; ///< and of D
	bool damping_single_is_current;
	double* group_mass; ///< of each group: room for factors of its elements' mass; NULL where they do not make up M
	float* full_mass;   ///< M and its alpha part in the order of full rows; NULL: not yet, or diagonal
	float* full_alpha;
	double* wide_in; ///< vectors in double precision, where single precision must make do with it
	double* wide_out;
	double* diagonal;  ///< diagonal blocks of what was asked for last, 9 a node; NULL where the pattern has no others
	double* damping;   ///< beta part of D, 9 a block, where damping_is_assembled; NULL when no body has beta
	double* damping_x; ///< positions at which D is, whose products stand for it; NULL: they cannot, D is assembled
	bool damping_is_assembled; ///< at damping_x
	double* damping_diagonal;  ///< its diagonal blocks, 9 a node; NULL when no body has beta
	bool damping_acts;         ///< damping_start is past
	double* alpha_mass;        ///< the model's; NULL before damping_start
	double* alpha_entries;     ///< its diagonal, for every entry; NULL unless M is diagonal
	double damping_start;      ///< steps that begin earlier have D = 0 [s]
	uint64_t damping_stamp;    ///< state at which D was made; 0: not yet
	double* beta;              ///< one a group [s]
	bool damping_at_rest;      ///< D is made once, at the rest positions
	bool damping_is_current;   ///< D follows the state
	JnHold hold;               ///< of held coordinates
	const JnAlgebra* algebra;
	double* inverse_mass;     ///< of every entry [1/kg], 0 where it is held; NULL unless M is diagonal
	double* momenta;          ///< M v, for the energies; forces, while advancing
	double* scratch;          ///< 9 a block: the shifted matrix before it is factored
	double* shifted_diagonal; ///< 9 a node: its diagonal blocks
	JnModelMatrix matrices[JN_SOLVER_SLOTS];
	uint64_t uses;
};

/// Build the system of a finished model (mass, pattern and constraints present), into model->system.
JnStatus jn_model_system_create(JnModel* model, const JnVariant* solver);
void jn_model_system_destroy(JnModel* model);

/// Build it anew, as if nothing had been computed with it: without tangents, factors and whatever solvers have learned. Its
/// space is another one, which hands out stamps of its own.
JnStatus jn_model_system_renew(JnModel* model, const JnVariant* solver);

/// Write or read by what residuals are judged.
void jn_system_archive(JnSystem* sys, JnArchive* archive);

/// Let `load`, 3 * nodes [N], act on the nodes until `who` changes it or takes it away (NULL). It is borrowed, and must be
/// constant while a step is computed.
void jn_model_system_set_load(JnModel* model, JnLoadOf who, const double* load);

/// sys->internal = the forces inside at s, if they are not known.
JnStatus jn_model_internal(JnModelSystem* sys, const JnState* s);

/// Let the inputs move over the step from t to t + dt as they were set.
void jn_model_inputs_begin(JnModel* model, double t, double dt);

/// Find or make the matrix of a shift.
JnStatus jn_model_matrix(JnModelSystem* sys, JnShift shift, JnMatrix** out);

/// What solvers may ask of the matrices in their slots.
JnOperator jn_model_matrix_operator(JnModelSystem* sys);

/// Every kept factor that depends on K or D is out of date.
void jn_model_matrix_expire(JnModelSystem* sys);

#endif
