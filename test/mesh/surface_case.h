/// @file surface_case.h
/// Surfaces for tests: boxes, spheres and a strip, with memory from an arena, and a log that keeps its words.
#ifndef JN_TEST_MESH_SURFACE_CASE_H
#define JN_TEST_MESH_SURFACE_CASE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/log.h"
#include "mesh/surface.h"

/// What was logged since words_keep.
typedef struct Words {
	int errors, warnings;
	char text[8192];
} Words;

static inline void words_add(void* user, JnLogLevel level, const char* message) {
	Words* words = user;
	const size_t used = strlen(words->text);
	words->errors += level == JN_LOG_ERROR;
	words->warnings += level == JN_LOG_WARNING;
	snprintf(words->text + used, sizeof words->text - used, "%s\n", message);
}

static inline void words_keep(Words* words) {
	*words = (Words){0};
	jn_log_set_sink(words_add, words);
}

static inline void assert_says(const Words* words, const char* part) {
	if (strstr(words->text, part) == NULL) fail_msg("'%s' is not in: %s", part, words->text);
}

static inline void assert_near(const char* what, double value, double expected, double tolerance) {
	print_message("%s: value %.17g, expected %.17g, tolerance %g\n", what, value, expected, tolerance);
	if (!(fabs(value - expected) <= tolerance)) fail_msg("%s is off by %g", what, value - expected);
}

static inline JnSurface surface_new(JnArena* arena, int nodes, int triangles) {
	JnSurface s = {.node_count = nodes, .triangle_count = triangles};
	s.nodes = jn_arena_take(arena, 3 * (size_t)nodes + 1, sizeof *s.nodes);
	s.triangles = jn_arena_take(arena, 3 * (size_t)triangles + 1, sizeof *s.triangles);
	assert_non_null(s.nodes);
	assert_non_null(s.triangles);
	return s;
}

static inline void put_triangle(JnSurface* s, int triangle, int a, int b, int c) {
	const int t[3] = {a, b, c};
	memcpy(s->triangles + 3 * triangle, t, sizeof t);
}

/// The box from `low` with equal edges `size`: 8 nodes, 12 triangles that face outward.
static inline JnSurface surface_cube(JnArena* arena, double low, double size) {
	static const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
	JnSurface s = surface_new(arena, 8, 12);
	for (int i = 0; i < 8; i++)
		for (int a = 0; a < 3; a++) s.nodes[3 * i + a] = low + size * (i >> a & 1);
	for (int q = 0; q < 6; q++) {
		put_triangle(&s, 2 * q, quads[q][0], quads[q][1], quads[q][2]);
		put_triangle(&s, 2 * q + 1, quads[q][0], quads[q][2], quads[q][3]);
	}
	return s;
}

/// A sphere about the origin: `rings` bands from pole to pole, each of 2 * rings sectors.
static inline JnSurface surface_sphere(JnArena* arena, double radius, int rings) {
	const int around = 2 * rings, inner = rings - 1, south = inner * around, north = south + 1;
	JnSurface s = surface_new(arena, inner * around + 2, 2 * around * inner);
	for (int i = 0; i < inner * around; i++) {
		const double polar = M_PI * (i / around + 1) / rings, turn = M_PI * 2 * (i % around) / around;
		s.nodes[3 * i] = radius * sin(polar) * cos(turn);
		s.nodes[3 * i + 1] = radius * sin(polar) * sin(turn);
		s.nodes[3 * i + 2] = -radius * cos(polar);
	}
	s.nodes[3 * south + 2] = -radius;
	s.nodes[3 * north + 2] = radius;
	int count = 0;
	for (int k = 0; k < around; k++) {
		const int next = (k + 1) % around, top = (inner - 1) * around;
		put_triangle(&s, count++, south, next, k);
		put_triangle(&s, count++, north, top + k, top + next);
		for (int r = 0; r + 1 < inner; r++) {
			const int a = r * around + k, b = r * around + next;
			put_triangle(&s, count++, a, b, b + around);
			put_triangle(&s, count++, a, b + around, a + around);
		}
	}
	assert_int_equal(count, s.triangle_count);
	return s;
}

/// Two surfaces as one, the second moved by `shift` along x.
static inline JnSurface surface_join(JnArena* arena, const JnSurface* a, const JnSurface* b, double shift) {
	JnSurface s = surface_new(arena, a->node_count + b->node_count, a->triangle_count + b->triangle_count);
	memcpy(s.nodes, a->nodes, 3 * (size_t)a->node_count * sizeof *s.nodes);
	memcpy(s.triangles, a->triangles, 3 * (size_t)a->triangle_count * sizeof *s.triangles);
	for (int i = 0; i < 3 * b->node_count; i++) s.nodes[3 * a->node_count + i] = b->nodes[i] + (i % 3 == 0 ? shift : 0);
	for (int i = 0; i < 3 * b->triangle_count; i++)
		s.triangles[3 * a->triangle_count + i] = b->triangles[i] + a->node_count;
	return s;
}

static inline void surface_reverse(JnSurface* s, int triangle) {
	const int* t = s->triangles + 3 * triangle;
	put_triangle(s, triangle, t[0], t[2], t[1]);
}

/// A strip of 2 * segments triangles whose end is joined to its start with a half turn.
static inline JnSurface surface_moebius(JnArena* arena, int segments) {
	JnSurface s = surface_new(arena, 2 * segments, 2 * segments);
	for (int i = 0; i < segments; i++) {
		const double turn = 2 * M_PI * i / segments;
		for (int side = 0; side < 2; side++) {
			const double wide = 0.3 * (2 * side - 1), radius = 1 + wide * cos(turn / 2);
			double* x = s.nodes + 3 * (2 * i + side);
			x[0] = radius * cos(turn);
			x[1] = radius * sin(turn);
			x[2] = wide * sin(turn / 2);
		}
		const int last = i + 1 == segments, a = 2 * i, b = 2 * i + 1, next = last ? 0 : a + 2;
		const int c = last ? next + 1 : next, d = last ? next : next + 1;
		put_triangle(&s, 2 * i, a, c, b);
		put_triangle(&s, 2 * i + 1, b, c, d);
	}
	return s;
}

#endif
