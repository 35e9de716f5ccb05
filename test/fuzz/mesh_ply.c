// PLY files as far as jounce looks at them itself; assimp reads them in a process of its own.
#include "mesh/format/ply_check.h"
#include "support/fuzz.h"
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	char* text = fuzz_text(data, size);
	fuzz_listen();
	fuzz_judge(jn_ply_check("mesh.ply", &(JnContent){size, text}));
	free(text);
	return 0;
}
