// /mesh/<body>, without its surface (surface.c):
//     cells [c,k]      numbers of nodes in VTK's order; attributes shape, vtk_type, first_node, node_count
//     volumes [n]      of a body of points: one a node [m^3]
//     axis [3]         of a thread: weights of the three nodes of a frame, whose sum lies on the axis; frame k is the
//                      nodes first_node + 3 k and the two behind it. Attributes radius [m], is_closed
#include "record/body.h"

static JnStatus write_cells(JnH5File* file, const JnRecordBody* body) {
	const JnShapeInfo* shape = &jn_shape_info[body->shape];
	const hsize_t dims[2] = {(hsize_t)body->cell_count, (hsize_t)shape->nodes};
	char name[512];
	snprintf(name, sizeof name, "/mesh/%s/cells", body->name);
	JN_TRY(jn_h5_array(file, name, H5T_STD_I32LE, H5T_NATIVE_INT, 2, dims, body->cells));
	JN_TRY(jn_h5_attribute_text(file, name, "shape", shape->name));
	JN_TRY(jn_h5_attribute_integer(file, name, "vtk_type", shape->vtk_type));
	JN_TRY(jn_h5_attribute_integer(file, name, "first_node", body->first_node));
	return jn_h5_attribute_integer(file, name, "node_count", body->node_count);
}

static JnStatus write_volumes(JnH5File* file, const JnRecordBody* body) {
	const hsize_t count = (hsize_t)body->node_count;
	char name[512];
	if (body->volumes == NULL) return JN_OK;
	snprintf(name, sizeof name, "/mesh/%s/volumes", body->name);
	JN_TRY(jn_h5_array(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &count, body->volumes));
	return jn_h5_attribute_text(file, name, "unit", "m^3");
}

static JnStatus write_thread(JnH5File* file, const JnRecordBody* body) {
	const hsize_t count = JN_FRAME_NODES;
	char name[512];
	if (body->thread == NULL) return JN_OK;
	snprintf(name, sizeof name, "/mesh/%s/axis", body->name);
	JN_TRY(jn_h5_array(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &count, body->thread->axis));
	JN_TRY(jn_h5_attribute_real(file, name, "radius", body->thread->radius));
	return jn_h5_attribute_integer(file, name, "is_closed", body->thread->is_closed);
}

JnStatus jn_record_bodies_write(JnH5File* file, const JnRecordInfo* info) {
	for (int i = 0; i < info->body_count; i++) {
		JN_TRY(write_cells(file, &info->bodies[i]));
		JN_TRY(write_volumes(file, &info->bodies[i]));
		JN_TRY(write_thread(file, &info->bodies[i]));
	}
	return JN_OK;
}
