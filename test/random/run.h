/// @file run.h
/// Random scenes, run one by one in processes of their own with bounds on what they take.
#ifndef JN_TEST_RANDOM_RUN_H
#define JN_TEST_RANDOM_RUN_H

#include <stdint.h>

typedef struct RunOptions {
	long seed, first, count; ///< scenes
	long steps;              ///< of each
	long attempts;           ///< draws of a scene, while they are refused
	long cpu;    ///< processor time after which no step begins [s]; after twenty times as much the scene is ended
	long memory; ///< address space [MiB]; 0: no limit
	long files;  ///< largest file [MiB]
	const char* folder; ///< each draw gets a folder in it, with scene.yaml, stderr and out/
} RunOptions;

/// Run them, and print a line for each draw when it has ended: its folder's name, index, attempt, exit status (below 0: the
/// signal), processor time [s] and memory [MiB]. Returns 0, or 1 when a folder or a process cannot be made.
int random_scenes_run(const RunOptions* options);

#endif
