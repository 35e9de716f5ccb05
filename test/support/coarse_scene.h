/// @file coarse_scene.h
/// The scenes of scenes/ for tests of many steps: shapes are meshed coarsely, of many bodies a few are kept.
#ifndef JN_TEST_SUPPORT_COARSE_SCENE_H
#define JN_TEST_SUPPORT_COARSE_SCENE_H

#include "jounce/scene.h"

enum { MOST_SETS = 48, SET_LENGTH = 160 };

/// The `--set` entries of a run. Must stay where it is: `list` points into it.
typedef struct Sets {
	char text[MOST_SETS][SET_LENGTH];
	const char* list[MOST_SETS];
	int count;
} Sets;

__attribute__((format(printf, 2, 3))) void add_set(Sets* sets, const char* format, ...);
/// A copy that may be added to.
void copy_sets(const Sets* from, Sets* to);

/// What a scene says before anything is set.
typedef struct Plan {
	int bodies;
	double dt;   ///< first step of its controller [s]; NAN where that has none
	Sets coarse; ///< meshes of few cells
} Plan;

/// The test fails when the file cannot be read.
void make_plan(const char* path, Plan* plan);
/// Whether a body stays: of many, some of the first and of the last, which are often of two kinds.
bool is_kept(int body, int bodies);
/// Forget the other bodies. The scene is the test's own, so that its definitions may be changed.
void drop_bodies(const JnScene* scene);
/// Call `visit` with the path of every scene of scenes/, but for those that are others with more points.
void visit_scenes(void (*visit)(const char* path));

#endif
