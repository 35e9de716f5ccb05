/// @file export.h
/// What the formats of `jounce export` share: the frames and parts of a recording, read one frame at a time. A format
/// is one file and one row of the table in export.c.
#ifndef JN_APP_EXPORT_H
#define JN_APP_EXPORT_H

#include "record/text_file.h"
#include "recording.h"

typedef enum ExportKind {
	EXPORT_SURFACE, ///< triangles
	EXPORT_CURVE,   ///< the axis of a thread: vertices in their order
	EXPORT_POINTS,  ///< vertices alone
} ExportKind;

/// A body or an obstacle as it is seen.
typedef struct ExportPart {
	const char* name;
	ExportKind kind;
	int vertex_count;
	int triangle_count;
	const int* triangles;      ///< 3 * triangle_count numbers of vertices, outward
	const int* points;         ///< numbers of points of the recording, one a vertex; NULL: made of a thread, or fixed
	const double* fixed;       ///< positions of what never moves [m]; NULL: it moves
	const RecordingBody* body; ///< NULL: an obstacle, or nodes without bodies
	const double* volumes;     ///< of EXPORT_POINTS: one a vertex [m^3]; NULL: unknown
	double radius;             ///< of a thread [m]
	bool is_closed;            ///< of EXPORT_CURVE: the last vertex is joined to the first
} ExportPart;

typedef struct Export {
	const char* path; ///< a file, or of formats that write many a folder that is there, and empty
	Recording recording;
	JnArena arena;
	bool wants_volume;   ///< cells in place of surfaces
	const char* color;   ///< what colours show; NULL: nothing
	double fps;          ///< frames a second in the animation; 0: the simulation's own time
	int frame_count;     ///< chosen ones
	const int* frames;   ///< their numbers in the recording, ascending
	const double* times; ///< when they are seen [s]
	int part_count;
	const ExportPart* parts;
	double* points;   ///< of the frame in hand, 3 * recording.point_count [m]
	double* vertices; ///< room for the vertices of any part, 3 numbers each
	long written;     ///< files
} Export;

typedef struct ExportFormat {
	const char *name, *doc;
	const char* output;     ///< name in the folder of the recording: of the file, or of a folder for many
	bool is_folder;         ///< writes many files
	bool has_time;          ///< --fps means something
	bool has_volume;        ///< can write cells, and does so unless asked for the surface
	bool has_color;         ///< --color means something
	ExportKind thread_kind; ///< a curve, or EXPORT_SURFACE: a tube
	JnStatus (*write)(Export* export);
} ExportFormat;

JnStatus export_glb(Export* export);
JnStatus export_obj(Export* export);
JnStatus export_ply(Export* export);
JnStatus export_vtu(Export* export);
JnStatus export_pc2(Export* export);
JnStatus export_usda(Export* export);

/// Write to `output`, or where the format usually goes when that is NULL.
JnStatus export_write(Export* export, const ExportFormat* format, const char* output);

/// Find the parts: bodies in their order, then obstacles.
JnStatus export_find_parts(Export* export, ExportKind thread_kind);

/// Read the chosen frame `index`. JN_BAD_INPUT after a message; JN_RUN_FAILED after one when Ctrl-C was pressed.
JnStatus export_load(Export* export, int index);

/// Vertices of a part in the frame in hand, 3 * vertex_count [m].
void export_vertices(const Export* export, const ExportPart* part, double* out);

/// Values of the vertices of a part that moves and is no tube, from those of all points of the recording.
void export_gather(const ExportPart* part, int components, const double* values, double* out);

/// Create `path`, to be closed with jn_text_close, which gives it its name, or jn_text_abandon.
JnStatus export_open(const char* path, JnTextFile* file);

/// Create a file in the export's folder.
JnStatus export_open_in(Export* export, const char* name, JnTextFile* file);

/// Numbers as binary, least significant byte first on any machine; jn_text_write tells failures.
void export_put_floats(JnTextFile* file, size_t count, const double* values);
void export_put_bits(JnTextFile* file, uint32_t bits, int bytes);

#endif
