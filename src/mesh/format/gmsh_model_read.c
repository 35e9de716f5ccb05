// The receiving end of gmsh_model.c. Its input comes from a process that may have been damaged by what it read, so that
// sizes and numbers are checked again.
#include <limits.h>
#include <string.h>
#include <sys/stat.h>

#include "base/log.h"
#include "mesh/format/gmsh_model.h"
#include "mesh/format/gmsh_stream.h"

typedef struct Reader {
	FILE* stream;
	const char* what;
	JnArena* arena;
	size_t size; // of the whole stream
} Reader;

static JnStatus tell_damage(const Reader* reader) {
	return jn_error(JN_BAD_INPUT, "%s: the mesh is not whole", reader->what);
}

/// `count` objects of `size` bytes, from the arena.
static JnStatus take(const Reader* reader, size_t count, size_t size, void* out) {
	if (count > reader->size / size) return tell_damage(reader);
	void* data = jn_arena_take(reader->arena, count + 1, size);
	if (data == NULL) return JN_OUT_OF_MEMORY;
	if (fread(data, size, count, reader->stream) != count) return tell_damage(reader);
	memcpy(out, &data, sizeof data);
	return JN_OK;
}

static JnStatus check_range(const Reader* reader, const int* nodes, size_t count, size_t node_count) {
	for (size_t i = 0; i < count; ++i)
		if (nodes[i] < 0 || (size_t)nodes[i] >= node_count) return tell_damage(reader);
	return JN_OK;
}

static JnStatus read_set(const Reader* reader, size_t node_count, JnNodeSet* set) {
	JnGmshSetHeader header;
	if (fread(&header, sizeof header, 1, reader->stream) != 1 || header.count > INT_MAX) return tell_damage(reader);
	char* name = NULL;
	JN_TRY(take(reader, header.name_length, 1, &name));
	JN_TRY(take(reader, header.count, sizeof *set->nodes, &set->nodes));
	set->name = name;
	set->count = (int)header.count;
	return check_range(reader, set->nodes, header.count, node_count);
}

/// Members of both, ascending, into the first.
static JnStatus join_sets(const Reader* reader, JnNodeSet* set, const JnNodeSet* other) {
	int* nodes;
	int count = 0;
	JN_NEW(reader->arena, nodes, (size_t)set->count + (size_t)other->count + 1);
	for (int i = 0, j = 0; i < set->count || j < other->count;) {
		const int a = i < set->count ? set->nodes[i] : INT_MAX, b = j < other->count ? other->nodes[j] : INT_MAX;
		nodes[count++] = a < b ? a : b;
		i += a <= b;
		j += b <= a;
	}
	set->nodes = nodes;
	set->count = count;
	return JN_OK;
}

/// Groups of one name, such as a surface and its points, are one set.
static JnStatus add_set(const Reader* reader, const JnNodeSet* set, JnMesh* mesh) {
	for (int i = 0; i < mesh->set_count; ++i)
		if (strcmp(mesh->sets[i].name, set->name) == 0) return join_sets(reader, &mesh->sets[i], set);
	mesh->sets[mesh->set_count++] = *set;
	return JN_OK;
}

static JnStatus read_sets(const Reader* reader, const JnGmshHeader* header, JnMesh* mesh) {
	if (header->sets > reader->size) return tell_damage(reader);
	JN_NEW(reader->arena, mesh->sets, header->sets + 1);
	for (size_t i = 0; i < header->sets; ++i) {
		JnNodeSet set;
		JN_TRY(read_set(reader, header->nodes, &set));
		if (set.name[0] != '\0') JN_TRY(add_set(reader, &set, mesh));
	}
	return JN_OK;
}

JnStatus jn_gmsh_model_read(FILE* stream, const char* what, JnArena* arena, JnImport* out) {
	struct stat info;
	JnGmshHeader header;
	*out = (JnImport){0};
	if (fstat(fileno(stream), &info) != 0) return jn_error(JN_IO_FAILED, "%s: cannot be read", what);
	const Reader reader = {stream, what, arena, (size_t)info.st_size};
	if (fread(&header, sizeof header, 1, stream) != 1) return tell_damage(&reader);
	const bool is_volume = header.shape != JN_GMSH_SURFACE;
	if (header.nodes > INT_MAX / 3 || header.entries > INT_MAX || (is_volume && header.shape >= JN_SOLID_SHAPE_COUNT))
		return tell_damage(&reader);
	double* nodes = NULL;
	int* cells = NULL;
	JN_TRY(take(&reader, 3 * header.nodes, sizeof *nodes, &nodes));
	JN_TRY(take(&reader, header.entries, sizeof *cells, &cells));
	JN_TRY(check_range(&reader, cells, header.entries, header.nodes));
	out->is_volume = is_volume;
	if (!is_volume) {
		out->surface = (JnSurface){(int)header.nodes, nodes, (int)(header.entries / 3), cells};
		return JN_OK;
	}
	out->volume =
		(JnMesh){.shape = (JnShape)header.shape, .node_count = (int)header.nodes, .nodes = nodes, .cells = cells};
	out->volume.cell_count = (int)header.entries / jn_shape_info[header.shape].nodes;
	return read_sets(&reader, &header, &out->volume);
}
