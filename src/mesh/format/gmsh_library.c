// Gmsh by dlopen. It is one per process and cannot be unloaded (its libraries register what runs at exit), so the handle
// is opened anew each time, which costs nothing once it is in memory.
#include "mesh/format/gmsh_library.h"

#include "base/log.h"

#ifdef JN_GMSH_LIBRARY

	#include <dlfcn.h>
	#include <string.h>

/// Set a function's address; false when the library has none of that name. memcpy: ISO C has no cast for it.
static bool find_function(void* library, const char* name, void* function) {
	void* const address = dlsym(library, name);
	memcpy(function, &address, sizeof address);
	return address != NULL;
}

static const char* find_functions(JnGmsh* gmsh) {
	#define FIND(name)                                                                                                 \
		if (!find_function(gmsh->library, "gmsh" #name, &gmsh->name)) return "gmsh" #name;
	JN_GMSH_FUNCTIONS(FIND)
	#undef FIND
	return NULL;
}

static JnStatus start(const char* what, JnGmsh* gmsh) {
	int error = 0;
	gmsh->Initialize(0, NULL, 0, &error);
	if (error == 0) gmsh->OptionSetNumber("General.Terminal", 0, &error);
	if (error == 0) gmsh->OptionSetNumber("General.NumThreads", 1, &error);
	return jn_gmsh_check(gmsh, error, what, "start");
}

JnStatus jn_gmsh_open(const char* what, JnGmsh* gmsh) {
	*gmsh = (JnGmsh){.library = dlopen(JN_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE)};
	if (gmsh->library == NULL) {
		const char* reason = dlerror();
		return jn_error(JN_BAD_INPUT,
						"%s: this needs Gmsh, which cannot be loaded: %s. On Debian: apt-get install libgmsh-dev", what,
						reason != NULL ? reason : JN_GMSH_LIBRARY);
	}
	const char* missing = find_functions(gmsh);
	if (missing == NULL) return start(what, gmsh);
	dlclose(gmsh->library);
	*gmsh = (JnGmsh){0};
	return jn_error(JN_BAD_INPUT, "%s: this needs another version of Gmsh: %s has no function %s", what,
					JN_GMSH_LIBRARY, missing);
}

void jn_gmsh_close(JnGmsh* gmsh) {
	if (gmsh->library == NULL) return;
	int error = 0;
	gmsh->Clear(&error);
	gmsh->Finalize(&error);
	dlclose(gmsh->library);
	*gmsh = (JnGmsh){0};
}

JnStatus jn_gmsh_check(const JnGmsh* gmsh, int error, const char* what, const char* task) {
	if (error == 0) return JN_OK;
	char* words = NULL;
	int ignored = 0;
	gmsh->LoggerGetLastError(&words, &ignored);
	const bool has_words = words != NULL && words[0] != '\0';
	jn_error(JN_BAD_INPUT, "%s: Gmsh cannot %s: %s", what, task, has_words ? words : "it does not say why");
	gmsh->Free(words);
	return JN_BAD_INPUT;
}

#else

JnStatus jn_gmsh_open(const char* what, JnGmsh* gmsh) {
	*gmsh = (JnGmsh){0};
	return jn_error(JN_BAD_INPUT,
					"%s: this needs Gmsh, which was not there when jounce was built. On Debian: apt-get "
					"install libgmsh-dev, then build anew",
					what);
}

void jn_gmsh_close(JnGmsh* gmsh) {
	*gmsh = (JnGmsh){0};
}

JnStatus jn_gmsh_check(const JnGmsh* gmsh, int error, const char* what, const char* task) {
	(void)gmsh;
	return error == 0 ? JN_OK : jn_error(JN_BAD_INPUT, "%s: Gmsh cannot %s", what, task);
}

#endif
