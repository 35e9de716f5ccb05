// The kinds of curves, in the order of the reference.
#include "mesh/shape/path_rows.h"

static const JnRow* const rows[] = {
	&jn_path_polyline.row, &jn_path_spline.row,     &jn_path_helix.row,
	&jn_path_circle.row,   &jn_path_torus_knot.row, &jn_path_overhand.row,
};

const JnRowList jn_path_list = {"curve", rows, sizeof rows / sizeof rows[0]};
