#include "view_bodies.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "recording_file.h"

static herr_t meet_body(hid_t group, const char* name, const H5L_info_t* info, void* user) {
	ViewRun* run = user;
	(void)group, (void)info;
	if (strcmp(name, "nodes") == 0 || strlen(name) >= sizeof run->bodies->name) return 0;
	if (run->bodies != NULL) snprintf(run->bodies[run->body_count].name, sizeof run->bodies->name, "%s", name);
	run->body_count++;
	return 0;
}

static int by_node(const void* a, const void* b) {
	return ((const ViewBody*)a)->first_node - ((const ViewBody*)b)->first_node;
}

static JnStatus read_body_facts(ViewRun* run, ViewBody* body) {
	char name[160], *shape;
	snprintf(name, sizeof name, "/mesh/%s/cells", body->name);
	JN_TRY(recording_file_attribute(run->file, name, "first_node", H5T_NATIVE_INT, &body->first_node));
	JN_TRY(recording_file_attribute(run->file, name, "node_count", H5T_NATIVE_INT, &body->node_count));
	JN_TRY(recording_file_text(run->file, name, "shape", &run->arena, &shape));
	snprintf(body->shape, sizeof body->shape, "%s", shape);
	const hid_t cells = H5Dopen2(run->file, name, H5P_DEFAULT);
	if (cells < 0) return JN_IO_FAILED;
	hsize_t dims[2] = {0};
	const hid_t space = H5Dget_space(cells);
	if (H5Sget_simple_extent_ndims(space) == 2) H5Sget_simple_extent_dims(space, dims, NULL);
	body->cell_count = (int)dims[0];
	H5Sclose(space);
	H5Dclose(cells);
	const bool is_inside =
		body->first_node >= 0 && body->node_count >= 0 && body->first_node <= run->node_count - body->node_count;
	return is_inside ? JN_OK : JN_IO_FAILED;
}

JnStatus view_bodies_list(ViewRun* run) {
	JN_TRY(recording_file_visit(run->file, "/mesh", meet_body, run));
	JN_NEW(&run->arena, run->bodies, run->body_count + 1);
	run->body_count = 0;
	JN_TRY(recording_file_visit(run->file, "/mesh", meet_body, run));
	for (int b = 0; b < run->body_count; ++b) JN_TRY(read_body_facts(run, &run->bodies[b]));
	qsort(run->bodies, (size_t)run->body_count, sizeof *run->bodies, by_node);
	return JN_OK;
}
