// The step controllers that scenes may name, and making one.
#include <stdlib.h>

#include "base/log.h"
#include "control/controller.h"
#include "control/fixed.h"

static const JnRow* const rows[] = {&jn_controller_fixed.row};

const JnRowList jn_controller_list = {.noun = "controller", .rows = rows, .count = sizeof rows / sizeof *rows};

JnController* jn_controller_create(const JnVariant* choice) {
	JnController* controller = calloc(1, sizeof *controller);
	if (controller == NULL) {
		jn_error(JN_OUT_OF_MEMORY, "out of memory: controller");
		return NULL;
	}
	controller->type = (const JnControllerType*)choice->row;
	controller->options = choice->options;
	const size_t size = controller->type->memory_size;
	controller->memory = calloc(1, size > 0 ? size : 1);
	if (controller->memory != NULL) return controller;
	free(controller);
	jn_error(JN_OUT_OF_MEMORY, "out of memory: controller");
	return NULL;
}

void jn_controller_destroy(JnController* controller) {
	if (controller == NULL) return;
	free(controller->memory);
	free(controller);
}
