/// @file topology.h
/// The cells of all bodies in the one array that XDMF can show.
#ifndef JN_RECORD_TOPOLOGY_H
#define JN_RECORD_TOPOLOGY_H

#include "record/recorder.h"

/// Bodies of one shape: `rows` cells of `row_length` nodes. Several shapes: 1-D, `rows` numbers, each cell led by the
/// number that XDMF has for its shape, and row_length 1.
typedef struct JnTopology {
	bool is_mixed;
	const char* name; ///< XDMF topology type: "Hexahedron", "Mixed"
	long rows, row_length;
	long cell_count;
	int* cells;  ///< rows * row_length
	int* bodies; ///< cell_count numbers: index of the body of each cell
} JnTopology;

/// The sizes and the name, without arrays.
JnTopology jn_topology_measure(const JnRecordInfo* info);

/// With arrays, to be given to jn_topology_destroy. JN_OUT_OF_MEMORY.
JnStatus jn_topology_create(JnTopology* topology, const JnRecordInfo* info);
void jn_topology_destroy(JnTopology* topology);

#endif
