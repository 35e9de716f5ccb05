// Gmsh is loaded when it is needed: what is said where it cannot be loaded, or is another library than it should be.
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "support/support.h"

static const char scene[] = "duration: 1 ms\nbodies:\n  - shape: {type: file, path: cell.msh}\n"
							"    material: {law: linear, density: 1000, young: 1e5, poisson: 0.3}\n    mass: lumped\n";
static const char cell[] =
	"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
	"$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";

/// Run the scene where every library called libgmsh is `stand_in`; what it says. The caller frees it.
static char* run_with(const char* stand_in) {
	char folder[256];
	glob_t found;
	assert_int_equal(folder_create(folder), 0);
	file_write(path_join(folder, "scene.yaml"), scene);
	file_write(path_join(folder, "cell.msh"), cell);
	file_write(path_join(folder, "words"), "no library at all\n");
	const bool is_there = glob("/usr/lib/*/libgmsh.so*", 0, NULL, &found) == 0;
	for (size_t i = 0; is_there && i < found.gl_pathc; ++i)
		assert_int_equal(symlink(stand_in != NULL ? stand_in : path_join(folder, "words"),
								 path_join(folder, strrchr(found.gl_pathv[i], '/') + 1)),
						 0);
	globfree(&found);
	setenv("LD_LIBRARY_PATH", folder, 1);
	Outcome outcome = command_run(folder, (const char* const[]){"run", "scene.yaml", NULL});
	unsetenv("LD_LIBRARY_PATH");
	folder_remove(folder);
	char* words = outcome.status == 2 ? strdup(outcome.err) : NULL; // 0: Debian's is not the one that is loaded
	outcome_free(&outcome);
	if (!is_there || words == NULL) skip();
	return words;
}

static void expect(char* words, const char* part) {
	if (strstr(words, part) == NULL) fail_msg("'%s' is not in: %s", part, words);
	free(words);
}

static void a_gmsh_that_cannot_be_loaded_is_asked_for(void** state) {
	(void)state;
	expect(run_with(NULL), "cell.msh: this needs Gmsh, which cannot be loaded: ");
	expect(run_with(NULL), "On Debian: apt-get install libgmsh-dev");
}

static void a_gmsh_without_a_function_is_another_version(void** state) {
	(void)state;
	glob_t found;
	if (glob("/usr/lib/*/libyaml-0.so.2", 0, NULL, &found) != 0) skip();
	char* words = run_with(found.gl_pathv[0]);
	globfree(&found);
	expect(words, "cell.msh: this needs another version of Gmsh: ");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_gmsh_that_cannot_be_loaded_is_asked_for),
		cmocka_unit_test(a_gmsh_without_a_function_is_another_version),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
