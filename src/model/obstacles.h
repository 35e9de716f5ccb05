/// @file obstacles.h
/// The obstacles of a model, from their definitions.
#ifndef JN_MODEL_OBSTACLES_H
#define JN_MODEL_OBSTACLES_H

#include "model/model.h"

/// Fill model->obstacles. `defs` are JnObstacleDef, whose names and options must outlive the model.
JnStatus jn_obstacles_create(const JnItems* defs, JnModel* model);

/// The name of a contact material: as given, or "default" for NULL.
static inline const char* jn_surface_name(const char* name) {
	return name != NULL ? name : "default";
}

#endif
