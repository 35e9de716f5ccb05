// .vtu files: what stands around libxml2 and zlib, and both with it.
#include "support/mesh_format.h"

extern const JnImportFormat jn_import_vtu;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	return fuzz_mesh_format(&jn_import_vtu, data, size);
}
