/// @file peer.h
/// What the drivers of other programs share: a scene of ours as a system of equations, the clock, and a file of states.
///
///   driver --scene FILE [--set KEY=VALUE ...] --span T --samples N [--frames FILE] [NAME=VALUE ...]
///
/// A state is written N times, at equal intervals up to T: time, positions and velocities of all nodes, 1 + 2 n doubles. What
/// the run took is printed as lines of a name and a number.
#ifndef JN_BENCHMARK_PEERS_PEER_H
#define JN_BENCHMARK_PEERS_PEER_H

#include <stdio.h>

#include "jounce/extend.h"
#include "jounce/jounce.h"

typedef struct Peer {
	JnScene* scene;
	JnSim* sim;
	JnSystem* sys;
	size_t n;              ///< entries of positions: 3 a node
	JnState state;         ///< of the system's space; in the beginning the start of the scene
	JnReport report;       ///< what the system has counted for a foreign integrator
	double span, interval; ///< simulated time, and that between states [s]
	int samples;
	FILE* frames;   ///< NULL: not asked for
	double seconds; ///< processor time between peer_resume and peer_pause
	double resumed;
	int word_count;
	char** words; ///< the arguments NAME=VALUE
} Peer;

/// Read the command line, build the scene with one thread. Returns JN_BAD_INPUT after a message.
JnStatus peer_open(Peer* peer, int count, char** arguments);
void peer_close(Peer* peer);

/// The value of an argument NAME=VALUE, or else `otherwise`.
const char* peer_word(const Peer* peer, const char* name, const char* otherwise);
double peer_number(const Peer* peer, const char* name, double otherwise);

/// Seconds of processor time that this process has used.
double peer_clock(void);

/// Let the clock run, or stand while a state is written.
void peer_resume(Peer* peer);
void peer_pause(Peer* peer);

/// Write a state. Stops the clock meanwhile.
void peer_write(Peer* peer, double t, const double* x, const double* v);

/// Print a count, or the processor time at the end.
void peer_print(const char* name, double value);
void peer_finish(const Peer* peer);

/// out = M^-1 f(t, x, v), with zeros at held nodes.
JnStatus peer_acceleration(Peer* peer, double t, const double* x, const double* v, double* out);

/// K and D at a state are what matrices are made of from now on.
JnStatus peer_linearize(Peer* peer, double t, const double* x, const double* v);

/// What a model freezes over a step, such as its damping, is frozen at this state.
JnStatus peer_begin(Peer* peer, double t, const double* x, const double* v);

/// The matrix mass M + damping D + stiffness K of the last peer_linearize; NULL on failure.
JnMatrix* peer_matrix(Peer* peer, double mass, double damping, double stiffness);

#endif
