// Scene files that are built as well: meshes, models, passes, controllers, solvers. Memory is bounded, so that a model with
// a hundred million nodes fails early; scenes that name files are left out, since those are targets of their own.
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "support/fuzz.h"

static const size_t MOST_MEMORY = (size_t)96 << 20;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	char* text = fuzz_text(data, size);
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	fuzz_listen();
	fuzz_limit_memory(MOST_MEMORY);
	JnStatus status = jn_scene_parse("scene.yaml", text, 0, NULL, &scene);
	if (status == JN_OK && strstr(text, "path") == NULL) status = jn_scene_build(scene, 1, &sim);
	fuzz_limit_memory(0);
	fuzz_judge(status);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	free(text);
	return 0;
}
