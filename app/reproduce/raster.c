// Each panel is drawn at twice its size and averaged. A corner of a triangle is lit by the mean normal of the triangles
// around it, or by its own where the two are far apart (an edge).
#include "reproduce/raster.h"

#include <math.h>
#include <string.h>

#include "math/vec3.h"

enum { FINER = 2, COLOURS = 4 };

static const double edge_cosine = 0.72; // beyond some 44 degrees an edge is shown; on those of a box it is 45
static const double colours[COLOURS][3] = {
	{0.93, 0.45, 0.20}, {0.20, 0.52, 0.78}, {0.30, 0.66, 0.42}, {0.72, 0.72, 0.74}};
static const double lights[2][4] = {{-0.45, 0.65, 0.61, 0.72},
									{0.75, 0.05, 0.66, 0.30}}; // direction in view axes, strength

typedef struct Corner {
	double x, y, depth; // pixels, pixels, metres towards the camera
	double normal[3];   // in view axes
} Corner;

typedef struct Canvas {
	int width, height;
	float* depth;
	float* colour; // 3 a pixel
} Canvas;

static void to_axes(const View* view, const double p[3], double out[3]) {
	out[0] = vec3_dot(p, view->right);
	out[1] = vec3_dot(p, view->up);
	out[2] = vec3_dot(p, view->back);
}

// ---- the camera ----

static void bound(const Picture* picture, const View* view, double low[3], double high[3]) {
	for (int i = 0; i < 3; ++i) low[i] = INFINITY, high[i] = -INFINITY;
	for (int p = 0; p < picture->count; ++p)
		for (int i = 0; i < 3 * picture->panels[p].triangle_count; ++i) {
			double at[3];
			to_axes(view, picture->panels[p].points + 3 * (size_t)picture->panels[p].triangles[i], at);
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
				 .width = FINER * picture->width,
				 .height = FINER * picture->height};
	double low[3], high[3];
	vec3_cross(world_up, view.back, view.right);
	vec3_normalize(view.right);
	vec3_cross(view.back, view.right, view.up);
	bound(picture, &view, low, high);
	const double wide = fmax(high[0] - low[0], 1e-9), tall = fmax(high[1] - low[1], 1e-9);
	for (int i = 0; i < 3; ++i) view.middle[i] = (low[i] + high[i]) / 2;
	view.distance = 3 * fmax(fmax(wide, tall), high[2] - low[2]);
	const double nearer = 1 - (high[2] - view.middle[2]) / view.distance; // the front is drawn larger by 1 / nearer
	view.scale = 0.94 * nearer * fmin(view.width / wide, view.height / tall);
	return view;
}

// ---- geometry ----

static void project(const View* view, const double p[3], Corner* corner) {
	double at[3];
	to_axes(view, p, at);
	for (int i = 0; i < 3; ++i) at[i] -= view->middle[i];
	const double scale = view->scale / (1 - at[2] / view->distance);
	*corner = (Corner){.x = view->width / 2.0 + scale * at[0], .y = view->height / 2.0 - scale * at[1], .depth = at[2]};
}

// Twice the area times the outward normal.
static void face_normal(const Panel* panel, int triangle, double out[3]) {
	const int* t = panel->triangles + 3 * (size_t)triangle;
	double edges[2][3];
	for (int i = 0; i < 3; ++i) {
		const double start = panel->points[3 * (size_t)t[0] + (size_t)i];
		edges[0][i] = panel->points[3 * (size_t)t[1] + (size_t)i] - start;
		edges[1][i] = panel->points[3 * (size_t)t[2] + (size_t)i] - start;
	}
	vec3_cross(edges[0], edges[1], out);
}

static void add_normals(const Panel* panel, double* normals) {
	for (int i = 0; i < panel->triangle_count; ++i) {
		double normal[3];
		face_normal(panel, i, normal);
		for (int c = 0; c < 9; ++c)
			normals[3 * (size_t)panel->triangles[3 * i + c / 3] + (size_t)(c % 3)] += normal[c % 3];
	}
	for (int i = 0; i < panel->point_count; ++i) vec3_normalize(normals + 3 * (size_t)i);
}

// ---- light ----

static void shade(const double raw[3], int body, float out[3]) {
	double normal[3] = {raw[0], raw[1], raw[2]};
	vec3_normalize(normal);
	const double side = normal[2] < 0 ? -1 : 1; // sheets have two sides, and inverted elements show their inside
	double diffuse = 0.26, gloss = 0;
	for (int i = 0; i < 3; ++i) normal[i] *= side;
	for (int l = 0; l < 2; ++l) {
		double half[3] = {lights[l][0], lights[l][1], lights[l][2] + 1};
		vec3_normalize(half);
		diffuse += lights[l][3] * fmax(vec3_dot(normal, lights[l]), 0);
		gloss += 0.35 * lights[l][3] * pow(fmax(vec3_dot(normal, half), 0), 40);
	}
	for (int i = 0; i < 3; ++i) out[i] = (float)fmin(diffuse * colours[body % COLOURS][i] + gloss, 1);
}

static double twice_area(const Corner* a, const Corner* b, double x, double y) {
	return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static void fill_pixel(Canvas* canvas, const Corner c[3], const double w[3], int body, int x, int y) {
	const size_t at = (size_t)y * (size_t)canvas->width + (size_t)x;
	const float depth = (float)(w[0] * c[0].depth + w[1] * c[1].depth + w[2] * c[2].depth);
	if (depth <= canvas->depth[at]) return;
	double normal[3];
	for (int i = 0; i < 3; ++i) normal[i] = w[0] * c[0].normal[i] + w[1] * c[1].normal[i] + w[2] * c[2].normal[i];
	canvas->depth[at] = depth;
	shade(normal, body, canvas->colour + 3 * at);
}

static void fill(Canvas* canvas, const Corner c[3], int body) {
	const double area = twice_area(&c[0], &c[1], c[2].x, c[2].y);
	if (!(fabs(area) > 1e-9)) return;
	const int left = (int)fmax(floor(fmin(c[0].x, fmin(c[1].x, c[2].x))), 0);
	const int right = (int)fmin(ceil(fmax(c[0].x, fmax(c[1].x, c[2].x))), canvas->width - 1);
	const int top = (int)fmax(floor(fmin(c[0].y, fmin(c[1].y, c[2].y))), 0);
	const int bottom = (int)fmin(ceil(fmax(c[0].y, fmax(c[1].y, c[2].y))), canvas->height - 1);
	for (int y = top; y <= bottom; ++y)
		for (int x = left; x <= right; ++x) {
			const double px = x + 0.5, py = y + 0.5;
			const double w[3] = {twice_area(&c[1], &c[2], px, py) / area, twice_area(&c[2], &c[0], px, py) / area,
								 twice_area(&c[0], &c[1], px, py) / area};
			if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) fill_pixel(canvas, c, w, body, x, y);
		}
}

static void draw_triangle(Canvas* canvas, const Panel* panel, const View* view, const double* normals, int triangle) {
	Corner corners[3];
	double own[3];
	face_normal(panel, triangle, own);
	vec3_normalize(own);
	for (int i = 0; i < 3; ++i) {
		const size_t node = (size_t)panel->triangles[3 * triangle + i];
		project(view, panel->points + 3 * node, &corners[i]);
		const double* smooth = normals + 3 * node;
		to_axes(view, vec3_dot(smooth, own) > edge_cosine ? smooth : own, corners[i].normal);
	}
	fill(canvas, corners, panel->bodies[triangle]);
}

// The mean of the finer pixels.
static void reduce(const Canvas* canvas, int stride, unsigned char* pixels) {
	for (int y = 0; y < canvas->height / FINER; ++y)
		for (int x = 0; x < canvas->width / FINER; ++x)
			for (int c = 0; c < 3; ++c) {
				float sum = 0;
				for (int i = 0; i < FINER * FINER; ++i) {
					const int fine_x = FINER * x + i % FINER, fine_y = FINER * y + i / FINER;
					sum += canvas->colour[3 * ((size_t)fine_y * (size_t)canvas->width + (size_t)fine_x) + (size_t)c];
				}
				pixels[3 * ((size_t)y * (size_t)stride + (size_t)x) + (size_t)c] =
					(unsigned char)(255 * sum / (FINER * FINER) + 0.5F);
			}
}

JnStatus raster_panel(const Panel* panel, const View* view, int stride, unsigned char* pixels) {
	JnArena arena = {0};
	const size_t size = (size_t)view->width * (size_t)view->height;
	Canvas canvas = {.width = view->width, .height = view->height};
	canvas.depth = jn_arena_take(&arena, size, sizeof *canvas.depth);
	canvas.colour = jn_arena_take(&arena, size, 3 * sizeof *canvas.colour);
	double* normals = jn_arena_take(&arena, (size_t)panel->point_count, 3 * sizeof *normals);
	const bool has_room = canvas.depth != NULL && canvas.colour != NULL && normals != NULL;
	for (size_t i = 0; has_room && i < size; ++i) canvas.depth[i] = -INFINITY;
	for (size_t i = 0; has_room && i < 3 * size; ++i) canvas.colour[i] = 0.965F;
	if (has_room) add_normals(panel, normals);
	for (int i = 0; has_room && i < panel->triangle_count; ++i) draw_triangle(&canvas, panel, view, normals, i);
	if (has_room) reduce(&canvas, stride, pixels);
	jn_arena_free(&arena);
	return has_room ? JN_OK : JN_OUT_OF_MEMORY;
}
