/// @file frames.h
/// The frames of a recording: where the points of all surfaces are, over time.
///
/// Points are those of the surfaces: the nodes of the mesh, or vertices of surfaces where bodies carry some along.
#ifndef JN_APP_REPRODUCE_FRAMES_H
#define JN_APP_REPRODUCE_FRAMES_H

#include "base/arena.h"
#include "mesh/surface.h"
#include "recording_file.h"

typedef struct Frames {
	JnArena arena;
	RecordingFile* file;
	int count;
	double* times; ///< count [s]
	int node_count;
	double* rest; ///< of the nodes, 3 * node_count [m]
	int point_count;
	bool are_nodes; ///< the points are the nodes
	int triangle_count;
	int* triangles;      ///< 3 * triangle_count points, outward
	int* bodies;         ///< triangle_count: which body, from 0
	JnSurface obstacles; ///< all of them, facing out of what is solid; empty when there are none
} Frames;

/// Open run.h5 in `folder`. JN_IO_FAILED after a message. Close with frames_close in either case.
JnStatus frames_open(const char* folder, Frames* frames);
void frames_close(Frames* frames);

/// The frame nearest to a time.
int frames_nearest(const Frames* frames, double t);

/// Positions of all points in a frame, 3 * point_count [m].
JnStatus frames_read(const Frames* frames, int frame, double* points);

/// Positions of all nodes in a frame, 3 * node_count [m], and a field with one number a node, such as "damage".
JnStatus frames_read_nodes(const Frames* frames, int frame, double* positions);
JnStatus frames_read_field(const Frames* frames, int frame, const char* field, double* values);

#endif
