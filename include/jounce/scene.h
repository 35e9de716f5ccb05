/// @file scene.h
/// Scenes: a YAML file read into definitions, and run with recorders.
#ifndef JOUNCE_SCENE_H
#define JOUNCE_SCENE_H

#include "jounce/sim.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A point whose motion goes into the series: the node nearest to it at rest, or the mean position of chosen nodes.
/// Exactly one of `at` and `where` is given.
typedef struct JnProbeDef {
	const char* name;
	double at[3];       ///< rest position [m]; NAN when not given
	JnSelectDef* where; ///< nodes of a body; NULL when not given
	const char* body;   ///< name of the body whose nodes are meant; NULL: all for `at`, the only one for `where`
} JnProbeDef;

typedef struct JnRecordDef {
	double interval;  ///< simulated time between frames [s]; 0: every step
	bool exact_times; ///< steps end on frames; else frames are interpolated between steps
	bool plots;       ///< draw plots/ at the end
} JnRecordDef;

/// When a run saves its state, to be resumed from (docs/checkpoints.md).
typedef struct JnCheckpointDef {
	double
		every; ///< simulated time between saved states [s]; 0: after a number of steps that the size of the model decides
	int keep; ///< files that stay
} JnCheckpointDef;

/// All that a scene file says.
typedef struct JnSceneDef {
	const char* name;
	const char* description;
	JnSimDef sim;
	JnItems probes; ///< JnProbeDef
	JnRecordDef record;
	JnCheckpointDef checkpoint;
} JnSceneDef;

extern const JnKey jn_scene_keys[]; ///< the keys at the root of a scene file, of JnSceneDef

typedef struct JnScene JnScene;

/// Read a scene file and apply `sets` ("step.dt=33ms"), in order. On failure *scene is NULL and a message says where
/// and why: JN_IO_FAILED when the file cannot be read, JN_BAD_INPUT for everything else.
JnStatus jn_scene_load(const char* path, int set_count, const char* const sets[], JnScene** scene);
void jn_scene_destroy(JnScene* scene);
const JnSceneDef* jn_scene_def(const JnScene* scene);
const char* jn_scene_path(const JnScene* scene); ///< as given to jn_scene_load

/// Build the simulation of a scene, which must outlive it: jn_sim_create on its definitions, with messages that name the
/// place in the file.
JnStatus jn_scene_build(const JnScene* scene, int threads, JnSim** sim);

/// How far a run is; given after every accepted step.
typedef struct JnProgress {
	long steps;
	double t, t_end, dt;   ///< [s]
	double wall_seconds;   ///< since stepping began
	int newton;            ///< iterations of the last step
	double specific_error; ///< |e_tot(t) - e_tot(0)| [J/kg]
} JnProgress;

enum { JN_PACE_SHARES = 4 };

/// How a run kept up with the clock. Percentiles: 50, 95, 99 and 99.9 % of the steps are not above, to a hundredth of the
/// value. The clock stands still while results are measured and written; steps and lateness are without that.
typedef struct JnPaceReport {
	double speed;                    ///< simulated seconds a wall second, as asked for
	long steps, missed;              ///< missed: done after the time at which their end was due
	double step[JN_PACE_SHARES];     ///< what a step took [s]
	double lateness[JN_PACE_SHARES]; ///< how late it was done; 0 when in time [s]
	double waking[JN_PACE_SHARES];   ///< how late the system woke it from waiting, of the times that it waited [s]
	double step_worst, lateness_worst, waking_worst; ///< [s]
	double reached;                                  ///< simulated seconds a wall second, without recording
	double possible;                                 ///< the same without waiting: how much faster it could go
	double stepping_seconds, waiting_seconds, recording_seconds; ///< parts of the wall time [s]
} JnPaceReport;

typedef struct JnRunOptions {
	const char* directory;                           ///< where results go; made if missing
	int threads;                                     ///< 0: as many as there are
	bool (*progress)(void* user, const JnProgress*); ///< return false to stop after this step; NULL: run to the end
	void* user;
	double speed; ///< simulated seconds a wall second, for runs that wait for the clock; 0: as fast as it goes
} JnRunOptions;

/// What a run came to.
typedef struct JnRunResult {
	bool was_stopped;
	long resumed_at; ///< steps that an earlier run had done
	long steps, frames, rejected, newton, factorizations, solves, iterations;
	long served[JN_WAY_COUNT];     ///< solves by their way
	long changes;                  ///< from one way to another
	double t, t_end, wall_seconds; ///< reached and wanted; spent
	bool has_plots;                ///< they were asked for
	double specific_error;         ///< at the end [J/kg]
	int nodes, elements;
	JnPaceReport pace; ///< of runs that wait for the clock; speed 0: this one did not
} JnRunResult;

/// Simulate a scene and record it. JN_RUN_FAILED: the last good state is on disk. `result` is filled as far as the run
/// came, also on failure.
JnStatus jn_scene_run(const JnScene* scene, const JnRunOptions* options, JnRunResult* result);

/// How to resume.
typedef struct JnResumeOptions {
	JnRunOptions run;  ///< directory: of the run
	const char* from;  ///< the checkpoint file; NULL: the newest from which the bits are those of a run without a break
	bool takes_latest; ///< without `from`: the newest of all; motion agrees to the accuracy of solvers
	int set_count;
	const char* const* sets; ///< further overrides, such as a smaller step; the nodes, method and controller must stay
} JnResumeOptions;

/// Go on with a run that was interrupted, killed, or has failed, in its folder. JN_BAD_INPUT after a message when there is
/// nothing to go on from, or when that is damaged; nothing is changed then.
JnStatus jn_scene_resume(const JnResumeOptions* options, JnRunResult* result);

#ifdef __cplusplus
}
#endif
#endif
