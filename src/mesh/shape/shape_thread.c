// Threads: frames of three nodes along a curve, three tetrahedra between two of them (thread.h).
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "math/vec3.h"
#include "mesh/shape/path.h"
#include "mesh/shape/shape_keys.h"
#include "mesh/thread.h"

typedef struct ThreadPointDef {
	double at[3];
} ThreadPointDef;

typedef struct ThreadDef {
	JnItems points; // ThreadPointDef
	JnPathDef path;
	double radius, twist; // twist in turns
	int links, needle;
	int section;
} ThreadDef;

enum { SECTION_CENTRED, SECTION_CORNER };

/// Where the nodes of a frame lie in the plane of its two normals, in radii, and the weights of the axis.
typedef struct Section {
	double at[JN_FRAME_NODES][2], axis[JN_FRAME_NODES];
} Section;

// Three lines at r / sqrt 2 about the axis have the moments of inertia of a round section of radius r, in every direction.
#define HALF_ROOT 0.70710678118654752440
#define HIGH (HALF_ROOT * 0.86602540378443864676)
static const Section sections[] = {
	[SECTION_CENTRED] = {.at = {{HALF_ROOT, 0}, {-0.5 * HALF_ROOT, HIGH}, {-0.5 * HALF_ROOT, -HIGH}},
						 .axis = {1.0 / 3, 1.0 / 3, 1.0 / 3}},
	[SECTION_CORNER] = {.at = {{0, 0}, {1, 0}, {0, 1}}, .axis = {1, 0, 0}},
};

static void place_frame(const Section* section, const JnStation* station, double radius, double* nodes) {
	for (int i = 0; i < JN_FRAME_NODES; ++i)
		for (int a = 0; a < 3; ++a)
			nodes[3 * i + a] = station->X[a] + radius * (section->at[i][0] * station->across[0][a] +
														 section->at[i][1] * station->across[1][a]);
}

static void join_frames(int first, int second, int* cells) {
	const int R = 3 * first, P = R + 1, Q = R + 2, R1 = 3 * second, P1 = R1 + 1, Q1 = R1 + 2;
	const int link[JN_LINK_CELLS][4] = {{R1, P, Q, R}, {R1, Q1, Q, P}, {R1, P, P1, Q1}};
	for (int c = 0; c < JN_LINK_CELLS; ++c)
		for (int i = 0; i < 4; ++i) cells[4 * c + i] = link[c][i];
}

// The order of EX's cells may be left-handed: exchange two nodes where it is.
static void turn_cells(JnMesh* mesh) {
	for (int c = 0; c < mesh->cell_count; ++c) {
		int* cell = mesh->cells + 4 * (ptrdiff_t)c;
		if (jn_mesh_cell_volume(mesh, c) > 0) continue;
		const int swap = cell[0];
		cell[0] = cell[1];
		cell[1] = swap;
	}
}

// Frames whose nodes a set has: first <= frame < end; node -1: all three of a frame.
typedef struct FrameSet {
	const char* name;
	int first, end, node;
} FrameSet;

static JnStatus fill_set(const FrameSet* from, JnArena* arena, JnNodeSet* set) {
	const int each = from->node < 0 ? JN_FRAME_NODES : 1;
	*set = (JnNodeSet){.name = from->name, .count = each * (from->end - from->first)};
	JN_NEW(arena, set->nodes, set->count);
	for (int i = 0; i < set->count; ++i)
		set->nodes[i] = JN_FRAME_NODES * (from->first + i / each) + (from->node < 0 ? i % each : from->node);
	return JN_OK;
}

static JnStatus name_sets(const ThreadDef* def, JnArena* arena, JnMesh* mesh) {
	const int frames = mesh->thread->frame_count;
	const FrameSet all[] = {
		{"start", 0, 1, -1},
		{"end", frames - 1, mesh->thread->is_closed ? frames - 1 : frames, -1},
		{"needle", 0, def->needle > 0 ? def->needle + 1 : 0, -1},
		{"axis", 0, def->section == SECTION_CORNER ? frames : 0, JN_THREAD_R},
	};
	const int most = sizeof all / sizeof *all;
	JN_NEW(arena, mesh->sets, most);
	for (int i = 0; i < most; ++i)
		if (all[i].end > all[i].first) JN_TRY(fill_set(&all[i], arena, &mesh->sets[mesh->set_count++]));
	return JN_OK;
}

// Where the curve bends by an angle over a distance, the inner side of the thread is shorter by radius * angle.
static JnStatus check_bends(const ThreadDef* def, const JnThread* thread, const JnStation* stations, const char* what) {
	for (int link = 0; link < jn_thread_links(thread); ++link) {
		const JnStation *a = &stations[link], *b = &stations[jn_thread_end(thread, link)];
		const double chord = vec3_distance(a->X, b->X), angle = vec3_distance(a->along, b->along);
		if (!isfinite(chord + angle))
			return jn_error(
				JN_BAD_INPUT,
				"%s: the curve has no direction at link %d of %d: points fall together, or sizes of its parts lie "
				"too far apart; use less extreme ones",
				what, link, jn_thread_links(thread));
		if (def->radius * angle < 0.9 * chord) continue;
		return jn_error(JN_BAD_INPUT,
						"%s: near [%g, %g, %g] m the curve bends with a radius of %g m, too sharply for a thread of "
						"radius %g m; widen the curve or make the thread thinner",
						what, b->X[0], b->X[1], b->X[2], chord / angle, def->radius);
	}
	return JN_OK;
}

static JnStatus check_counts(const ThreadDef* def, const JnPath* path, const char* what) {
	if (path->is_closed && def->links < 3)
		return jn_error(JN_BAD_INPUT, "%s.links: %d make no loop; give three or more", what, def->links);
	if (path->is_closed && def->twist != floor(def->twist))
		return jn_error(JN_BAD_INPUT, "%s.twist: %g turns do not close in a loop; give a whole number", what,
						def->twist);
	if (def->needle > def->links - path->is_closed)
		return jn_error(JN_BAD_INPUT, "%s.needle: %d links are more than the thread has to give, %d; give fewer", what,
						def->needle, def->links - path->is_closed);
	return JN_OK;
}

static JnStatus sweep(const ThreadDef* def, const JnThread* thread, const JnStation* stations, JnArena* arena,
					  JnMesh* mesh) {
	const int links = jn_thread_links(thread);
	*mesh = (JnMesh){.shape = JN_TET4,
					 .node_count = JN_FRAME_NODES * thread->frame_count,
					 .cell_count = JN_LINK_CELLS * links,
					 .thread = thread};
	JN_NEW(arena, mesh->nodes, 3 * (size_t)mesh->node_count);
	JN_NEW(arena, mesh->cells, 4 * (size_t)mesh->cell_count);
	for (int k = 0; k < thread->frame_count; ++k)
		place_frame(&sections[def->section], &stations[k], def->radius, mesh->nodes + 9 * (ptrdiff_t)k);
	for (int k = 0; k < links; ++k) join_frames(k, jn_thread_end(thread, k), mesh->cells + 12 * (ptrdiff_t)k);
	turn_cells(mesh);
	return name_sets(def, arena, mesh);
}

static JnStatus trace(const ThreadDef* def, const char* what, JnArena* scratch, JnPath* path) {
	char where[128];
	if ((def->points.count > 0) == (def->path.curve.row != NULL))
		return jn_error(JN_BAD_INPUT, "%s.curve: %s; give one of curve and points", what,
						def->points.count > 0 ? "there are points, too" : "nothing says where the thread goes");
	snprintf(where, sizeof where, "%s.curve", what);
	if (def->path.curve.row != NULL) return jn_path_create(&def->path, where, scratch, path);
	return jn_path_through(def->points.count, def->points.data, what, scratch, path);
}

static JnStatus generate_with(const ThreadDef* def, const char* what, JnArena* scratch, JnArena* arena, JnMesh* mesh) {
	JnPath path;
	JnStation* stations;
	JnThread* thread;
	JN_TRY(trace(def, what, scratch, &path));
	JN_TRY(check_counts(def, &path, what));
	JN_NEW(arena, thread, 1);
	*thread = (JnThread){.frame_count = def->links + !path.is_closed,
						 .is_closed = path.is_closed,
						 .radius = def->radius,
						 .link_length = path.length / def->links};
	memcpy(thread->axis, sections[def->section].axis, sizeof thread->axis);
	JN_NEW(scratch, stations, thread->frame_count);
	jn_path_stations(&path, thread->frame_count, def->twist, stations);
	JN_TRY(check_bends(def, thread, stations, what));
	return sweep(def, thread, stations, arena, mesh);
}

static JnStatus generate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	JnArena scratch = {0};
	const JnStatus status = generate_with(options, what, &scratch, arena, mesh);
	jn_arena_free(&scratch);
	return status;
}

static const char* const section_names[] = {"centred", "corner", NULL};

static const JnKey point_keys[] = {
	{.name = "at",
	 .kind = JN_REAL3,
	 .field = offsetof(ThreadPointDef, at),
	 .required = true,
	 .unit = "m",
	 .meaning = "where it passes"},
	{0},
};

static const JnKey keys[] = {
	JN_PATH_KEY_ROWS(ThreadDef, path., false),
	{.name = "points",
	 .kind = JN_LIST,
	 .field = offsetof(ThreadDef, points),
	 .keys = point_keys,
	 .size = sizeof(ThreadPointDef),
	 .meaning = "in place of a curve: two or more points of a spline"},
	JN_LENGTH_KEY(ThreadDef, radius, "half its thickness"),
	{.name = "links",
	 .kind = JN_INTEGER,
	 .field = offsetof(ThreadDef, links),
	 .value = {100},
	 .low = 1,
	 .high = 1000000,
	 .meaning = "pieces along its length"},
	{.name = "section",
	 .kind = JN_CHOICE,
	 .field = offsetof(ThreadDef, section),
	 .names = section_names,
	 .meaning =
		 "where the three nodes of a frame lie: centred: about the curve, so that it bends alike in all directions; "
		 "corner: one on the curve and two at the radius along its normals, as in the paper"},
	{.name = "twist",
	 .kind = JN_REAL,
	 .field = offsetof(ThreadDef, twist),
	 .low = -1e6,
	 .high = 1e6,
	 .meaning = "turns of the frames about the curve over the whole length, at rest; whole numbers in a loop"},
	{.name = "needle",
	 .kind = JN_INTEGER,
	 .field = offsetof(ThreadDef, needle),
	 .low = 0,
	 .high = 1000000,
	 .meaning = "links at its start that the set `needle` holds, to be driven or fixed; 0: none"},
	{0},
};

const JnShapeType jn_shape_thread = {
	.row =
		{"thread",
		 "A thread along a curve, as frames of three nodes with tetrahedra between them. Its sets are start and end, a "
		 "frame each (a loop has no end), needle, and with corner sections axis, the nodes on the curve.",
		 keys, sizeof(ThreadDef)},
	.generate = generate,
};
