// Files and folders that are whole or not there, and what goes into them.
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "export.h"
#include "interrupt.h"

JnStatus export_load(Export* export, int index) {
	if (app_interrupted) return jn_error(JN_RUN_FAILED, "stopped; nothing was written");
	return recording_points(&export->recording, export->frames[index], export->points);
}

JnStatus export_open(const char* path, JnTextFile* file) {
	const char* slash = strrchr(path, '/');
	char folder[JN_PATH_SIZE] = ".";
	if (slash != NULL) snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
	return jn_text_open(file, slash == path ? "" : folder, slash != NULL ? slash + 1 : path, JN_TEXT_REPLACE);
}

JnStatus export_open_in(Export* export, const char* name, JnTextFile* file) {
	export->written++;
	return jn_text_open(file, export->path, name, JN_TEXT_DIRECT);
}

static char* store(char* out, uint32_t bits, int bytes) {
	for (int i = 0; i < bytes; ++i) *out++ = (char)(bits >> 8 * i & 255);
	return out;
}

void export_put_bits(JnTextFile* file, uint32_t bits, int bytes) {
	char out[4];
	store(out, bits, bytes);
	jn_text_write(file, out, (size_t)bytes);
}

void export_put_floats(JnTextFile* file, size_t count, const double* values) {
	char buffer[4096], *end = buffer;
	for (size_t i = 0; i < count; ++i) {
		const float single = (float)values[i];
		uint32_t bits;
		memcpy(&bits, &single, sizeof bits);
		end = store(end, bits, 4);
		if (end < buffer + sizeof buffer && i + 1 < count) continue;
		jn_text_write(file, buffer, (size_t)(end - buffer));
		end = buffer;
	}
}
