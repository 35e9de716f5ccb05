/// @file shape_case.h
/// Meshes of shapes from the text of a scene file, and what can be asked of any mesh.
#ifndef JN_TEST_MESH_SHAPE_CASE_H
#define JN_TEST_MESH_SHAPE_CASE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/key.h"
#include "mesh/boundary.h"
#include "mesh/quality.h"
#include "mesh/shape/shape.h"
#include "support/support.h"

typedef struct ShapeCase {
	JnVariant shape;
	JnMesh mesh;
	JnArena arena;
} ShapeCase;

/// Generate from text such as "{type: ball, radius: 1}". Free with shape_free, also after a failure.
static inline JnStatus shape_try(ShapeCase* c, const char* text) {
	static const JnKey keys[] = {
		{.name = "shape", .kind = JN_VARIANT, .required = true, .rows = &jn_shape_list, .tag = "type"},
		{0},
	};
	char document_text[1024];
	JnDocument document;
	*c = (ShapeCase){0};
	snprintf(document_text, sizeof document_text, "shape: %s\n", text);
	JN_TRY(jn_document_parse("test.yaml", document_text, &c->arena, &document));
	JN_TRY(jn_keys_read(keys, document.root, "", &c->arena, &c->shape));
	const JnShapeType* type = (const JnShapeType*)c->shape.row;
	return type->generate(c->shape.options, "shape", &c->arena, &c->mesh);
}

static inline void shape_make(ShapeCase* c, const char* text) {
	if (shape_try(c, text) != JN_OK) fail_msg("%s is refused", text);
}

static inline void shape_free(ShapeCase* c) {
	jn_arena_free(&c->arena);
}

/// Generating fails with JN_BAD_INPUT and a message that contains `part`.
static inline void shape_expect_refusal(const char* text, const char* part) {
	ShapeCase c;
	log_capture();
	const JnStatus status = shape_try(&c, text);
	if (status != JN_BAD_INPUT || strstr(log_text(), part) == NULL)
		fail_msg("%s: expected '%s', got '%s'", text, part, log_text());
	log_release();
	shape_free(&c);
}

static inline double mesh_volume(const JnMesh* mesh) {
	double volume = 0;
	for (int cell = 0; cell < mesh->cell_count; ++cell) volume += jn_mesh_cell_volume(mesh, cell);
	return volume;
}

static inline const JnNodeSet* mesh_set(const JnMesh* mesh, const char* name) {
	for (int i = 0; i < mesh->set_count; ++i)
		if (strcmp(mesh->sets[i].name, name) == 0) return &mesh->sets[i];
	fail_msg("there is no set '%s'", name);
	return NULL;
}

static inline bool set_has(const JnNodeSet* set, int node) {
	for (int i = 0; i < set->count; ++i)
		if (set->nodes[i] == node) return true;
	return false;
}

#endif
