// MSH 2.2 and 4.1, text and binary, by Gmsh. Gmsh crashes on some damaged files (4 of 150 with a few bytes changed, of
// two formats out of four), so that it reads in a child process (guard.h), which costs the 0.2 s that Gmsh needs to start.
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include "base/guard.h"
#include "base/log.h"
#include "mesh/format/gmsh_model.h"

#ifdef JN_GMSH_LIBRARY

typedef struct Job {
	const char* path;
	JnMshOutline outline;
} Job;

/// In the child. Gmsh sees the open file under a name without extension, beside which it finds no script to run with it.
static JnStatus read_in_child(void* user, FILE* result) {
	const Job* job = user;
	JnGmsh gmsh;
	char name[64];
	JN_TRY(jn_gmsh_open(job->path, &gmsh));
	const int file = open(job->path, O_RDONLY);
	if (file < 0) return jn_error(JN_IO_FAILED, "%s: cannot open the file", job->path);
	snprintf(name, sizeof name, "/proc/self/fd/%d", file);
	int error = 0;
	gmsh.Open(name, &error);
	JN_TRY(jn_gmsh_check(&gmsh, error, job->path, "read the file"));
	return jn_gmsh_model_write(&gmsh, job->path, &job->outline, result);
}

/// Gmsh takes up to some 40 bytes of memory a byte of a binary file.
static JnGuardLimits limits_for(size_t file_size) {
	const size_t gigabyte = (size_t)1 << 30;
	return (JnGuardLimits){.memory = 2 * gigabyte + 100 * file_size, .seconds = 20 + 2 * (int)(file_size >> 20)};
}

static JnStatus read_gmsh(const char* path, JnArena* arena, JnImport* out) {
	JnArena scratch = {0};
	JnContent content;
	Job job = {.path = path};
	*out = (JnImport){0};
	JnStatus status = jn_content_read(path, &scratch, &content);
	if (status == JN_OK) status = jn_msh_outline(path, &content, &job.outline);
	jn_arena_free(&scratch);
	JN_TRY(status);
	FILE* mesh;
	JN_TRY(jn_guard_run(path, limits_for(content.size), read_in_child, &job, &mesh));
	status = jn_gmsh_model_read(mesh, path, arena, out);
	fclose(mesh);
	return status;
}

#else

static JnStatus read_gmsh(const char* path, JnArena* arena, JnImport* out) {
	(void)arena;
	JnGmsh gmsh;
	*out = (JnImport){0};
	return jn_gmsh_open(path, &gmsh);
}

#endif

extern const JnImportFormat jn_import_gmsh;
const JnImportFormat jn_import_gmsh = {"Gmsh", "msh", read_gmsh};
