// The editing of closed triangle surfaces. Nothing geometrical happens here but the middle of a split edge and creases.
#include "mesh/fill/half_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"

/// Resize an array of `count` objects, or return JN_OUT_OF_MEMORY from the calling function.
#define RESIZE(array, count)                                                                                           \
	do {                                                                                                               \
		void* grown = realloc((array), (size_t)(count) * sizeof *(array));                                             \
		if (grown == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: a surface of %d half-edges", mesh->room); \
		(array) = grown;                                                                                               \
	} while (0)

static JnStatus reserve(JnHalfEdges* mesh, int nodes, int half_edges) {
	if (mesh->node_count + nodes > mesh->node_room) {
		mesh->node_room = 2 * (mesh->node_count + nodes);
		RESIZE(mesh->nodes, 3 * (size_t)mesh->node_room);
		RESIZE(mesh->leaving, mesh->node_room);
	}
	if (mesh->count + half_edges > mesh->room) {
		mesh->room = 2 * (mesh->count + half_edges);
		RESIZE(mesh->from, mesh->room);
		RESIZE(mesh->twin, mesh->room);
		RESIZE(mesh->crease, mesh->room);
	}
	return JN_OK;
}

/// An edge as it is seen from a half-edge, for finding twins.
typedef struct Side {
	int low, high, h;
} Side;

static int compare_sides(const void* a, const void* b) {
	const Side *p = a, *q = b;
	if (p->low != q->low) return p->low < q->low ? -1 : 1;
	if (p->high != q->high) return p->high < q->high ? -1 : 1;
	return p->h < q->h ? -1 : p->h > q->h;
}

static JnStatus pair(JnHalfEdges* mesh, Side* sides, const char* what) {
	for (int h = 0; h < mesh->count; h++) {
		const int a = mesh->from[h], b = jn_to(mesh, h);
		sides[h] = (Side){.low = a < b ? a : b, .high = a < b ? b : a, .h = h};
	}
	qsort(sides, (size_t)mesh->count, sizeof *sides, compare_sides);
	for (int i = 0; i < mesh->count; i += 2) {
		const Side *p = &sides[i], *q = i + 1 < mesh->count ? p + 1 : p;
		const bool is_pair = q != p && p->low == q->low && p->high == q->high && mesh->from[p->h] != mesh->from[q->h];
		const bool is_triple = i + 2 < mesh->count && p[2].low == p->low && p[2].high == p->high;
		if (!is_pair || is_triple)
			return jn_error(JN_BAD_INPUT, "%s: the edge between nodes %d and %d does not have two triangles that agree",
							what, p->low, p->high);
		mesh->twin[p->h] = q->h;
		mesh->twin[q->h] = p->h;
	}
	return JN_OK;
}

/// Give every fan of triangles its own node: the first one keeps the number, others get copies.
static JnStatus separate_fans(JnHalfEdges* mesh) {
	bool* seen = calloc((size_t)mesh->count + 1, sizeof *seen);
	if (seen == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: a surface of %d half-edges", mesh->count);
	JnStatus status = JN_OK;
	for (int start = 0; start < mesh->count && status == JN_OK; start++) {
		if (seen[start]) continue;
		int node = mesh->from[start];
		if (mesh->leaving[node] >= 0) {
			status = reserve(mesh, 1, 0);
			if (status != JN_OK) break;
			memcpy(mesh->nodes + 3 * (ptrdiff_t)mesh->node_count, mesh->nodes + 3 * (ptrdiff_t)node,
				   3 * sizeof(double));
			node = mesh->node_count++;
		}
		mesh->leaving[node] = start;
		for (int h = start; !seen[h]; h = jn_turn(mesh, h)) {
			seen[h] = true;
			mesh->from[h] = node;
		}
	}
	free(seen);
	return status;
}

static JnStatus create(const JnSurface* surface, const char* what, JnHalfEdges* mesh) {
	JN_TRY(reserve(mesh, surface->node_count, 3 * surface->triangle_count));
	mesh->node_count = surface->node_count;
	mesh->count = 3 * surface->triangle_count;
	memcpy(mesh->nodes, surface->nodes, 3 * (size_t)surface->node_count * sizeof(double));
	memcpy(mesh->from, surface->triangles, (size_t)mesh->count * sizeof(int));
	for (int h = 0; h < mesh->count; h++) mesh->crease[h] = false;
	for (int i = 0; i < mesh->node_count; i++) mesh->leaving[i] = -1;
	Side* sides = malloc(((size_t)mesh->count + 1) * sizeof *sides);
	if (sides == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: a surface of %d half-edges", mesh->count);
	const JnStatus status = pair(mesh, sides, what);
	free(sides);
	return status == JN_OK ? separate_fans(mesh) : status;
}

JnStatus jn_half_edges_create(const JnSurface* surface, const char* what, JnHalfEdges* mesh) {
	*mesh = (JnHalfEdges){0};
	const JnStatus status = create(surface, what, mesh);
	if (status != JN_OK) jn_half_edges_free(mesh);
	return status;
}

void jn_half_edges_free(JnHalfEdges* mesh) {
	free(mesh->nodes);
	free(mesh->leaving);
	free(mesh->from);
	free(mesh->twin);
	free(mesh->crease);
	*mesh = (JnHalfEdges){0};
}

JnStatus jn_half_edges_surface(const JnHalfEdges* mesh, JnArena* arena, JnSurface* surface) {
	*surface = (JnSurface){0};
	JN_NEW(arena, surface->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, surface->triangles, mesh->count);
	int* number;
	JN_NEW(arena, number, mesh->node_count);
	for (int i = 0; i < mesh->node_count; i++) {
		if (mesh->leaving[i] < 0) continue;
		number[i] = surface->node_count++;
		memcpy(surface->nodes + 3 * (ptrdiff_t)number[i], mesh->nodes + 3 * (ptrdiff_t)i, 3 * sizeof(double));
	}
	for (int h = 0; h < mesh->count; h += 3) {
		if (mesh->from[h] < 0) continue;
		int* triangle = surface->triangles + 3 * (ptrdiff_t)surface->triangle_count++;
		for (int k = 0; k < 3; k++) triangle[k] = number[mesh->from[h + k]];
	}
	return JN_OK;
}

static void unit_normal(const JnHalfEdges* mesh, int h, double n[3]) {
	const int t = h - h % 3;
	vec3_triangle(mesh->nodes + 3 * (ptrdiff_t)mesh->from[t], mesh->nodes + 3 * (ptrdiff_t)mesh->from[t + 1],
				  mesh->nodes + 3 * (ptrdiff_t)mesh->from[t + 2], n);
	vec3_normalize(n);
}

int jn_half_edges_crease(JnHalfEdges* mesh, double angle) {
	int count = 0;
	for (int h = 0; h < mesh->count; h++) {
		const int twin = mesh->twin[h];
		if (mesh->from[h] < 0 || twin < h) continue;
		double m[3], n[3];
		unit_normal(mesh, h, m);
		unit_normal(mesh, twin, n);
		mesh->crease[h] = mesh->crease[twin] = vec3_dot(m, n) < cos(angle);
		count += mesh->crease[h];
	}
	return count;
}

int jn_crease_count(const JnHalfEdges* mesh, int node) {
	int count = 0, h = mesh->leaving[node];
	do {
		count += mesh->crease[h];
		h = jn_turn(mesh, h);
	} while (h != mesh->leaving[node]);
	return count;
}

int jn_valence(const JnHalfEdges* mesh, int node) {
	int count = 0, h = mesh->leaving[node];
	do {
		count++;
		h = jn_turn(mesh, h);
	} while (h != mesh->leaving[node]);
	return count;
}

static void join(JnHalfEdges* mesh, int h, int twin) {
	mesh->twin[h] = twin;
	mesh->twin[twin] = h;
}

/// Write triangle h, h + 1, h + 2.
static void put(JnHalfEdges* mesh, int h, int a, int b, int c) {
	mesh->from[h] = a;
	mesh->from[h + 1] = b;
	mesh->from[h + 2] = c;
}

/// Let a half-edge take the place of another towards its neighbour.
static void inherit(JnHalfEdges* mesh, int h, int twin, bool crease) {
	join(mesh, h, twin);
	mesh->crease[h] = crease;
}

JnStatus jn_half_edges_split(JnHalfEdges* mesh, int h) {
	JN_TRY(reserve(mesh, 1, 6));
	const int g = mesh->twin[h], hn = jn_next(h), hb = jn_before(h), gb = jn_before(g);
	const int a = mesh->from[h], b = mesh->from[g], c = mesh->from[hb], d = mesh->from[gb], m = mesh->node_count++;
	const int p = mesh->count, q = mesh->count + 3; // new triangles m b c and b m d
	const bool crease = mesh->crease[h];
	mesh->count += 6;
	double *xm = mesh->nodes + 3 * (ptrdiff_t)m, *xa = mesh->nodes + 3 * (ptrdiff_t)a,
		   *xb = mesh->nodes + 3 * (ptrdiff_t)b;
	for (int k = 0; k < 3; k++) xm[k] = 0.5 * (xa[k] + xb[k]);
	put(mesh, p, m, b, c);
	put(mesh, q, b, m, d);
	inherit(mesh, p + 1, mesh->twin[hn], mesh->crease[hn]);
	inherit(mesh, q + 2, mesh->twin[gb], mesh->crease[gb]);
	mesh->from[hn] = m; // a b c becomes a m c
	mesh->from[g] = m;  // b a d becomes m a d
	inherit(mesh, hn, p + 2, false);
	inherit(mesh, gb, q + 1, false);
	mesh->crease[p + 2] = mesh->crease[q + 1] = false;
	join(mesh, p, q);
	mesh->crease[p] = mesh->crease[q] = crease;
	mesh->leaving[m] = p;
	mesh->leaving[b] = q;
	mesh->leaving[c] = hb;
	mesh->leaving[d] = gb;
	mesh->leaving[a] = h;
	return JN_OK;
}

static bool are_neighbours(const JnHalfEdges* mesh, int a, int b) {
	int h = mesh->leaving[a];
	do {
		if (jn_to(mesh, h) == b) return true;
		h = jn_turn(mesh, h);
	} while (h != mesh->leaving[a]);
	return false;
}

bool jn_half_edges_flip(JnHalfEdges* mesh, int h) {
	const int g = mesh->twin[h], hn = jn_next(h), hb = jn_before(h), gn = jn_next(g), gb = jn_before(g);
	const int a = mesh->from[h], b = mesh->from[g], c = mesh->from[hb], d = mesh->from[gb];
	if (c == d || jn_valence(mesh, a) < 4 || jn_valence(mesh, b) < 4 || are_neighbours(mesh, c, d)) return false;
	// a b c and b a d become d c a (at h) and c d b (at g)
	const int out[4] = {mesh->twin[hb], mesh->twin[gn], mesh->twin[gb], mesh->twin[hn]}; // c-a, a-d, d-b, b-c
	const bool crease[4] = {mesh->crease[hb], mesh->crease[gn], mesh->crease[gb], mesh->crease[hn]};
	mesh->from[h] = d, mesh->from[hn] = c, mesh->from[hb] = a;
	mesh->from[g] = c, mesh->from[gn] = d, mesh->from[gb] = b;
	inherit(mesh, hn, out[0], crease[0]);
	inherit(mesh, hb, out[1], crease[1]);
	inherit(mesh, gn, out[2], crease[2]);
	inherit(mesh, gb, out[3], crease[3]);
	mesh->crease[h] = mesh->crease[g] = false;
	mesh->leaving[a] = hb;
	mesh->leaving[b] = gb;
	mesh->leaving[c] = hn;
	mesh->leaving[d] = gn;
	return true;
}

bool jn_half_edges_can_collapse(const JnHalfEdges* mesh, int h) {
	const int g = mesh->twin[h], a = mesh->from[h], b = mesh->from[g];
	const int c = mesh->from[jn_before(h)], d = mesh->from[jn_before(g)];
	if (c == d || jn_valence(mesh, c) < 4 || jn_valence(mesh, d) < 4) return false; // a triangle would be doubled
	int common = 0, at = mesh->leaving[a];
	do {
		common += are_neighbours(mesh, jn_to(mesh, at), b);
		at = jn_turn(mesh, at);
	} while (at != mesh->leaving[a]);
	return common == 2;
}

/// Take triangle of h away: its other two sides become one edge, a crease if one was.
static void close_gap(JnHalfEdges* mesh, int h) {
	const int p = mesh->twin[jn_next(h)], q = mesh->twin[jn_before(h)], t = h - h % 3;
	mesh->crease[p] = mesh->crease[q] = mesh->crease[p] || mesh->crease[q];
	join(mesh, p, q);
	mesh->leaving[mesh->from[p]] = p;
	mesh->leaving[mesh->from[q]] = q;
	put(mesh, t, -1, -1, -1);
}

void jn_half_edges_collapse(JnHalfEdges* mesh, int h) {
	const int g = mesh->twin[h], a = mesh->from[h], b = mesh->from[g];
	int at = h;
	do { // all that left a now leaves b
		mesh->from[at] = b;
		at = jn_turn(mesh, at);
	} while (at != h);
	close_gap(mesh, h);
	close_gap(mesh, g);
	mesh->leaving[a] = -1;
}
