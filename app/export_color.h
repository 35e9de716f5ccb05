/// @file export_color.h
/// What colours of vertices show: a number for each, and its place in a map of colours.
#ifndef JN_APP_EXPORT_COLOR_H
#define JN_APP_EXPORT_COLOR_H

#include "export.h"

/// Values of all points of the recording in a frame, and the range of the moving parts over all chosen frames.
typedef struct ExportColor {
	const char* name; ///< "speed"
	int field;        ///< of the recording; -1: displacement, -2: speed
	double low, high;
	double* values;          ///< of the frame in hand, recording.point_count
	double *nodes, *numbers; ///< room for a field of nodes and of points, 3 numbers each
} ExportColor;

/// Find export->color and its range, which takes a look at all chosen frames. JN_BAD_INPUT after a message when there
/// is no such field.
JnStatus export_color_create(Export* export, ExportColor* color);

/// Fill the values of the chosen frame `index`, which is in hand.
JnStatus export_color_load(const Export* export, int index, ExportColor* color);

/// Value of a vertex; of threads, of the first node of its frame, and 0 of obstacles.
double export_color_value(const ExportPart* part, int vertex, const ExportColor* color);

/// Viridis, three bytes.
void export_color_bytes(const ExportColor* color, double value, unsigned char bytes[3]);

#endif
