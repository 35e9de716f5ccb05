/// @file gmsh_library.h
/// Gmsh, loaded when it is first needed: it brings some fifty libraries, whose start would be felt in every run.
/// Between open and close its one model and its options belong to the caller; two threads must not have it at once.
#ifndef JN_MESH_FORMAT_GMSH_LIBRARY_H
#define JN_MESH_FORMAT_GMSH_LIBRARY_H

#include "jounce/base.h"

#ifdef JN_GMSH_LIBRARY
	#include <gmshc.h>

	/// The functions that jounce calls, without their prefix: gmsh.Open(path, &error) is gmshOpen(path, &error).
	#define JN_GMSH_FUNCTIONS(X)                                                                                       \
		X(Initialize)                                                                                                  \
		X(Finalize)                                                                                                    \
		X(Free)                                                                                                        \
		X(Clear)                                                                                                       \
		X(Open)                                                                                                        \
		X(Write)                                                                                                       \
		X(LoggerGetLastError)                                                                                          \
		X(OptionSetNumber)                                                                                             \
		X(ModelAdd)                                                                                                    \
		X(ModelAddDiscreteEntity)                                                                                      \
		X(ModelAddPhysicalGroup)                                                                                       \
		X(ModelGetEntities)                                                                                            \
		X(ModelGetPhysicalGroups)                                                                                      \
		X(ModelGetPhysicalName)                                                                                        \
		X(ModelSetPhysicalName)                                                                                        \
		X(ModelGeoAddSurfaceLoop)                                                                                      \
		X(ModelGeoAddVolume)                                                                                           \
		X(ModelGeoSynchronize)                                                                                         \
		X(ModelMeshAddElementsByType)                                                                                  \
		X(ModelMeshAddNodes)                                                                                           \
		X(ModelMeshClassifySurfaces)                                                                                   \
		X(ModelMeshCreateGeometry)                                                                                     \
		X(ModelMeshCreateTopology)                                                                                     \
		X(ModelMeshGenerate)                                                                                           \
		X(ModelMeshGetElementTypes)                                                                                    \
		X(ModelMeshGetElementsByType)                                                                                  \
		X(ModelMeshGetNodes)                                                                                           \
		X(ModelMeshGetNodesForPhysicalGroup)
#endif

/// Gmsh while it is open. Without it at build time there are no functions: callers that use them ask for JN_GMSH_LIBRARY.
typedef struct JnGmsh {
	void* library; ///< NULL: closed
#ifdef JN_GMSH_LIBRARY
	#define JN_GMSH_MEMBER(name) __typeof__(gmsh##name)* name;
	JN_GMSH_FUNCTIONS(JN_GMSH_MEMBER)
	#undef JN_GMSH_MEMBER
#endif
} JnGmsh;

/// Load and start Gmsh: no configuration files are read, it writes nothing to the terminal, uses one thread and an empty
/// model. JN_BAD_INPUT, after a message that begins with `what`, when it was not there at build time or is not now.
JnStatus jn_gmsh_open(const char* what, JnGmsh* gmsh);

/// Forget the model and the options. The library stays in memory. Without effect when closed.
void jn_gmsh_close(JnGmsh* gmsh);

/// What became of a call that left `error`: JN_OK for 0, else JN_BAD_INPUT after "<what>: Gmsh cannot <task>: <its words>".
JnStatus jn_gmsh_check(const JnGmsh* gmsh, int error, const char* what, const char* task);

#endif
