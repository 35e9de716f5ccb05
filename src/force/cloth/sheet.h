/// @file sheet.h
/// A surface mesh as cloth: the directions of its threads, and its edges with what lies at them. Inside force/cloth only.
#ifndef JN_FORCE_CLOTH_SHEET_H
#define JN_FORCE_CLOTH_SHEET_H

#include "force/cloth/cloth.h"

/// Keys of `material:` for the laws of cloth. What a bend stiffness is differs between them.
typedef struct JnClothDef {
	double density;           ///< [kg/m^2]
	double grain[3];          ///< direction of the threads u at rest; NAN: the first edge of the first triangle
	double stretch[2], shear; ///< along u and v, and between them [N/m]
	double bend[2];           ///< of the threads u and v [N/m] or [N m]
	double stretch_damping, shear_damping, bend_damping; ///< stiffness-proportional [s]
} JnClothDef;

/// A stiffness or damping >= 0; the key of two is that of the directions u and v.
#define JN_CLOTH_NUMBER(kind_of, field_of, unit_of, ...)                                                               \
	{                                                                                                                  \
		.name = #field_of, .kind = (kind_of), .field = offsetof(JnClothDef, field_of), .high = INFINITY,               \
		.open = JN_OPEN_HIGH, .unit = unit_of, __VA_ARGS__                                                             \
	}

/// The rows of JnClothDef; a law says what its stiffnesses mean, and the unit of the last.
#define JN_CLOTH_KEYS(stretch_words, shear_words, bend_unit, bend_words)                                               \
	{.name = "density",                                                                                                \
	 .kind = JN_REAL,                                                                                                  \
	 .field = offsetof(JnClothDef, density),                                                                           \
	 .high = INFINITY,                                                                                                 \
	 .open = JN_OPEN_LOW | JN_OPEN_HIGH,                                                                               \
	 .required = true,                                                                                                 \
	 .unit = "kg/m^2",                                                                                                 \
	 .remedy = "a shirt has 0.15 kg/m^2, denim 0.4",                                                                   \
	 .meaning = "mass an area at rest"},                                                                               \
		{.name = "grain",                                                                                              \
		 .kind = JN_REAL3,                                                                                             \
		 .field = offsetof(JnClothDef, grain),                                                                         \
		 .absent_allowed = true,                                                                                       \
		 .meaning = "direction of the threads u at rest, laid onto each triangle; v is across; the first axis of a "   \
					"cloth shape (the first edge of the first triangle) when absent"},                                 \
		{.name = "stretch",                                                                                            \
		 .kind = JN_REAL2,                                                                                             \
		 .field = offsetof(JnClothDef, stretch),                                                                       \
		 .high = INFINITY,                                                                                             \
		 .open = JN_OPEN_LOW | JN_OPEN_HIGH,                                                                           \
		 .required = true,                                                                                             \
		 .unit = "N/m",                                                                                                \
		 .meaning = stretch_words ": force a width for a strain of 1"},                                                \
		JN_CLOTH_NUMBER(JN_REAL, shear, "N/m", .required = true, .meaning = shear_words),                              \
		JN_CLOTH_NUMBER(JN_REAL2, bend, bend_unit, .required = true, .meaning = bend_words),                           \
		JN_CLOTH_NUMBER(JN_REAL, stretch_damping, "s", .meaning = "stiffness-proportional damping of stretch"),        \
		JN_CLOTH_NUMBER(JN_REAL, shear_damping, "s", .meaning = "of shear"),                                           \
		JN_CLOTH_NUMBER(JN_REAL, bend_damping, "s", .meaning = "of bending"), {                                        \
		0                                                                                                              \
	}

typedef struct JnSheetCell {
	double u[3], v[3]; ///< unit vectors along the threads and across
	double area;       ///< [m^2]
} JnSheetCell;

typedef struct JnSheetEdge {
	int nodes[2];    ///< low, high
	int wings[2];    ///< nodes opposite, in the triangles on its left and right; -1: it is on the rim
	double length;   ///< [m]
	double area;     ///< of its triangles together [m^2]
	double along[2]; ///< squares of the cosines between it and u, v
} JnSheetEdge;

typedef struct JnSheet {
	const JnMesh* mesh;
	JnSheetCell* cells; ///< one a triangle
	int edge_count;
	JnSheetEdge* edges;
} JnSheet;

/// Look at a mesh. `what` is the key path of the body. JN_BAD_INPUT, after a message, when it is no surface of triangles,
/// has triangles without area, edges of three triangles or neighbours that are turned against each other.
JnStatus jn_sheet_create(const JnLaw* law, const JnClothDef* def, const JnMesh* mesh, const char* what, JnArena* arena,
						 JnSheet* sheet);

/// The groups of a law: from a sheet to out->list, which has room for three.
typedef JnStatus JnClothFill(const JnClothDef* def, const JnSheet* sheet, int first_node, JnArena* scratch,
							 JnArena* arena, JnGroups* out);

/// What JnLaw.build does for a law of cloth.
JnStatus jn_cloth_build(JnClothFill* fill, const JnLaw* law, const void* options, const JnMesh* mesh, int first_node,
						const char* what, JnArena* arena, JnGroups* out);

/// Position of a node at rest.
static inline const double* jn_sheet_node(const JnSheet* sheet, int node) {
	return sheet->mesh->nodes + 3 * (ptrdiff_t)node;
}

#endif
