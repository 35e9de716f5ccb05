/// @file view_elastic.h
/// Strain energy and stress of recorded frames, from the model that the recorded scene gives once more.
#ifndef JN_APP_VIEW_ELASTIC_H
#define JN_APP_VIEW_ELASTIC_H

#include "base/arena.h"
#include "jounce/scene.h"

#define VIEW_ABSENT (-1e30) ///< the value of a node that has none

typedef struct ViewElastic {
	JnArena arena;
	JnScene* scene;
	JnSim* sim;
	const JnModel* model;
	double* sums;    ///< one a node
	double* weights; ///< one a node
	double* buffer;  ///< what a kernel gives for some batches
} ViewElastic;

/// Build the model of a recorded scene; `rest[3 * node_count]` are the recorded rest positions. JN_BAD_INPUT after a message
/// when it cannot be built, or is another one by now. To be closed in any case.
JnStatus view_elastic_open(ViewElastic* elastic, const char* path, const char* text, int node_count,
						   const double* rest);
void view_elastic_close(ViewElastic* elastic);

/// values[node_count]: energy of the elements about each node over their volume at rest [J/m^3], of surfaces over their area
/// [J/m^2] when all bodies are surfaces. VIEW_ABSENT for nodes of other surfaces and of bodies that break: which bonds are
/// whole is not recorded.
void view_elastic_energy(ViewElastic* elastic, const double* x, double* values);

/// values[node_count]: von Mises stress [Pa] of the mean Cauchy stress of each solid element, averaged by volume over the
/// elements about a node. VIEW_ABSENT for nodes without solid elements.
void view_elastic_stress(ViewElastic* elastic, const double* x, double* values);

#endif
