// Where an export goes: a file that may be replaced, or a new folder. Nothing is seen there before it is whole.
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/log.h"
#include "export.h"

static JnStatus fail_path(const char* path) {
	return jn_error(JN_IO_FAILED, "%s: cannot write here: %s", path, strerror(errno));
}

/// JN_OK when there is no such folder, or nothing in it.
static JnStatus check_folder(const char* path) {
	DIR* folder = opendir(path);
	int entries = 0;
	if (folder == NULL && errno == ENOENT) return JN_OK;
	if (folder == NULL) return fail_path(path);
	while (readdir(folder) != NULL) entries++;
	closedir(folder);
	if (entries <= 2) return JN_OK; // itself and its parent
	return jn_error(JN_BAD_INPUT, "%s: this folder is not empty; remove it or choose another one with -o", path);
}

/// A file may be replaced, and nothing else.
static JnStatus check_file(const char* path) {
	struct stat facts;
	if (stat(path, &facts) != 0 || S_ISREG(facts.st_mode)) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: this is %s; give the name of a file with -o", path,
					S_ISDIR(facts.st_mode) ? "a folder" : "no file that can be replaced");
}

static void remove_folder(const char* path) {
	DIR* folder = opendir(path);
	char name[JN_PATH_SIZE];
	for (struct dirent* entry; folder != NULL && (entry = readdir(folder)) != NULL;)
		if (entry->d_name[0] != '.' && jn_path_join(path, entry->d_name, name) == JN_OK) unlink(name);
	if (folder != NULL) closedir(folder);
	rmdir(path);
}

/// Everything goes into a folder beside the wanted one, which takes its name at the end.
static JnStatus write_folder(Export* export, const ExportFormat* format, const char* path) {
	char part[JN_PATH_SIZE];
	JN_TRY(check_folder(path));
	if (snprintf(part, sizeof part, "%s.XXXXXX", path) >= (int)sizeof part || mkdtemp(part) == NULL)
		return fail_path(path);
	export->path = part;
	const mode_t mask = umask(0);
	umask(mask);
	JnStatus status = format->write(export);
	if (status == JN_OK && (chmod(part, 0777 & ~mask) != 0 || rename(part, path) != 0)) status = fail_path(path);
	if (status != JN_OK) remove_folder(part);
	export->path = path;
	return status;
}

JnStatus export_write(Export* export, const ExportFormat* format, const char* output) {
	char otherwise[JN_PATH_SIZE];
	const char* slash = strrchr(export->recording.path, '/');
	const int length = slash != NULL ? (int)(slash - export->recording.path) + 1 : 0;
	snprintf(otherwise, sizeof otherwise, "%.*s%s", length, export->recording.path, format->output);
	const char* path = jn_arena_text(&export->arena, output != NULL ? output : otherwise);
	if (path == NULL) return JN_OUT_OF_MEMORY;
	for (char* end = (char*)path + strlen(path); format->is_folder && end > path + 1 && end[-1] == '/';) *--end = '\0';
	export->path = path;
	if (format->is_folder) return write_folder(export, format, path);
	export->written = 1;
	JN_TRY(check_file(path));
	return format->write(export);
}
