/// @file system_list.h
/// The built-in systems that may stand in a scene in place of bodies: each is a file and a row.
#ifndef JN_MODEL_SYSTEM_LIST_H
#define JN_MODEL_SYSTEM_LIST_H

#include "jounce/extend.h"

/// A system of equations with its start. Its unknowns are coordinates of nodes, three a node, so that recordings show it.
typedef struct JnSystemType {
	JnRow row;
	/// Build it; free with jn_user_system_destroy. The options must outlive it.
	JnStatus (*create)(const void* options, JnSystem** sys);
	void (*start)(const void* options, double* x, double* v); ///< the state at t = 0
	int column_count;
	const JnPassColumn* columns;                                                ///< of the series
	void (*measure)(const void* options, const JnState* state, double* values); ///< one a column
} JnSystemType;

extern const JnRowList jn_system_list; ///< rows are &JnSystemType.row

#endif
