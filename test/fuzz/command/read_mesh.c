// The option reader of jounce mesh, which no other file sees.
#include "command.h"
#include "mesh.c"

int fuzz_read_mesh(int count, char** arguments) {
	MeshOptions options = {0};
	const int status = read_options(count, arguments, &options);
	jn_arena_free(&options.arena);
	return status;
}
