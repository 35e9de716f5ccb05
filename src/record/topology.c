// One topology for all bodies: with a single shape every reader opens it; several need XDMF's "Mixed".
#include "record/topology.h"

#include <stdlib.h>
#include <string.h>

#include "base/log.h"

static const int xdmf_number[JN_SHAPE_COUNT] = {
	[JN_TET4] = 6, [JN_TET10] = 0x26, [JN_HEX8] = 9, [JN_TRI3] = 4, [JN_POINT1] = 1};

// Numbers before the nodes of a cell in a mixed topology: its type, and for points how many they are.
static int head_of(JnShape shape) {
	return shape == JN_POINT1 ? 2 : 1;
}

// Nodes without bodies are cells by themselves, so that they can be seen.
static JnTopology measure_points(const JnRecordInfo* info) {
	return (JnTopology){
		.name = "Polyvertex", .row_length = 1, .rows = info->node_count, .cell_count = info->node_count};
}

JnTopology jn_topology_measure(const JnRecordInfo* info) {
	if (info->body_count == 0) return measure_points(info);
	JnTopology topology = {.name = "Tetrahedron", .row_length = 4};
	long numbers = 0;
	for (int i = 0; i < info->body_count; i++) {
		const JnRecordBody* body = &info->bodies[i];
		const JnShapeInfo* shape = &jn_shape_info[body->shape];
		topology.name = shape->xdmf;
		topology.row_length = shape->nodes;
		topology.is_mixed |= body->shape != info->bodies[0].shape;
		topology.cell_count += body->cell_count;
		numbers += (long)body->cell_count * (head_of(body->shape) + shape->nodes);
	}
	topology.rows = topology.cell_count;
	if (!topology.is_mixed) return topology;
	topology.name = "Mixed";
	topology.rows = numbers;
	topology.row_length = 1;
	return topology;
}

static int* copy_cell(const JnTopology* topology, const JnRecordBody* body, int cell, int* out) {
	const int nodes = jn_shape_info[body->shape].nodes;
	if (topology->is_mixed) *out++ = xdmf_number[body->shape];
	if (topology->is_mixed && head_of(body->shape) == 2) *out++ = nodes;
	memcpy(out, body->cells + (size_t)cell * (size_t)nodes, (size_t)nodes * sizeof *out);
	return out + nodes;
}

JnStatus jn_topology_create(JnTopology* topology, const JnRecordInfo* info) {
	*topology = jn_topology_measure(info);
	topology->cells = malloc((size_t)(topology->rows * topology->row_length + 1) * sizeof *topology->cells);
	topology->bodies = malloc((size_t)(topology->cell_count + 1) * sizeof *topology->bodies);
	if (topology->cells == NULL || topology->bodies == NULL) {
		jn_topology_destroy(topology);
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the topology of %ld cells", topology->cell_count);
	}
	int *cells = topology->cells, *bodies = topology->bodies;
	for (int i = 0; info->body_count == 0 && i < info->node_count; i++) {
		cells[i] = i;
		bodies[i] = 0;
	}
	for (int i = 0; i < info->body_count; i++) {
		for (int cell = 0; cell < info->bodies[i].cell_count; cell++) {
			cells = copy_cell(topology, &info->bodies[i], cell, cells);
			*bodies++ = i;
		}
	}
	return JN_OK;
}

void jn_topology_destroy(JnTopology* topology) {
	free(topology->cells);
	free(topology->bodies);
	topology->cells = topology->bodies = NULL;
}
