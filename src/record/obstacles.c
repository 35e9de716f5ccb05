// What never moves, written once. Triangles face out of what is solid.
//
//   /obstacles/<name>/points [p,3]     [m]                     /topology/obstacle_points [.,3]      of all obstacles
//   /obstacles/<name>/triangles [m,3]  numbers of its points   /topology/obstacle_triangles [.,3]   numbers of those
//                                                              /topology/obstacle [.]               index, a triangle
//
// and obstacles.xdmf, which shows the latter.
#include "record/obstacles.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/log.h"
#include "record/text_file.h"

long jn_record_obstacle_points(const JnRecordInfo* info) {
	long count = 0;
	for (int i = 0; i < info->obstacle_count; i++) count += info->obstacles[i].surface.node_count;
	return count;
}

long jn_record_obstacle_triangles(const JnRecordInfo* info) {
	long count = 0;
	for (int i = 0; i < info->obstacle_count; i++) count += info->obstacles[i].surface.triangle_count;
	return count;
}

// ---- run.h5 ----

static JnStatus write_reals(JnH5File* file, const char* name, long rows, const double* data) {
	const hsize_t dims[2] = {(hsize_t)rows, 3};
	return jn_h5_array(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 2, dims, data);
}

static JnStatus write_numbers(JnH5File* file, const char* name, long rows, int columns, const int* data) {
	const hsize_t dims[2] = {(hsize_t)rows, (hsize_t)columns};
	return jn_h5_array(file, name, H5T_STD_I32LE, H5T_NATIVE_INT, columns > 1 ? 2 : 1, dims, data);
}

static JnStatus write_obstacle(JnH5File* file, const JnRecordObstacle* obstacle) {
	const JnSurface* surface = &obstacle->surface;
	char name[512];
	snprintf(name, sizeof name, "/obstacles/%s/points", obstacle->name);
	JN_TRY(write_reals(file, name, surface->node_count, surface->nodes));
	JN_TRY(jn_h5_attribute_text(file, name, "unit", "m"));
	snprintf(name, sizeof name, "/obstacles/%s/triangles", obstacle->name);
	return write_numbers(file, name, surface->triangle_count, 3, surface->triangles);
}

/// One array for all: points, triangles with their numbers, and the number of its obstacle for each triangle.
static JnStatus gather(const JnRecordInfo* info, JnArena* arena, double** points, int** triangles, int** obstacles) {
	long point = 0, triangle = 0;
	JN_NEW(arena, *points, 3 * jn_record_obstacle_points(info));
	JN_NEW(arena, *triangles, 3 * jn_record_obstacle_triangles(info));
	JN_NEW(arena, *obstacles, jn_record_obstacle_triangles(info));
	for (int i = 0; i < info->obstacle_count; i++) {
		const JnSurface* surface = &info->obstacles[i].surface;
		memcpy(*points + 3 * point, surface->nodes, 3 * (size_t)surface->node_count * sizeof **points);
		for (int k = 0; k < 3 * surface->triangle_count; k++)
			(*triangles)[3 * triangle + k] = (int)(surface->triangles[k] + point);
		for (int k = 0; k < surface->triangle_count; k++) (*obstacles)[triangle + k] = i;
		point += surface->node_count;
		triangle += surface->triangle_count;
	}
	return JN_OK;
}

static JnStatus write_topology(JnH5File* file, const JnRecordInfo* info, JnArena* arena) {
	const long triangle_count = jn_record_obstacle_triangles(info);
	double* points;
	int *triangles, *obstacles;
	JN_TRY(gather(info, arena, &points, &triangles, &obstacles));
	JN_TRY(write_reals(file, "/topology/obstacle_points", jn_record_obstacle_points(info), points));
	JN_TRY(write_numbers(file, "/topology/obstacle_triangles", triangle_count, 3, triangles));
	return write_numbers(file, "/topology/obstacle", triangle_count, 1, obstacles);
}

JnStatus jn_record_obstacles_write(JnH5File* file, const JnRecordInfo* info) {
	if (info->obstacle_count == 0) return JN_OK;
	for (int i = 0; i < info->obstacle_count; i++) JN_TRY(write_obstacle(file, &info->obstacles[i]));
	JnArena arena = {0};
	const JnStatus status = write_topology(file, info, &arena);
	jn_arena_free(&arena);
	return status;
}

// ---- obstacles.xdmf ----

static void print_item(JnTextFile* file, long rows, int columns, const char* type, const char* dataset) {
	jn_text_print(file, "\t\t\t\t<DataItem Dimensions=\"%ld", rows);
	if (columns > 1) jn_text_print(file, " %d", columns);
	jn_text_print(file, "\" %s Format=\"HDF\">run.h5:/topology/%s</DataItem>\n", type, dataset);
}

static JnStatus write_xdmf(const JnRecordInfo* info) {
	const char* const real = "NumberType=\"Float\" Precision=\"8\"";
	const char* const integer = "NumberType=\"Int\" Precision=\"4\"";
	const long triangles = jn_record_obstacle_triangles(info);
	JnTextFile file;
	JN_TRY(jn_text_open(&file, info->directory, "obstacles.xdmf", JN_TEXT_REPLACE));
	jn_text_print(&file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n\t<Domain>\n"
						 "\t\t<Grid Name=\"obstacles\" GridType=\"Uniform\">\n");
	jn_text_print(&file, "\t\t\t<Topology TopologyType=\"Triangle\" NumberOfElements=\"%ld\">\n", triangles);
	print_item(&file, triangles, 3, integer, "obstacle_triangles");
	jn_text_print(&file, "\t\t\t</Topology>\n\t\t\t<Geometry GeometryType=\"XYZ\">\n");
	print_item(&file, jn_record_obstacle_points(info), 3, real, "obstacle_points");
	jn_text_print(&file, "\t\t\t</Geometry>\n"
						 "\t\t\t<Attribute Name=\"obstacle\" AttributeType=\"Scalar\" Center=\"Cell\">\n");
	print_item(&file, triangles, 1, integer, "obstacle");
	jn_text_print(&file, "\t\t\t</Attribute>\n\t\t</Grid>\n\t</Domain>\n</Xdmf>\n");
	return jn_text_close(&file);
}

/// Without obstacles, none of an earlier run in the same folder stay either.
static JnStatus open_obstacles(JnRecorder* recorder, const JnRecordInfo* info) {
	char path[JN_PATH_SIZE];
	(void)recorder;
	if (info->obstacle_count > 0) return write_xdmf(info);
	JN_TRY(jn_path_join(info->directory, "obstacles.xdmf", path));
	unlink(path);
	return JN_OK;
}

static JnStatus write_nothing(JnRecorder* recorder, const JnRecordStep* step) {
	(void)recorder, (void)step;
	return JN_OK;
}

static JnStatus close_nothing(JnRecorder* recorder, const JnRecordEnd* end) {
	(void)recorder, (void)end;
	return JN_OK;
}

const JnRecorderType jn_recorder_obstacles = {
	.name = "obstacles",
	.doc = "obstacles.xdmf: the obstacles of run.h5 for ParaView and meshio",
	.size = sizeof(JnRecorder),
	.open = open_obstacles,
	.write = write_nothing,
	.close = close_nothing,
};
