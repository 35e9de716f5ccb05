// Names of the ways to solve linear systems.
#include "jounce/base.h"

const char* jn_way_name(JnWay way) {
	static const char* const names[JN_WAY_COUNT] = {
		[JN_WAY_DIRECT] = "direct",         [JN_WAY_PLAIN] = "none",
		[JN_WAY_BLOCK] = "block",           [JN_WAY_KEPT] = "kept",
		[JN_WAY_INCOMPLETE] = "incomplete", [JN_WAY_MULTIGRID] = "multigrid"};
	return names[way];
}
