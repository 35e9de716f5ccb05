// The memory of a run, as the system sees it.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include <cmocka.h>

#include "support/support.h"

static const char scene_text[] = "duration: 1000\n"
								 "bodies:\n"
								 "  - shape: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}\n"
								 "    material: {law: linear, density: 1000, young: 1e4, poisson: 0.3}\n"
								 "    mass: lumped\n"
								 "    fix: [{where: {face: x-}}]\n"
								 "integrator: verlet\n"
								 "step: {dt: 1 ms}\n"
								 "record: {interval: 1e6, plots: no}\n";

// Most memory of the run, and of those before it [KiB].
static long run_for(const char* folder, const char* steps) {
	const char* const arguments[] = {"run",       "scene.yaml", "-o",      "out", "--quiet",
									 "--threads", "1",          "--steps", steps, NULL};
	Outcome outcome = command_run(folder, arguments);
	if (outcome.status != 0) fail_msg("jounce run ends with %d: %s", outcome.status, outcome.err);
	outcome_free(&outcome);
	struct rusage usage;
	getrusage(RUSAGE_CHILDREN, &usage);
	return usage.ru_maxrss;
}

// HDF5's caches kept 170 bytes of each step, 14 MiB of 80000. What is left are the places of chunks in the file, of which
// each of some 25 columns has one in 1024 steps, and the allocator's choices.
static void memory_of_a_run_hardly_grows_with_its_steps(void** state) {
	(void)state;
	char folder[256];
	assert_int_equal(folder_create(folder), 0);
	file_write(path_join(folder, "scene.yaml"), scene_text);
	const long few = run_for(folder, "20000"), many = run_for(folder, "100000");
	folder_remove(folder);
	print_message("20000 steps: %ld KiB, 100000 steps: %ld KiB, at most 4096 KiB more\n", few, many);
	if (many > few + 4096) fail_msg("80000 steps more take %ld KiB more, expected 4096 at most", many - few);
}

int main(void) {
	const struct CMUnitTest tests[] = {cmocka_unit_test(memory_of_a_run_hardly_grows_with_its_steps)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
