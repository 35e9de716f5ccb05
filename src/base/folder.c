#include "base/folder.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/log.h"

JnStatus jn_folder_make(const char* path) {
	char part[4096];
	const size_t length = strlen(path);
	if (length == 0 || length >= sizeof part)
		return jn_error(JN_IO_FAILED, "'%.100s' is no usable folder name; choose another output with -o", path);
	for (size_t i = 1; i <= length; ++i) {
		if (path[i] != '/' && path[i] != '\0') continue;
		memcpy(part, path, i);
		part[i] = '\0';
		if (mkdir(part, 0777) != 0 && errno != EEXIST)
			return jn_error(JN_IO_FAILED, "%s: cannot make this folder: %s", part, strerror(errno));
	}
	struct stat about;
	if (stat(path, &about) != 0 || !S_ISDIR(about.st_mode))
		return jn_error(JN_IO_FAILED, "%s: is no folder; choose another output with -o", path);
	if (access(path, W_OK) != 0)
		return jn_error(JN_IO_FAILED, "%s: cannot write here: %s; choose another output with -o", path,
						strerror(errno));
	return JN_OK;
}
