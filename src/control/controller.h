/// @file controller.h
/// Making controllers; the rules themselves are rows of the list.
#ifndef JN_CONTROL_CONTROLLER_H
#define JN_CONTROL_CONTROLLER_H

#include "jounce/extend.h"

extern const JnRowList jn_controller_list; ///< rows are &JnControllerType.row

/// A controller of the row that `choice` names, for steps of `integrator` on `sys`; it keeps pointers to all of them.
/// `path` says where its keys stand, for messages. JN_BAD_INPUT after a message when its options contradict each other or
/// when it cannot serve the method. Free with jn_controller_destroy.
JnStatus jn_controller_create(const JnVariant* choice, const char* path, JnIntegrator* integrator, JnSystem* sys,
							  JnController** controller);
void jn_controller_destroy(JnController* controller);

/// Call before every attempt, when what acts on the step is known.
JnStatus jn_controller_prepare(JnController* controller, const JnStep* step);

/// Write or read what the controller remembers.
void jn_controller_archive(JnController* controller, JnArchive* archive);

/// What the last refusal was about, when JN_RUN_FAILED came of it.
void jn_controller_explain(const JnController* controller, JnComplaint* complaint);

#endif
