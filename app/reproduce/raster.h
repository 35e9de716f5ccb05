/// @file raster.h
/// Triangles and balls into pixels: perspective, a depth buffer, smooth shading but for sharp edges, two lights.
#ifndef JN_APP_REPRODUCE_RASTER_H
#define JN_APP_REPRODUCE_RASTER_H

#include "reproduce/picture.h"

/// Where the camera stands; the same for all panels of a picture.
typedef struct View {
	double right[3], up[3], back[3]; ///< the camera's axes; `back` points at it
	double middle[3];                ///< what it looks at, in these axes [m]
	double distance;                 ///< from there [m]
	double scale;                    ///< pixels a metre at the middle
	int width, height;               ///< of a panel [pixels]
} View;

/// A view that has all panels in it.
View raster_view(const Picture* picture);

/// Draw a panel, from its upper left pixel at `pixels`; `stride` is the width of the whole array [pixels].
JnStatus raster_panel(const Panel* panel, const View* view, int stride, unsigned char* pixels);

#endif
