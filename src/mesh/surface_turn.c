// Which way triangles face. A flood from triangle to triangle over edges of two makes parts whose triangles agree; the
// signed volume of a closed part says whether it is inside out. Parts inside others are found by rays: inside an odd
// number of others, a part is the wall of a cavity.
#include "base/log.h"
#include "mesh/surface_edges.h"
#include "mesh/triangle_tree.h"

typedef struct Part {
	int first;        // its triangle with the lowest number
	int count, flips; // triangles, and those that differ from the first
	bool has_hole;
	double volume; // six times that inside [m^3]
	int turns;     // of the ray at hand; 0 between rays
} Part;

typedef struct Turner {
	JnSurface* surface;
	int* across;   // by place: the place of the other triangle at that edge, -1: none
	int* part_of;  // by triangle
	bool* is_flip; // by triangle: to be turned
	Part* parts;
	int part_count;
	int tested, depth; // of the ray at hand: the part that it starts on, parts around that
} Turner;

static JnStatus connect(Turner* turner, const char* what, JnArena* scratch) {
	const int total = 3 * turner->surface->triangle_count;
	JnEdgeSide* sides;
	JnOffenders crowded = {0};
	JN_TRY(jn_surface_edges(turner->surface, scratch, &sides));
	for (int i = 0; i < total; i++) turner->across[i] = -1;
	for (int i = 0, count = 0; i < total; i += count) {
		count = jn_edge_side_count(sides, i, total);
		if (count > 2) jn_offenders_add_edge(&crowded, turner->surface, &sides[i]);
		if (count != 2) continue;
		turner->across[sides[i].place] = sides[i + 1].place;
		turner->across[sides[i + 1].place] = sides[i].place;
	}
	if (crowded.count == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s: edges of more than two triangles: %s%s (%d in all); remove inner walls and doubled faces in "
					"your modeller (in Blender: Select > All by Trait > Non Manifold shows them)",
					what, crowded.text, jn_offenders_rest(&crowded), crowded.count);
}

/// Whether neighbours at an edge run along it in the same direction, so that one of them faces the wrong side.
static bool disagree(const Turner* turner, int place, int other) {
	return turner->surface->triangles[place] == turner->surface->triangles[other];
}

/// Give the triangles that hang together with `first` a part, and note which differ from it.
static void flood(Turner* turner, int first, int* queue, JnOffenders* one_sided) {
	Part part = {.first = first};
	queue[part.count++] = first;
	turner->part_of[first] = turner->part_count;
	for (int next = 0; next < part.count; next++) {
		const int triangle = queue[next];
		part.flips += turner->is_flip[triangle];
		for (int place = 3 * triangle; place < 3 * triangle + 3; place++) {
			const int other = turner->across[place];
			part.has_hole |= other < 0;
			if (other < 0) continue;
			const bool is_flip = turner->is_flip[triangle] != disagree(turner, place, other);
			if (turner->part_of[other / 3] < 0) {
				turner->part_of[other / 3] = turner->part_count;
				turner->is_flip[other / 3] = is_flip;
				queue[part.count++] = other / 3;
			} else if (turner->is_flip[other / 3] != is_flip) {
				const double* at = turner->surface->nodes + 3 * (ptrdiff_t)turner->surface->triangles[place];
				if (place < other) jn_offenders_add(one_sided, "(%.4g, %.4g, %.4g)", at[0], at[1], at[2]);
			}
		}
	}
	turner->parts[turner->part_count++] = part;
}

static JnStatus find_parts(Turner* turner, const char* what, JnArena* scratch) {
	const int count = turner->surface->triangle_count;
	int* queue;
	JnOffenders one_sided = {0};
	JN_NEW(scratch, queue, (size_t)count + 1);
	for (int i = 0; i < count; i++) turner->part_of[i] = -1;
	for (int i = 0; i < count; i++)
		if (turner->part_of[i] < 0) flood(turner, i, queue, &one_sided);
	if (one_sided.count == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s: a part of the surface has one side only, like a Moebius strip: its triangles cannot agree at "
					"%s%s (%d places); cut it there in your modeller",
					what, one_sided.text, jn_offenders_rest(&one_sided), one_sided.count);
}

/// Six times the volume between a triangle, as it will face, and a point.
static double volume_at(const Turner* turner, int triangle, const double* origin) {
	double edge[3][3];
	for (int i = 0; i < 3; i++) {
		const int node = turner->surface->triangles[3 * (ptrdiff_t)triangle + i];
		for (int a = 0; a < 3; a++) edge[i][a] = turner->surface->nodes[3 * (ptrdiff_t)node + a] - origin[a];
	}
	const double *a = edge[0], *b = edge[1], *c = edge[2];
	const double volume =
		a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
	return turner->is_flip[triangle] ? -volume : volume;
}

static void measure_parts(Turner* turner) {
	const JnSurface* surface = turner->surface;
	for (int i = 0; i < surface->triangle_count; i++) {
		Part* part = &turner->parts[turner->part_of[i]];
		part->volume += volume_at(turner, i, surface->nodes + 3 * (ptrdiff_t)surface->triangles[3 * part->first]);
	}
}

static void meet(void* user, int triangle, int turns) {
	Turner* turner = user;
	const int number = turner->part_of[triangle];
	Part* part = &turner->parts[number];
	if (number == turner->tested || part->has_hole) return;
	turner->depth -= part->turns != 0;
	part->turns += turner->is_flip[triangle] ? -turns : turns;
	turner->depth += part->turns != 0;
}

static void forget(void* user, int triangle, int turns) {
	Turner* turner = user;
	(void)turns;
	turner->parts[turner->part_of[triangle]].turns = 0;
}

/// How many other closed parts are around a part: from the middle of its first triangle.
static int depth_of(Turner* turner, const JnTriangleTree* tree, int part) {
	const JnSurface* surface = turner->surface;
	double middle[3] = {0};
	for (int i = 0; i < 9; i++)
		middle[i % 3] +=
			surface->nodes[3 * (ptrdiff_t)surface->triangles[3 * turner->parts[part].first + i / 3] + i % 3] / 3;
	turner->tested = part;
	turner->depth = 0;
	jn_triangle_tree_crossings(tree, middle, meet, turner);
	jn_triangle_tree_crossings(tree, middle, forget, turner);
	return turner->depth;
}

/// Which parts are to be turned as a whole.
static JnStatus judge_parts(Turner* turner, JnArena* scratch, bool* is_turned) {
	JnTriangleTree tree;
	measure_parts(turner);
	if (turner->part_count > 1) JN_TRY(jn_triangle_tree_create(turner->surface, scratch, &tree));
	for (int i = 0; i < turner->part_count; i++) {
		const Part* part = &turner->parts[i];
		const bool is_cavity = turner->part_count > 1 && !part->has_hole && depth_of(turner, &tree, i) % 2 == 1;
		is_turned[i] = part->has_hole ? 2 * part->flips > part->count : (part->volume < 0) != is_cavity;
	}
	return JN_OK;
}

static JnStatus turn(Turner* turner, const char* what, JnArena* scratch, int* turned) {
	JnSurface* surface = turner->surface;
	const size_t count = (size_t)surface->triangle_count + 1;
	bool* is_turned;
	JN_NEW(scratch, turner->across, 3 * count);
	JN_NEW(scratch, turner->part_of, count);
	JN_NEW(scratch, turner->is_flip, count);
	JN_NEW(scratch, turner->parts, count);
	JN_TRY(connect(turner, what, scratch));
	JN_TRY(find_parts(turner, what, scratch));
	JN_NEW(scratch, is_turned, (size_t)turner->part_count + 1);
	JN_TRY(judge_parts(turner, scratch, is_turned));
	for (int i = 0; i < surface->triangle_count; i++) {
		if (turner->is_flip[i] == is_turned[turner->part_of[i]]) continue;
		int* nodes = surface->triangles + 3 * (ptrdiff_t)i;
		const int second = nodes[1];
		nodes[1] = nodes[2];
		nodes[2] = second;
		*turned += 1;
	}
	return JN_OK;
}

JnStatus jn_surface_turn(JnSurface* surface, const char* what, int* turned) {
	JnArena scratch = {0};
	Turner turner = {.surface = surface};
	*turned = 0;
	const JnStatus status = turn(&turner, what, &scratch, turned);
	jn_arena_free(&scratch);
	return status;
}
