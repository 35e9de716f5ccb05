// run.xdmf and surface.xdmf: how ParaView and meshio find their way through run.h5, to the cells and to the surfaces of
// the bodies. A temporal collection with one grid a frame, in which position stands twice: as geometry, which ParaView
// shows deformed, and as point data, because meshio takes the points of the first frame for all. The files on disk are
// complete at any time.
#include <math.h>
#include <stdlib.h>

#include "base/log.h"
#include "base/timer.h"
#include "record/host.h"
#include "record/recorder.h"
#include "record/surface.h"
#include "record/text_file.h"
#include "record/topology.h"

enum { COST_RATIO = 50 }; // rewriting the files takes at most 1/50 of the run

// One of the files: what stays the same in its grids.
typedef struct XdmfView {
	const char* file_name; // "run.xdmf"
	const char* shape;     // XDMF topology type
	const char *cells, *bodies;
	long cell_count, rows, row_length; // row_length 0: one dimension
	long point_count;
	int vector_count;
	const char* vectors[2][2]; // name and dataset of a frame; the first is the geometry
	int field_count;
	const JnField* fields; // of the points
} XdmfView;

enum { VIEWS = 2 };

typedef struct Xdmf {
	JnRecorder base;
	XdmfView views[VIEWS];
	double* times; // of the frames [s]
	long frame_count, capacity;
	double written; // clock after the last writing [s]
	double pause;   // until the next one [s]
	bool is_broken; // a failure has been told
} Xdmf;

static XdmfView view_of_cells(const JnRecordInfo* info) {
	const JnTopology topology = jn_topology_measure(info);
	return (XdmfView){
		.file_name = "run.xdmf",
		.shape = topology.name,
		.cells = "cells",
		.bodies = "body",
		.cell_count = topology.cell_count,
		.rows = topology.rows,
		.row_length = topology.is_mixed ? 0 : topology.row_length,
		.point_count = info->node_count,
		.vector_count = 2,
		.vectors = {{"position", "position"}, {"velocity", "velocity"}},
		.field_count = info->field_count,
		.fields = info->fields,
	};
}

static XdmfView view_of_surface(const JnRecordInfo* info) {
	const bool has_embedding = jn_record_has_embedding(info);
	return (XdmfView){
		.file_name = "surface.xdmf",
		.shape = "Triangle",
		.cells = "surface",
		.bodies = "surface_body",
		.cell_count = jn_record_triangles(info),
		.rows = jn_record_triangles(info),
		.row_length = 3,
		.point_count = jn_record_points(info),
		.vector_count = 1,
		.vectors = {{"position", has_embedding ? "surface" : "position"}},
		.field_count = has_embedding ? 0 : info->field_count, // they are known at nodes only
		.fields = info->fields,
	};
}

static void print_topology(JnTextFile* file, const XdmfView* view) {
	jn_text_print(file, "\t\t\t\t<Topology TopologyType=\"%s\" NumberOfElements=\"%ld\">\n", view->shape,
				  view->cell_count);
	jn_text_print(file, "\t\t\t\t\t<DataItem Dimensions=\"%ld", view->rows);
	if (view->row_length > 0) jn_text_print(file, " %ld", view->row_length);
	jn_text_print(file,
				  "\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">run.h5:/topology/%s</DataItem>\n"
				  "\t\t\t\t</Topology>\n",
				  view->cells);
}

static void print_numbers(JnTextFile* file, const XdmfView* view, long frame, const char* dataset, int components) {
	jn_text_print(file, "\t\t\t\t\t<DataItem Dimensions=\"%ld", view->point_count);
	if (components > 1) jn_text_print(file, " %d", components);
	jn_text_print(file, "\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">run.h5:/frames/%08ld/%s</DataItem>\n",
				  frame, dataset);
}

static void print_attribute(JnTextFile* file, const XdmfView* view, long frame, const char* const names[2],
							int components) {
	jn_text_print(file, "\t\t\t\t<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Node\">\n", names[0],
				  components > 1 ? "Vector" : "Scalar");
	print_numbers(file, view, frame, names[1], components);
	jn_text_print(file, "\t\t\t\t</Attribute>\n");
}

static void print_frame(JnTextFile* file, const XdmfView* view, long frame, double time) {
	jn_text_print(file, "\t\t\t<Grid Name=\"frame %ld\" GridType=\"Uniform\">\n", frame);
	jn_text_print(file, "\t\t\t\t<Time Value=\"%.17g\"/>\n", time);
	print_topology(file, view);
	jn_text_print(file, "\t\t\t\t<Geometry GeometryType=\"XYZ\">\n");
	print_numbers(file, view, frame, view->vectors[0][1], 3);
	jn_text_print(file, "\t\t\t\t</Geometry>\n");
	for (int i = 0; i < view->vector_count; i++) print_attribute(file, view, frame, view->vectors[i], 3);
	for (int i = 0; i < view->field_count; i++) {
		const JnField* field = &view->fields[i];
		print_attribute(file, view, frame, (const char* [2]){field->name, field->name}, field->components);
	}
	jn_text_print(file,
				  "\t\t\t\t<Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">\n"
				  "\t\t\t\t\t<DataItem Dimensions=\"%ld\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">"
				  "run.h5:/topology/%s</DataItem>\n\t\t\t\t</Attribute>\n\t\t\t</Grid>\n",
				  view->cell_count, view->bodies);
}

static JnStatus write_file(const Xdmf* xdmf, const XdmfView* view) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, xdmf->base.info->directory, view->file_name, JN_TEXT_REPLACE));
	jn_text_print(&file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n\t<Domain>\n"
						 "\t\t<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
	for (long i = 0; i < xdmf->frame_count; i++) print_frame(&file, view, i, xdmf->times[i]);
	jn_text_print(&file, "\t\t</Grid>\n\t</Domain>\n</Xdmf>\n");
	return jn_text_close(&file);
}

static JnStatus write_files(Xdmf* xdmf) {
	const double start = jn_seconds();
	xdmf->is_broken = true; // until all are closed
	for (int i = 0; i < VIEWS; i++) JN_TRY(write_file(xdmf, &xdmf->views[i]));
	xdmf->written = jn_seconds();
	xdmf->pause = fmax(1, COST_RATIO * (xdmf->written - start));
	xdmf->is_broken = false;
	return JN_OK;
}

static JnStatus open_xdmf(JnRecorder* recorder, const JnRecordInfo* info) {
	Xdmf* xdmf = (Xdmf*)recorder;
	xdmf->views[0] = view_of_cells(info);
	xdmf->views[1] = view_of_surface(info);
	return write_files(xdmf);
}

static JnStatus reserve(Xdmf* xdmf, long frames) {
	long capacity = xdmf->capacity > 0 ? xdmf->capacity : 1024;
	while (capacity < frames) capacity *= 2;
	if (capacity == xdmf->capacity) return JN_OK;
	double* times = realloc(xdmf->times, (size_t)capacity * sizeof *times);
	if (times == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the times of %ld frames", capacity);
	xdmf->times = times;
	xdmf->capacity = capacity;
	return JN_OK;
}

static void archive_xdmf(JnRecorder* recorder, JnArchive* archive) {
	Xdmf* xdmf = (Xdmf*)recorder;
	xdmf->frame_count = jn_archive_count(archive, "frames", (int)xdmf->frame_count, sizeof *xdmf->times);
	if (archive->is_reading && archive->status == JN_OK) archive->status = reserve(xdmf, xdmf->frame_count);
	jn_archive_reals(archive, "times", xdmf->times, (size_t)xdmf->frame_count);
}

static JnStatus resume_xdmf(JnRecorder* recorder, const JnRecordInfo* info, JnArchive* archive) {
	Xdmf* xdmf = (Xdmf*)recorder;
	archive_xdmf(recorder, archive);
	const JnStatus status = archive->status == JN_OK ? open_xdmf(recorder, info) : archive->status;
	if (status != JN_OK) free(xdmf->times);
	return status;
}

static JnStatus add_time(Xdmf* xdmf, double t) {
	JN_TRY(reserve(xdmf, xdmf->frame_count + 1));
	xdmf->times[xdmf->frame_count++] = t;
	return JN_OK;
}

static JnStatus write_xdmf(JnRecorder* recorder, const JnRecordStep* step) {
	Xdmf* xdmf = (Xdmf*)recorder;
	if (!step->is_frame) return JN_OK;
	JN_TRY(add_time(xdmf, step->t));
	const bool is_first = xdmf->frame_count == 1;
	return is_first || jn_seconds() - xdmf->written >= xdmf->pause ? write_files(xdmf) : JN_OK;
}

static JnStatus close_xdmf(JnRecorder* recorder, const JnRecordEnd* end) {
	Xdmf* xdmf = (Xdmf*)recorder;
	(void)end;
	const JnStatus status = xdmf->is_broken ? JN_IO_FAILED : write_files(xdmf);
	free(xdmf->times);
	return status;
}

const JnRecorderType jn_recorder_xdmf = {
	.name = "xdmf",
	.doc = "run.xdmf and surface.xdmf: the frames of run.h5 for ParaView and meshio, as cells and as surfaces",
	.size = sizeof(Xdmf),
	.open = open_xdmf,
	.write = write_xdmf,
	.close = close_xdmf,
	.resume = resume_xdmf,
	.archive = archive_xdmf,
};
