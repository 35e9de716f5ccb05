/// @file examine.h
/// Places in a model, for messages about what went wrong: where it is most deformed, and what a place is called.
#ifndef JN_MODEL_EXAMINE_H
#define JN_MODEL_EXAMINE_H

#include "model/model.h"

/// A node or an element of a body.
typedef struct JnSpot {
	int body;     ///< -1: nowhere
	int node;     ///< number in the model; of an element: its first
	int element;  ///< number in the body's cells (`is_cell`) or in a group; -1: only the node is meant
	bool is_cell; ///< a cell of the mesh, as recordings number them
	int group;    ///< of the model; -1 with cells
	double value; ///< of the quantity asked for
} JnSpot;

/// The solid cell whose volume ratio det dx/dX is smallest at x, which is below 0 where it is inside out. body -1: there are
/// no solids, or x is not finite.
JnSpot jn_model_most_squeezed(const JnModel* model, const double* x);

/// The element in which a distance of two nodes has changed by the largest factor, up or down; `value` is that factor.
/// Elements that can break are not looked at.
JnSpot jn_model_most_stretched(const JnModel* model, const double* x);

/// A node.
JnSpot jn_model_node(const JnModel* model, int node);

/// The shortest edge at rest of the elements that have a node [m]; INFINITY: none has.
double jn_model_edge_at(const JnModel* model, int node);

/// Kinetic and elastic energy of a body [J], its mass taken as lumped.
double jn_model_body_energy(const JnModel* model, int body, const JnState* state);

/// Write what the place is called and where it is at x, such as "cell 7 of 'beam' at (0.1, 0.2, 1) m". At most `size` bytes.
void jn_spot_name(const JnModel* model, const JnSpot* spot, const double* x, size_t size, char* text);

#endif
