// Which pairs can meet: chosen where the points are, and good as long as none moves farther than the reach.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "detect/segment.h"
#include "math/vec3.h"
#include "pass/collision.h"

static const double least_reach = 0.5; // in largest radii
static const double steps_ahead = 8;   // for which the pairs of a fast thread should do

void jn_collision_points(const JnCollision* pass, const double* x, double (*out)[3]) {
	for (int s = 0; s < pass->strand_count; ++s) {
		const JnStrand* strand = &pass->strands[s];
		const double *from = x + 3 * (ptrdiff_t)pass->frame_node[strand->first_frame], *w = strand->axis;
		double(*to)[3] = out + strand->first_frame;
		for (int k = 0; k < strand->frame_count; ++k)
			for (int a = 0; a < 3; ++a)
				to[k][a] = w[0] * from[9 * k + a] + w[1] * from[9 * k + 3 + a] + w[2] * from[9 * k + 6 + a];
	}
	for (int h = 0; h < pass->hide_count; ++h) {
		const JnHide* hide = &pass->hides[h];
		double(*to)[3] = out + pass->frame_count + hide->first_vertex;
		for (int v = 0; v < hide->skin.vertex_count; ++v)
			memcpy(to[v], x + 3 * (ptrdiff_t)hide->skin.nodes[v], sizeof to[v]);
	}
}

double jn_collision_farthest(int count, double (*a)[3], double (*b)[3]) {
	double most = 0;
	for (int k = 0; k < count; ++k) {
		const double x = a[k][0] - b[k][0], y = a[k][1] - b[k][1], z = a[k][2] - b[k][2],
					 square = x * x + y * y + z * z;
		most = square > most ? square : most;
	}
	return most;
}

JnStatus jn_collision_add_watch(JnCollision* pass, JnWatch watch) {
	JN_TRY(
		jn_grow((void**)&pass->watches, &pass->watch_capacity, (size_t)pass->watch_count + 1, sizeof *pass->watches));
	pass->watches[pass->watch_count++] = watch;
	return JN_OK;
}

void jn_collision_link_at(const JnCollision* pass, int link, double out[2][3]) {
	memcpy(out[0], pass->watched[pass->link_ends[link][0]], sizeof out[0]);
	memcpy(out[1], pass->watched[pass->link_ends[link][1]], sizeof out[1]);
}

// ---- links with links

/// Links of one thread that are near each other along it do not collide.
static bool are_apart(const JnCollision* pass, int a, int b) {
	const JnStrand* strand = &pass->strands[pass->link_strand[a]];
	if (pass->link_strand[b] != pass->link_strand[a]) return true;
	int steps = abs(a - b);
	if (strand->is_closed && strand->link_count - steps < steps) steps = strand->link_count - steps;
	return steps >= strand->apart;
}

static JnStatus watch_pair(JnCollision* pass, int a, int b) {
	double first[2][3], second[2][3], share[2], offset[3];
	if (!are_apart(pass, a, b)) return JN_OK;
	const double near =
		pass->strands[pass->link_strand[a]].radius + pass->strands[pass->link_strand[b]].radius + pass->margin;
	jn_collision_link_at(pass, a, first);
	jn_collision_link_at(pass, b, second);
	const double clear = sqrt(jn_segments_nearest(first, second, share, offset)) - near;
	if (clear > 2 * pass->reach) return JN_OK;
	return jn_collision_add_watch(pass, (JnWatch){JN_MEETING_LINKS, a < b ? a : b, a < b ? b : a, 0, clear});
}

/// Half of the 27 cells around a cell, itself first.
static const int around[14][3] = {{0, 0, 0},  {1, 0, 0},  {-1, 1, 0}, {0, 1, 0}, {1, 1, 0},  {-1, -1, 1}, {0, -1, 1},
								  {1, -1, 1}, {-1, 0, 1}, {0, 0, 1},  {1, 0, 1}, {-1, 1, 1}, {0, 1, 1},   {1, 1, 1}};

static JnStatus watch_links(JnCollision* pass) {
	for (int link = 0; link < pass->link_count; ++link)
		for (int k = 0; k < 14; ++k) {
			const int* own = pass->link_cell[link];
			const int cell[3] = {own[0] + around[k][0], own[1] + around[k][1], own[2] + around[k][2]};
			int other = jn_collision_first_in(pass, cell);
			for (; other >= 0; other = jn_collision_next_in(pass, other, cell))
				if (k > 0 || other > link) JN_TRY(watch_pair(pass, link, other));
		}
	return JN_OK;
}

// ---- with obstacles

// Between two frames the distance is at least half of what their distances leave over from the link's length.
static JnStatus watch_obstacle(JnCollision* pass, int index) {
	const JnObstacle* shape = &pass->model->obstacles[index].shape;
	double* distance = pass->frame_distance;
	for (int f = 0; f < pass->frame_count; ++f) {
		double normal[3];
		distance[f] = jn_obstacle_distance(shape, pass->watched[f], normal);
		const double clear = distance[f] - pass->strands[pass->frame_strand[f]].radius - pass->margin;
		if (clear <= pass->reach)
			JN_TRY(jn_collision_add_watch(pass, (JnWatch){JN_MEETING_FRAME_OBSTACLE, f, index, 0, clear}));
	}
	for (int link = 0; link < pass->link_count; ++link) {
		const int* ends = pass->link_ends[link];
		const double length = vec3_distance(pass->watched[ends[0]], pass->watched[ends[1]]);
		const double clear = 0.5 * (distance[ends[0]] + distance[ends[1]] - length) -
							 pass->strands[pass->link_strand[link]].radius - pass->margin;
		if (clear <= pass->reach)
			JN_TRY(jn_collision_add_watch(pass, (JnWatch){JN_MEETING_LINK_OBSTACLE, link, index, 0, clear}));
	}
	return JN_OK;
}

// ---- all of them

static uint64_t rank(const JnWatch* watch) {
	return (uint64_t)watch->kind << 60 | (uint64_t)watch->hide << 48 | (uint64_t)watch->first << 24 |
		   (uint64_t)watch->second;
}

static void sink(JnWatch* heap, int count, int at) {
	const JnWatch watch = heap[at];
	for (int child = 2 * at + 1; child < count; at = child, child = 2 * at + 1) {
		if (child + 1 < count && rank(&heap[child + 1]) > rank(&heap[child])) ++child;
		if (rank(&heap[child]) <= rank(&watch)) break;
		heap[at] = heap[child];
	}
	heap[at] = watch;
}

/// In an order that does not depend on when the pairs were chosen; a heap, as qsort allocates.
static void sort(JnWatch* watches, int count) {
	for (int at = count / 2 - 1; at >= 0; --at) sink(watches, count, at);
	for (int end = count - 1; end > 0; --end) {
		const JnWatch last = watches[end];
		watches[end] = watches[0];
		watches[0] = last;
		sink(watches, end, 0);
	}
}

static double longest_link(const JnCollision* pass) {
	double longest = 0;
	for (int link = 0; link < pass->link_count; ++link)
		longest = fmax(longest,
					   vec3_distance(pass->watched[pass->link_ends[link][0]], pass->watched[pass->link_ends[link][1]]));
	return longest;
}

static JnStatus choose(JnCollision* pass, double travel) {
	const int points = pass->frame_count + pass->vertex_count;
	const double radius = pass->largest_radius;
	memcpy(pass->watched, pass->start, (size_t)points * sizeof *pass->watched);
	const double length = longest_link(pass);
	pass->reach = fmax(fmax(least_reach * radius, travel), fmin(steps_ahead * travel, 0.5 * length + radius));
	const double width = length + 2 * radius + pass->margin + 2 * pass->reach;
	pass->watch_count = 0;
	jn_collision_fill_grid(pass, width);
	JN_TRY(watch_links(pass));
	for (int i = 0; i < pass->model->obstacle_count; ++i) JN_TRY(watch_obstacle(pass, i));
	JN_TRY(jn_collision_watch_hides(pass, length));
	sort(pass->watches, pass->watch_count);
	pass->is_watching = true;
	return JN_OK;
}

// Between start and end a frame is on the line between them, and a link's points are between its frames: nothing of a link is
// farther from where it was than its frames are.
static void measure_travel(JnCollision* pass) {
	for (int f = 0; f < pass->frame_count; ++f) {
		const double *from = pass->watched[f], *a = pass->start[f], *b = pass->end[f];
		const double x[3] = {a[0] - from[0], a[1] - from[1], a[2] - from[2]};
		const double y[3] = {b[0] - from[0], b[1] - from[1], b[2] - from[2]};
		const double s = vec3_dot(x, x), e = vec3_dot(y, y);
		pass->travelled[f] = sqrt(s > e ? s : e);
	}
}

static JnStatus look_around(JnCollision* pass) {
	const int points = pass->frame_count + pass->vertex_count;
	pass->is_watching = false;
	const double travel = sqrt(jn_collision_farthest(points, pass->start, pass->end));
	if (!isfinite(travel)) return JN_NOT_FINITE;
	pass->ran_away = travel > JN_COLLISION_TOO_FAR * pass->extent ? travel : 0;
	return pass->ran_away == 0 ? choose(pass, travel) : JN_NOT_CONVERGED;
}

// The end of a step is the start of the next.
static void find_start(JnCollision* pass, const JnState* start) {
	if (pass->start_stamp == start->stamp) return;
	pass->start_stamp = start->stamp;
	if (pass->moved_stamp != start->stamp) {
		jn_collision_points(pass, start->x, pass->start);
		return;
	}
	double(*points)[3] = pass->start;
	pass->start = pass->moved;
	pass->moved = points;
	pass->moved_stamp = 0;
}

JnStatus jn_collision_watch(JnCollision* pass, const JnStep* step) {
	const int points = pass->frame_count + pass->vertex_count;
	find_start(pass, step->start);
	jn_collision_points(pass, step->end->x, pass->end);
	const double limit = pass->reach * pass->reach;
	if (!pass->is_watching || !(jn_collision_farthest(points, pass->start, pass->watched) <= limit) ||
		!(jn_collision_farthest(points, pass->end, pass->watched) <= limit))
		JN_TRY(look_around(pass));
	measure_travel(pass);
	return JN_OK;
}
