/// @file blocks.h
/// The matrix of a model in 3x3 blocks, for solvers that want its numbers and not only its product.
#ifndef JN_BENCHMARK_PEERS_BLOCKS_H
#define JN_BENCHMARK_PEERS_BLOCKS_H

#include "peer.h"

/// Rows of blocks, columns ascending: all of them, or the upper triangle from the diagonal on. The numbers of a block stand
/// by columns, as PETSc has them.
typedef struct PeerBlocks {
	bool is_full;
	int nodes;
	const int *row_start, *column; ///< nodes + 1; row_start[nodes]
} PeerBlocks;

/// The places of the blocks; JN_BAD_INPUT after a message for models whose matrix is never assembled, or that have damping.
JnStatus peer_blocks(const Peer* peer, bool is_full, PeerBlocks* out);

/// numbers[9 * row_start[nodes]] = mass M + stiffness K of the last peer_linearize. Held rows and columns are 0 but for
/// `mass` times the node's on the diagonal.
void peer_fill_blocks(const Peer* peer, const PeerBlocks* blocks, double mass, double stiffness, double* numbers);

#endif
