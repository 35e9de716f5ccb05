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
#include <sys/mman.h>

#include <cmocka.h>

#include "jounce/scene.h"
#include "support/allocator.h"
#include "support/support.h"

enum { MOST_SITES = 4000 };

typedef struct Site {
	const void* address;
	long number; // of its first allocation in the run that met it
} Site;

// Where child processes meet sites, too: in memory that they share.
static struct Shared {
	int count;
	Site sites[MOST_SITES];
	const void* culprit; // of the allocation `refused`
	long refused;
} * shared;

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

static void share(void) {
	if (shared != NULL) return;
	void* memory = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	assert_true(memory != MAP_FAILED);
	shared = memory;
}

static void meet(const void* address, long number) {
	for (int i = 0; i < shared->count; ++i)
		if (shared->sites[i].address == address) return;
	if (shared->count < MOST_SITES) shared->sites[shared->count++] = (Site){address, number};
}

static void see(const void* address, long number) {
	if (number == shared->refused) shared->culprit = address;
}

/// Load and run; the result goes into a folder that is removed.
static JnStatus run_case(const void* user) {
	const Case* tried = user;
	char folder[256];
	int set_count = 0;
	while (tried->sets[set_count] != NULL) ++set_count;
	JnScene* scene = NULL;
	JnRunResult result;
	assert_int_equal(folder_create(folder), 0);
	const JnRunOptions options = {.directory = folder, .threads = 1};
	JnStatus status =
		jn_scene_load(path_join(JN_SOURCE_DIR "/test/allocation", tried->scene), set_count, tried->sets, &scene);
	if (status == JN_OK) status = jn_scene_run(scene, &options, &result);
	jn_scene_destroy(scene);
	folder_remove(folder);
	return status;
}

/// Of an address in this program: what addr2line takes.
static size_t offset_of(const void* address) {
	Dl_info facts;
	return address != NULL && dladdr(address, &facts) != 0
			   ? (size_t)((const char*)address - (const char*)facts.dli_fbase)
			   : 0;
}

/// True, with words, unless work in which an allocation was refused has ended as it should.
static bool is_unclean(const Work* work, long number, JnStatus status) {
	const char* fault = NULL;
	if (H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) > 0)
		fault = "HDF5 objects stay open";
	else if (shared->culprit != NULL && status != JN_OK && status != JN_OUT_OF_MEMORY) // JN_OK: it could do without
		fault = jn_status_name(status);
	else if (status != JN_OK && strstr(log_text(), "memory") == NULL)
		fault = "no word about memory";
	if (fault != NULL)
		print_message("%s, allocation %ld at %#zx: %s; \"%s\"\n", work->name, number, offset_of(shared->culprit), fault,
					  log_text());
	return fault != NULL;
}

/// Returns whether it ended badly.
static bool run_failing(const Work* work, long number) {
	shared->culprit = NULL;
	shared->refused = number;
	log_capture();
	allocator_watch(see);
	allocator_fail_at(number);
	const JnStatus status = work->run(work->user);
	allocator_fail_at(0);
	allocator_watch(NULL);
	log_release();
	return is_unclean(work, number, status);
}

static long run_whole(const Work* work) {
	allocator_watch(meet);
	allocator_fail_at(0);
	const JnStatus status = work->run(work->user);
	const long count = allocator_count();
	allocator_watch(NULL);
	assert_int_equal(status, JN_OK);
	return count;
}

long allocation_sweep(const Work* work, Sweep sweep) {
	share();
	const int known = shared->count;
	const long count = run_whole(work);
	const long runs = sweep == SWEEP_ALL ? count : shared->count - known;
	int bad = 0;
	for (long i = 0; i < runs; ++i)
		bad += run_failing(work, sweep == SWEEP_ALL ? i + 1 : shared->sites[known + i].number);
	assert_int_equal(bad, 0);
	return runs;
}

long allocation_sweep_case(const Case* tried, Sweep sweep) {
	return allocation_sweep(&(Work){tried->scene, run_case, tried}, sweep);
}

int allocation_site_count(void) {
	const char* path = getenv("JN_ALLOCATION_SITES");
	FILE* file = path != NULL ? fopen(path, "a") : NULL;
	share();
	for (int i = 0; file != NULL && i < shared->count; ++i)
		fprintf(file, "%#zx\n", offset_of(shared->sites[i].address));
	if (file != NULL) fclose(file);
	return shared->count;
}
