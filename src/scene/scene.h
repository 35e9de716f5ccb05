/// @file scene.h
/// A loaded scene: the document and the definitions that it filled.
#ifndef JN_SCENE_SCENE_H
#define JN_SCENE_SCENE_H

#include "base/document.h"
#include "jounce/scene.h"

struct JnScene {
	JnArena arena;
	JnDocument document;
	int set_count;
	const char** sets; ///< overrides that were applied
	JnSceneDef def;
};

#endif
