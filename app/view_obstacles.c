#include "view_obstacles.h"

#include <stdio.h>
#include <string.h>

#include "recording_file.h"

static herr_t meet_obstacle(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	ViewRun* run = user;
	(void)group, (void)info;
	if (strlen(name) >= sizeof run->obstacles->name) return 0;
	if (run->obstacles != NULL)
		snprintf(run->obstacles[run->obstacle_count].name, sizeof run->obstacles->name, "%s", name);
	run->obstacle_count++;
	return 0;
}

static JnStatus count_obstacle(ViewRun* run, ViewObstacle* obstacle) {
	char name[160];
	snprintf(name, sizeof name, "/obstacles/%s/points", obstacle->name);
	const hssize_t points = recording_file_measure(run->file, name);
	snprintf(name, sizeof name, "/obstacles/%s/triangles", obstacle->name);
	const hssize_t corners = recording_file_measure(run->file, name);
	if (points < 0 || corners < 0 || points > INT32_MAX || corners > INT32_MAX) return JN_IO_FAILED;
	obstacle->first_point = run->obstacle_point_count;
	obstacle->first_triangle = run->obstacle_triangle_count;
	run->obstacle_point_count += obstacle->point_count = (int)(points / 3);
	run->obstacle_triangle_count += obstacle->triangle_count = (int)(corners / 3);
	return JN_OK;
}

static JnStatus read_obstacle(ViewRun* run, const ViewObstacle* obstacle) {
	char name[160];
	int* triangles = run->obstacle_triangles + 3 * (ptrdiff_t)obstacle->first_triangle;
	float* points = run->obstacle_points + 3 * (ptrdiff_t)obstacle->first_point;
	snprintf(name, sizeof name, "/obstacles/%s/points", obstacle->name);
	JN_TRY(recording_file_array(run->file, name, H5T_NATIVE_FLOAT, 3 * (hssize_t)obstacle->point_count, points));
	snprintf(name, sizeof name, "/obstacles/%s/triangles", obstacle->name);
	JN_TRY(recording_file_array(run->file, name, H5T_NATIVE_INT, 3 * (hssize_t)obstacle->triangle_count, triangles));
	for (int i = 0; i < 3 * obstacle->triangle_count; ++i) {
		if (triangles[i] < 0 || triangles[i] >= obstacle->point_count) return JN_IO_FAILED;
		triangles[i] += obstacle->first_point;
	}
	return JN_OK;
}

JnStatus view_obstacles_read(ViewRun* run) {
	if (H5Lexists(run->file, "/obstacles", H5P_DEFAULT) <= 0) return JN_OK;
	JN_TRY(recording_file_visit(run->file, "/obstacles", meet_obstacle, run));
	JN_NEW(&run->arena, run->obstacles, run->obstacle_count + 1);
	run->obstacle_count = 0;
	JN_TRY(recording_file_visit(run->file, "/obstacles", meet_obstacle, run));
	for (int i = 0; i < run->obstacle_count; ++i) JN_TRY(count_obstacle(run, &run->obstacles[i]));
	JN_NEW(&run->arena, run->obstacle_points, 3 * run->obstacle_point_count + 1);
	JN_NEW(&run->arena, run->obstacle_triangles, 3 * run->obstacle_triangle_count + 1);
	for (int i = 0; i < run->obstacle_count; ++i) JN_TRY(read_obstacle(run, &run->obstacles[i]));
	return JN_OK;
}
