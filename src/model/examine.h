/// @file examine.h
/// Places in a model, for messages about what went wrong: where it is most deformed, and what a place is called.
#ifndef JN_MODEL_EXAMINE_H
#define JN_MODEL_EXAMINE_H

#include "model/model.h"

/// A node or a cell of a body.
typedef struct JnSpot {
	int body;     ///< -1: nowhere
	int node;     ///< number in the model; of a cell: its first
	int cell;     ///< of the body's mesh, as recordings number them; -1: only the node is meant
	double value; ///< of the quantity asked for
} JnSpot;

/// The solid cell whose volume ratio det dx/dX is smallest at x, which is below 0 where it is inside out. body -1: there are
/// no solids, or x is not finite.
JnSpot jn_model_most_squeezed(const JnModel* model, const double* x);

/// A node.
JnSpot jn_model_node(const JnModel* model, int node);

/// The shortest edge at rest of the elements that have a node [m]; INFINITY: none has.
double jn_model_edge_at(const JnModel* model, int node);

/// Kinetic and elastic energy of a body [J], its mass taken as lumped.
double jn_model_body_energy(const JnModel* model, int body, const JnState* state);

/// Write what the place is called and where it is at x, such as "cell 7 of 'beam' at (0.1, 0.2, 1) m". At most `size` bytes.
void jn_spot_name(const JnModel* model, const JnSpot* spot, const double* x, size_t size, char* text);

#endif
