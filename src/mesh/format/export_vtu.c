// Meshes as .vtu (vtu_write.h). Node sets are UInt8 point data named "set:<name>", 1 for members.
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "mesh/format/export_volume.h"
#include "mesh/format/vtk_cells.h"
#include "mesh/format/vtu_write.h"

static uint64_t cell_end(const void* data, size_t i) {
	return (i + 1) * (uint64_t)jn_shape_info[((const JnMesh*)data)->shape].nodes;
}

static uint64_t cell_type(const void* data, size_t i) {
	(void)i;
	return (uint64_t)jn_shape_info[((const JnMesh*)data)->shape].vtk_type;
}

static JnStatus write_set(JnVtuWriter* writer, const JnMesh* mesh, const JnNodeSet* set) {
	unsigned char* marks;
	char* name;
	const size_t length = strlen(set->name) + sizeof JN_VTK_SET_PREFIX;
	JN_NEW(writer->arena, marks, mesh->node_count);
	JN_NEW(writer->arena, name, length);
	snprintf(name, length, "%s%s", JN_VTK_SET_PREFIX, set->name);
	for (int i = 0; i < set->count; ++i) marks[set->nodes[i]] = 1;
	return jn_vtu_bytes(writer, name, (size_t)mesh->node_count, marks);
}

static JnStatus write_piece(JnVtuWriter* writer, const JnMesh* mesh) {
	const size_t nodes = (size_t)mesh->node_count, cells = (size_t)mesh->cell_count;
	const size_t entries = cells * (size_t)jn_shape_info[mesh->shape].nodes;
	fputs("<PointData>\n", writer->stream);
	for (int s = 0; s < mesh->set_count; ++s) JN_TRY(write_set(writer, mesh, &mesh->sets[s]));
	fputs("</PointData>\n<Points>\n", writer->stream);
	JN_TRY(jn_vtu_reals(writer, "Points", 3, 3 * nodes, mesh->nodes));
	fputs("</Points>\n<Cells>\n", writer->stream);
	JN_TRY(jn_vtu_integers(writer, "connectivity", entries, mesh->cells));
	JN_TRY(jn_vtu_array(writer, &(JnVtuArray){"Int64", "offsets", 1, 8, cells}, cell_end, mesh));
	JN_TRY(jn_vtu_array(writer, &(JnVtuArray){"UInt8", "types", 1, 1, cells}, cell_type, mesh));
	fputs("</Cells>\n", writer->stream);
	return JN_OK;
}

static JnStatus write_file(JnVtuWriter* writer, const JnMesh* mesh) {
	jn_vtu_begin(writer, mesh->node_count, mesh->cell_count);
	JN_TRY(write_piece(writer, mesh));
	jn_vtu_end(writer);
	return JN_OK;
}

JnStatus jn_export_vtu(const JnMesh* mesh, const char* temporary, const char* path) {
	JnArena scratch = {0};
	JnVtuWriter writer = {.stream = fopen(temporary, "wb"), .arena = &scratch};
	if (writer.stream == NULL) return jn_error(JN_IO_FAILED, "%s: cannot create the file: %s", path, strerror(errno));
	const JnStatus status = write_file(&writer, mesh);
	const bool is_bad = ferror(writer.stream) != 0;
	jn_arena_free(&scratch);
	if ((fclose(writer.stream) != 0 || is_bad) && status == JN_OK)
		return jn_error(JN_IO_FAILED, "%s: cannot write the file: %s", path, strerror(errno));
	return status;
}
