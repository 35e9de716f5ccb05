/// @file obstacles.h
/// Obstacles in run.h5: each by itself, and all in the arrays that XDMF can show.
#ifndef JN_RECORD_OBSTACLES_H
#define JN_RECORD_OBSTACLES_H

#include "record/h5_file.h"
#include "record/recorder.h"

/// Points and triangles of all obstacles together.
long jn_record_obstacle_points(const JnRecordInfo* info);
long jn_record_obstacle_triangles(const JnRecordInfo* info);

/// Write what obstacles.c tells; nothing when there are no obstacles.
JnStatus jn_record_obstacles_write(JnH5File* file, const JnRecordInfo* info);

#endif
