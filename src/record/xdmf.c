// run.xdmf: how ParaView and meshio find their way through run.h5. A temporal collection with one grid a frame, in
// which position stands twice: as geometry, which ParaView shows deformed, and as point data, because meshio takes the
// points of the first frame for all. The file on disk is complete at any time.
#include <math.h>
#include <stdlib.h>

#include "base/log.h"
#include "base/timer.h"
#include "record/host.h"
#include "record/recorder.h"
#include "record/text_file.h"
#include "record/topology.h"

enum { COST_RATIO = 50 }; // rewriting the file takes at most 1/50 of the run

typedef struct Xdmf {
	JnRecorder base;
	JnTopology topology; // sizes only
	double* times;       // of the frames [s]
	long frame_count, capacity;
	double written; // clock after the last writing [s]
	double pause;   // until the next one [s]
	bool is_broken; // a failure has been told
} Xdmf;

static void print_topology(JnTextFile* file, const JnTopology* topology) {
	jn_text_print(file, "\t\t\t\t<Topology TopologyType=\"%s\" NumberOfElements=\"%ld\">\n", topology->name,
				  topology->cell_count);
	jn_text_print(file, "\t\t\t\t\t<DataItem Dimensions=\"%ld", topology->rows);
	if (!topology->is_mixed) jn_text_print(file, " %ld", topology->row_length);
	jn_text_print(file, "\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">run.h5:/topology/cells</DataItem>\n"
						"\t\t\t\t</Topology>\n");
}

static void print_vector(JnTextFile* file, long frame, int node_count, const char* name) {
	jn_text_print(file,
				  "\t\t\t\t\t<DataItem Dimensions=\"%d 3\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
				  "run.h5:/frames/%08ld/%s</DataItem>\n",
				  node_count, frame, name);
}

static void print_frame(JnTextFile* file, const Xdmf* xdmf, long frame) {
	const int node_count = xdmf->base.info->node_count;
	jn_text_print(file, "\t\t\t<Grid Name=\"frame %ld\" GridType=\"Uniform\">\n", frame);
	jn_text_print(file, "\t\t\t\t<Time Value=\"%.17g\"/>\n", xdmf->times[frame]);
	print_topology(file, &xdmf->topology);
	jn_text_print(file, "\t\t\t\t<Geometry GeometryType=\"XYZ\">\n");
	print_vector(file, frame, node_count, "position");
	jn_text_print(file, "\t\t\t\t</Geometry>\n");
	const char* const names[] = {"position", "velocity"};
	for (int i = 0; i < 2; i++) {
		jn_text_print(file, "\t\t\t\t<Attribute Name=\"%s\" AttributeType=\"Vector\" Center=\"Node\">\n", names[i]);
		print_vector(file, frame, node_count, names[i]);
		jn_text_print(file, "\t\t\t\t</Attribute>\n");
	}
	jn_text_print(file,
				  "\t\t\t\t<Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">\n"
				  "\t\t\t\t\t<DataItem Dimensions=\"%ld\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">"
				  "run.h5:/topology/body</DataItem>\n\t\t\t\t</Attribute>\n\t\t\t</Grid>\n",
				  xdmf->topology.cell_count);
}

static JnStatus write_file(Xdmf* xdmf) {
	const double start = jn_seconds();
	JnTextFile file;
	xdmf->is_broken = true; // until the file is closed
	JN_TRY(jn_text_open(&file, xdmf->base.info->directory, "run.xdmf", JN_TEXT_REPLACE));
	jn_text_print(&file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n\t<Domain>\n"
						 "\t\t<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
	for (long i = 0; i < xdmf->frame_count; i++) print_frame(&file, xdmf, i);
	jn_text_print(&file, "\t\t</Grid>\n\t</Domain>\n</Xdmf>\n");
	JN_TRY(jn_text_close(&file));
	xdmf->written = jn_seconds();
	xdmf->pause = fmax(1, COST_RATIO * (xdmf->written - start));
	xdmf->is_broken = false;
	return JN_OK;
}

static JnStatus open_xdmf(JnRecorder* recorder, const JnRecordInfo* info) {
	Xdmf* xdmf = (Xdmf*)recorder;
	xdmf->topology = jn_topology_measure(info);
	return write_file(xdmf);
}

static JnStatus add_time(Xdmf* xdmf, double t) {
	if (xdmf->frame_count == xdmf->capacity) {
		const long capacity = xdmf->capacity > 0 ? 2 * xdmf->capacity : 1024;
		double* times = realloc(xdmf->times, (size_t)capacity * sizeof *times);
		if (times == NULL)
			return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the times of %ld frames", capacity);
		xdmf->times = times;
		xdmf->capacity = capacity;
	}
	xdmf->times[xdmf->frame_count++] = t;
	return JN_OK;
}

static JnStatus write_xdmf(JnRecorder* recorder, const JnRecordStep* step) {
	Xdmf* xdmf = (Xdmf*)recorder;
	if (!step->is_frame) return JN_OK;
	JN_TRY(add_time(xdmf, step->t));
	const bool is_first = xdmf->frame_count == 1;
	return is_first || jn_seconds() - xdmf->written >= xdmf->pause ? write_file(xdmf) : JN_OK;
}

static JnStatus close_xdmf(JnRecorder* recorder, const JnRecordEnd* end) {
	Xdmf* xdmf = (Xdmf*)recorder;
	(void)end;
	const JnStatus status = xdmf->is_broken ? JN_IO_FAILED : write_file(xdmf);
	free(xdmf->times);
	return status;
}

const JnRecorderType jn_recorder_xdmf = {
	.name = "xdmf",
	.doc = "run.xdmf: the frames of run.h5 for ParaView and meshio",
	.size = sizeof(Xdmf),
	.open = open_xdmf,
	.write = write_xdmf,
	.close = close_xdmf,
};
