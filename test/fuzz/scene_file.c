// Bytes of scene files, by way of the file: size, zero bytes, encodings.
#include <stdlib.h>

#include "jounce/scene.h"
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	JnScene* scene = NULL;
	const char* path = fuzz_file(data, size);
	fuzz_listen();
	const JnStatus status = jn_scene_load(path, 0, NULL, &scene);
	fuzz_judge(status);
	if ((status == JN_OK) != (scene != NULL)) abort();
	jn_scene_destroy(scene);
	return 0;
}
