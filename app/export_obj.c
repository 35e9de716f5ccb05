// OBJ: text, an object for each part, vertices with the digits of a float. Its numbers of vertices count from 1 through
// the file.
#include <stdio.h>

#include "export.h"
#include "export_obj.h"

void export_obj_part(JnTextFile* file, const ExportPart* part, const double* vertices, int first) {
	jn_text_print(file, "o %s\n", part->name);
	for (int i = 0; i < part->vertex_count; ++i, vertices += 3)
		jn_text_print(file, "v %.9g %.9g %.9g\n", vertices[0], vertices[1], vertices[2]);
	for (int i = 0; i < part->triangle_count; ++i) {
		const int* t = part->triangles + 3 * (ptrdiff_t)i;
		jn_text_print(file, "f %d %d %d\n", t[0] + first, t[1] + first, t[2] + first);
	}
	for (int i = 0; i < part->vertex_count && part->kind == EXPORT_POINTS; ++i)
		jn_text_print(file, "p %d\n", i + first);
}

static JnStatus write_frame(Export* export, int index) {
	JnTextFile file;
	char name[64];
	int first = 1;
	JN_TRY(export_load(export, index));
	snprintf(name, sizeof name, "frame_%08d.obj", export->frames[index]);
	JN_TRY(export_open_in(export, name, &file));
	jn_text_print(&file, "# %s, t = %.9g s, metres\n", export->recording.scene_name,
				  export->recording.times[export->frames[index]]);
	for (int i = 0; i < export->part_count; ++i) {
		export_vertices(export, &export->parts[i], export->vertices);
		export_obj_part(&file, &export->parts[i], export->vertices, first);
		first += export->parts[i].vertex_count;
	}
	return jn_text_close(&file);
}

JnStatus export_obj(Export* export) {
	for (int i = 0; i < export->frame_count; ++i) JN_TRY(write_frame(export, i));
	return JN_OK;
}
