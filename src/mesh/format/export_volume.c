// Volumes into files: the format by the extension, the name when all is written.
#include "mesh/format/export_volume.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/log.h"
#include "mesh/format/export.h"

typedef struct Format {
	const char* extension;
	JnStatus (*write)(const JnMesh* mesh, const char* temporary, const char* path);
} Format;

static const Format formats[] = {{".msh", jn_export_gmsh}, {".vtu", jn_export_vtu}};

enum { PATH_SIZE = 4096 };

static const Format* find_format(const char* path) {
	const char* name = strrchr(path, '/') != NULL ? strrchr(path, '/') : path;
	const char* extension = strrchr(name, '.');
	for (size_t i = 0; i < sizeof formats / sizeof formats[0] && extension != NULL; ++i)
		if (strcasecmp(extension, formats[i].extension) == 0) return &formats[i];
	return NULL;
}

JnStatus jn_export_volume(const JnMesh* mesh, const char* path) {
	const Format* format = find_format(path);
	char temporary[PATH_SIZE];
	if (format == NULL) return jn_error(JN_BAD_INPUT, "%s: a volume can be written as .msh or .vtu", path);
	// the extension comes last: by it Gmsh knows the format
	const int length = snprintf(temporary, sizeof temporary, "%s.%ld%s", path, (long)getpid(), format->extension);
	if (length < 0 || length >= PATH_SIZE) return jn_error(JN_IO_FAILED, "%s: the path is too long", path);
	JnStatus status = format->write(mesh, temporary, path);
	if (status == JN_OK && rename(temporary, path) != 0)
		status = jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", path, strerror(errno));
	if (status != JN_OK) unlink(temporary);
	return status;
}
