// MSH 4.1, binary: in text Gmsh writes 16 digits, which do not keep a double. Tags are numbers from 1. A node set is a
// discrete point with one point element for each member, in a physical group of its name.
#include "mesh/format/export_volume.h"

#include <string.h>

#include "base/log.h"
#include "mesh/format/gmsh_model.h"

#ifdef JN_GMSH_LIBRARY

typedef struct Writer {
	JnGmsh gmsh;
	const JnMesh* mesh;
	const char* path;
	JnArena scratch;
} Writer;

static JnStatus check(const Writer* writer, int error) {
	return jn_gmsh_check(&writer->gmsh, error, writer->path, "write the file");
}

static JnStatus add_nodes(Writer* writer) {
	const size_t count = (size_t)writer->mesh->node_count;
	size_t* tags;
	int error = 0;
	JN_NEW(&writer->scratch, tags, count);
	for (size_t i = 0; i < count; ++i) tags[i] = i + 1;
	writer->gmsh.ModelMeshAddNodes(3, 1, tags, count, writer->mesh->nodes, 3 * count, NULL, 0, &error);
	return check(writer, error);
}

static JnStatus add_cells(Writer* writer) {
	const JnMesh* mesh = writer->mesh;
	const size_t cells = (size_t)mesh->cell_count, each = (size_t)jn_shape_info[mesh->shape].nodes;
	size_t *tags, *nodes;
	int error = 0;
	JN_NEW(&writer->scratch, tags, cells);
	JN_NEW(&writer->scratch, nodes, cells * each);
	for (size_t i = 0; i < cells; ++i) {
		int cell[10];
		for (size_t k = 0; k < each; ++k) cell[k] = mesh->cells[i * each + k];
		jn_gmsh_reorder(mesh->shape, 1, cell);
		for (size_t k = 0; k < each; ++k) nodes[i * each + k] = (size_t)cell[k] + 1;
		tags[i] = i + 1;
	}
	writer->gmsh.ModelMeshAddElementsByType(1, jn_gmsh_element_type(mesh->shape), tags, cells, nodes, cells * each,
											&error);
	return check(writer, error);
}

/// Physical group `tag` of the one entity of that tag.
static JnStatus add_group(const Writer* writer, int dimension, int tag, const char* name) {
	int error = 0;
	#if GMSH_API_VERSION_MAJOR == 4 && GMSH_API_VERSION_MINOR < 11
	writer->gmsh.ModelAddPhysicalGroup(dimension, &tag, 1, tag, &error);
	#else
	writer->gmsh.ModelAddPhysicalGroup(dimension, &tag, 1, tag, name, &error);
	#endif
	if (error == 0 && name[0] != '\0') writer->gmsh.ModelSetPhysicalName(dimension, tag, name, &error);
	return check(writer, error);
}

/// Point elements have the numbers behind `*element`.
static JnStatus add_set(Writer* writer, const JnNodeSet* set, int point, size_t* element) {
	size_t *tags, *nodes;
	int error = 0;
	const size_t count = (size_t)set->count;
	if (strchr(set->name, '"') != NULL || strchr(set->name, '\n') != NULL)
		return jn_error(JN_BAD_INPUT, "%s: .msh files cannot hold the name of the node set %s", writer->path,
						set->name);
	JN_NEW(&writer->scratch, tags, count);
	JN_NEW(&writer->scratch, nodes, count);
	for (size_t i = 0; i < count; ++i) {
		nodes[i] = (size_t)set->nodes[i] + 1;
		tags[i] = ++*element;
	}
	writer->gmsh.ModelAddDiscreteEntity(0, point, NULL, 0, &error);
	JN_TRY(check(writer, error));
	writer->gmsh.ModelMeshAddElementsByType(point, JN_GMSH_POINT, tags, count, nodes, count, &error);
	JN_TRY(check(writer, error));
	return add_group(writer, 0, point, set->name);
}

static JnStatus write_model(Writer* writer, const char* temporary) {
	size_t element = (size_t)writer->mesh->cell_count;
	int error = 0;
	writer->gmsh.ModelAdd("jounce", &error);
	JN_TRY(check(writer, error));
	writer->gmsh.ModelAddDiscreteEntity(3, 1, NULL, 0, &error);
	JN_TRY(check(writer, error));
	JN_TRY(add_nodes(writer));
	JN_TRY(add_cells(writer));
	JN_TRY(add_group(writer, 3, 1, "")); // meshio wants all cells in groups when some are
	for (int s = 0; s < writer->mesh->set_count; ++s) JN_TRY(add_set(writer, &writer->mesh->sets[s], s + 1, &element));
	writer->gmsh.OptionSetNumber("Mesh.MshFileVersion", 4.1, &error);
	if (error == 0) writer->gmsh.OptionSetNumber("Mesh.Binary", 1, &error);
	if (error == 0) writer->gmsh.OptionSetNumber("Mesh.SaveAll", 1, &error);
	if (error == 0) writer->gmsh.Write(temporary, &error);
	return check(writer, error);
}

JnStatus jn_export_gmsh(const JnMesh* mesh, const char* temporary, const char* path) {
	Writer writer = {.mesh = mesh, .path = path};
	JN_TRY(jn_gmsh_open(path, &writer.gmsh));
	const JnStatus status = write_model(&writer, temporary);
	jn_gmsh_close(&writer.gmsh);
	jn_arena_free(&writer.scratch);
	return status;
}

#else

JnStatus jn_export_gmsh(const JnMesh* mesh, const char* temporary, const char* path) {
	(void)mesh, (void)temporary;
	JnGmsh gmsh;
	return jn_gmsh_open(path, &gmsh);
}

#endif
