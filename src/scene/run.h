/// @file run.h
/// A run in progress, shared by run.c (the loop) and run_info.c (what is recorded about it).
#ifndef JN_SCENE_RUN_H
#define JN_SCENE_RUN_H

#include "base/log.h"
#include "record/recorder.h"
#include "scene/pace.h"
#include "scene/probe.h"
#include "scene/scene.h"

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
	JnLog outer;        ///< where messages go on to
	char message[1024]; ///< the last error
} JnRun;

/// Fill run->info: all that stays constant over a run.
JnStatus jn_run_describe(JnRun* run);

/// Fill run->fields: where the numbers of each field are at present.
void jn_run_find_fields(JnRun* run);

/// Fill run->values with the row of the present state, and the energy errors of run->end.
void jn_run_measure(JnRun* run);

#endif
