// Panels are rasterised one by one (raster.h) into one array of pixels, which gnuplot writes as a PNG with titles.
#include "reproduce/picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "compare_drawing.h"
#include "compare_script.h"
#include "reproduce/raster.h"

enum { TITLE_HEIGHT = 34, GAP = 8 };

static JnStatus copy_surface(const JnSurface* from, JnArena* arena, JnSurface* out) {
	const size_t numbers = 3 * (size_t)from->node_count, corners = 3 * (size_t)from->triangle_count;
	*out = *from;
	JN_NEW(arena, out->nodes, numbers + 1);
	JN_NEW(arena, out->triangles, corners + 1);
	if (from->nodes != NULL) memcpy(out->nodes, from->nodes, numbers * sizeof *out->nodes);
	if (corners > 0) memcpy(out->triangles, from->triangles, corners * sizeof *out->triangles);
	return JN_OK;
}

static JnStatus fill_panel(const Frames* frames, double t, const char* title, JnArena* arena, Panel* panel) {
	const JnSurface bodies = {.node_count = frames->point_count,
							  .triangle_count = frames->triangle_count,
							  .triangles = frames->triangles}; // its nodes are those of the frame
	int* colours;
	JN_NEW(arena, colours, frames->triangle_count + 1);
	JN_TRY(copy_surface(&bodies, arena, &panel->surface));
	JN_TRY(copy_surface(&frames->obstacles, arena, &panel->obstacles));
	JN_TRY(frames_read(frames, frames_nearest(frames, t), panel->surface.nodes));
	memcpy(colours, frames->bodies, (size_t)frames->triangle_count * sizeof *colours);
	panel->bodies = colours;
	snprintf(panel->title, sizeof panel->title, "%s", title);
	return JN_OK;
}

static JnStatus fill_points(const Frames* frames, double t, const PointPaint* paint, JnArena* arena,
							PanelPoints* points) {
	const int frame = frames_nearest(frames, t);
	*points = (PanelPoints){.count = frames->node_count, .paint = *paint};
	JN_NEW(arena, points->at, 3 * (size_t)frames->node_count);
	JN_NEW(arena, points->values, frames->node_count);
	JN_TRY(frames_read_nodes(frames, frame, points->at));
	return frames_read_field(frames, frame, paint->field, points->values);
}

static JnStatus add_panel(Picture* picture, const char* folder, double t, const char* title, const PointPaint* paint) {
	Frames frames;
	Panel panel = {0};
	JnStatus status = frames_open(folder, &frames);
	if (status == JN_OK && picture->count == PICTURE_MOST_PANELS)
		status = jn_error(JN_BAD_INPUT, "%s: more than %d panels", picture->name, PICTURE_MOST_PANELS);
	if (status == JN_OK) status = fill_panel(&frames, t, title, &picture->arena, &panel);
	if (status == JN_OK && paint != NULL) status = fill_points(&frames, t, paint, &picture->arena, &panel.points);
	panel.paint_count = picture->paint_count;
	panel.paints = picture->paints;
	if (status == JN_OK) picture->panels[picture->count++] = panel;
	frames_close(&frames);
	return status;
}

JnStatus picture_add(Picture* picture, const char* folder, double t, const char* title) {
	return add_panel(picture, folder, t, title, NULL);
}

JnStatus picture_add_points(Picture* picture, const char* folder, double t, const char* title,
							const PointPaint* paint) {
	return add_panel(picture, folder, t, title, paint);
}

void picture_free(Picture* picture) {
	jn_arena_free(&picture->arena);
}

typedef struct Layout {
	int rows, width, height; ///< of the whole picture [pixels]
} Layout;

static Layout lay_out(const Picture* picture) {
	const int rows = (picture->count + picture->columns - 1) / picture->columns;
	return (Layout){.rows = rows,
					.width = picture->columns * (picture->width + GAP) - GAP,
					.height = rows * (picture->height + TITLE_HEIGHT)};
}

static void place(const Picture* picture, int panel, int* left, int* top) {
	*left = panel % picture->columns * (picture->width + GAP);
	*top = panel / picture->columns * (picture->height + TITLE_HEIGHT) + TITLE_HEIGHT;
}

static JnStatus write_script(const Picture* picture, const char* folder, Layout layout) {
	JnTextFile file;
	char name[128];
	snprintf(name, sizeof name, "%s.gnuplot", picture->name);
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	jn_text_print(&file, "# To draw it again: gnuplot %s; %s.rgb has the pixels\n", name, picture->name);
	jn_text_print(&file,
				  "set encoding utf8\nset terminal pngcairo size %d,%d font 'sans-serif,13'\nset output '%s.png'\n"
				  "unset border\nunset tics\nunset key\n"
				  "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n"
				  "set xrange [0:%d]\nset yrange [0:%d]\n",
				  layout.width, layout.height, picture->name, layout.width, layout.height);
	for (int i = 0; i < picture->count; ++i) {
		int left = 0, top = 0;
		place(picture, i, &left, &top);
		jn_text_print(&file, "set label %d '", i + 1);
		compare_print_quoted(&file, picture->panels[i].title);
		jn_text_print(&file, "' at %d,%d left noenhanced front\n", left + 8, layout.height - top + TITLE_HEIGHT / 2);
	}
	jn_text_print(&file,
				  "plot '%s.rgb' binary array=(%d,%d) flipy format='%%uchar' using 1:2:3 with rgbimage notitle\n",
				  picture->name, layout.width, layout.height);
	return jn_text_close(&file);
}

static JnStatus write_pixels(const Picture* picture, const char* folder, const unsigned char* pixels, size_t size) {
	JnTextFile file;
	char name[128];
	snprintf(name, sizeof name, "%s.rgb", picture->name);
	JN_TRY(jn_text_open(&file, folder, name, JN_TEXT_REPLACE));
	jn_text_write(&file, (const char*)pixels, size);
	return jn_text_close(&file);
}

JnStatus picture_draw(const Picture* picture, const char* folder) {
	if (picture->count == 0) return JN_OK;
	JnArena arena = {0};
	const Layout layout = lay_out(picture);
	const size_t size = 3 * (size_t)layout.width * (size_t)layout.height;
	unsigned char* pixels = jn_arena_take(&arena, size, 1);
	JnStatus status = pixels != NULL ? JN_OK : JN_OUT_OF_MEMORY;
	if (status == JN_OK) memset(pixels, 255, size);
	const View view = raster_view(picture);
	for (int i = 0; i < picture->count && status == JN_OK; ++i) {
		int left = 0, top = 0;
		place(picture, i, &left, &top);
		status = raster_panel(&picture->panels[i], &view, layout.width,
							  pixels + 3 * ((size_t)top * (size_t)layout.width + (size_t)left));
	}
	if (status == JN_OK) status = write_pixels(picture, folder, pixels, size);
	if (status == JN_OK) status = write_script(picture, folder, layout);
	if (status == JN_OK) compare_draw(folder, picture->name);
	jn_arena_free(&arena);
	return status;
}
