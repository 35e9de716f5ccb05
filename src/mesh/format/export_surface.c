// Surfaces into files. Numbers as text have all their digits; STL is binary, in single precision.
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/log.h"
#include "mesh/format/export.h"

typedef struct SurfaceFormat {
	const char* extension;
	void (*write)(const JnSurface* surface, FILE* file); // errors stay in the stream
} SurfaceFormat;

static void write_nodes(const JnSurface* surface, const char* before, FILE* file) {
	for (int i = 0; i < surface->node_count; i++) {
		const double* x = surface->nodes + 3 * (ptrdiff_t)i;
		fprintf(file, "%s%.17g %.17g %.17g\n", before, x[0], x[1], x[2]);
	}
}

static void write_triangles(const JnSurface* surface, const char* before, int first, FILE* file) {
	for (int i = 0; i < surface->triangle_count; i++) {
		const int* t = surface->triangles + 3 * (ptrdiff_t)i;
		fprintf(file, "%s%d %d %d\n", before, t[0] + first, t[1] + first, t[2] + first);
	}
}

static void write_obj(const JnSurface* surface, FILE* file) {
	write_nodes(surface, "v ", file);
	write_triangles(surface, "f ", 1, file);
}

static void write_off(const JnSurface* surface, FILE* file) {
	fprintf(file, "OFF\n%d %d 0\n", surface->node_count, surface->triangle_count);
	write_nodes(surface, "", file);
	write_triangles(surface, "3 ", 0, file);
}

static void write_ply(const JnSurface* surface, FILE* file) {
	fprintf(file,
			"ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
			"element face %d\nproperty list uchar int vertex_indices\nend_header\n",
			surface->node_count, surface->triangle_count);
	write_nodes(surface, "", file);
	write_triangles(surface, "3 ", 0, file);
}

/// The least significant byte first, on any machine.
static void put_bits(uint32_t bits, int bytes, FILE* file) {
	for (int i = 0; i < bytes; i++) fputc((int)(bits >> 8 * i & 255), file);
}

static void put_float(double value, FILE* file) {
	const float single = (float)value;
	uint32_t bits;
	memcpy(&bits, &single, sizeof bits);
	put_bits(bits, 4, file);
}

/// 80 bytes of title, a count, and 50 bytes a triangle: its normal (0: see the corners), its corners, two bytes of 0.
static void write_stl(const JnSurface* surface, FILE* file) {
	fprintf(file, "%-80s", "binary STL by jounce");
	put_bits((uint32_t)surface->triangle_count, 4, file);
	for (int i = 0; i < surface->triangle_count; i++) {
		for (int a = 0; a < 3; a++) put_float(0, file);
		for (int k = 0; k < 9; k++)
			put_float(surface->nodes[3 * (ptrdiff_t)surface->triangles[3 * (ptrdiff_t)i + k / 3] + k % 3], file);
		put_bits(0, 2, file);
	}
}

static const SurfaceFormat formats[] = {
	{".obj", write_obj},
	{".ply", write_ply},
	{".stl", write_stl},
	{".off", write_off},
};

/// "<path>.part" is written and renamed.
static JnStatus write_whole(const JnSurface* surface, const SurfaceFormat* format, const char* path, const char* part) {
	FILE* file = fopen(part, "wb");
	if (file == NULL) return jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", path, strerror(errno));
	format->write(surface, file);
	const bool is_written = ferror(file) == 0;
	if ((fclose(file) == 0) & is_written && rename(part, path) == 0) return JN_OK;
	const int reason = errno;
	remove(part);
	return jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", path, strerror(reason));
}

JnStatus jn_export_surface(const JnSurface* surface, const char* path) {
	const char* extension = strrchr(path, '.');
	const SurfaceFormat* format = NULL;
	for (size_t i = 0; extension != NULL && i < sizeof formats / sizeof formats[0]; i++)
		if (strcasecmp(formats[i].extension, extension) == 0) format = &formats[i];
	if (format == NULL)
		return jn_error(JN_BAD_INPUT, "%s: cannot write a surface by this name; known endings are obj ply stl off",
						path);
	JnArena scratch = {0};
	const size_t size = strlen(path) + sizeof ".part";
	char* part;
	JN_NEW(&scratch, part, size);
	snprintf(part, size, "%s.part", path);
	const JnStatus status = write_whole(surface, format, path, part);
	jn_arena_free(&scratch);
	return status;
}
