#include "export_color.h"

#include <math.h>
#include <string.h>

#include "base/key.h"
#include "base/log.h"
#include "math/vec3.h"

enum { DISPLACEMENT = -1, SPEED = -2 };

static const char* color_name(void* context, int index) {
	const Recording* recording = context;
	static const char* const always[] = {"displacement", "speed"};
	if (index < 2) return always[index];
	return index - 2 < recording->field_count ? recording->fields[index - 2].name : NULL;
}

static JnStatus find_field(const Export* export, ExportColor* color) {
	const Recording* recording = &export->recording;
	int index = 0;
	const char* name;
	while ((name = color_name((void*)recording, index)) != NULL && strcmp(name, export->color) != 0) index++;
	if (name == NULL) {
		const char* near = jn_suggest(export->color, color_name, (void*)recording);
		return jn_error(JN_BAD_INPUT, "--color: this recording has no '%s'; it has displacement, speed%s%s",
						export->color, near != NULL ? "; did you mean " : " and the fields of its frames",
						near != NULL ? near : "");
	}
	color->name = name;
	color->field = index == 0 ? DISPLACEMENT : index == 1 ? SPEED : index - 2;
	return JN_OK;
}

/// Lengths of vectors, or scalars as they are.
static void reduce(int count, int components, const double* numbers, double* values) {
	for (int i = 0; i < count; ++i) values[i] = components == 3 ? vec3_length(numbers + 3 * (ptrdiff_t)i) : numbers[i];
}

JnStatus export_color_load(const Export* export, int index, ExportColor* color) {
	const Recording* recording = &export->recording;
	const int components = color->field >= 0 ? recording->fields[color->field].components : 3;
	if (color->field == DISPLACEMENT) {
		JN_TRY(recording_points(recording, 0, color->numbers));
		for (size_t i = 0; i < 3 * (size_t)recording->point_count; ++i)
			color->numbers[i] = export->points[i] - color->numbers[i];
	} else {
		JN_TRY(color->field == SPEED ? recording_velocities(recording, export->frames[index], color->nodes)
									 : recording_field(recording, export->frames[index], color->field, color->nodes));
		recording_at_points(recording, components, color->nodes, color->numbers);
	}
	reduce(recording->point_count, components, color->numbers, color->values);
	return JN_OK;
}

double export_color_value(const ExportPart* part, int vertex, const ExportColor* color) {
	if (part->fixed != NULL) return 0;
	if (part->points != NULL) return color->values[part->points[vertex]];
	const int sides = part->vertex_count / part->body->thread->frame_count;
	return color->values[part->body->first_point + JN_FRAME_NODES * (vertex / sides)];
}

JnStatus export_color_create(Export* export, ExportColor* color) {
	const size_t points = (size_t) export->recording.point_count;
	JN_TRY(find_field(export, color));
	color->low = INFINITY;
	color->high = -INFINITY;
	JN_NEW(&export->arena, color->values, points);
	JN_NEW(&export->arena, color->numbers, 3 * points);
	JN_NEW(&export->arena, color->nodes, 3 * (size_t) export->recording.node_count);
	for (int index = 0; index < export->frame_count; ++index) {
		JN_TRY(export_load(export, index));
		JN_TRY(export_color_load(export, index, color));
		for (size_t i = 0; i < points; ++i) {
			color->low = fmin(color->low, color->values[i]);
			color->high = fmax(color->high, color->values[i]);
		}
	}
	return JN_OK;
}

void export_color_bytes(const ExportColor* color, double value, unsigned char bytes[3]) {
	static const unsigned char map[9][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
											{44, 113, 142}, {33, 144, 141}, {39, 173, 129},
											{92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
	const double range = color->high - color->low;
	const double place = range > 0 ? 8 * fmin(fmax((value - color->low) / range, 0), 1) : 0;
	const int low = place < 8 ? (int)place : 7;
	for (int i = 0; i < 3; ++i)
		bytes[i] = (unsigned char)lrint(map[low][i] + (place - low) * (map[low + 1][i] - map[low][i]));
}
