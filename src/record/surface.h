/// @file surface.h
/// The surfaces of all bodies in the one array of points and the one of triangles that XDMF can show.
///
/// Without embedded surfaces the points are the nodes. With one, the points of the bodies follow each other: the vertices
/// of an embedded surface, or all nodes of a body that has none.
#ifndef JN_RECORD_SURFACE_H
#define JN_RECORD_SURFACE_H

#include "record/h5_file.h"
#include "record/recorder.h"

/// Does a body carry an embedded surface, so that the points are not simply the nodes?
bool jn_record_has_embedding(const JnRecordInfo* info);

/// Points of a body, and of all bodies together.
int jn_record_point_count(const JnRecordBody* body);
long jn_record_points(const JnRecordInfo* info);
long jn_record_triangles(const JnRecordInfo* info);

/// positions[3 * points] [m] when the nodes are at x[3 * node_count].
void jn_record_surface_positions(const JnRecordInfo* info, const double* x, double* positions);

/// Write /mesh/<body>/surface for every body, /topology/surface [triangles, 3] with numbers of points, and
/// /topology/surface_body [triangles].
JnStatus jn_record_surface_write(JnH5File* file, const JnRecordInfo* info);

#endif
