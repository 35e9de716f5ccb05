// The shapes that a scene can name, one row each.
#include "mesh/shape.h"

extern const JnShapeType jn_shape_box;

static const JnRow* const rows[] = {
	&jn_shape_box.row,
};

const JnRowList jn_shape_list = {"shape", rows, sizeof rows / sizeof rows[0]};
