// The rows of obstacles, and of what a body says about contact, in a scene file.
#include "detect/obstacle.h"
#include "jounce/model.h"

const JnKey jn_body_contact_keys[] = {
	{.name = "active",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnBodyContactDef, active),
	 .value = {1},
	 .meaning = "whether the body touches anything at all"},
	{.name = "self",
	 .kind = JN_SWITCH,
	 .field = offsetof(JnBodyContactDef, self),
	 .meaning = "whether the body touches itself"},
	{.name = "surface",
	 .kind = JN_TEXT,
	 .field = offsetof(JnBodyContactDef, surface),
	 .text = "default",
	 .meaning = "name of its contact material, by which friction is looked up"},
	{.name = "offset",
	 .kind = JN_REAL,
	 .field = offsetof(JnBodyContactDef, offset),
	 .low = 0,
	 .high = 1e6,
	 .absent_allowed = true,
	 .unit = "m",
	 .meaning =
		 "distance that its vertices keep from obstacles, such as half the thickness of a cloth; when absent, a "
		 "twentieth of the mean edge of a cloth, so that its triangles clear balls of five edges, and 0 of others"},
	{0},
};

const JnKey jn_obstacle_keys[] = {
	{.name = "name",
	 .kind = JN_TEXT,
	 .field = offsetof(JnObstacleDef, name),
	 .text = "obstacle",
	 .meaning = "used in records and messages"},
	{.name = "shape",
	 .kind = JN_VARIANT,
	 .field = offsetof(JnObstacleDef, shape),
	 .required = true,
	 .rows = &jn_obstacle_list,
	 .tag = "type",
	 .meaning = "what is solid"},
	{.name = "surface",
	 .kind = JN_TEXT,
	 .field = offsetof(JnObstacleDef, surface),
	 .text = "default",
	 .meaning = "name of its contact material, by which friction is looked up"},
	{0},
};
