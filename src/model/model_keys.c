// The rows of a body in a scene file.
#include "force/kernel.h"
#include "jounce/model.h"
#include "mesh/shape.h"
#include "model/motion.h"

static const char* const faces[] = {"none", "x-", "x+", "y-", "y+", "z-", "z+", "all", NULL};
static const char* const masses[] = {"consistent", "lumped", NULL};
static const char* const held_or_free[] = {"held", "free", NULL};
static const char* const stiffnesses[] = {"start", "rest", "current", NULL};

static const JnKey box_keys[] = {
	{.name = "min",
	 .kind = JN_REAL3,
	 .field = offsetof(JnRegionBoxDef, min),
	 .required = true,
	 .unit = "m",
	 .meaning = "lowest corner"},
	{.name = "max",
	 .kind = JN_REAL3,
	 .field = offsetof(JnRegionBoxDef, max),
	 .required = true,
	 .unit = "m",
	 .meaning = "highest corner"},
	{0},
};

static const JnKey sphere_keys[] = {
	{.name = "center",
	 .kind = JN_REAL3,
	 .field = offsetof(JnRegionSphereDef, center),
	 .required = true,
	 .unit = "m",
	 .meaning = "its middle"},
	{.name = "radius",
	 .kind = JN_REAL,
	 .field = offsetof(JnRegionSphereDef, radius),
	 .required = true,
	 .low = 0,
	 .high = 1e9,
	 .unit = "m",
	 .meaning = "its radius"},
	{0},
};

static const JnKey select_keys[] = {
	{.name = "face",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnSelectDef, face),
	 .names = faces,
	 .meaning = "a side of the body's bounding box, or all nodes"},
	{.name = "box",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSelectDef, box),
	 .keys = box_keys,
	 .size = sizeof(JnRegionBoxDef),
	 .meaning = "nodes inside or on a box"},
	{.name = "sphere",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(JnSelectDef, sphere),
	 .keys = sphere_keys,
	 .size = sizeof(JnRegionSphereDef),
	 .meaning = "nodes inside or on a sphere"},
	{.name = "nearest",
	 .kind = JN_REAL3,
	 .field = offsetof(JnSelectDef, nearest),
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning = "the node nearest to a point"},
	{0},
};

static const JnKey fix_keys[] = {
	{.name = "where",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnFixDef, where),
	 .keys = select_keys,
	 .meaning = "which nodes, by their rest positions: exactly one of the entries"},
	{.name = "axes",
	 .kind = JN_TEXT,
	 .field = offsetof(JnFixDef, axes),
	 .text = "xyz",
	 .meaning = "which coordinates are held: any of x, y, z"},
	{0},
};

#define MOTION(axis, index)                                                                                            \
	{                                                                                                                  \
		.name = axis, .kind = JN_VARIANT, .field = offsetof(JnDriveDef, motion) + (index) * sizeof(JnVariant),         \
		.rows = &jn_motion_list, .tag = "type", .meaning = "displacement along " axis                                  \
	}

static const JnKey drive_keys[] = {
	{.name = "where",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnDriveDef, where),
	 .keys = select_keys,
	 .meaning = "which nodes, by their rest positions: exactly one of the entries"},
	MOTION("x", 0),
	MOTION("y", 1),
	MOTION("z", 2),
	{.name = "others",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnDriveDef, others),
	 .names = held_or_free,
	 .meaning = "what the axes without a motion do"},
	{0},
};

static const JnKey damping_keys[] = {
	{.name = "alpha",
	 .kind = JN_REAL,
	 .field = offsetof(JnDampingDef, alpha),
	 .low = 0,
	 .high = 1e6,
	 .unit = "1/s",
	 .meaning = "mass part of Rayleigh damping D = alpha M + beta K"},
	{.name = "beta",
	 .kind = JN_REAL,
	 .field = offsetof(JnDampingDef, beta),
	 .low = 0,
	 .high = 1e3,
	 .unit = "s",
	 .meaning = "stiffness part of Rayleigh damping"},
	{.name = "stiffness",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnDampingDef, stiffness),
	 .names = stiffnesses,
	 .meaning = "where K is taken: at the start of each step and constant over it (a small error of first order), at "
				"rest, or at the current state (costly)"},
	{0},
};

const JnKey jn_body_keys[] = {
	{.name = "name",
	 .kind = JN_TEXT,
	 .field = offsetof(JnBodyDef, name),
	 .text = "body",
	 .meaning = "used in records and messages"},
	{.name = "shape",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnBodyDef, shape),
	 .required = true,
	 .rows = &jn_shape_list,
	 .tag = "type",
	 .meaning = "geometry and mesh"},
	{.name = "material",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnBodyDef, material),
	 .required = true,
	 .rows = &jn_law_list,
	 .tag = "law",
	 .meaning = "constitutive law and its constants"},
	{.name = "mass",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnBodyDef, mass),
	 .names = masses,
	 .meaning = "mass matrix: consistent (more accurate), or lumped (diagonal, for explicit methods)"},
	{.name = "damping",
	 .kind = JN_OBJECT,
	 .field = offsetof(JnBodyDef, damping),
	 .keys = damping_keys,
	 .meaning = "Rayleigh damping"},
	{.name = "velocity",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBodyDef, velocity),
	 .unit = "m/s",
	 .meaning = "of all free nodes at the start"},
	{.name = "spin",
	 .kind = JN_REAL3,
	 .field = offsetof(JnBodyDef, spin),
	 .unit = "rad/s",
	 .meaning = "angular velocity of all free nodes at the start, about the body's centre of mass at rest; added to "
				"velocity"},
	{.name = "fix",
	 .kind = JN_LIST,
	 .field = offsetof(JnBodyDef, fix),
	 .keys = fix_keys,
	 .size = sizeof(JnFixDef),
	 .meaning = "nodes held at their rest positions"},
	{.name = "drive",
	 .kind = JN_LIST,
	 .field = offsetof(JnBodyDef, drive),
	 .keys = drive_keys,
	 .size = sizeof(JnDriveDef),
	 .meaning = "nodes moved along prescribed paths"},
	{0},
};
