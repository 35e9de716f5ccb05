#include "mesh/fill/cache.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/folder.h"
#include "base/hash.h"
#include "base/log.h"
#include "mesh/fill/tetrahedra.h"
#include "mesh/format/export.h"
#include "mesh/format/import.h"

static const char MESHER[] = "tetrahedra 1"; // renewed when jn_tetrahedra_fill gives other meshes than before

enum { PATH_SIZE = 4096 };

static void swallow(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level, (void)message;
}

static bool find_folder(char folder[PATH_SIZE]) {
	const char *own = getenv("JOUNCE_CACHE"), *caches = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
	int length = 0;
	if (own != NULL && own[0] != '\0')
		length = strcmp(own, "off") == 0 ? 0 : snprintf(folder, PATH_SIZE, "%s", own);
	else if (caches != NULL && caches[0] == '/')
		length = snprintf(folder, PATH_SIZE, "%s/jounce", caches);
	else if (home != NULL && home[0] == '/')
		length = snprintf(folder, PATH_SIZE, "%s/.cache/jounce", home);
	return length > 0 && length < PATH_SIZE - 64;
}

static bool find_path(const JnSurface* surface, double size, char path[PATH_SIZE]) {
	char folder[PATH_SIZE], name[33];
	if (!find_folder(folder) || jn_folder_make(folder) != JN_OK) return false;
	JnHash hash = jn_hash_add(jn_hash_start(), MESHER, sizeof MESHER);
	hash = jn_hash_add(hash, &size, sizeof size);
	hash = jn_hash_add(hash, surface->nodes, 3 * (size_t)surface->node_count * sizeof *surface->nodes);
	hash = jn_hash_add(hash, surface->triangles, 3 * (size_t)surface->triangle_count * sizeof *surface->triangles);
	jn_hash_text(hash, name);
	return snprintf(path, PATH_SIZE, "%s/%s.vtu", folder, name) < PATH_SIZE;
}

static bool is_kept_mesh(const char* path, JnArena* arena, JnMesh* mesh) {
	JnImport import = {0};
	if (access(path, R_OK) != 0 || jn_import(path, arena, &import) != JN_OK) return false;
	if (!import.is_volume || import.volume.shape != JN_TET4) return false;
	*mesh = import.volume;
	return true;
}

JnStatus jn_cache_tetrahedra(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh,
							 bool* was_kept) {
	char path[PATH_SIZE];
	const JnLog outer = jn_log_swap((JnLog){swallow, NULL});
	const bool has_path = find_path(surface, size, path);
	const bool is_found = has_path && is_kept_mesh(path, arena, mesh);
	jn_log_swap(outer);
	if (was_kept != NULL) *was_kept = is_found;
	if (is_found) return JN_OK;
	JN_TRY(jn_tetrahedra_fill(surface, size, what, arena, mesh));
	if (!has_path) return JN_OK;
	jn_log_swap((JnLog){swallow, NULL});
	jn_export_volume(mesh, path);
	jn_log_swap(outer);
	return JN_OK;
}
