// frame_<number>.vtu with points, velocity and all fields in double precision and the number of its body for each cell;
// run.pvd, which tells their times; obstacles.vtu. As volume: the nodes and cells of the recording. As surface: the
// vertices of its parts, threads as lines along their axes.
#include <stdio.h>
#include <string.h>

#include "export.h"
#include "mesh/format/vtu_write.h"

enum { VTK_VERTEX = 1, VTK_LINE = 3, VTK_TRIANGLE = 5 };

/// Cells of all parts one after the other, the same in all frames.
typedef struct Cells {
	int point_count;
	long count, entries;
	int *nodes, *ends;    // numbers of points; of each cell, where the next one begins
	unsigned char* types; // VTK's
	int* bodies;          // of each cell
	double* radii;        // of threads, of each cell [m]; NULL: as volume
} Cells;

typedef struct Vtu {
	Export* export;
	Cells cells;
	JnVtuWriter writer;
	double *nodes, *points, *out; // a field of the nodes, of the points, and of what is written
} Vtu;

// ---- cells ----

static JnStatus make_room(JnArena* arena, long count, long entries, Cells* cells) {
	JN_NEW(arena, cells->nodes, entries + 1);
	JN_NEW(arena, cells->ends, count + 1);
	JN_NEW(arena, cells->types, count + 1);
	JN_NEW(arena, cells->bodies, count + 1);
	return JN_OK;
}

/// `nodes` are counted from `first`.
static void add_cell(Cells* cells, int type, int body, int node_count, const int* nodes, int first) {
	for (int i = 0; i < node_count; ++i) cells->nodes[cells->entries++] = nodes[i] + first;
	cells->types[cells->count] = (unsigned char)type;
	cells->bodies[cells->count] = body;
	cells->ends[cells->count++] = (int)cells->entries;
}

static JnStatus find_volume(const Recording* recording, JnArena* arena, Cells* cells) {
	long count = 0, entries = 0;
	for (int i = 0; i < recording->body_count; ++i) {
		count += recording->bodies[i].cell_count;
		entries += (long)recording->bodies[i].cell_count * jn_shape_info[recording->bodies[i].shape].nodes;
	}
	if (recording->body_count == 0) count = entries = recording->node_count;
	JN_TRY(make_room(arena, count, entries, cells));
	cells->point_count = recording->node_count;
	for (int i = 0; i < recording->node_count && recording->body_count == 0; ++i)
		add_cell(cells, VTK_VERTEX, 0, 1, &i, 0);
	for (int i = 0; i < recording->body_count; ++i) {
		const RecordingBody* body = &recording->bodies[i];
		const JnShapeInfo* shape = &jn_shape_info[body->shape];
		for (int c = 0; c < body->cell_count; ++c)
			add_cell(cells, shape->vtk_type, i, shape->nodes, body->cells + (ptrdiff_t)c * shape->nodes, 0);
	}
	return JN_OK;
}

static int lines_of(const ExportPart* part) {
	return part->kind == EXPORT_CURVE ? part->vertex_count - !part->is_closed : 0;
}

static void add_part(const ExportPart* part, int number, Cells* cells) {
	const long first_cell = cells->count;
	for (int t = 0; t < part->triangle_count; ++t)
		add_cell(cells, VTK_TRIANGLE, number, 3, part->triangles + 3 * (ptrdiff_t)t, cells->point_count);
	for (int i = 0; i < lines_of(part); ++i)
		add_cell(cells, VTK_LINE, number, 2, (int[2]){i, (i + 1) % part->vertex_count}, cells->point_count);
	for (int i = 0; i < part->vertex_count && part->kind == EXPORT_POINTS; ++i)
		add_cell(cells, VTK_VERTEX, number, 1, &i, cells->point_count);
	for (long c = first_cell; c < cells->count; ++c) cells->radii[c] = part->radius;
	cells->point_count += part->vertex_count;
}

/// Of all parts that move, or of those that do not.
static JnStatus find_surface(const Export* export, bool is_fixed, JnArena* arena, Cells* cells) {
	long count = 0, entries = 0;
	for (int i = 0; i < export->part_count; ++i) {
		const ExportPart* part = &export->parts[i];
		const long points = part->kind == EXPORT_POINTS ? part->vertex_count : 0;
		count += part->triangle_count + lines_of(part) + points;
		entries += 3L * part->triangle_count + 2L * lines_of(part) + points;
	}
	JN_TRY(make_room(arena, count, entries, cells));
	JN_NEW(arena, cells->radii, count + 1);
	for (int i = 0; i < export->part_count; ++i)
		if ((export->parts[i].fixed != NULL) == is_fixed) add_part(&export->parts[i], i, cells);
	return JN_OK;
}

// ---- arrays ----

/// Values of what is written, from those of all points.
static void gather(const Export* export, bool is_fixed, int components, const double* points, double* out) {
	for (int i = 0; i < export->part_count; ++i) {
		const ExportPart* part = &export->parts[i];
		if ((part->fixed != NULL) != is_fixed) continue;
		if (is_fixed)
			export_vertices(export, part, out);
		else
			export_gather(part, components, points, out);
		out += (ptrdiff_t)part->vertex_count * components;
	}
}

/// A field of the nodes, which are in vtu->nodes.
static JnStatus write_field(const Vtu* vtu, const char* name, int components, JnVtuWriter* writer) {
	const double* values = vtu->nodes;
	if (!vtu->export->wants_volume) {
		recording_at_points(&vtu->export->recording, components, vtu->nodes, vtu->points);
		gather(vtu->export, false, components, vtu->points, vtu->out);
		values = vtu->out;
	}
	return jn_vtu_reals(writer, name, components, (size_t)components * (size_t)vtu->cells.point_count, values);
}

static JnStatus write_fields(const Vtu* vtu, int frame, JnVtuWriter* writer) {
	const Recording* recording = &vtu->export->recording;
	fputs("<PointData>\n", writer->stream);
	JN_TRY(recording_velocities(recording, frame, vtu->nodes));
	JN_TRY(write_field(vtu, "velocity", 3, writer));
	for (int i = 0; i < recording->field_count; ++i) {
		JN_TRY(recording_field(recording, frame, i, vtu->nodes));
		JN_TRY(write_field(vtu, recording->fields[i].name, recording->fields[i].components, writer));
	}
	fputs("</PointData>\n", writer->stream);
	return JN_OK;
}

static JnStatus write_cells(const Cells* cells, const double* points, JnVtuWriter* writer) {
	const size_t count = (size_t)cells->count;
	fputs("<CellData>\n", writer->stream);
	JN_TRY(jn_vtu_integers(writer, "body", count, cells->bodies));
	if (cells->radii != NULL) JN_TRY(jn_vtu_reals(writer, "radius", 1, count, cells->radii));
	fputs("</CellData>\n<Points>\n", writer->stream);
	JN_TRY(jn_vtu_reals(writer, "Points", 3, 3 * (size_t)cells->point_count, points));
	fputs("</Points>\n<Cells>\n", writer->stream);
	JN_TRY(jn_vtu_integers(writer, "connectivity", (size_t)cells->entries, cells->nodes));
	JN_TRY(jn_vtu_integers(writer, "offsets", count, cells->ends));
	JN_TRY(jn_vtu_bytes(writer, "types", count, cells->types));
	fputs("</Cells>\n", writer->stream);
	return JN_OK;
}

// ---- files ----

static JnStatus write_frame(const Vtu* vtu, int index, JnVtuWriter* writer) {
	Export* export = vtu->export;
	jn_vtu_begin(writer, vtu->cells.point_count, vtu->cells.count);
	JN_TRY(write_fields(vtu, export->frames[index], writer));
	if (export->wants_volume)
		JN_TRY(recording_positions(&export->recording, export->frames[index], vtu->out));
	else
		gather(export, false, 3, export->points, vtu->out);
	JN_TRY(write_cells(&vtu->cells, vtu->out, writer));
	jn_vtu_end(writer);
	return JN_OK;
}

static JnStatus write_obstacles(const Vtu* vtu, int index, JnVtuWriter* writer) {
	Cells cells = {0};
	(void)index;
	JN_TRY(find_surface(vtu->export, true, writer->arena, &cells));
	double* points;
	JN_NEW(writer->arena, points, 3 * (size_t)cells.point_count + 1);
	gather(vtu->export, true, 3, NULL, points);
	jn_vtu_begin(writer, cells.point_count, cells.count);
	JN_TRY(write_cells(&cells, points, writer));
	jn_vtu_end(writer);
	return JN_OK;
}

static JnStatus write_file(Vtu* vtu, const char* name, int index,
						   JnStatus (*write)(const Vtu* vtu, int index, JnVtuWriter* writer)) {
	JnTextFile file;
	JN_TRY(export_open_in(vtu->export, name, &file));
	vtu->writer.stream = file.stream;
	const JnStatus status = write(vtu, index, &vtu->writer);
	if (status == JN_OK) return jn_text_close(&file);
	jn_text_abandon(&file);
	return status;
}

static JnStatus write_times(Export* export) {
	JnTextFile file;
	JN_TRY(export_open_in(export, "run.pvd", &file));
	jn_text_print(&file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n\t<Collection>\n");
	for (int i = 0; i < export->frame_count; ++i)
		jn_text_print(&file, "\t\t<DataSet timestep=\"%.17g\" file=\"frame_%08d.vtu\"/>\n", export->times[i],
					  export->frames[i]);
	jn_text_print(&file, "\t</Collection>\n</VTKFile>\n");
	return jn_text_close(&file);
}

JnStatus export_vtu(Export* export) {
	Vtu vtu = {.export = export, .writer.arena = &export->arena};
	const Recording* recording = &export->recording;
	JN_TRY(export->wants_volume ? find_volume(recording, &export->arena, &vtu.cells)
								: find_surface(export, false, &export->arena, &vtu.cells));
	JN_NEW(&export->arena, vtu.nodes, 3 * (size_t)recording->node_count);
	JN_NEW(&export->arena, vtu.points, 3 * (size_t)recording->point_count + 1);
	JN_NEW(&export->arena, vtu.out, 3 * (size_t)vtu.cells.point_count + 1);
	for (int i = 0; i < export->frame_count; ++i) {
		char name[64];
		snprintf(name, sizeof name, "frame_%08d.vtu", export->frames[i]);
		JN_TRY(export_load(export, i));
		JN_TRY(write_file(&vtu, name, i, write_frame));
	}
	if (recording->obstacle_count > 0) JN_TRY(write_file(&vtu, "obstacles.vtu", 0, write_obstacles));
	return write_times(export);
}
