/// @file export.h
/// A model of ours as text, for programs that make their own.
#ifndef JN_BENCHMARK_PEERS_EXPORT_H
#define JN_BENCHMARK_PEERS_EXPORT_H

#include "peer.h"

/// Write the model of a scene with one body, in lines of a word and its numbers:
///
///   gravity gx gy gz                             [m/s^2]
///   material density young poisson               [kg/m^3] [Pa]; laws of solids
///   thread stiffness density radius              [Pa] [kg/m^3] [m]; a thread of constraints
///   plane px py pz nx ny nz                      one an obstacle
///   node x y z vx vy vz mass                     in order, at rest; start velocity; row sum of the mass matrix [kg]
///   held entry                                   3 * node + axis
///   tet4 a b c d  |  hex8 a b c d e f g h        numbers of nodes from 0, in VTK's order
///   probe name node
JnStatus peer_export(Peer* peer, const char* path);

#endif
