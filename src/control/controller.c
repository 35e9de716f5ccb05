#include "control/controller.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/log.h"

static JnStatus build(JnController* self) {
	const JnControllerType* type = self->type;
	self->memory = calloc(1, type->memory_size > 0 ? type->memory_size : 1);
	self->vectors = calloc((size_t)type->vectors + 1, sizeof *self->vectors);
	if (self->memory == NULL || self->vectors == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: controller");
	if (type->check != NULL) JN_TRY(type->check(self));
	for (int i = 0; i < type->vectors; ++i) {
		self->vectors[i] = self->sys->space->ops->create(self->sys->space);
		if (self->vectors[i] == NULL) return JN_OUT_OF_MEMORY;
	}
	return type->create != NULL ? type->create(self) : JN_OK;
}

JnStatus jn_controller_create(const JnVariant* choice, const char* path, JnIntegrator* integrator, JnSystem* sys,
							  JnController** controller) {
	*controller = NULL;
	JnController* self = calloc(1, sizeof *self);
	if (self == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: controller");
	self->type = (const JnControllerType*)choice->row;
	self->options = choice->options;
	self->integrator = integrator;
	self->sys = sys;
	snprintf(self->path, sizeof self->path, "%s", path);
	const JnStatus status = build(self);
	if (status == JN_OK)
		*controller = self;
	else
		jn_controller_destroy(self);
	return status;
}

void jn_controller_destroy(JnController* self) {
	if (self == NULL) return;
	if (self->memory != NULL && self->type->destroy != NULL) self->type->destroy(self);
	for (int i = 0; self->vectors != NULL && i < self->type->vectors; ++i)
		self->sys->space->ops->destroy(self->sys->space, self->vectors[i]);
	free(self->vectors);
	free(self->memory);
	free(self);
}

JnStatus jn_controller_prepare(JnController* self, const JnStep* step) {
	return self->type->prepare != NULL ? self->type->prepare(self, step) : JN_OK;
}

void jn_controller_explain(const JnController* self, JnComplaint* complaint) {
	*complaint = (JnComplaint){0};
	if (self->type->explain != NULL) self->type->explain(self, complaint);
}

void jn_controller_archive(JnController* self, JnArchive* archive) {
	if (self->type->archive != NULL) {
		self->type->archive(self, archive);
		return;
	}
	jn_archive_bytes(archive, self->type->row.name, self->memory, self->type->memory_size);
	for (int i = 0; i < self->type->vectors; ++i)
		jn_archive_reals(archive, "vector", self->vectors[i], self->sys->space->length);
}
