// Legacy .vtk files, as they are read and then repaired.
#include "support/mesh_format.h"

extern const JnImportFormat jn_import_vtk;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	return fuzz_mesh_format(&jn_import_vtk, data, size);
}
