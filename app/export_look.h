/// @file export_look.h
/// How parts look where a format has colours, and which way is up.
#ifndef JN_APP_EXPORT_LOOK_H
#define JN_APP_EXPORT_LOOK_H

#include "export.h"

/// Linear red, green and blue of a part: one of a palette for each body, grey for what never moves.
const double* export_look_color(const Export* export, int part);

/// The rotation that turns up, as gravity says it, to y: x, y, z, w of a unit quaternion.
void export_look_upright(const Export* export, double quaternion[4]);

#endif
