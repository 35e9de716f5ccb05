// /mesh/<body>/surface, of kind "boundary":
//     triangles [m,3]    the outer faces of the cells, with numbers of nodes
// and of kind "embedded", a finer surface that the cells carry along:
//     triangles [m,3]    with numbers of its own vertices
//     rest      [s,3]    of the vertices [m]
//     nodes     [s,k]    the nodes that carry each vertex
//     weights   [s,k]    and their shares: a vertex is at the sum of weight * position
// Attributes: kind, first_point and point_count, which say where the body's points are in /frames/<number>/surface.
#include "record/surface.h"

#include <stdlib.h>
#include <string.h>

#include "base/log.h"

bool jn_record_has_embedding(const JnRecordInfo* info) {
	for (int i = 0; i < info->body_count; i++)
		if (info->bodies[i].embedding != NULL) return true;
	return false;
}

int jn_record_point_count(const JnRecordBody* body) {
	return body->embedding != NULL ? body->embedding->surface.node_count : body->node_count;
}

long jn_record_points(const JnRecordInfo* info) {
	long count = 0;
	if (!jn_record_has_embedding(info)) return info->node_count;
	for (int i = 0; i < info->body_count; i++) count += jn_record_point_count(&info->bodies[i]);
	return count;
}

long jn_record_triangles(const JnRecordInfo* info) {
	long count = 0;
	for (int i = 0; i < info->body_count; i++) count += info->bodies[i].triangle_count;
	return count;
}

void jn_record_surface_positions(const JnRecordInfo* info, const double* x, double* positions) {
	for (int i = 0; i < info->body_count; i++) {
		const JnRecordBody* body = &info->bodies[i];
		const double* own = x + 3 * (ptrdiff_t)body->first_node;
		if (body->embedding != NULL)
			jn_embedding_positions(body->embedding, own, positions);
		else
			memcpy(positions, own, 3 * (size_t)body->node_count * sizeof *positions);
		positions += 3 * (ptrdiff_t)jn_record_point_count(body);
	}
}

/// A copy of `count` numbers, each moved by `offset`; NULL after a message.
static int* shifted(const int* numbers, size_t count, long offset) {
	int* out = malloc((count + 1) * sizeof *out);
	if (out == NULL) jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the surfaces of run.h5");
	for (size_t i = 0; out != NULL && i < count; i++) out[i] = (int)(numbers[i] + offset);
	return out;
}

static JnStatus write_array(JnH5File* file, const JnRecordBody* body, const char* array, hid_t memory_type, int rows,
							int columns, const void* data) {
	const hsize_t dims[2] = {(hsize_t)rows, (hsize_t)columns};
	const hid_t file_type = memory_type == H5T_NATIVE_INT ? H5T_STD_I32LE : H5T_IEEE_F64LE;
	char name[512];
	snprintf(name, sizeof name, "/mesh/%s/surface/%s", body->name, array);
	return jn_h5_array(file, name, file_type, memory_type, 2, dims, data);
}

static JnStatus write_embedding(JnH5File* file, const JnRecordBody* body) {
	const JnEmbedding* embedding = body->embedding;
	const int vertices = embedding->surface.node_count, nodes = embedding->cell_nodes;
	int* global = shifted(embedding->nodes, (size_t)vertices * (size_t)nodes, body->first_node);
	if (global == NULL) return JN_OUT_OF_MEMORY;
	const JnStatus status = write_array(file, body, "nodes", H5T_NATIVE_INT, vertices, nodes, global);
	free(global);
	JN_TRY(status);
	JN_TRY(write_array(file, body, "rest", H5T_NATIVE_DOUBLE, vertices, 3, embedding->surface.nodes));
	if (embedding->offsets != NULL)
		JN_TRY(write_array(file, body, "offsets", H5T_NATIVE_DOUBLE, vertices, 3, embedding->offsets));
	return write_array(file, body, "weights", H5T_NATIVE_DOUBLE, vertices, nodes, embedding->weights);
}

static JnStatus write_body(JnH5File* file, const JnRecordBody* body, long first_point) {
	char group[512];
	snprintf(group, sizeof group, "/mesh/%s/surface", body->name);
	JN_TRY(write_array(file, body, "triangles", H5T_NATIVE_INT, body->triangle_count, 3, body->triangles));
	if (body->embedding != NULL) JN_TRY(write_embedding(file, body));
	JN_TRY(jn_h5_attribute_text(file, group, "kind", body->embedding != NULL ? "embedded" : "boundary"));
	JN_TRY(jn_h5_attribute_integer(file, group, "first_point", first_point));
	return jn_h5_attribute_integer(file, group, "point_count", jn_record_point_count(body));
}

/// The triangles of all bodies with numbers of points, and the number of its body for each.
static void gather(const JnRecordInfo* info, int* triangles, int* bodies) {
	long first_point = 0;
	const bool has_embedding = jn_record_has_embedding(info);
	for (int i = 0; i < info->body_count; i++) {
		const JnRecordBody* body = &info->bodies[i];
		const long known = body->embedding != NULL ? 0 : body->first_node; // where its triangles count from
		const long offset = has_embedding ? first_point - known : 0;
		for (int k = 0; k < 3 * body->triangle_count; k++) *triangles++ = (int)(body->triangles[k] + offset);
		for (int k = 0; k < body->triangle_count; k++) *bodies++ = i;
		first_point += jn_record_point_count(body);
	}
}

static JnStatus write_topology(JnH5File* file, const JnRecordInfo* info) {
	const long count = jn_record_triangles(info);
	const hsize_t dims[2] = {(hsize_t)count, 3};
	int* triangles = malloc((4 * (size_t)count + 1) * sizeof *triangles);
	if (triangles == NULL)
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the %ld triangles of the surface", count);
	int* bodies = triangles + 3 * count;
	gather(info, triangles, bodies);
	JnStatus status = jn_h5_array(file, "/topology/surface", H5T_STD_I32LE, H5T_NATIVE_INT, 2, dims, triangles);
	if (status == JN_OK)
		status = jn_h5_array(file, "/topology/surface_body", H5T_STD_I32LE, H5T_NATIVE_INT, 1, dims, bodies);
	free(triangles);
	return status;
}

JnStatus jn_record_surface_write(JnH5File* file, const JnRecordInfo* info) {
	long first_point = 0;
	for (int i = 0; i < info->body_count; i++) {
		const JnRecordBody* body = &info->bodies[i];
		JN_TRY(write_body(file, body, jn_record_has_embedding(info) ? first_point : body->first_node));
		first_point += jn_record_point_count(body);
	}
	return write_topology(file, info);
}
