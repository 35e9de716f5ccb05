#include "base/grow.h"

#include <stdlib.h>

#include "base/log.h"

JnStatus jn_grow(void** at, size_t* capacity, size_t count, size_t size) {
	if (count <= *capacity) return JN_OK;
	const size_t larger = count + count / 2;
	void* grown = realloc(*at, larger * size);
	if (grown == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: %zu bytes", larger * size);
	*at = grown;
	*capacity = larger;
	return JN_OK;
}
