// The shapes that a scene can name, one row each.
#include "mesh/shape/shape.h"

extern const JnShapeType jn_shape_box;
extern const JnShapeType jn_shape_ball;
extern const JnShapeType jn_shape_cylinder;
extern const JnShapeType jn_shape_jello;
extern const JnShapeType jn_shape_rope;
extern const JnShapeType jn_shape_thread;
extern const JnShapeType jn_shape_sheet;
extern const JnShapeType jn_shape_cloth;
extern const JnShapeType jn_shape_torus;
extern const JnShapeType jn_shape_duck;
extern const JnShapeType jn_shape_beach_ball;
extern const JnShapeType jn_shape_file;
extern const JnShapeType jn_shape_points_box;
extern const JnShapeType jn_shape_points_file;
extern const JnShapeType jn_shape_rigid_sphere;
extern const JnShapeType jn_shape_rigid_plate;

static const JnRow* const rows[] = {
	&jn_shape_box.row,        &jn_shape_sheet.row,       &jn_shape_cloth.row,        &jn_shape_ball.row,
	&jn_shape_cylinder.row,   &jn_shape_torus.row,       &jn_shape_rope.row,         &jn_shape_thread.row,
	&jn_shape_jello.row,      &jn_shape_duck.row,        &jn_shape_beach_ball.row,   &jn_shape_file.row,
	&jn_shape_points_box.row, &jn_shape_points_file.row, &jn_shape_rigid_sphere.row, &jn_shape_rigid_plate.row,
};

const JnRowList jn_shape_list = {"shape", rows, sizeof rows / sizeof rows[0]};
