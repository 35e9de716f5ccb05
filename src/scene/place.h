/// @file place.h
/// Messages that begin with a key path, completed by the place in the scene file: the layers below know
/// `bodies[0].fix[1].where`, and only the scene knows that this is line 25.
#ifndef JN_SCENE_PLACE_H
#define JN_SCENE_PLACE_H

#include "base/document.h"
#include "base/log.h"

typedef struct JnPlacing {
	const JnDocument* document;
	JnLog outer; ///< where the messages go on to
} JnPlacing;

/// From now on, errors "bodies[0].name: ..." go out as "file:line:column: bodies[0].name: ...". `placing` must stay
/// where it is until jn_placing_end.
void jn_placing_begin(JnPlacing* placing, const JnDocument* document);
void jn_placing_end(JnPlacing* placing);

#endif
