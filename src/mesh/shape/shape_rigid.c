// Rigid balls and plates, for the law rigid.
#include "base/log.h"
#include "math/vec3.h"
#include "mesh/rigid.h"
#include "mesh/shape/shape_keys.h"

typedef struct SphereDef {
	double center[3], radius;
} SphereDef;

typedef struct PlateDef {
	double point[3], normal[3];
	double size[2];
	double thickness;
	double shown;
} PlateDef;

static const JnRigid upright = {.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

static JnStatus generate_sphere(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	(void)what;
	const SphereDef* def = options;
	JnRigid rigid = upright;
	rigid.radius = def->radius;
	return jn_rigid_mesh(&rigid, def->center, 0, arena, mesh);
}

// Two unit vectors across a unit normal: the first along the coordinate axis that is farthest from it, made square.
static void span(double axes[3][3]) {
	int least = 0;
	for (int a = 1; a < 3; a++)
		if (fabs(axes[2][a]) < fabs(axes[2][least])) least = a;
	for (int a = 0; a < 3; a++) axes[0][a] = (a == least) - axes[2][least] * axes[2][a];
	const double length = vec3_length(axes[0]);
	for (int a = 0; a < 3; a++) axes[0][a] /= length;
	vec3_cross(axes[2], axes[0], axes[1]);
}

static JnStatus generate_plate(const void* options, const char* what, JnArena* arena, JnMesh* mesh) {
	const PlateDef* def = options;
	const double length = vec3_length(def->normal);
	JnRigid rigid = {.radius = def->thickness / 2};
	if (!(length > 0)) return jn_error(JN_BAD_INPUT, "%s.normal: has no length; give a direction", what);
	for (int a = 0; a < 3; a++) rigid.axes[2][a] = def->normal[a] / length;
	span(rigid.axes);
	for (int a = 0; a < 2; a++) rigid.half[a] = isnan(def->size[a]) ? INFINITY : def->size[a] / 2;
	return jn_rigid_mesh(&rigid, def->point, def->shown / 2, arena, mesh);
}

static const JnKey sphere_keys[] = {
	JN_POSITION_KEY(SphereDef, center, "its middle"),
	JN_LENGTH_KEY(SphereDef, radius, "half its diameter"),
	{0},
};

static const JnKey plate_keys[] = {
	JN_POSITION_KEY(PlateDef, point, "its middle"),
	{.name = "normal",
	 .kind = JN_REAL3,
	 .field = offsetof(PlateDef, normal),
	 .value = {0, 1, 0},
	 .meaning = "direction across it, of any length"},
	{.name = "size",
	 .kind = JN_REAL2,
	 .field = offsetof(PlateDef, size),
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning =
		 "edges; without end when absent. The first is as near as can be to the coordinate axis most square to the "
		 "normal"},
	JN_LENGTH_KEY(PlateDef, thickness, "of the plate, whose edges are round"),
	{.name = "shown",
	 .kind = JN_REAL,
	 .field = offsetof(PlateDef, shown),
	 .value = {1},
	 .high = INFINITY,
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,
	 .unit = "m",
	 .meaning = "edge of what is drawn of a plate without end"},
	{0},
};

const JnShapeType jn_shape_rigid_sphere = {
	.row = {"rigid_sphere", "A rigid ball that moves but does not turn, for the law rigid.", sphere_keys,
			sizeof(SphereDef)},
	.generate = generate_sphere,
};

const JnShapeType jn_shape_rigid_plate = {
	.row = {"rigid_plate", "A rigid plate that moves but does not turn, for the law rigid.", plate_keys,
			sizeof(PlateDef)},
	.generate = generate_plate,
};
