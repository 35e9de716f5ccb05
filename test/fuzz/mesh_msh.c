// .msh files as far as jounce looks at them itself (the first byte is odd), and the meshes that the process with Gmsh hands
// back (it is even).
#include <stdio.h>
#include <stdlib.h>

#include "mesh/format/gmsh_model.h"
#include "mesh/format/msh_outline.h"
#include "support/fuzz.h"
#include "support/mesh_format.h"

static JnStatus read_outline(const uint8_t* data, size_t size) {
	JnMshOutline outline;
	char* text = fuzz_text(data, size);
	const JnStatus status = jn_msh_outline("mesh.msh", &(JnContent){size, text}, &outline);
	free(text);
	return status;
}

static JnStatus read_model(const uint8_t* data, size_t size) {
	JnArena arena = {0};
	JnImport import;
	FILE* stream = fopen(fuzz_file(data, size), "rb");
	if (stream == NULL) abort();
	JnStatus status = jn_gmsh_model_read(stream, "mesh.msh", &arena, &import);
	fclose(stream);
	if (status == JN_OK)
		status = import.is_volume ? jn_mesh_repair(&import.volume, "mesh.msh", &arena)
								  : jn_surface_repair(&import.surface, "mesh.msh");
	if (status == JN_OK) fuzz_check_import(&import);
	jn_arena_free(&arena);
	return status;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	if (size == 0) return 0;
	fuzz_listen();
	fuzz_judge(data[0] % 2 == 1 ? read_outline(data + 1, size - 1) : read_model(data + 1, size - 1));
	return 0;
}
