#include "model/obstacles.h"

#include <stdio.h>
#include <string.h>

#include "base/log.h"

static JnStatus create(const JnItems* defs, int index, JnModel* model) {
	const JnObstacleDef* def = (const JnObstacleDef*)defs->data + index;
	for (int i = 0; i < index; ++i)
		if (strcmp(def->name, model->obstacles[i].name) == 0)
			return jn_error(JN_BAD_INPUT, "obstacles[%d].name: '%s' is the name of obstacles[%d] already; use another",
							index, def->name, i);
	JnModelObstacle* obstacle = &model->obstacles[index];
	*obstacle = (JnModelObstacle){.name = def->name, .surface = jn_surface_name(def->surface)};
	obstacle->shape.type = (const JnObstacleType*)def->shape.row;
	char what[96];
	snprintf(what, sizeof what, "obstacles[%d].shape", index);
	return obstacle->shape.type->create(def->shape.options, what, &model->arena, &obstacle->shape.geometry);
}

JnStatus jn_obstacles_create(const JnItems* defs, JnModel* model) {
	model->obstacle_count = defs->count;
	JN_NEW(&model->arena, model->obstacles, defs->count);
	for (int i = 0; i < defs->count; ++i) JN_TRY(create(defs, i, model));
	return JN_OK;
}
