/// @file run.h
/// A run in progress, shared by run.c (the loop) and run_info.c (what is recorded about it).
#ifndef JN_SCENE_RUN_H
#define JN_SCENE_RUN_H

#include "base/log.h"
#include "record/recorder.h"
#include "scene/pace.h"
#include "scene/probe.h"
#include "scene/scene.h"

/// When a run saves its state, and what it saved last (checkpoint.h).
typedef struct JnRunSaving {
	JnArchive kept;   ///< of the step it was saved after
	long step;        ///< that step
	bool is_written;  ///< to a file
	double written;   ///< clock at the last file [s]
	double next_time; ///< with checkpoint.every: when the next is due [s]
	long due;         ///< number of that one
	long next_step;   ///< without: the step after which the next is due; 0: with
} JnRunSaving;

typedef struct JnRun {
	const JnScene* scene;
	const JnRunOptions* options;
	JnArena arena;
	JnSim* sim;
	JnRecordInfo info;
	JnRecorders recorders;
	JnRecordEnd end;
	JnPace pace; ///< speed 0: this run waits for no clock
	JnPaceReport pace_report;
	JnProbe* probes;
	double* values;        ///< one a column
	const double** fields; ///< one a field
	double total_at_start;
	double began;      ///< clock when stepping began [s]
	double next_frame; ///< time of the next frame that is due [s]
	long frames_due;   ///< number of that frame
	JnState between;   ///< a frame between steps
	bool frame_is_written, recorders_are_open;
	bool has_state; ///< the simulation has one that can be written
	JnRunSaving saving;
	long resumed_at; ///< steps that an earlier run had done
	bool
		changes_step; ///< of a run that is resumed: its settings may be others, and with them the size of its next step
	JnLog outer;      ///< where messages go on to
	char message[1024]; ///< the last error
} JnRun;

/// Fill run->info: all that stays constant over a run.
JnStatus jn_run_describe(JnRun* run);

/// Fill run->fields: where the numbers of each field are at present.
void jn_run_find_fields(JnRun* run);

/// Fill run->values with the row of the present state, and the energy errors of run->end. JN_RUN_FAILED after a message when
/// its energy is out of all proportion.
JnStatus jn_run_measure(JnRun* run);

/// Build, step, record and close. resumed: what is left of a checkpoint behind its origin, to go on from; NULL: from the start.
/// Frees all that `run` holds.
JnStatus jn_run_execute(JnRun* run, JnArchive* resumed, JnRunResult* result);

#endif
