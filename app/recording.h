/// @file recording.h
/// A recording for those who look at it: run.h5, whose layout src/record/hdf5.c and its neighbours tell, checked so
/// that every number of a node, point or frame in here is one. Arrays live as long as the recording.
#ifndef JN_APP_RECORDING_H
#define JN_APP_RECORDING_H

#include "base/arena.h"
#include "mesh/mesh.h"
#include "mesh/surface.h"
#include "mesh/thread.h"
#include "recording_file.h"

typedef struct RecordingBody {
	const char* name;
	JnShape shape;
	int first_node, node_count;
	int cell_count;
	const int* cells; ///< cell_count * jn_shape_info[shape].nodes numbers of nodes of the recording, in VTK's order
	bool is_embedded; ///< its surface is finer than its cells and is carried along by them
	int first_point, point_count; ///< which points of the recording may be its surface's
	int carrier_count;            ///< of an embedded surface: nodes that carry a point
	const int* carriers;          ///< carrier_count * point_count numbers of nodes of the recording; NULL: not embedded
	const double* weights;        ///< their shares; a field at a point is the sum of weight * value
	const double* point_rest;     ///< of an embedded surface: 3 * point_count [m]
	int triangle_count;
	const int* triangles;   ///< 3 * triangle_count numbers of points of the recording, outward; none of points
	const double* volumes;  ///< of points: node_count [m^3]; NULL: unknown, or not points
	const JnThread* thread; ///< frames, radius, axis (link_length is 0); NULL: not a thread
} RecordingBody;

/// A thing that never moves. Its triangles have the numbers of its own points.
typedef struct RecordingObstacle {
	const char* name;
	JnSurface surface;
} RecordingObstacle;

/// Numbers of every node in every frame, beside position and velocity.
typedef struct RecordingField {
	const char *name, *unit;
	int components; ///< 1 or 3
} RecordingField;

/// A column of the series, one value for each accepted step.
typedef struct RecordingColumn {
	const char *name, *unit;
} RecordingColumn;

typedef struct Recording {
	JnArena arena;
	RecordingFile* file; ///< NULL: closed
	const char* path;    ///< of run.h5
	const char *scene_name, *scene_path, *scene_text, *method, *host, *created, *version;
	const char *outcome, *message; ///< "running", "done", "failed", "interrupted"; one line, or ""
	double total_mass;             ///< [kg]
	double gravity[3];             ///< [m/s^2]; 0: none, or not recorded
	int node_count;
	const double* rest; ///< 3 * node_count [m]
	int point_count;    ///< points of the surfaces: the nodes, unless a body is embedded
	bool has_embedding;
	int body_count; ///< in the order of the scene
	const RecordingBody* bodies;
	int obstacle_count;
	const RecordingObstacle* obstacles;
	int field_count;
	const RecordingField* fields;
	int column_count;
	const RecordingColumn* columns;
	int step_count; ///< values of each column
	int frame_count;
	const double* times; ///< of the frames [s]
} Recording;

/// Open the recording in a folder, or the file run.h5 itself; also of a run that goes on, as far as it is written.
/// JN_BAD_INPUT, after a message that says what to do, when it is missing, foreign, cut short or damaged. Whatever
/// comes back, recording_close is due.
JnStatus recording_open(const char* folder, Recording* recording);
void recording_close(Recording* recording);

/// The axis against which gravity points, 0, 1 or 2, and whether up is along it or `*is_down`, against it; y without
/// gravity.
int recording_up(const Recording* recording, bool* is_down);

/// Positions and velocities of the nodes in a frame, 3 * node_count [m], [m/s]. JN_BAD_INPUT after a message, also when
/// one is not finite.
JnStatus recording_positions(const Recording* recording, int frame, double* x);
JnStatus recording_velocities(const Recording* recording, int frame, double* v);

/// Positions of the points of the surfaces, 3 * point_count [m].
JnStatus recording_points(const Recording* recording, int frame, double* points);

/// Values of the points of the surfaces, components * point_count, from those of the nodes, components * node_count.
void recording_at_points(const Recording* recording, int components, const double* nodes, double* points);

/// A field of the nodes, components * node_count numbers.
JnStatus recording_field(const Recording* recording, int frame, int field, double* values);

/// A column of the series, step_count numbers.
JnStatus recording_series(const Recording* recording, int column, double* values);

#endif
