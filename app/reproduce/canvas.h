/// @file canvas.h
/// Pixels with a depth buffer, and lit triangles drawn into them.
#ifndef JN_APP_REPRODUCE_CANVAS_H
#define JN_APP_REPRODUCE_CANVAS_H

enum { CANVAS_FINER = 2 }; ///< pixels of a canvas along each side of a pixel of the picture

typedef struct Canvas {
	int width, height;
	float* depth;
	float* colour; ///< 3 a pixel, 0 .. 1
} Canvas;

typedef struct Corner {
	double x, y, depth; ///< pixels, pixels, metres towards the camera
	double normal[3];   ///< in view axes, of any length
	double cover;       ///< 1: opaque; 0: nothing to be seen
} Corner;

typedef struct Paint {
	double colour[3];
	double gloss; ///< 0: dull
} Paint;

/// Draw a triangle where nothing is in front of it.
void canvas_fill(Canvas* canvas, const Corner corners[3], const Paint* paint);

/// Draw a ball with its middle at `at`, whose normal does not matter: `radius` in pixels, `depth` its radius in metres.
/// It is one pixel wide at least.
void canvas_ball(Canvas* canvas, const Corner* at, double radius, double depth, const Paint* paint);

/// The means of the finer pixels, as bytes, to an array that is `stride` pixels wide.
void canvas_reduce(const Canvas* canvas, int stride, unsigned char* pixels);

#endif
