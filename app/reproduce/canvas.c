#include "reproduce/canvas.h"

#include <math.h>
#include <stddef.h>

#include "math/vec3.h"

static const double lights[2][4] = {{-0.45, 0.65, 0.61, 0.72},
									{0.75, 0.05, 0.66, 0.30}}; // direction in view axes, strength

static void shade(const double raw[3], const Paint* paint, float out[3]) {
	double normal[3] = {raw[0], raw[1], raw[2]};
	vec3_normalize(normal);
	const double side = normal[2] < 0 ? -1 : 1; // sheets have two sides, and inverted elements show their inside
	double diffuse = 0.26, gloss = 0;
	for (int i = 0; i < 3; ++i) normal[i] *= side;
	for (int l = 0; l < 2; ++l) {
		double half[3] = {lights[l][0], lights[l][1], lights[l][2] + 1};
		vec3_normalize(half);
		diffuse += lights[l][3] * fmax(vec3_dot(normal, lights[l]), 0);
		gloss += paint->gloss * lights[l][3] * pow(fmax(vec3_dot(normal, half), 0), 40);
	}
	for (int i = 0; i < 3; ++i) out[i] = (float)fmin(diffuse * paint->colour[i] + gloss, 1);
}

static double twice_area(const Corner* a, const Corner* b, double x, double y) {
	return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static void fill_pixel(Canvas* canvas, const Corner c[3], const double w[3], const Paint* paint, int x, int y) {
	const size_t at = (size_t)y * (size_t)canvas->width + (size_t)x;
	const float depth = (float)(w[0] * c[0].depth + w[1] * c[1].depth + w[2] * c[2].depth);
	if (depth <= canvas->depth[at]) return;
	const float cover = (float)(w[0] * c[0].cover + w[1] * c[1].cover + w[2] * c[2].cover);
	double normal[3];
	float colour[3];
	for (int i = 0; i < 3; ++i) normal[i] = w[0] * c[0].normal[i] + w[1] * c[1].normal[i] + w[2] * c[2].normal[i];
	canvas->depth[at] = depth;
	shade(normal, paint, colour);
	for (size_t i = 0; i < 3; ++i) {
		float* under = canvas->colour + 3 * at + i;
		*under += cover * (colour[i] - *under);
	}
}

void canvas_fill(Canvas* canvas, const Corner c[3], const Paint* paint) {
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
			if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) fill_pixel(canvas, c, w, paint, x, y);
		}
}

void canvas_ball(Canvas* canvas, const Corner* at, double radius, double depth, const Paint* paint) {
	const double reach = fmax(radius, 0.5);
	const int left = (int)fmax(ceil(at->x - reach - 0.5), 0), top = (int)fmax(ceil(at->y - reach - 0.5), 0);
	const int right = (int)fmin(floor(at->x + reach - 0.5), canvas->width - 1);
	const int bottom = (int)fmin(floor(at->y + reach - 0.5), canvas->height - 1);
	for (int y = top; y <= bottom; ++y)
		for (int x = left; x <= right; ++x) {
			Corner point = *at;
			point.normal[0] = (x + 0.5 - at->x) / reach;
			point.normal[1] = (at->y - y - 0.5) / reach;
			const double rest = 1 - point.normal[0] * point.normal[0] - point.normal[1] * point.normal[1];
			point.normal[2] = sqrt(fmax(rest, 0));
			point.depth += depth * point.normal[2];
			const Corner same[3] = {point, point, point};
			if (rest >= 0) fill_pixel(canvas, same, (const double[3]){1, 0, 0}, paint, x, y);
		}
}

void canvas_reduce(const Canvas* canvas, int stride, unsigned char* pixels) {
	for (int y = 0; y < canvas->height / CANVAS_FINER; ++y)
		for (int x = 0; x < canvas->width / CANVAS_FINER; ++x)
			for (int c = 0; c < 3; ++c) {
				float sum = 0;
				for (int i = 0; i < CANVAS_FINER * CANVAS_FINER; ++i) {
					const int fine_x = CANVAS_FINER * x + i % CANVAS_FINER,
							  fine_y = CANVAS_FINER * y + i / CANVAS_FINER;
					sum += canvas->colour[3 * ((size_t)fine_y * (size_t)canvas->width + (size_t)fine_x) + (size_t)c];
				}
				pixels[3 * ((size_t)y * (size_t)stride + (size_t)x) + (size_t)c] =
					(unsigned char)(255 * sum / (CANVAS_FINER * CANVAS_FINER) + 0.5F);
			}
}
