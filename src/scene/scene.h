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

/// jn_scene_load for text that is there already, such as that of a recording; `path` names it, and is where relative paths
/// in it start from. NULL: read the file.
JnStatus jn_scene_parse(const char* path, const char* text, int set_count, const char* const sets[], JnScene** scene);

#endif
