// stdio with its errors kept, and the usual way to replace a file at once: write beside it, fsync, rename.
#include "record/text_file.h"

#include <errno.h>
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include "base/log.h"

JnStatus jn_path_join(const char* directory, const char* name, char path[JN_PATH_SIZE]) {
	const int length = snprintf(path, JN_PATH_SIZE, "%s/%s", directory, name);
	if (length >= 0 && length < JN_PATH_SIZE) return JN_OK;
	return jn_error(JN_IO_FAILED,
					"the path of %s in %.60s... is longer than %d bytes; record into a directory nearer to the root",
					name, directory, JN_PATH_SIZE - 1);
}

JnStatus jn_text_open(JnTextFile* file, const char* directory, const char* name, JnTextMode mode) {
	*file = (JnTextFile){.mode = mode};
	JN_TRY(jn_path_join(directory, name, file->path));
	JN_TRY(jn_path_join(directory, name, file->temporary));
	if (mode == JN_TEXT_REPLACE) {
		char temporary_name[256];
		snprintf(temporary_name, sizeof temporary_name, "%s.tmp", name);
		JN_TRY(jn_path_join(directory, temporary_name, file->temporary));
	}
	file->stream = fopen(file->temporary, "w");
	if (file->stream != NULL) return JN_OK;
	return jn_error(JN_IO_FAILED, "%s: cannot create the file: %s", file->temporary, strerror(errno));
}

JnStatus jn_text_resume(JnTextFile* file, const char* directory, const char* name, long size) {
	*file = (JnTextFile){.mode = JN_TEXT_DIRECT};
	JN_TRY(jn_path_join(directory, name, file->path));
	JN_TRY(jn_path_join(directory, name, file->temporary));
	file->stream = fopen(file->path, "r+");
	if (file->stream == NULL)
		return jn_error(JN_IO_FAILED, "%s: cannot open the file to go on: %s", file->path, strerror(errno));
	const long length = fseek(file->stream, 0, SEEK_END) == 0 ? ftell(file->stream) : -1;
	const bool is_shorter = length >= 0 && length < size;
	if (length >= size && ftruncate(fileno(file->stream), size) == 0 && fseek(file->stream, size, SEEK_SET) == 0)
		return JN_OK;
	const int error = errno;
	fclose(file->stream);
	file->stream = NULL;
	if (is_shorter)
		return jn_error(JN_BAD_INPUT,
						"%s: has fewer than the %ld bytes that the checkpoint tells of; it is that of another run",
						file->path, size);
	return jn_error(JN_IO_FAILED, "%s: cannot be gone on with: %s", file->path, strerror(error));
}

static void keep_error(JnTextFile* file) {
	if (file->error == 0) file->error = errno != 0 ? errno : EIO;
}

void jn_text_print(JnTextFile* file, const char* format, ...) {
	va_list arguments;
	va_start(arguments, format);
	if (vfprintf(file->stream, format, arguments) < 0) keep_error(file);
	va_end(arguments);
}

void jn_text_write(JnTextFile* file, const char* text, size_t length) {
	if (fwrite(text, 1, length, file->stream) != length) keep_error(file);
}

static JnStatus tell_error(JnTextFile* file) {
	if (file->error == 0) return JN_OK;
	if (file->is_told) return JN_IO_FAILED;
	file->is_told = true;
	return jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", file->path, strerror(file->error));
}

JnStatus jn_text_flush(JnTextFile* file) {
	if (fflush(file->stream) != 0) keep_error(file);
	return tell_error(file);
}

JnStatus jn_text_sync(JnTextFile* file) {
	JN_TRY(jn_text_flush(file));
	if (fdatasync(fileno(file->stream)) != 0) keep_error(file);
	return tell_error(file);
}

JnStatus jn_text_close(JnTextFile* file) {
	if (file->stream == NULL) return JN_OK;
	const bool is_replacing = file->mode == JN_TEXT_REPLACE;
	if (fflush(file->stream) != 0) keep_error(file);
	if (is_replacing && file->error == 0 && fsync(fileno(file->stream)) != 0) keep_error(file);
	if (fclose(file->stream) != 0) keep_error(file);
	file->stream = NULL;
	if (is_replacing && file->error == 0 && rename(file->temporary, file->path) != 0) keep_error(file);
	if (is_replacing && file->error != 0) unlink(file->temporary);
	return tell_error(file);
}

void jn_text_abandon(JnTextFile* file) {
	if (file->stream == NULL) return;
	fclose(file->stream);
	file->stream = NULL;
	if (file->mode == JN_TEXT_REPLACE) unlink(file->temporary);
}
