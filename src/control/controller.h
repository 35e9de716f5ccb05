/// @file controller.h
/// Making controllers; the rules themselves are rows of the list.
#ifndef JN_CONTROL_CONTROLLER_H
#define JN_CONTROL_CONTROLLER_H

#include "jounce/extend.h"

extern const JnRowList jn_controller_list; ///< rows are &JnControllerType.row

/// A controller of the row that `choice` names, whose options it keeps by pointer; NULL when memory is out.
JnController* jn_controller_create(const JnVariant* choice);
void jn_controller_destroy(JnController* controller);

#endif
