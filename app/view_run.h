/// @file view_run.h
/// A recording as a viewer wants it: surfaces, threads and points of its bodies, and frames one by one. The layout of run.h5
/// is told in src/record/hdf5.c. Recordings that are still being written are opened anew for each look.
#ifndef JN_APP_VIEW_RUN_H
#define JN_APP_VIEW_RUN_H

#include <stdbool.h>

#include "base/log.h"
#include "record/text_file.h"
#include "recording.h"
#include "view_elastic.h"
#include "view_map.h"

typedef enum ViewKind {
	VIEW_SURFACE, ///< triangles
	VIEW_THREAD,  ///< a round tube about a line of points
	VIEW_POINTS,  ///< a ball for each point
} ViewKind;

typedef struct ViewBody {
	const char *name, *shape;
	ViewKind kind;
	int first_node, node_count, cell_count;
	int first_point, point_count;       ///< of the drawn points
	int first_triangle, triangle_count; ///< of the drawn triangles
	double radius;                      ///< of a thread [m]; of points: of a ball of their mean volume
	bool is_closed;                     ///< a thread whose last point is joined to its first
} ViewBody;

typedef struct ViewObstacle {
	const char* name;
	int first_point, point_count, first_triangle, triangle_count;
} ViewObstacle;

/// Numbers at nodes.
typedef struct ViewField {
	char name[80], unit[32];
	int components;   ///< in the recording, 1 or 3; 0: computed from the model
	char absent[256]; ///< why there are none; "": there are
} ViewField;

typedef struct ViewRun {
	char folder[JN_PATH_SIZE], path[JN_PATH_SIZE];
	JnArena arena;
	Recording recording; ///< facts, bodies, obstacles; its file is NULL while closed
	char* summary;       ///< text of summary.json; NULL: there is none yet
	int body_count, obstacle_count, field_count;
	ViewBody* bodies; ///< in the order of their nodes
	ViewObstacle* obstacles;
	ViewField* fields; ///< beside displacements, which the page knows
	int triangle_count, obstacle_triangle_count, obstacle_point_count;
	int* triangles;          ///< 3 * triangle_count numbers of drawn points
	int* obstacle_triangles; ///< numbers of obstacle_points
	float* obstacle_points;  ///< 3 * obstacle_point_count [m]
	ViewMap points;          ///< drawn points from the points of the recording
	ViewMap nodes;           ///< drawn points from nodes, for fields
	float* rest;             ///< of the drawn points, 3 * points.count [m]
	double* scratch;         ///< three for each node, or point of the recording
	double* values;          ///< one a node
	long frame_count;
	double* times; ///< of the frames [s]
	size_t time_room;
	bool is_quiet; ///< while a run in progress is looked at; `log` is where messages went before
	JnLog log;
	ViewElastic elastic; ///< built when strain energy or stress is first asked for
	bool has_tried_elastic;
	char elastic_reason[256]; ///< why there is none; "" when there is
} ViewRun;

/// Open run.h5 in `folder`. JN_IO_FAILED or JN_BAD_INPUT after a message when it is not there, is no recording or is cut off. To be closed
/// in any case.
JnStatus view_run_open(ViewRun* run, const char* folder);
void view_run_close(ViewRun* run);

/// Is it still being written, as far as one can tell?
bool view_run_is_running(const ViewRun* run);

/// Look for new frames and the outcome of a run in progress. JN_IO_FAILED, without a message: it is being written at this
/// moment, so that it cannot be read; what was known stays. Ask again.
JnStatus view_run_refresh(ViewRun* run);

/// out[3 * run->points.count]: where the drawn points are in a frame [m]. JN_IO_FAILED, without a message; here and below
/// JN_BAD_INPUT when HDF5 crashes on what is not being written, which has been said.
JnStatus view_run_positions(ViewRun* run, long frame, float* out);

/// out[rows * components]: a dataset of a frame. JN_IO_FAILED, without a message.
JnStatus view_run_read(ViewRun* run, long frame, const char* name, int rows, int components, double* out);

typedef struct ViewColumn {
	char name[96], unit[32];
	double* values; ///< one an accepted step
} ViewColumn;

typedef struct ViewSeries {
	JnArena arena;
	int count;
	long rows;
	ViewColumn* columns;
} ViewSeries;

/// Read the columns of the series; free series->arena in any case. JN_IO_FAILED without a message.
JnStatus view_run_series(ViewRun* run, ViewSeries* series);

#endif
