/// @file render_shoot.h
/// Pictures of recordings: the viewer's page draws them in a browser without a window, and hands them to this process.
#ifndef JN_APP_RENDER_SHOOT_H
#define JN_APP_RENDER_SHOOT_H

#include "view_routes.h"

typedef enum RenderKind { RENDER_RAW, RENDER_PNG, RENDER_JPEG, RENDER_WEBP } RenderKind;

/// Where one looks from: around what moves at an angle, or from a point to a point.
typedef struct RenderCamera {
	bool has_angles, has_points;
	double azimuth, elevation; ///< [degrees]
	double zoom;               ///< 1: all of the motion is seen
	double eye[3], target[3];  ///< [m]
} RenderCamera;

typedef struct RenderJob {
	ViewSources* sources; ///< all open; side by side in the picture
	int width, height;
	int samples; ///< along each side of a pixel
	RenderKind kind;
	RenderCamera camera;
	const char *field, *map, *theme; ///< NULL: no colours by a field; the page's own
	bool has_range;
	double range[2]; ///< of the field that the colours span
	bool has_legend, has_time, has_names;
	int count;
	const double* times; ///< one a picture [s]
	/// Called for each picture in order: a file of its kind, or width * height * 4 bytes of red, green, blue and alpha. What
	/// is not JN_OK ends the work.
	JnStatus (*take)(void* user, int number, const void* data, size_t size);
	void* user; ///< handed to `take`
} RenderJob;

/// Make all pictures, or those until Ctrl-C: `*taken` says how many. JN_IO_FAILED after a message: no browser, one that
/// crashes or does nothing for two minutes. No browser is left behind.
JnStatus render_shoot(const RenderJob* job, int* taken);

#endif
