#define _GNU_SOURCE // dladdr
#include "support.h"

#include <dlfcn.h>
#include <hdf5.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/allocator.h"
#include "support/support.h"

enum { MOST_SITES = 4000 };

typedef struct Site {
	const void* address;
	long number; // of its first allocation in the run that met it
} Site;

static Site sites[MOST_SITES];
static int site_count;

const Case allocation_cases[] = {
	{"solids.yaml", {NULL}},
	{"solids.yaml", {"integrator.method=bdf2", "contact.prediction=iterated", "contact.solver.method=admm"}},
	{"solids.yaml", {"integrator.method=sdirk2", "step.controller=step_doubling", "contact.solver.method=delassus"}},
	{"cloth.yaml", {NULL}},
	{"suture.yaml", {NULL}},
	{"points.yaml", {NULL}},
	{"threads.yaml", {NULL}},
	{"large.yaml", {NULL}},
	{"large.yaml", {"solver.precondition=incomplete", "solver.matrix=assembled"}},
	{"large.yaml", {"solver.precondition=kept", "solver.precision=double"}},
	{"large.yaml", {"solver={method: auto}", "integrator.method=average_vector_field"}},
	{"exponential.yaml", {NULL}},
	{"files.yaml", {NULL}},
	{"shapes.yaml", {NULL}},
	{"pendulum.yaml", {NULL}},
	{NULL, {NULL}},
};

static void meet(const void* address, long number) {
	for (int i = 0; i < site_count; ++i)
		if (sites[i].address == address) return;
	if (site_count < MOST_SITES) sites[site_count++] = (Site){address, number};
}

/// Load and run; the result goes into `folder`.
static JnStatus run(const Case* tried, const char* folder) {
	int set_count = 0;
	while (tried->sets[set_count] != NULL) ++set_count;
	JnScene* scene = NULL;
	JnRunResult result;
	const JnRunOptions options = {.directory = folder, .threads = 1};
	JN_TRY(jn_scene_load(path_join(JN_SOURCE_DIR "/test/allocation", tried->scene), set_count, tried->sets, &scene));
	const JnStatus status = jn_scene_run(scene, &options, &result);
	jn_scene_destroy(scene);
	return status;
}

/// Of an address in this program: what addr2line takes.
static size_t offset_of(const void* address) {
	Dl_info facts;
	return address != NULL && dladdr(address, &facts) != 0
			   ? (size_t)((const char*)address - (const char*)facts.dli_fbase)
			   : 0;
}

/// True, with words, unless a run in which an allocation was refused has ended as it should.
static bool is_unclean(const Case* tried, long number, JnStatus status) {
	const char* fault = NULL;
	const bool was_refused = allocator_culprit() != NULL;
	if (H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) > 0)
		fault = "HDF5 objects stay open";
	else if (was_refused && status != JN_OK && status != JN_OUT_OF_MEMORY) // JN_OK: it could do without
		fault = jn_status_name(status);
	else if (status != JN_OK && strstr(log_text(), "memory") == NULL)
		fault = "no word about memory";
	if (fault != NULL)
		print_message("%s, allocation %ld at %#zx: %s; \"%s\"\n", tried->scene, number, offset_of(allocator_culprit()),
					  fault, log_text());
	return fault != NULL;
}

/// Returns whether it ended badly.
static bool run_failing(const Case* tried, long number) {
	char folder[256];
	assert_int_equal(folder_create(folder), 0);
	log_capture();
	allocator_fail_at(number);
	const JnStatus status = run(tried, folder);
	log_release();
	const bool is_bad = is_unclean(tried, number, status);
	allocator_fail_at(0);
	folder_remove(folder);
	return is_bad;
}

static long run_whole(const Case* tried) {
	char folder[256];
	assert_int_equal(folder_create(folder), 0);
	allocator_watch(meet);
	allocator_fail_at(0);
	const JnStatus status = run(tried, folder);
	const long count = allocator_count();
	allocator_watch(NULL);
	folder_remove(folder);
	assert_int_equal(status, JN_OK);
	return count;
}

long allocation_sweep(const Case* tried, Sweep sweep) {
	const int known = site_count;
	const long count = run_whole(tried);
	const long runs = sweep == SWEEP_ALL ? count : site_count - known;
	int bad = 0;
	for (long i = 0; i < runs; ++i) bad += run_failing(tried, sweep == SWEEP_ALL ? i + 1 : sites[known + i].number);
	assert_int_equal(bad, 0);
	return runs;
}

int allocation_site_count(void) {
	const char* path = getenv("JN_ALLOCATION_SITES");
	FILE* file = path != NULL ? fopen(path, "w") : NULL;
	for (int i = 0; file != NULL && i < site_count; ++i) fprintf(file, "%#zx\n", offset_of(sites[i].address));
	if (file != NULL) fclose(file);
	return site_count;
}
