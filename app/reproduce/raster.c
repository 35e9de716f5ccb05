// Each panel is drawn at twice its size and averaged. A corner of a triangle is lit by the mean normal of the triangles
// around it, or by its own where the two are far apart (an edge). Obstacles may be of any size, and the view is that of
// the bodies: so they are seen from outside only, cut into pieces as large as the view, and fade away around it.
#include "reproduce/raster.h"

#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "reproduce/canvas.h"

enum { TURNS = 4 }; // paints of bodies that are given none

// Beyond these angles, some 44 and 18 degrees, an edge is shown. On those of a box of even cells it is 45; where only
// its corners have normals, as in an obstacle, they lean to its larger sides.
static const double body_edge = 0.72, obstacle_edge = 0.95;
static const Paint body_paints[] = {
	[PAINT_ORANGE] = {{0.93, 0.45, 0.20}, 0.35}, [PAINT_BLUE] = {{0.20, 0.52, 0.78}, 0.35},
	[PAINT_GREEN] = {{0.30, 0.66, 0.42}, 0.35},  [PAINT_GREY] = {{0.72, 0.72, 0.74}, 0.35},
	[PAINT_YELLOW] = {{1.00, 0.80, 0.10}, 0.35}, [PAINT_RED] = {{0.86, 0.22, 0.24}, 0.35},
	[PAINT_TEAL] = {{0.16, 0.62, 0.64}, 0.20},   [PAINT_VIOLET] = {{0.52, 0.40, 0.72}, 0.20},
	[PAINT_OLIVE] = {{0.55, 0.60, 0.36}, 0.25}};
static const Paint obstacle_paint = {{0.88, 0.88, 0.88}, 0};

// A corner of a triangle before it is projected.
typedef struct Vertex {
	double at[3];     // in view axes, from the middle of the view [m]
	double normal[3]; // in view axes
} Vertex;

// How far around the middle of the view obstacles are seen: all of them up to `inner`, none beyond `outer` [m].
typedef struct Fading {
	double inner, outer;
} Fading;

static void to_axes(const View* view, const double p[3], double out[3]) {
	out[0] = vec3_dot(p, view->right);
	out[1] = vec3_dot(p, view->up);
	out[2] = vec3_dot(p, view->back);
}

// ---- the camera ----

static void bound_points(const PanelPoints* points, const View* view, double low[3], double high[3]) {
	for (int i = 0; i < points->count; ++i) {
		double at[3];
		to_axes(view, points->at + 3 * (size_t)i, at);
		for (int c = 0; c < 3; ++c) {
			low[c] = fmin(low[c], at[c] - points->paint.radius);
			high[c] = fmax(high[c], at[c] + points->paint.radius);
		}
	}
}

static void bound(const Picture* picture, const View* view, double low[3], double high[3]) {
	for (int i = 0; i < 3; ++i) low[i] = INFINITY, high[i] = -INFINITY;
	for (int p = 0; p < picture->count; ++p) bound_points(&picture->panels[p].points, view, low, high);
	for (int p = 0; p < picture->count; ++p)
		for (int i = 0; i < 3 * picture->panels[p].surface.triangle_count; ++i) {
			const JnSurface* surface = &picture->panels[p].surface;
			if (picture->focus > 0 && picture->panels[p].bodies[i / 3] >= picture->focus) continue;
			double at[3];
			to_axes(view, surface->nodes + 3 * (size_t)surface->triangles[i], at);
			for (int c = 0; c < 3; ++c) {
				low[c] = fmin(low[c], at[c]);
				high[c] = fmax(high[c], at[c]);
			}
		}
}

View raster_view(const Picture* picture) {
	const double degree = acos(-1.0) / 180, world_up[3] = {0, 1, 0};
	const double a = picture->camera.azimuth * degree, e = picture->camera.elevation * degree;
	View view = {.back = {sin(a) * cos(e), sin(e), cos(a) * cos(e)},
				 .width = CANVAS_FINER * picture->width,
				 .height = CANVAS_FINER * picture->height};
	double low[3], high[3];
	vec3_cross(world_up, view.back, view.right);
	vec3_normalize(view.right);
	vec3_cross(view.back, view.right, view.up);
	bound(picture, &view, low, high);
	const double wide = fmax(high[0] - low[0], 1e-9), tall = fmax(high[1] - low[1], 1e-9);
	for (int i = 0; i < 3; ++i) view.middle[i] = (low[i] + high[i]) / 2;
	view.distance = 3 * fmax(fmax(wide, tall), high[2] - low[2]);
	const double nearer = 1 - (high[2] - view.middle[2]) / view.distance; // the front is drawn larger by 1 / nearer
	const double filled = picture->focus > 0 ? 0.72 : 0.94;               // others are seen around those in focus
	view.scale = filled * nearer * fmin(view.width / wide, view.height / tall);
	return view;
}

// ---- geometry ----

// Twice the area times the outward normal.
static void face_normal(const JnSurface* surface, int triangle, double out[3]) {
	const int* t = surface->triangles + 3 * (size_t)triangle;
	vec3_triangle(surface->nodes + 3 * (size_t)t[0], surface->nodes + 3 * (size_t)t[1],
				  surface->nodes + 3 * (size_t)t[2], out);
}

static void add_normals(const JnSurface* surface, double* normals) {
	for (int i = 0; i < surface->triangle_count; ++i) {
		double normal[3];
		face_normal(surface, i, normal);
		for (int c = 0; c < 9; ++c)
			normals[3 * (size_t)surface->triangles[3 * i + c / 3] + (size_t)(c % 3)] += normal[c % 3];
	}
	for (int i = 0; i < surface->node_count; ++i) vec3_normalize(normals + 3 * (size_t)i);
}

static void place_triangle(const JnSurface* surface, const View* view, const double* normals, double edge, int triangle,
						   Vertex vertices[3]) {
	double own[3];
	face_normal(surface, triangle, own);
	vec3_normalize(own);
	for (int i = 0; i < 3; ++i) {
		const size_t node = (size_t)surface->triangles[3 * triangle + i];
		const double* smooth = normals + 3 * node;
		to_axes(view, surface->nodes + 3 * node, vertices[i].at);
		for (int c = 0; c < 3; ++c) vertices[i].at[c] -= view->middle[c];
		to_axes(view, vec3_dot(smooth, own) > edge ? smooth : own, vertices[i].normal);
	}
}

static Corner project(const View* view, const Vertex* vertex, double cover) {
	const double scale = view->scale / (1 - vertex->at[2] / view->distance);
	Corner corner = {.x = view->width / 2.0 + scale * vertex->at[0],
					 .y = view->height / 2.0 - scale * vertex->at[1],
					 .depth = vertex->at[2],
					 .cover = cover};
	memcpy(corner.normal, vertex->normal, sizeof corner.normal);
	return corner;
}

// At the camera or behind it, as bodies out of focus may be.
static bool is_behind(const View* view, const Vertex v[3]) {
	return fmax(v[0].at[2], fmax(v[1].at[2], v[2].at[2])) > 0.8 * view->distance;
}

static const Paint* paint_of(const Panel* panel, int triangle) {
	const int body = panel->bodies[triangle];
	return &body_paints[body < panel->paint_count ? (int)panel->paints[body] : body % TURNS];
}

static void draw_bodies(Canvas* canvas, const Panel* panel, const View* view, const double* normals) {
	for (int i = 0; i < panel->surface.triangle_count; ++i) {
		Vertex vertices[3];
		Corner corners[3];
		place_triangle(&panel->surface, view, normals, body_edge, i, vertices);
		if (is_behind(view, vertices)) continue;
		for (int k = 0; k < 3; ++k) corners[k] = project(view, &vertices[k], 1);
		canvas_fill(canvas, corners, paint_of(panel, i));
	}
}

// ---- points ----

// From pale over orange to dark red.
static Paint paint_at(const PointPaint* paint, double value) {
	static const double colours[][3] = {{0.80, 0.84, 0.88}, {0.95, 0.66, 0.30}, {0.80, 0.16, 0.12}, {0.38, 0.02, 0.05}};
	enum { STEPS = sizeof colours / sizeof *colours - 1 };
	const double place = STEPS * fmax(0, fmin((value - paint->low) / (paint->high - paint->low), 1));
	const int below = (int)fmin(place, STEPS - 1);
	Paint out = {.gloss = 0.1};
	for (int c = 0; c < 3; ++c)
		out.colour[c] = colours[below][c] + (place - below) * (colours[below + 1][c] - colours[below][c]);
	return out;
}

static void draw_points(Canvas* canvas, const PanelPoints* points, const View* view) {
	for (int i = 0; i < points->count; ++i) {
		Vertex vertex = {0};
		to_axes(view, points->at + 3 * (size_t)i, vertex.at);
		for (int c = 0; c < 3; ++c) vertex.at[c] -= view->middle[c];
		if (vertex.at[2] > 0.8 * view->distance) continue;
		const Corner corner = project(view, &vertex, 1);
		const Paint paint = paint_at(&points->paint, points->values[i]);
		const double scale = view->scale / (1 - vertex.at[2] / view->distance);
		canvas_ball(canvas, &corner, scale * points->paint.radius, points->paint.radius, &paint);
	}
}

// ---- obstacles ----

static Fading fading_of(const View* view) {
	const double half = fmax(view->width, view->height) / (2 * view->scale);
	const double outer = fmin(1.8 * half, 0.6 * view->distance); // well before the camera
	return (Fading){.inner = outer / 2, .outer = outer};
}

static double cover_at(const Fading* fading, const double at[3]) {
	const double share = (fading->outer - vec3_length(at)) / (fading->outer - fading->inner);
	const double s = fmax(0, fmin(1, share));
	return s * s * (3 - 2 * s);
}

// No point of the triangle is farther from its middle than the farthest corner.
static bool is_out_of_sight(const Fading* fading, const Vertex v[3]) {
	double middle[3], radius = 0;
	for (int c = 0; c < 3; ++c) middle[c] = (v[0].at[c] + v[1].at[c] + v[2].at[c]) / 3;
	for (int i = 0; i < 3; ++i) radius = fmax(radius, vec3_distance(middle, v[i].at));
	return vec3_length(middle) - radius > fading->outer;
}

static Vertex between(const Vertex* a, const Vertex* b) {
	Vertex middle;
	for (int c = 0; c < 3; ++c) {
		middle.at[c] = (a->at[c] + b->at[c]) / 2;
		middle.normal[c] = (a->normal[c] + b->normal[c]) / 2;
	}
	return middle;
}

// Halve the longest edge until the pieces are small against the fading. A piece of a huge triangle that is out of sight
// goes at once, so that few are left.
static void draw_piece(Canvas* canvas, const View* view, const Fading* fading, const Vertex v[3]) {
	if (is_out_of_sight(fading, v)) return;
	int longest = 0;
	double length = 0;
	for (int i = 0; i < 3; ++i) {
		const double edge = vec3_distance(v[i].at, v[(i + 1) % 3].at);
		if (edge > length) length = edge, longest = i;
	}
	if (length > fading->outer / 12) {
		const Vertex *a = &v[longest], *b = &v[(longest + 1) % 3], *c = &v[(longest + 2) % 3], middle = between(a, b);
		draw_piece(canvas, view, fading, (Vertex[3]){*a, middle, *c});
		draw_piece(canvas, view, fading, (Vertex[3]){middle, *b, *c});
		return;
	}
	Corner corners[3];
	for (int i = 0; i < 3; ++i) corners[i] = project(view, &v[i], cover_at(fading, v[i].at));
	canvas_fill(canvas, corners, &obstacle_paint);
}

static bool faces_camera(const View* view, const Vertex v[3]) {
	double area[3];
	vec3_triangle(v[0].at, v[1].at, v[2].at, area);
	const double to_camera[3] = {-v[0].at[0], -v[0].at[1], view->distance - v[0].at[2]};
	return vec3_dot(area, to_camera) > 0;
}

// After the bodies, as they fade into what is behind them.
static void draw_obstacles(Canvas* canvas, const Panel* panel, const View* view, const double* normals) {
	const Fading fading = fading_of(view);
	for (int i = 0; i < panel->obstacles.triangle_count; ++i) {
		Vertex vertices[3];
		place_triangle(&panel->obstacles, view, normals, obstacle_edge, i, vertices);
		if (faces_camera(view, vertices)) draw_piece(canvas, view, &fading, vertices);
	}
}

JnStatus raster_panel(const Panel* panel, const View* view, int stride, unsigned char* pixels) {
	JnArena arena = {0};
	const size_t size = (size_t)view->width * (size_t)view->height;
	const size_t points = (size_t)panel->surface.node_count, others = (size_t)panel->obstacles.node_count;
	Canvas canvas = {.width = view->width, .height = view->height};
	canvas.depth = jn_arena_take(&arena, size, sizeof *canvas.depth);
	canvas.colour = jn_arena_take(&arena, size, 3 * sizeof *canvas.colour);
	double* normals = jn_arena_take(&arena, points + others, 3 * sizeof *normals);
	const bool has_room = canvas.depth != NULL && canvas.colour != NULL && normals != NULL;
	for (size_t i = 0; has_room && i < size; ++i) canvas.depth[i] = -INFINITY;
	for (size_t i = 0; has_room && i < 3 * size; ++i) canvas.colour[i] = 0.965F;
	if (has_room) {
		add_normals(&panel->surface, normals);
		add_normals(&panel->obstacles, normals + 3 * points);
		draw_bodies(&canvas, panel, view, normals);
		draw_points(&canvas, &panel->points, view);
		draw_obstacles(&canvas, panel, view, normals + 3 * points);
		canvas_reduce(&canvas, stride, pixels);
	}
	jn_arena_free(&arena);
	return has_room ? JN_OK : JN_OUT_OF_MEMORY;
}
