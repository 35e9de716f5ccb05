// What malloc gave stands in the pointer before the aligned piece.
#include "base/aligned.h"

#include <stdint.h>
#include <stdlib.h>

void* jn_aligned_take(size_t bytes) {
	if (bytes > SIZE_MAX - (size_t)3 * JN_ALIGNMENT) return NULL;
	const size_t lines = (bytes + JN_ALIGNMENT - 1) / JN_ALIGNMENT * JN_ALIGNMENT;
	char* whole = calloc(lines + JN_ALIGNMENT + sizeof(void*), 1);
	if (whole == NULL) return NULL;
	const size_t after = (uintptr_t)(whole + sizeof(void*)) % JN_ALIGNMENT;
	void** aligned = (void**)(whole + sizeof(void*) + (after > 0 ? JN_ALIGNMENT - after : 0));
	aligned[-1] = whole;
	return aligned;
}

void jn_aligned_free(void* memory) {
	if (memory != NULL) free(((void**)memory)[-1]);
}
