/// @file sim.h
/// A simulation: a model, an integrator and a step controller, stepped from state to state.
#ifndef JOUNCE_SIM_H
#define JOUNCE_SIM_H

#include "jounce/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Friction between two contact materials, in either order.
typedef struct JnContactPairDef {
	const char *first, *second; ///< names, as `surface` of bodies and obstacles says
	double friction;            ///< coefficient mu
} JnContactPairDef;

/// How bodies meet each other and obstacles: the predictor-corrector of HO section 4 (docs/contact.md).
typedef struct JnContactDef {
	int rule;       ///< 0 approaching: surfaces meet and do not overlap; 1 touching: as in the paper
	int prediction; ///< contact forces in it: 0 auto; 1 carried: of the last step; 2 iterated: of this one; 3 free: none
	int rounds;     ///< most predictions a step where they are iterated
	double margin;  ///< distance within which a vertex is watched [m]; NAN: a twentieth of the mean edge
	double push_out; ///< fastest separation of what overlaps [m/s]
	double friction; ///< mu of pairs that `pairs` does not name
	JnItems pairs;   ///< JnContactPairDef
	int damping; ///< D in the corrector's matrix: 0 auto: unless the prediction is free, as in the paper; 1 no; 2 yes
	JnVariant solver; ///< row of jn_qp_list
} JnContactDef;

/// When what can break may do so; which strains break it is the material's (docs/peridynamics.md).
typedef struct JnFractureDef {
	double start;  ///< nothing breaks before this time [s]
	double debris; ///< nodes that have lost this share of their elements lose the rest; 1: none
} JnFractureDef;

typedef struct JnSimDef {
	JnModelDef model;
	JnVariant system;      ///< row of jn_system_list, simulated in place of a model; row NULL: none
	JnContactDef* contact; ///< NULL: bodies pass through each other
	JnFractureDef fracture;
	JnVariant integrator; ///< row of the integrator list
	JnNewtonDef newton;
	JnVariant step;  ///< row of the controller list
	double duration; ///< simulated time [s]
} JnSimDef;

typedef struct JnSim JnSim;

/// Build the model and put it at its start. `def` and what it points to must outlive the simulation. `threads` 0: as
/// many as there are. On failure *sim is NULL and a message says why.
JnStatus jn_sim_create(const JnSimDef* def, int threads, JnSim** sim);
void jn_sim_destroy(JnSim* sim);

/// The same for a system of your own (extend.h), from positions x and velocities v at t = 0, which are copied. `settings`
/// is YAML with the keys duration, integrator, newton and step of a scene file:
///   "{duration: 10 s, integrator: {method: newmark, beta: 0.25}, step: {dt: 1 ms}}"
/// The system must outlive the simulation.
JnStatus jn_sim_create_for(JnSystem* sys, const char* settings, const double* x, const double* v, JnSim** sim);

/// Advance by one accepted step. JN_RUN_FAILED, after a message, when no admissible step works: the state is then still
/// that of the last accepted step.
JnStatus jn_sim_step(JnSim* sim);

/// Has the whole duration been simulated?
bool jn_sim_is_done(const JnSim* sim);

/// Let no step go beyond time t [s], from now on; INFINITY: only the duration ends steps. The controller goes on afterwards
/// with the size that it wanted.
void jn_sim_stop_at(JnSim* sim, double t);

JnModel* jn_sim_model(JnSim* sim); ///< NULL for a built-in system, and for one of the user's own

/// Energies and momenta of the present state, and the mass [kg], of a model or a built-in system.
JnEnergies jn_sim_energies(JnSim* sim);
double jn_sim_mass(const JnSim* sim);

JnSystem* jn_sim_system(JnSim* sim); ///< what is stepped
const JnState* jn_sim_state(const JnSim* sim);

/// Fill `out`, of the system's space, with the state at a time t within the last accepted step: positions on the cubic between
/// its ends (error of fourth order in the step), velocities by its derivative (third order); straight lines where contact has
/// edited the end. Held nodes are where they should be. At the end of the step, and later, it is a copy of jn_sim_state.
void jn_sim_state_at(const JnSim* sim, double t, JnState* out);

long jn_sim_steps(const JnSim* sim);                  ///< accepted so far
double jn_sim_last_dt(const JnSim* sim);              ///< size of the last accepted step [s]; 0 before the first
double jn_sim_next_dt(const JnSim* sim);              ///< size of the next attempt, if nothing ends it earlier [s]
const JnReport* jn_sim_last_report(const JnSim* sim); ///< cost of the last step, its rejected attempts included
int jn_sim_threads(const JnSim* sim);

/// The passes that run, in order; *count of them.
JnPass* const* jn_sim_passes(const JnSim* sim, int* count);

#ifdef __cplusplus
}
#endif
#endif
