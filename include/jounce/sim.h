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

/// How threads meet themselves, each other, bodies and obstacles: capsules and impulses (docs/collision.md).
typedef struct JnCollisionDef {
	double friction;    ///< mu of pairs that `pairs` does not name
	JnItems pairs;      ///< JnContactPairDef
	double restitution; ///< share of the approach velocity with which what meets parts again
	double residue;     ///< share of the response forces that acts on as a force during the next step
	double push_out;    ///< fastest separation of what overlaps at the start of a step [m/s]
	double neighbors;   ///< links of one thread nearer than this along it do not collide [m]; NAN: pi radii
	int iterations;     ///< sweeps of a step at most, at the level of positions and at that of velocities
	double tolerance;   ///< motion of a contact in a sweep, relative to that of all, at which they end
} JnCollisionDef;

/// Where a thread may go through the surface of a body (docs/collision.md).
typedef struct JnSutureDef {
	const char *thread, *body; ///< names of bodies
	int tip;                   ///< the end that pierces: 0 first, 1 last
	int needle;                ///< links from the tip on that pass through the surface
	double friction;           ///< mu along the thread, of the force across it
	double hold;               ///< friction without that [N]
	double clear;              ///< links nearer to a site along the thread do not collide [m]; NAN: two links
} JnSutureDef;

/// Positions moved onto the lengths at rest after every step, sweep by sweep (docs/relax.md).
typedef struct JnRelaxDef {
	int sweeps;        ///< through all elements, a step
	bool axis;         ///< of threads: lengths of links along the axis
	bool springs;      ///< lengths of all springs
	bool volumes;      ///< of the tetrahedra
	double compliance; ///< alpha of lengths [m/N]; 0: rigid
	double factor;     ///< over-relaxation, in (0, 2)
	int velocity;      ///< 0 follow: v += dx/dt; 1 keep
	int order;         ///< 0 before contact; 1 after it
} JnRelaxDef;

/// When the energy of a run is suspect (docs/failures.md).
typedef struct JnWatchDef {
	double energy; ///< share of the largest kinetic and elastic energy; a larger gain from nowhere warns; 0: no watch
	double stop;   ///< multiple of it at which the run ends
} JnWatchDef;

typedef struct JnSimDef {
	JnModelDef model;
	JnVariant system;          ///< row of jn_system_list, simulated in place of a model; row NULL: none
	JnContactDef* contact;     ///< NULL: bodies pass through each other
	JnRelaxDef* relax;         ///< NULL: no relaxation
	JnCollisionDef* collision; ///< NULL: threads pass through everything
	JnSutureDef* suture;       ///< NULL: no thread pierces a body
	JnFractureDef fracture;
	JnVariant integrator; ///< row of the integrator list
	JnNewtonDef newton;
	JnVariant step;  ///< row of the controller list
	double duration; ///< simulated time [s]
	JnWatchDef watch;
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

/// Compare the energies of the present state with what the run should have: call it after every step, and once before the
/// first. Warns once of energy that comes from nowhere; JN_RUN_FAILED after a message when it is out of all proportion
/// (`watch` in a scene). Driven nodes and wind cost the forces of the state; all else is free.
JnStatus jn_sim_watch(JnSim* sim, const JnEnergies* energies);

JnSystem* jn_sim_system(JnSim* sim); ///< what is stepped
const JnState* jn_sim_state(const JnSim* sim);

/// Fill `out`, of the system's space, with the state at a time t within the last accepted step: positions on the cubic between
/// its ends (error of fourth order in the step), velocities by its derivative (third order); straight lines where contact has
/// edited the end. Held nodes are where they should be. At the end of the step, and later, it is a copy of jn_sim_state.
void jn_sim_state_at(const JnSim* sim, double t, JnState* out);

/// Nodes that a program moves from step to step: those of `drive: [{where: ..., input: NAME}]` in a scene.
typedef struct JnInput JnInput;

/// The input of a name; NULL when no node of the model has it. Owned by the simulation.
JnInput* jn_sim_input(JnSim* sim, const char* name);

/// Where its nodes shall be at the end of the next step: a displacement from rest [m], the same for all of them, and its
/// velocity there [m/s]; NULL: the mean velocity of the step. In between they move on the cubic that has position and
/// velocity of both ends, at every stage of every method. A step that is cut short goes on along it; after its end they stand
/// still until the input is set again. Allocates nothing.
void jn_input_set(JnInput* input, const double displacement[3], const double velocity[3]);

/// The force with which the rest of the model, its weight and damping included, acts on the nodes of an input in the present
/// state [N], without their inertia: what a hand feels that holds them. Allocates nothing.
JnStatus jn_sim_input_force(JnSim* sim, const JnInput* input, double force[3]);

long jn_sim_steps(const JnSim* sim);                  ///< accepted so far
double jn_sim_last_dt(const JnSim* sim);              ///< size of the last accepted step [s]; 0 before the first
double jn_sim_next_dt(const JnSim* sim);              ///< size of the next attempt, if nothing ends it earlier [s]
const JnReport* jn_sim_last_report(const JnSim* sim); ///< cost of the last step, its rejected attempts included
int jn_sim_threads(const JnSim* sim);

/// Save the state, and all that the following steps depend on: history of the method and of the controller, impulses of
/// contacts, broken bonds. Then the simulation goes on exactly as one that is restored from what was saved, bit by bit: it
/// forgets factors and other things that only save time (jn_sim_restore). `archive` is empty, or holds pieces of the caller's
/// own. What jn_sim_system and jn_sim_passes gave before is invalid afterwards, as are vectors of the system's space.
JnStatus jn_sim_save(JnSim* sim, JnArchive* archive);

/// The same without the second half: the simulation is not changed. One that is restored from it follows the same motion to the
/// accuracy of solvers, and bit by bit where nothing is kept from step to step.
JnStatus jn_sim_snapshot(JnSim* sim, JnArchive* archive);

/// Go on from what was saved of a simulation of the same definition. JN_BAD_INPUT, after a message, for what is of another
/// one, or damaged: the simulation can then only be destroyed. As after jn_sim_save, what others hold of its parts is invalid.
JnStatus jn_sim_restore(JnSim* sim, JnArchive* archive);

/// Let the next attempt have the controller's first size: for one that was restored with other settings of its controller.
void jn_sim_restart_step(JnSim* sim);

/// The passes that run, in order; *count of them.
JnPass* const* jn_sim_passes(const JnSim* sim, int* count);

#ifdef __cplusplus
}
#endif
#endif
