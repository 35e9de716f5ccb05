// USD as text, "#usda 1.0": a Mesh for each surface, BasisCurves for threads, Points for points, with points and extent
// over time. Without --fps a second of the simulation has 24 time codes, with it every frame is one.
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "export.h"
#include "export_look.h"

enum { USUAL_FPS = 24 };

/// The name of a prim is an identifier: letters, digits and _, no digit first.
static void identify(const char* name, char out[256]) {
	int length = 0;
	if (!isalpha((unsigned char)name[0]) && name[0] != '_') out[length++] = '_';
	for (; *name != '\0' && length < 255; ++name) out[length++] = isalnum((unsigned char)*name) ? *name : '_';
	out[length] = '\0';
}

static double time_code(const Export* export, int index) {
	const double second = export->fps > 0 ? export->fps : USUAL_FPS;
	return (export->times[index] - export->times[0]) * second;
}

// ---- values ----

static void print_points(JnTextFile* file, int count, const double* points) {
	jn_text_print(file, "[");
	for (int i = 0; i < count; ++i, points += 3)
		jn_text_print(file, "%s(%.9g, %.9g, %.9g)", i > 0 ? ", " : "", points[0], points[1], points[2]);
	jn_text_print(file, "]");
}

static void print_integers(JnTextFile* file, const char* name, int count, int each, const int* numbers) {
	jn_text_print(file, "\t\tint[] %s = [", name);
	for (int i = 0; i < count; ++i) jn_text_print(file, "%s%d", i > 0 ? ", " : "", numbers != NULL ? numbers[i] : each);
	jn_text_print(file, "]\n");
}

static void bound(const ExportPart* part, const double* points, double box[6]) {
	for (int a = 0; a < 3; ++a) {
		box[a] = INFINITY;
		box[3 + a] = -INFINITY;
	}
	for (int i = 0; i < 3 * part->vertex_count; ++i) {
		box[i % 3] = fmin(box[i % 3], points[i]);
		box[3 + i % 3] = fmax(box[3 + i % 3], points[i]);
	}
	for (int a = 0; a < 3; ++a) {
		box[a] -= part->kind == EXPORT_CURVE ? part->radius : 0;
		box[3 + a] += part->kind == EXPORT_CURVE ? part->radius : 0;
	}
}

// ---- parts ----

static JnStatus print_samples(Export* export, const ExportPart* part, double* boxes, JnTextFile* file) {
	jn_text_print(file, "\t\tpoint3f[] points.timeSamples = {\n");
	for (int i = 0; i < export->frame_count; ++i) {
		JN_TRY(export_load(export, i));
		export_vertices(export, part, export->vertices);
		bound(part, export->vertices, boxes + 6 * (ptrdiff_t)i);
		jn_text_print(file, "\t\t\t%.9g: ", time_code(export, i));
		print_points(file, part->vertex_count, export->vertices);
		jn_text_print(file, ",\n");
	}
	jn_text_print(file, "\t\t}\n\t\tfloat3[] extent.timeSamples = {\n");
	for (int i = 0; i < export->frame_count; ++i) {
		jn_text_print(file, "\t\t\t%.9g: ", time_code(export, i));
		print_points(file, 2, boxes + 6 * (ptrdiff_t)i);
		jn_text_print(file, ",\n");
	}
	jn_text_print(file, "\t\t}\n");
	return JN_OK;
}

static void print_still(const ExportPart* part, JnTextFile* file) {
	double box[6];
	bound(part, part->fixed, box);
	jn_text_print(file, "\t\tpoint3f[] points = ");
	print_points(file, part->vertex_count, part->fixed);
	jn_text_print(file, "\n\t\tfloat3[] extent = ");
	print_points(file, 2, box);
	jn_text_print(file, "\n");
}

static void print_mesh(const ExportPart* part, JnTextFile* file) {
	jn_text_print(file, "\t\tuniform token subdivisionScheme = \"none\"\n\t\tuniform bool doubleSided = true\n");
	print_integers(file, "faceVertexCounts", part->triangle_count, 3, NULL);
	print_integers(file, "faceVertexIndices", 3 * part->triangle_count, 0, part->triangles);
}

static void print_curve(const ExportPart* part, JnTextFile* file) {
	jn_text_print(file,
				  "\t\tuniform token type = \"linear\"\n\t\tuniform token wrap = \"%s\"\n"
				  "\t\tfloat[] widths = [%.9g] (\n\t\t\tinterpolation = \"constant\"\n\t\t)\n",
				  part->is_closed ? "periodic" : "nonperiodic", 2 * part->radius);
	print_integers(file, "curveVertexCounts", 1, 0, &part->vertex_count);
}

/// Balls of the volumes of the points.
static void print_widths(const ExportPart* part, JnTextFile* file) {
	const double pi = 3.14159265358979323846;
	if (part->volumes == NULL) return;
	jn_text_print(file, "\t\tfloat[] widths = [");
	for (int i = 0; i < part->vertex_count; ++i)
		jn_text_print(file, "%s%.9g", i > 0 ? ", " : "", cbrt(6 * part->volumes[i] / pi));
	jn_text_print(file, "] (\n\t\t\tinterpolation = \"vertex\"\n\t\t)\n");
}

static JnStatus print_part(Export* export, int index, double* boxes, JnTextFile* file) {
	static const char* const types[] = {
		[EXPORT_SURFACE] = "Mesh", [EXPORT_CURVE] = "BasisCurves", [EXPORT_POINTS] = "Points"};
	const ExportPart* part = &export->parts[index];
	const double* color = export_look_color(export, index);
	char name[256];
	identify(part->name, name);
	// the number keeps names apart that differ in other characters only, and bodies from obstacles
	jn_text_print(file, "\n\tdef %s \"%s_%d\" (\n\t\tcustomData = {\n\t\t\tstring name = \"%s\"\n\t\t}\n\t)\n\t{\n",
				  types[part->kind], name, index, part->name);
	if (part->kind == EXPORT_SURFACE) print_mesh(part, file);
	if (part->kind == EXPORT_CURVE) print_curve(part, file);
	if (part->kind == EXPORT_POINTS) print_widths(part, file);
	jn_text_print(file, "\t\tcolor3f[] primvars:displayColor = [(%.9g, %.9g, %.9g)]\n", color[0], color[1], color[2]);
	if (part->fixed != NULL)
		print_still(part, file);
	else
		JN_TRY(print_samples(export, part, boxes, file));
	jn_text_print(file, "\t}\n");
	return JN_OK;
}

// ---- the file ----

/// USD knows y and z as up; what else is up is turned to y.
static void print_head(const Export* export, JnTextFile* file) {
	bool is_down;
	double q[4];
	const int up = recording_up(&export->recording, &is_down);
	const bool is_turned = up == 0 || is_down;
	const double rate = export->fps > 0 ? export->fps : USUAL_FPS;
	export_look_upright(export, q);
	jn_text_print(file,
				  "#usda 1.0\n(\n\tdefaultPrim = \"run\"\n\tdoc = \"jounce " JN_VERSION "\"\n\tendTimeCode = %.9g\n"
				  "\tframesPerSecond = %.9g\n\tmetersPerUnit = 1\n\tstartTimeCode = 0\n\ttimeCodesPerSecond = %.9g\n"
				  "\tupAxis = \"%c\"\n)\n\ndef Xform \"run\"\n{\n",
				  time_code(export, export->frame_count - 1), rate, rate, is_turned ? 'Y' : "XYZ"[up]);
	if (!is_turned) return;
	jn_text_print(file,
				  "\tquatf xformOp:orient = (%.9g, %.9g, %.9g, %.9g)\n"
				  "\tuniform token[] xformOpOrder = [\"xformOp:orient\"]\n",
				  q[3], q[0], q[1], q[2]);
}

static JnStatus write_all(Export* export, double* boxes, JnTextFile* file) {
	print_head(export, file);
	for (int i = 0; i < export->part_count; ++i) JN_TRY(print_part(export, i, boxes, file));
	jn_text_print(file, "}\n");
	return JN_OK;
}

JnStatus export_usda(Export* export) {
	JnTextFile file;
	double* boxes;
	JN_NEW(&export->arena, boxes, 6 * (size_t) export->frame_count);
	JN_TRY(export_open(export->path, &file));
	const JnStatus status = write_all(export, boxes, &file);
	if (status == JN_OK) return jn_text_close(&file);
	jn_text_abandon(&file);
	return status;
}
