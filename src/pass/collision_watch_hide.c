// Which frames and links may meet triangles and edges of surfaces: those whose middles are in the cells about them.
#include <math.h>
#include <string.h>

#include "detect/segment.h"
#include "math/vec3.h"
#include "mesh/triangle_tree.h"
#include "pass/collision.h"

typedef struct Box {
	double low[3], high[3];
} Box;

static Box box_around(int count, const double* const points[], double margin) {
	Box box;
	for (int a = 0; a < 3; ++a) {
		box.low[a] = box.high[a] = points[0][a];
		for (int i = 1; i < count; ++i) {
			box.low[a] = fmin(box.low[a], points[i][a]);
			box.high[a] = fmax(box.high[a], points[i][a]);
		}
		box.low[a] -= margin;
		box.high[a] += margin;
	}
	return box;
}

static bool boxes_meet(const Box* a, const Box* b) {
	for (int k = 0; k < 3; ++k)
		if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return false;
	return true;
}

typedef JnStatus See(JnCollision* pass, int hide, int item, int link);

static JnStatus see_all(JnCollision* pass, See* see, int hide, int item) {
	for (int link = 0; link < pass->link_count; ++link) JN_TRY(see(pass, hide, item, link));
	return JN_OK;
}

/// Call `see` for all links whose middles may be within the box. A large triangle has more cells about it than there are links.
static JnStatus search_links(JnCollision* pass, const Box* box, See* see, int hide, int item) {
	int low[3], high[3], cell[3];
	double cells = 1;
	jn_collision_cell_of(pass, box->low, low);
	jn_collision_cell_of(pass, box->high, high);
	for (int a = 0; a < 3; ++a) cells *= 1.0 + high[a] - low[a];
	if (cells > pass->link_count) return see_all(pass, see, hide, item);
	for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
		for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
			for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
				int link = jn_collision_first_in(pass, cell);
				for (; link >= 0; link = jn_collision_next_in(pass, link, cell)) JN_TRY(see(pass, hide, item, link));
			}
	return JN_OK;
}

static JnStatus see_triangle(JnCollision* pass, int hide, int triangle, int link) {
	const double* corners[3];
	const JnStrand* strand = &pass->strands[pass->link_strand[link]];
	const double near = strand->radius + pass->margin + 2 * pass->reach;
	const bool is_last = !strand->is_closed && link == strand->first_link + strand->link_count - 1;
	for (int i = 0; i < 3; ++i)
		corners[i] = pass->watched[jn_collision_vertex(pass, hide, pass->hides[hide].skin.triangles[3 * triangle + i])];
	for (int e = 0; e < (is_last ? 2 : 1); ++e) {
		const int frame = pass->link_ends[link][e];
		double weights[3], nearest[3];
		jn_triangle_nearest(corners[0], corners[1], corners[2], pass->watched[frame], weights);
		for (int a = 0; a < 3; ++a)
			nearest[a] = weights[0] * corners[0][a] + weights[1] * corners[1][a] + weights[2] * corners[2][a];
		if (vec3_distance(nearest, pass->watched[frame]) <= near)
			JN_TRY(jn_collision_add_watch(pass, (JnWatch){JN_MEETING_FRAME_TRIANGLE, frame, triangle, hide, 0}));
	}
	return JN_OK;
}

static JnStatus see_edge(JnCollision* pass, int hide, int edge, int link) {
	double own[2][3], other[2][3], share[2], offset[3];
	const double near = pass->strands[pass->link_strand[link]].radius + pass->margin + 2 * pass->reach;
	jn_collision_link_at(pass, link, own);
	for (int i = 0; i < 2; ++i)
		memcpy(other[i], pass->watched[jn_collision_vertex(pass, hide, pass->hides[hide].edges[edge][i])],
			   sizeof other[i]);
	if (jn_segments_nearest(own, other, share, offset) > near * near) return JN_OK;
	return jn_collision_add_watch(pass, (JnWatch){JN_MEETING_LINK_EDGE, link, edge, hide, 0});
}

static JnStatus watch_hide(JnCollision* pass, int index, const Box* all, double length) {
	const JnHide* hide = &pass->hides[index];
	const double margin = pass->largest_radius + pass->margin + 2 * pass->reach, half = 0.5 * length;
	const double* at[3];
	for (int t = 0; t < hide->skin.triangle_count; ++t) {
		for (int i = 0; i < 3; ++i)
			at[i] = pass->watched[jn_collision_vertex(pass, index, hide->skin.triangles[3 * t + i])];
		const Box box = box_around(3, at, margin + half);
		if (boxes_meet(&box, all)) JN_TRY(search_links(pass, &box, see_triangle, index, t));
	}
	for (int e = 0; e < hide->edge_count; ++e) {
		for (int i = 0; i < 2; ++i) at[i] = pass->watched[jn_collision_vertex(pass, index, hide->edges[e][i])];
		const Box box = box_around(2, at, margin + half);
		if (boxes_meet(&box, all)) JN_TRY(search_links(pass, &box, see_edge, index, e));
	}
	return JN_OK;
}

static Box box_of_frames(const JnCollision* pass) {
	Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
	for (int f = 0; f < pass->frame_count; ++f)
		for (int a = 0; a < 3; ++a) {
			box.low[a] = fmin(box.low[a], pass->watched[f][a]);
			box.high[a] = fmax(box.high[a], pass->watched[f][a]);
		}
	return box;
}

JnStatus jn_collision_watch_hides(JnCollision* pass, double length) {
	const Box all = box_of_frames(pass);
	for (int h = 0; h < pass->hide_count; ++h) JN_TRY(watch_hide(pass, h, &all, length));
	return JN_OK;
}
