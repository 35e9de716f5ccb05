/// @file moved_mesh.h
/// Meshes with their cells and nodes in another order.
#ifndef JN_TEST_SUPPORT_MOVED_MESH_H
#define JN_TEST_SUPPORT_MOVED_MESH_H

#include <stdint.h>

#include "mesh/mesh.h"

/// Exchange nodes of each cell, so that the cells of a mirrored body face outward again.
void mirror_cells(const JnMesh* mesh);

/// Begin each cell at another of its nodes; what is inside stays inside.
void turn_cells(const JnMesh* mesh);

/// Put nodes and cells into a random order: node i becomes node order[i]. Seed 0: leave them, order[i] = i.
void shuffle_mesh(const JnMesh* mesh, uint64_t seed, int* order);

#endif
