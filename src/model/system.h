/// @file system.h
/// A model as the system M a = f(t, x, v) that integrators see, and the numbers it keeps between calls.
#ifndef JN_MODEL_SYSTEM_H
#define JN_MODEL_SYSTEM_H

#include "model/assembly.h"

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

struct JnModelSystem {
	JnSystem base;
	JnModel* model;
	JnAssembly* assembly;
	JnSolver* solver;
	JnSolver* unsymmetric; ///< for matrices with the wind's derivatives; NULL: those are ignored, or there is no wind
	double* full;          ///< 9 a place of the pattern's full rows, for that solver

	double* external;   ///< gravity and loads [N], 3 * nodes
	const double* load; ///< further forces, constant over a step, such as those of contact [N]; NULL: none
	double* internal;   ///< internal forces at the state of internal_stamp [N]
	uint64_t internal_stamp;
	double* stiffness; ///< K at the state of stiffness_stamp, 9 a block; exact
	uint64_t stiffness_stamp;
	double* linear_x;        ///< positions at which K was made
	double* damping_x;       ///< the same of D; NULL unless the model is matrix-free and some body has beta
	double* damping;         ///< beta part of D, 9 a block; NULL when no body has beta, and before damping_start
	double* damping_store;   ///< what `damping` points to once it acts; NULL when no body has beta
	double* alpha_mass;      ///< the model's; NULL before damping_start
	double damping_start;    ///< steps that begin earlier have D = 0 [s]
	uint64_t damping_stamp;  ///< state at which D was made; 0: not yet
	double* beta;            ///< one a group [s]
	bool damping_at_rest;    ///< D is made once, at the rest positions
	bool damping_is_current; ///< D follows the state
	double* momenta;         ///< M v, for the energies
	double* scratch;         ///< 9 a block: the shifted matrix before it is factored
	JnModelMatrix matrices[JN_SOLVER_SLOTS];
	uint64_t uses;
};

/// Build the system of a finished model (mass, pattern and constraints present), into model->system.
JnStatus jn_model_system_create(JnModel* model, const JnVariant* solver);
void jn_model_system_destroy(JnModel* model);

/// Let `load`, 3 * nodes [N], act on the nodes until it is changed or taken away (NULL). It is borrowed, and must be
/// constant while a step is computed.
void jn_model_system_set_load(JnModel* model, const double* load);

/// Find or make the matrix of a shift.
JnStatus jn_model_matrix(JnModelSystem* sys, JnShift shift, JnMatrix** out);

/// out += scale * the beta part of D * in.
void jn_model_apply_damping(const JnModelSystem* sys, double scale, const double* in, double* out);

/// The matrix of a solver's slot, for a solver that asks for products: out = matrix * in.
void jn_model_matrix_product(void* sys, int slot, const double* in, double* out);

/// Every kept factor that depends on K or D is out of date.
void jn_model_matrix_expire(JnModelSystem* sys);

#endif
