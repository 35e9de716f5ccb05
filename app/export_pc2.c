// A folder with <name>.obj and <name>.pc2 for every part: a mesh, and where its vertices are over time. Obstacles have
// the mesh alone. PC2: a header of 32 bytes, "POINTCACHE2\0", version 1, vertices, start [frames], frames a sample,
// samples; then three floats for each vertex, sample by sample.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "export.h"
#include "export_obj.h"

enum { USUAL_FPS = 24 };

static JnStatus write_mesh(Export* export, const ExportPart* part) {
	JnTextFile file;
	char name[512];
	snprintf(name, sizeof name, "%s.obj", part->name);
	JN_TRY(export_open_in(export, name, &file));
	export_vertices(export, part, export->vertices);
	export_obj_part(&file, part, export->vertices, 1);
	return jn_text_close(&file);
}

/// Frames of the animation from one sample to the next, which a point cache takes to be all alike.
static double frames_a_sample(const Export* export) {
	const int last = export->frame_count - 1;
	if (export->fps > 0 || last == 0) return 1;
	const double mean = (export->times[last] - export->times[0]) / last;
	for (int i = 0; i < last; ++i) {
		if (fabs(export->times[i + 1] - export->times[i] - mean) <= 1e-3 * mean) continue;
		jn_warn("the frames are not equally far apart in time, which a point cache cannot tell: frames %d and %d are "
				"%g s apart, "
				"the mean is %g s; they will play as if they were. Choose some with --frames, or take glb or usda",
				export->frames[i], export->frames[i + 1], export->times[i + 1] - export->times[i], mean);
		break;
	}
	return mean * USUAL_FPS;
}

static JnStatus open_cache(Export* export, const ExportPart* part, double sampling, JnTextFile* file) {
	char name[512];
	snprintf(name, sizeof name, "%s.pc2", part->name);
	JN_TRY(export_open_in(export, name, file));
	jn_text_write(file, "POINTCACHE2", 12);
	export_put_bits(file, 1, 4);
	export_put_bits(file, (uint32_t)part->vertex_count, 4);
	export_put_floats(file, 2, (const double[2]){0, sampling});
	export_put_bits(file, (uint32_t) export->frame_count, 4);
	return JN_OK;
}

static JnStatus write_samples(Export* export, JnTextFile* files) {
	for (int i = 0; i < export->frame_count; ++i) {
		JN_TRY(export_load(export, i));
		for (int p = 0; p < export->part_count; ++p) {
			const ExportPart* part = &export->parts[p];
			if (part->fixed != NULL) continue;
			export_vertices(export, part, export->vertices);
			export_put_floats(&files[p], 3 * (size_t)part->vertex_count, export->vertices);
		}
	}
	return JN_OK;
}

static JnStatus write_caches(Export* export, JnTextFile* files) {
	const double sampling = frames_a_sample(export);
	for (int p = 0; p < export->part_count; ++p) {
		JN_TRY(write_mesh(export, &export->parts[p]));
		if (export->parts[p].fixed == NULL) JN_TRY(open_cache(export, &export->parts[p], sampling, &files[p]));
	}
	return write_samples(export, files);
}

JnStatus export_pc2(Export* export) {
	JnTextFile* files; // all open at once, since a frame is read once for all
	JN_NEW(&export->arena, files, export->part_count);
	JN_TRY(export_load(export, 0));
	JnStatus status = write_caches(export, files);
	for (int p = 0; p < export->part_count; ++p) {
		if (status == JN_OK)
			status = jn_text_close(&files[p]);
		else
			jn_text_abandon(&files[p]);
	}
	return status;
}
