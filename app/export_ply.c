// PLY, binary, little-endian, in single precision: all parts in one list of vertices and one of triangles. With
// colours, each vertex also has the number that its colour shows.
#include <stdio.h>

#include "export_color.h"

static void print_header(const Export* export, int index, const ExportColor* color, JnTextFile* file) {
	long vertices = 0, triangles = 0;
	for (int i = 0; i < export->part_count; ++i) {
		vertices += export->parts[i].vertex_count;
		triangles += export->parts[i].triangle_count;
	}
	jn_text_print(file,
				  "ply\nformat binary_little_endian 1.0\ncomment t = %.9g s, metres\nelement vertex %ld\n"
				  "property float x\nproperty float y\nproperty float z\n",
				  export->recording.times[export->frames[index]], vertices);
	if (color != NULL)
		jn_text_print(file, "property float %s\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n",
					  color->name);
	jn_text_print(file, "element face %ld\nproperty list uchar int vertex_indices\nend_header\n", triangles);
}

static void write_vertices(const Export* export, const ExportPart* part, const ExportColor* color, JnTextFile* file) {
	export_vertices(export, part, export->vertices);
	if (color == NULL) {
		export_put_floats(file, 3 * (size_t)part->vertex_count, export->vertices);
		return;
	}
	for (int i = 0; i < part->vertex_count; ++i) {
		unsigned char bytes[3] = {160, 160, 160}; // of obstacles
		const double value = export_color_value(part, i, color);
		if (part->fixed == NULL) export_color_bytes(color, value, bytes);
		export_put_floats(file, 3, export->vertices + 3 * (ptrdiff_t)i);
		export_put_floats(file, 1, &value);
		jn_text_write(file, (const char*)bytes, sizeof bytes);
	}
}

static void write_triangles(const Export* export, JnTextFile* file) {
	uint32_t first = 0;
	for (int i = 0; i < export->part_count; ++i) {
		const ExportPart* part = &export->parts[i];
		for (int t = 0; t < part->triangle_count; ++t) {
			export_put_bits(file, 3, 1);
			for (int k = 0; k < 3; ++k)
				export_put_bits(file, first + (uint32_t)part->triangles[3 * (ptrdiff_t)t + k], 4);
		}
		first += (uint32_t)part->vertex_count;
	}
}

static JnStatus write_frame(Export* export, int index, ExportColor* color) {
	JnTextFile file;
	char name[64];
	JN_TRY(export_load(export, index));
	if (color != NULL) JN_TRY(export_color_load(export, index, color));
	snprintf(name, sizeof name, "frame_%08d.ply", export->frames[index]);
	JN_TRY(export_open_in(export, name, &file));
	print_header(export, index, color, &file);
	for (int i = 0; i < export->part_count; ++i) write_vertices(export, &export->parts[i], color, &file);
	write_triangles(export, &file);
	return jn_text_close(&file);
}

JnStatus export_ply(Export* export) {
	ExportColor color = {0};
	if (export->color != NULL) JN_TRY(export_color_create(export, &color));
	for (int i = 0; i < export->frame_count; ++i) JN_TRY(write_frame(export, i, export->color != NULL ? &color : NULL));
	return JN_OK;
}
