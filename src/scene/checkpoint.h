/// @file checkpoint.h
/// The checkpoints of a run. Bits of a simulation change when it is saved (sim/archive.c), so that it is saved after steps that
/// the scene alone decides, never the clock: runs of a scene are the same, resumed or not. The clock only decides which of
/// the states are worth a file; the last one is kept in memory, for when the run is stopped.
#ifndef JN_SCENE_CHECKPOINT_H
#define JN_SCENE_CHECKPOINT_H

#include "scene/run.h"

/// Plan when to save, and remember where the run begins; checkpoints of an earlier run in its folder are removed.
JnStatus jn_run_checkpoints_begin(JnRun* run);

/// The same for a run that has just been restored.
void jn_run_checkpoints_go_on(JnRun* run);

/// After an accepted step that was recorded: save, if it is time.
JnStatus jn_run_save_if_due(JnRun* run);

/// A run that ends early, whole or in trouble, leaves its last saved state and the present one.
JnStatus jn_run_save_at_end(JnRun* run);

/// What a checkpoint begins with: the scene of the run.
typedef struct JnRunOrigin {
	const char *path, *text; ///< of the scene file
	int set_count;
	const char** sets; ///< overrides; JnRunOrigin's own, each points into the archive
} JnRunOrigin;

/// Read it. Free with jn_run_origin_free.
JnStatus jn_run_origin_read(JnArchive* archive, JnRunOrigin* origin);
void jn_run_origin_free(JnRunOrigin* origin);

/// Read the rest: numbers of the run, where its files go on, the state.
JnStatus jn_run_restore(JnRun* run, JnArchive* archive);

#endif
