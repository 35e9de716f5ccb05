/// @file simulation.h
/// A simulation in the flesh, shared by create.c (which builds it) and sim.c (which steps it).
#ifndef JN_SIM_SIMULATION_H
#define JN_SIM_SIMULATION_H

#include "base/arena.h"
#include "control/controller.h"
#include "integrate/integrator.h"
#include "jounce/sim.h"
#include "pass/pass.h"
#include "sim/watch.h"

struct JnSim {
	const JnSimDef* def;
	JnArena arena; // of settings given as text
	JnSimDef settings;
	int threads;
	JnModel* model;     // NULL when the system is built in, or the user's
	JnSystem* built_in; // NULL: none
	JnVec work[2];      // of a built-in system; of a model with inputs: the first, for forces
	JnSystem* sys;
	JnIntegrator* integrator;
	JnController* controller;
	JnPasses passes;
	JnState start; // the present state: the end of the last accepted step
	JnState end;   // of the attempt; between steps, the state before the present one
	double next_dt, last_dt;
	double longest_dt; // of the accepted steps
	JnEnergyWatch watch;
	bool was_edited; // by a pass: the end of the last accepted step
	double stop;     // no step goes beyond this time [s]
	long steps;
	JnReport report;
};

/// Build everything but the model anew, as if nothing had been computed with it. The state is then undefined.
JnStatus jn_sim_renew(JnSim* sim);

#endif
