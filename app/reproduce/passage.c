#include "reproduce/passage.h"

#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "mesh/triangle_tree.h"

enum { BELOW = -1, RIM = 0, ABOVE = 1 };

typedef struct Passages {
	const Frames* frames;
	int body_count, sheet_count;
	int* first;       // body_count + 1: the triangles of each body
	int* face;        // a triangle: which face of its sheet
	double* points;   // of a frame
	double* middle;   // 3 a body, in it
	int *side, *last; // [sheet][body]: in this frame and the one before it; RIM: unknown
} Passages;

static const int* corners_of(const Passages* p, int triangle) {
	return p->frames->triangles + 3 * (size_t)triangle;
}

static void normal_of(const Passages* p, int triangle, double normal[3]) {
	const int* t = corners_of(p, triangle);
	vec3_triangle(p->points + 3 * (size_t)t[0], p->points + 3 * (size_t)t[1], p->points + 3 * (size_t)t[2], normal);
}

// Triangles come body by body.
static JnStatus find_bodies(Passages* p, JnArena* arena) {
	const Frames* frames = p->frames;
	const int triangles = frames->triangle_count;
	p->body_count = triangles > 0 ? frames->bodies[triangles - 1] + 1 : 0;
	JN_NEW(arena, p->first, p->body_count + 1);
	for (int i = 0; i < triangles; ++i) p->first[frames->bodies[i] + 1] = i + 1;
	const size_t pairs = (size_t)p->sheet_count * (size_t)p->body_count;
	JN_NEW(arena, p->face, triangles + 1);
	JN_NEW(arena, p->points, 3 * (size_t)frames->point_count + 1);
	JN_NEW(arena, p->middle, 3 * (size_t)p->body_count + 1);
	JN_NEW(arena, p->side, pairs + 1);
	JN_NEW(arena, p->last, pairs + 1);
	return JN_OK;
}

// At the start sheets are flat: most of their area looks along one line. What is at the rim, or next to it, has no side.
static void find_faces(Passages* p, int sheet, bool* is_rim) {
	double largest[3] = {0}, normal[3];
	for (int i = p->first[sheet]; i < p->first[sheet + 1]; ++i) {
		normal_of(p, i, normal);
		if (vec3_length(normal) > vec3_length(largest)) memcpy(largest, normal, sizeof largest);
	}
	if (largest[1] < 0)
		for (int c = 0; c < 3; ++c) largest[c] = -largest[c];
	for (int i = p->first[sheet]; i < p->first[sheet + 1]; ++i) {
		normal_of(p, i, normal);
		const double cosine = vec3_dot(normal, largest) / (vec3_length(normal) * vec3_length(largest));
		p->face[i] = cosine > 0.9 ? ABOVE : cosine < -0.9 ? BELOW : RIM;
		for (int k = 0; p->face[i] == RIM && k < 3; ++k) is_rim[corners_of(p, i)[k]] = true;
	}
	for (int i = p->first[sheet]; i < p->first[sheet + 1]; ++i)
		for (int k = 0; k < 3; ++k)
			if (is_rim[corners_of(p, i)[k]]) p->face[i] = RIM;
}

// The mean of the corners of its triangles.
static void find_middle(const Passages* p, int body, double middle[3]) {
	const int count = 3 * (p->first[body + 1] - p->first[body]);
	for (int c = 0; c < 3; ++c) middle[c] = 0;
	for (int k = 0; k < count; ++k)
		for (int c = 0; c < 3; ++c)
			middle[c] += p->points[3 * (size_t)corners_of(p, p->first[body])[k] + (size_t)c] / count;
}

static int find_side(const Passages* p, int sheet, const double at[3]) {
	double least = INFINITY;
	int side = RIM;
	for (int i = p->first[sheet]; i < p->first[sheet + 1]; ++i) {
		const int* t = corners_of(p, i);
		const double *a = p->points + 3 * (size_t)t[0], *b = p->points + 3 * (size_t)t[1],
					 *c = p->points + 3 * (size_t)t[2];
		double w[3], near[3];
		jn_triangle_nearest(a, b, c, at, w);
		for (int k = 0; k < 3; ++k) near[k] = w[0] * a[k] + w[1] * b[k] + w[2] * c[k];
		const double distance = vec3_distance(near, at);
		if (distance < least) least = distance, side = p->face[i];
	}
	return side;
}

static JnStatus read_sides(Passages* p, int frame) {
	JN_TRY(frames_read(p->frames, frame, p->points));
	for (int b = p->sheet_count; b < p->body_count; ++b) find_middle(p, b, p->middle + 3 * (size_t)b);
	for (int s = 0; s < p->sheet_count; ++s)
		for (int b = p->sheet_count; b < p->body_count; ++b)
			p->side[s * p->body_count + b] = find_side(p, s, p->middle + 3 * (size_t)b);
	return JN_OK;
}

static JnStatus count(Passages* p, JnArena* arena, int* passages) {
	bool* is_rim;
	JN_NEW(arena, is_rim, p->frames->point_count + 1);
	JN_TRY(find_bodies(p, arena));
	JN_TRY(frames_read(p->frames, 0, p->points));
	for (int s = 0; s < p->sheet_count; ++s) find_faces(p, s, is_rim);
	for (int f = 0; f < p->frames->count; ++f) {
		JN_TRY(read_sides(p, f));
		for (int k = 0; k < p->sheet_count * p->body_count; ++k) *passages += p->side[k] * p->last[k] < 0;
		int* const swap = p->last;
		p->last = p->side;
		p->side = swap;
	}
	return JN_OK;
}

JnStatus passages_count(const Frames* frames, int sheet_count, int* passages) {
	JnArena arena = {0};
	Passages p = {.frames = frames, .sheet_count = sheet_count};
	*passages = 0;
	const JnStatus status = count(&p, &arena, passages);
	jn_arena_free(&arena);
	return status;
}
