/// @file detect_case.h
/// Skins and detectors for tests: every vertex is a node of the model, bodies one behind the other.
#ifndef JN_TEST_DETECT_DETECT_CASE_H
#define JN_TEST_DETECT_DETECT_CASE_H

#include "base/random.h"
#include "detect/detector.h"
#include "detect/tree.h"
#include "math/vec3.h"
#include "mesh/surface_case.h"

enum { CASE_BODIES = 4 };

/// Bodies and where their nodes are. Grows by case_add.
typedef struct Case {
	JnArena arena;
	int body_count, node_count;
	int first_node[CASE_BODIES + 1];
	JnSkin skins[CASE_BODIES];
	double *start, *end; ///< 3 * node_count
} Case;

static inline double* case_longer(Case* c, const double* old, int count) {
	double* longer = jn_arena_take(&c->arena, 3 * (size_t)count, sizeof *longer);
	assert_non_null(longer);
	if (old != NULL) memcpy(longer, old, 3 * (size_t)c->node_count * sizeof *longer);
	return longer;
}

/// Add a body with the shape of a surface, moved by `shift`, at rest during the step. Returns its number.
static inline int case_add(Case* c, const JnSurface* surface, const double shift[3]) {
	const int body = c->body_count++, nodes = c->node_count + surface->node_count;
	int* triangles = jn_arena_take(&c->arena, 3 * (size_t)surface->triangle_count, sizeof *triangles);
	assert_non_null(triangles);
	for (int i = 0; i < 3 * surface->triangle_count; i++) triangles[i] = surface->triangles[i] + c->node_count;
	assert_int_equal(jn_skin_from_triangles(surface->triangle_count, triangles, &c->arena, &c->skins[body]), JN_OK);
	c->skins[body].body = body;
	c->start = case_longer(c, c->start, nodes);
	c->end = case_longer(c, c->end, nodes);
	for (int i = 0; i < 3 * surface->node_count; i++)
		c->start[3 * c->node_count + i] = c->end[3 * c->node_count + i] = surface->nodes[i] + shift[i % 3];
	c->first_node[body] = c->node_count;
	c->node_count = c->first_node[body + 1] = nodes;
	return body;
}

/// Let a body move during the step.
static inline void case_move(Case* c, int body, double x, double y, double z) {
	const double by[3] = {x, y, z};
	for (int i = 3 * c->first_node[body]; i < 3 * c->first_node[body + 1]; i++) c->end[i] = c->start[i] + by[i % 3];
}

static inline JnDetector* case_detector(const Case* c, const JnDetectorOptions* options) {
	JnDetector* detector;
	assert_int_equal(jn_detector_create(c->body_count, c->skins, 0, NULL, options, &detector), JN_OK);
	return detector;
}

static inline JnContactList case_find(const Case* c, JnDetector* detector, double margin) {
	JnContactList list;
	assert_int_equal(jn_detector_find(detector, c->start, c->end, margin, &list), JN_OK);
	return list;
}

/// A flat sheet of 2 * cells * cells triangles in the plane z = 0, from the origin, facing up.
static inline JnSurface case_sheet(JnArena* arena, int cells, double size) {
	JnSurface s = surface_new(arena, (cells + 1) * (cells + 1), 2 * cells * cells);
	for (int i = 0; i < s.node_count; i++) {
		s.nodes[3 * i] = size * (i % (cells + 1)) / cells;
		s.nodes[3 * i + 1] = size * (i / (cells + 1)) / cells;
	}
	for (int i = 0; i < cells * cells; i++) {
		const int a = i % cells + i / cells * (cells + 1), b = a + 1, c = a + cells + 1, d = c + 1;
		put_triangle(&s, 2 * i, a, b, d);
		put_triangle(&s, 2 * i + 1, a, d, c);
	}
	return s;
}

/// A block with edges `size`, from the corner `low`.
static inline JnSurface case_block(JnArena* arena, const double low[3], const double size[3]) {
	JnSurface s = surface_cube(arena, 0, 1);
	for (int i = 0; i < 24; i++) s.nodes[i] = low[i % 3] + size[i % 3] * s.nodes[i];
	return s;
}

static inline void assert_same_contacts(const JnContact* a, const JnContact* b, int count) {
	for (int i = 0; i < count; i++) assert_memory_equal(&a[i], &b[i], sizeof *a);
}

#endif
