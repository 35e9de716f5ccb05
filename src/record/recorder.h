/// @file recorder.h
/// What was accepted, written down: each recorder is a file and a row. Recorders see finished steps only.
#ifndef JN_RECORD_RECORDER_H
#define JN_RECORD_RECORDER_H

#include "base/arena.h"
#include "jounce/archive.h"
#include "jounce/scene.h"
#include "mesh/embed.h"
#include "mesh/mesh.h"
#include "mesh/thread.h"

/// One column of the per-step series.
typedef struct JnColumn {
	const char* name; ///< "t", "kinetic", "probe.mid.y"
	const char* unit; ///< "s", "J", "" for counts
	bool is_count;    ///< written as an integer
} JnColumn;

/// Numbers of every node in every frame, beside position and velocity.
typedef struct JnField {
	const char* name; ///< "contact_force"; the name of its dataset in a frame
	const char* unit; ///< "N"
	int components;   ///< 1 or 3
} JnField;

/// The part of the mesh that one body owns.
typedef struct JnRecordBody {
	const char* name;
	JnShape shape;
	int first_node, node_count;
	int cell_count;
	const int* cells; ///< global node numbers
	int triangle_count;
	const int* triangles; ///< the surface: with global node numbers, or those of the embedded surface's vertices
	const JnEmbedding* embedding; ///< the surface that the cells carry along; NULL: it is made of faces of cells
	const JnThread* thread;       ///< the chain of frames that its nodes are; NULL: none
	const double* volumes;        ///< of a body of points: node_count of them [m^3]; NULL: none
} JnRecordBody;

/// A rigid thing that never moves, as it looks.
typedef struct JnRecordObstacle {
	const char* name;
	JnSurface surface;
} JnRecordObstacle;

/// All that stays constant over a run.
typedef struct JnRecordInfo {
	const char* directory; ///< exists and is writable
	const char* scene_name;
	const char* scene_path;
	const char* scene_text; ///< the file, with `--set` overrides as comment lines at its end
	const char* method;     ///< integrator's name
	int node_count;
	const double* nodes; ///< rest positions, 3 * node_count [m]
	int body_count;
	const JnRecordBody* bodies;
	int obstacle_count;
	const JnRecordObstacle* obstacles; ///< NULL: none
	int column_count;
	const JnColumn* columns;
	int field_count;
	const JnField* fields; ///< NULL: none
	bool wants_plots;      ///< draw plots/ at the end
	double total_mass;     ///< [kg]
	double gravity[3];     ///< [m/s^2]; what looks at a run takes its opposite for up
	int threads, simd_width;
	const char* blas; ///< such as "OpenBLAS 0.3.21 SkylakeX"
} JnRecordInfo;

/// One accepted step (or the start, step 0).
typedef struct JnRecordStep {
	long step;
	double t;
	bool is_frame;        ///< positions and velocities are due
	const double *x, *v;  ///< 3 * node_count
	const double* values; ///< column_count numbers
	/// field_count arrays of components * node_count finite numbers, node by node; needed in frames. NULL: there are none
	const double* const* fields;
} JnRecordStep;

/// How the run ended.
typedef struct JnRecordEnd {
	const char* outcome; ///< "done", "failed", "interrupted"
	const char* message; ///< one line, or ""
	double wall_seconds; ///< time spent stepping
	double setup_seconds;
	double seconds_predict, seconds_detect, seconds_factor, seconds_qp; ///< parts of wall_seconds, as in JnReport
	double seconds_save;                                                ///< and for checkpoints
	long steps, frames, rejected, newton, factorizations, solves, iterations, forces, tangents, indefinite, minimized;
	long served[JN_WAY_COUNT], changes;        ///< solves by their way, and changes of it
	double t, t_end;                           ///< reached and wanted [s]
	double specific_error, specific_error_max; ///< |e_tot(t) - e_tot(0)|, at the end and largest [J/kg]
	const JnPaceReport* pace;                  ///< NULL: the run did not wait for the clock
} JnRecordEnd;

typedef struct JnRecorder JnRecorder;

typedef struct JnRecorderType {
	const char* name;
	const char* doc;
	size_t size; ///< bytes of the recorder's own struct, whose first member is a JnRecorder
	JnStatus (*open)(JnRecorder*, const JnRecordInfo*); ///< info outlives the recorder
	JnStatus (*write)(JnRecorder*, const JnRecordStep*);
	JnStatus (*close)(JnRecorder*, const JnRecordEnd*); ///< called once for every opened recorder, also after failure
	/// In place of open: go on with what an earlier run of the same info has left, from where `archive` noted. NULL: open.
	JnStatus (*resume)(JnRecorder*, const JnRecordInfo*, JnArchive*);
	void (*archive)(JnRecorder*, JnArchive*); ///< note how far it has come; NULL: there is nothing to note
	JnStatus (*sync)(JnRecorder*);            ///< what was written survives a loss of power; NULL: nothing to do
} JnRecorderType;

struct JnRecorder {
	const JnRecorderType* type;
	const JnRecordInfo* info;
};

extern const JnRecorderType* const jn_recorder_list[]; ///< NULL at the end, in the order in which they run

/// The recorders of a run: open all, feed all, close all.
typedef struct JnRecorders {
	int count;
	JnRecorder** list;
} JnRecorders;

/// resumed: NULL, or what jn_recorders_archive noted in the run that is to go on.
JnStatus jn_recorders_open(JnRecorders* recorders, JnArena* arena, const JnRecordInfo* info, JnArchive* resumed);
JnStatus jn_recorders_write(JnRecorders* recorders, const JnRecordStep* step);
JnStatus jn_recorders_close(JnRecorders* recorders, const JnRecordEnd* end);

/// Note how far all of them have come.
void jn_recorders_archive(JnRecorders* recorders, JnArchive* archive);

/// All that was written survives a loss of power.
JnStatus jn_recorders_sync(JnRecorders* recorders);

#endif
