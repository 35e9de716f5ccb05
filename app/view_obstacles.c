#include "view_obstacles.h"

#include "base/log.h"

static void add(ViewRun* run, const RecordingObstacle* from, ViewObstacle* obstacle) {
	const JnSurface* surface = &from->surface;
	float* points = run->obstacle_points + 3 * (ptrdiff_t)run->obstacle_point_count;
	int* triangles = run->obstacle_triangles + 3 * (ptrdiff_t)run->obstacle_triangle_count;
	*obstacle = (ViewObstacle){from->name, run->obstacle_point_count, surface->node_count, run->obstacle_triangle_count,
							   surface->triangle_count};
	for (int i = 0; i < 3 * surface->node_count; ++i) points[i] = (float)surface->nodes[i];
	for (int i = 0; i < 3 * surface->triangle_count; ++i)
		triangles[i] = surface->triangles[i] + run->obstacle_point_count;
	run->obstacle_point_count += surface->node_count;
	run->obstacle_triangle_count += surface->triangle_count;
}

JnStatus view_obstacles_join(ViewRun* run) {
	const Recording* recording = &run->recording;
	size_t points = 0, triangles = 0;
	for (int i = 0; i < recording->obstacle_count; ++i) {
		points += (size_t)recording->obstacles[i].surface.node_count;
		triangles += (size_t)recording->obstacles[i].surface.triangle_count;
	}
	if (points > INT32_MAX / 3 || triangles > INT32_MAX / 3)
		return jn_error(JN_BAD_INPUT, "%s: too many obstacles to draw", run->path);
	JN_NEW(&run->arena, run->obstacles, recording->obstacle_count + 1);
	JN_NEW(&run->arena, run->obstacle_points, 3 * points + 1);
	JN_NEW(&run->arena, run->obstacle_triangles, 3 * triangles + 1);
	for (int i = 0; i < recording->obstacle_count; ++i)
		add(run, &recording->obstacles[i], &run->obstacles[run->obstacle_count++]);
	return JN_OK;
}
