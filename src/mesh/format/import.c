// The formats that can be read, and the way through them.
#include "mesh/format/import.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/log.h"
#include "mesh/repair.h"

extern const JnImportFormat jn_import_surface, jn_import_gmsh, jn_import_vtk, jn_import_vtu;

const JnImportFormat* const jn_import_list[] = {&jn_import_surface, &jn_import_gmsh, &jn_import_vtk, &jn_import_vtu,
												NULL};

/// Whether a list of words, separated by spaces, holds a word in upper or lower case.
static bool has_word(const char* words, const char* word, size_t length) {
	for (const char* at = words; *at != '\0'; at += strspn(at, " ")) {
		const size_t size = strcspn(at, " ");
		if (size == length && strncasecmp(at, word, size) == 0) return true;
		at += size;
	}
	return false;
}

static const JnImportFormat* find_format(const char* path) {
	const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
	if (dot == NULL || (slash != NULL && dot < slash)) return NULL;
	for (int i = 0; jn_import_list[i] != NULL; i++)
		if (has_word(jn_import_list[i]->extensions, dot + 1, strlen(dot + 1))) return jn_import_list[i];
	return NULL;
}

static JnStatus unknown_format(const char* path) {
	char known[300] = "";
	for (int i = 0; jn_import_list[i] != NULL; i++) {
		const size_t used = strlen(known);
		snprintf(known + used, sizeof known - used, " %s", jn_import_list[i]->extensions);
	}
	return jn_error(JN_BAD_INPUT, "%s: cannot tell the format by this name; known endings are%s", path, known);
}

JnStatus jn_import(const char* path, JnArena* arena, JnImport* out) {
	*out = (JnImport){.is_volume = false};
	const JnImportFormat* format = find_format(path);
	if (format == NULL) return unknown_format(path);
	JN_TRY(format->read(path, arena, out));
	return out->is_volume ? jn_mesh_repair(&out->volume, path, arena) : jn_surface_repair(&out->surface, path);
}
