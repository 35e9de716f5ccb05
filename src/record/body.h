/// @file body.h
/// What run.h5 says about the bodies, beside their surfaces.
#ifndef JN_RECORD_BODY_H
#define JN_RECORD_BODY_H

#include "record/h5_file.h"
#include "record/recorder.h"

/// Write what body.c tells, for every body.
JnStatus jn_record_bodies_write(JnH5File* file, const JnRecordInfo* info);

#endif
