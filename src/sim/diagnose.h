/// @file diagnose.h
/// Why a step cannot be taken: what fails, where, which limit is passed, and what to do about it. Nothing here costs anything
/// before something has failed.
#ifndef JN_SIM_DIAGNOSE_H
#define JN_SIM_DIAGNOSE_H

#include "control/controller.h"
#include "jounce/sim.h"

enum { JN_CAUSE_SIZE = 480, JN_PLACE_SIZE = 200, JN_REMEDY_SIZE = 360 };

/// A failed attempt, and what is found out about it.
typedef struct JnFailure {
	JnSim* sim;
	const JnStep* step;    ///< the attempt; NULL: the step was accepted, and the present state is its end
	JnStatus outcome;      ///< of the attempt; JN_OK: the controller has refused it
	JnComplaint complaint; ///< of the controller
	char cause[JN_CAUSE_SIZE], place[JN_PLACE_SIZE], remedy[JN_REMEDY_SIZE];
} JnFailure;

/// Find out why `failure` came about, from its first three fields: fill in the others.
void jn_sim_explain(JnFailure* failure);

/// Write the message of an attempt that ends the run; is_smallest: no smaller step is allowed. Returns JN_RUN_FAILED.
JnStatus jn_sim_fail(JnSim* sim, const JnStep* step, JnStatus outcome, bool is_smallest);

/// The same for a step that was accepted, and whose end turns out to be of no use, as `what` says.
JnStatus jn_sim_fail_at_end(JnSim* sim, const char* what, JnStatus outcome);

/// Is the present state beyond all bounds, so that no smaller step can mend it?
bool jn_sim_is_lost(const JnSim* sim);

/// Does the longest step so far, or `dt` if there was none, exceed the limit of stability? Then cause, place and remedy say so.
bool jn_sim_find_instability(JnSim* sim, double dt, JnFailure* out);

#endif
