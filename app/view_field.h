/// @file view_field.h
/// Numbers that colour what is drawn: those of the recording, speed, and what the model gives for recorded positions.
#ifndef JN_APP_VIEW_FIELD_H
#define JN_APP_VIEW_FIELD_H

#include "view_run.h"

/// Fill run->fields; without what frames hold while there is no frame. JN_IO_FAILED without a message.
JnStatus view_fields_list(ViewRun* run);

/// out[points.count]: a field at the drawn points of a frame, VIEW_ABSENT where it has no value; of vectors their length.
/// JN_BAD_INPUT, without a message, when there is no such field, or none such for this run: then run->elastic_reason says
/// why. JN_IO_FAILED without a message.
JnStatus view_field_read(ViewRun* run, const char* name, long frame, float* out);

#endif
