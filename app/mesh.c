// jounce mesh: read a mesh, check it, fill it, write it.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "base/timer.h"
#include "mesh/format/export.h"
#include "mesh/quality.h"
#include "mesh/shape/shape_file.h"
#include "options.h"

static const char help[] =
	"usage: jounce mesh IN [-o OUT] [--tets SIZE | --voxels SIZE] [--set key=value ...]\n\n"
	"Reads a surface (.obj .ply .stl .off .gltf .glb) or a volume (.msh .vtk .vtu), repairs what can be repaired, and\n"
	"says what it holds: counts, size, volume, quality of the cells.\n\n"
	"  -o, --output OUT   write it: volumes as .msh or .vtu, surfaces as .obj, .ply, .stl or .off\n"
	"      --tets SIZE    fill a closed surface with tetrahedra of this edge length, such as 2cm (by Gmsh)\n"
	"      --voxels SIZE  surround a closed surface with cubes of this edge length\n"
	"      --set k=v      a key of `shape: {type: file}`: up, scale, rotate, fit, translate, tetrahedra.element;\n"
	"                     `jounce describe bodies.shape.file` explains them\n\n"
	"Tetrahedra are kept in ~/.cache/jounce (JOUNCE_CACHE=folder or off), so that the same ones are made once.";

static const struct option known[] = {
	{"help", no_argument, NULL, 'h'},       {"output", required_argument, NULL, 'o'},
	{"tets", required_argument, NULL, 't'}, {"voxels", required_argument, NULL, 'v'},
	{"set", required_argument, NULL, 's'},  {0},
};

typedef struct MeshOptions {
	const char *in, *out;
	bool wants_help;
	JnArena arena;
	JnDocument document; // the keys of a shape, as options say them
} MeshOptions;

static JnStatus set(MeshOptions* options, const char* key, const char* value) {
	const size_t size = strlen(key) + strlen(value) + 2;
	char* text = jn_arena_take(&options->arena, size, 1);
	if (text == NULL) return JN_OUT_OF_MEMORY;
	snprintf(text, size, "%s=%s", key, value);
	return jn_document_set(&options->document, text);
}

static int read_option(int option, char** arguments, MeshOptions* options) {
	switch (option) {
	case 'h':
		options->wants_help = true;
		return EXIT_DONE;
	case 'o':
		options->out = optarg;
		return EXIT_DONE;
	case 't':
		return app_exit_status(set(options, "tetrahedra.size", optarg));
	case 'v':
		return app_exit_status(set(options, "voxels.size", optarg));
	case 's':
		return app_exit_status(jn_document_set(&options->document, optarg));
	case ':':
		return app_usage_error("mesh", "%s needs a value behind it", arguments[optind - 1]);
	default:
		return app_refuse_option("mesh", known, arguments);
	}
}

static int read_options(int count, char** arguments, MeshOptions* options) {
	opterr = 0;
	int status = app_exit_status(jn_document_parse("options", "{}", &options->arena, &options->document));
	for (int option; status == EXIT_DONE && (option = getopt_long(count, arguments, ":ho:", known, NULL)) != -1;)
		status = read_option(option, arguments, options);
	if (status != EXIT_DONE || options->wants_help) return status;
	if (optind == count) return app_usage_error("mesh", "no file is given");
	if (optind + 1 < count)
		return app_usage_error("mesh", "one file at a time; '%s' is one too many", arguments[optind + 1]);
	options->in = arguments[optind];
	return app_exit_status(set(options, "path", options->in));
}

static void print_box(int count, const double* points) {
	double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (int i = 0; i < 3 * count; ++i) {
		low[i % 3] = fmin(low[i % 3], points[i]);
		high[i % 3] = fmax(high[i % 3], points[i]);
	}
	printf("  box         [%.4g, %.4g] x [%.4g, %.4g] x [%.4g, %.4g] m\n", low[0], high[0], low[1], high[1], low[2],
		   high[2]);
}

static void print_surface(const JnSurface* surface) {
	printf("  surface     %d triangles, %d nodes\n", surface->triangle_count, surface->node_count);
	print_box(surface->node_count, surface->nodes);
	printf("  inside      %.6g m^3, area %.6g m^2\n", jn_surface_volume(surface), jn_surface_area(surface));
}

static JnStatus print_volume(const JnFileMesh* file, double seconds) {
	const JnMesh* mesh = &file->volume;
	JnQuality quality;
	JN_TRY(jn_mesh_quality(mesh, &quality));
	double volume = 0;
	for (int cell = 0; cell < mesh->cell_count; ++cell) volume += jn_mesh_cell_volume(mesh, cell);
	printf("  cells       %d %s, %d nodes", mesh->cell_count, jn_shape_info[mesh->shape].name, mesh->node_count);
	printf(file->was_kept ? " (made before, kept in the cache)\n" : " (%.2g s)\n", seconds);
	if (file->surface.triangle_count == 0) print_box(mesh->node_count, mesh->nodes);
	printf("  filled      %.6g m^3\n", volume);
	printf("  quality     %s: min %.3g (cell %d), median %.3g\n", quality.measure, quality.min, quality.worst,
		   quality.median);
	for (int i = 0; i < mesh->set_count; ++i)
		printf("  node set    %s: %d nodes\n", mesh->sets[i].name, mesh->sets[i].count);
	return JN_OK;
}

static JnStatus write_mesh(const JnFileMesh* file, const char* path) {
	JN_TRY(file->has_volume ? jn_export_volume(&file->volume, path) : jn_export_surface(&file->surface, path));
	printf("  written     %s\n", path);
	return JN_OK;
}

static JnStatus mesh(MeshOptions* options) {
	JnFileDef def;
	JnFileMesh file;
	JN_TRY(jn_keys_read(jn_file_keys, options->document.root, "mesh", &options->arena, &def));
	const double start = jn_seconds();
	JN_TRY(jn_file_mesh(&def, "mesh", &options->arena, &file));
	printf("%s: ok\n", options->in);
	if (file.surface.triangle_count > 0) print_surface(&file.surface);
	if (file.has_volume) JN_TRY(print_volume(&file, jn_seconds() - start));
	return options->out != NULL ? write_mesh(&file, options->out) : JN_OK;
}

int app_mesh(int count, char** arguments) {
	MeshOptions options = {0};
	int status = read_options(count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE)
		status = app_exit_status(mesh(&options));
	jn_arena_free(&options.arena);
	return status;
}
