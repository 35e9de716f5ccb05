/// @file picture.h
/// Pictures of surfaces: panels side by side, at one scale, drawn with a depth buffer and given a title by gnuplot.
#ifndef JN_APP_REPRODUCE_PICTURE_H
#define JN_APP_REPRODUCE_PICTURE_H

#include "reproduce/frames.h"

/// Bodies that are given none take the first four by turns.
typedef enum PaintName {
	PAINT_ORANGE,
	PAINT_BLUE,
	PAINT_GREEN,
	PAINT_GREY,
	PAINT_YELLOW,
	PAINT_RED,
	PAINT_TEAL,
	PAINT_VIOLET,
	PAINT_OLIVE,
} PaintName;

/// How points are drawn: as balls, coloured by a field of the recording, from pale at `low` to dark red at `high`.
typedef struct PointPaint {
	const char* field; ///< one number a node, such as "damage"
	double low, high;
	double radius; ///< [m]
} PointPaint;

typedef struct PanelPoints {
	int count;
	double* at;     ///< 3 * count [m]
	double* values; ///< of the field
	PointPaint paint;
} PanelPoints;

/// One view of a frame.
typedef struct Panel {
	char title[96];
	JnSurface surface; ///< of all bodies
	const int* bodies; ///< for each triangle of it, the number of its body
	int paint_count;
	const PaintName* paints; ///< one for each of the first bodies
	PanelPoints points;      ///< none in a picture of surfaces
	JnSurface obstacles;     ///< drawn in light grey, and without a say in the view
} Panel;

typedef struct Camera {
	double azimuth;   ///< [deg] about y, from looking along -z towards looking along -x
	double elevation; ///< [deg] above the horizon
} Camera;

enum { PICTURE_MOST_PANELS = 12 };

typedef struct Picture {
	const char* name; ///< of the files: name.png, name.gnuplot, name.rgb
	Camera camera;
	int columns;     ///< panels side by side
	int focus;       ///< the first bodies, so many, that the view has in it; 0: all
	int paint_count; ///< set before panels are added
	const PaintName* paints;
	int width, height; ///< of a panel [pixels]
	int count;
	Panel panels[PICTURE_MOST_PANELS];
	JnArena arena; ///< owns what the panels point to
} Picture;

/// Copy what a frame of a recording shows into the next panel.
JnStatus picture_add(Picture* picture, const char* folder, double t, const char* title);

/// The same, with all nodes of the frame as points, such as those of peridynamic bodies.
JnStatus picture_add_points(Picture* picture, const char* folder, double t, const char* title, const PointPaint* paint);

/// Write the picture's files into `folder` and draw them. JN_IO_FAILED, JN_OUT_OF_MEMORY.
JnStatus picture_draw(const Picture* picture, const char* folder);
void picture_free(Picture* picture);

#endif
