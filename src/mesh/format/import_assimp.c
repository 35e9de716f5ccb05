// Surfaces through assimp, which reads in single precision and gives each triangle corners of its own: those at exactly
// the same place become one node here, in silence. Materials, normals and textures are not looked at. Some damaged files
// crash assimp (deeply nested glTF, cut-off PLY and OFF), so it works in a child process; what it logs as an error counts
// as one.
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/guard.h"
#include "base/log.h"
#include "mesh/format/content.h"
#include "mesh/format/import.h"
#include "mesh/format/ply_check.h"
#include "mesh/surface_edges.h"

static const int MOST_TRIANGLES = 20000000;

/// What the child has to do, and what it has found.
typedef struct Reading {
	const char* path;
	FILE* result;
	int node_count;
	long long triangle_count;
	char complaint[300]; ///< the first error that assimp logged
} Reading;

/// At the head of the child's result; the coordinates and the triangles follow.
typedef struct Head {
	int node_count, triangle_count;
} Head;

static void keep_complaint(const char* message, char* user) {
	Reading* reading = (Reading*)(void*)user;
	const bool is_bad = strncmp(message, "Error", 5) == 0 || strstr(message, "unexpected EOF") != NULL;
	if (!is_bad || reading->complaint[0] != '\0') return;
	const char* words = strstr(message, ": ");
	snprintf(reading->complaint, sizeof reading->complaint, "%s", words != NULL ? words + 2 : message);
	reading->complaint[strcspn(reading->complaint, "\r\n")] = '\0';
}

static struct aiMatrix4x4 product(const struct aiMatrix4x4* a, const struct aiMatrix4x4* b) {
	struct aiMatrix4x4 out = *a;
	aiMultiplyMatrix4(&out, b);
	return out;
}

/// A mesh of the file, where a node of the file's tree places it.
typedef JnStatus (*PlacedVisit)(Reading* reading, const struct aiMesh* mesh, const struct aiMatrix4x4* place);

static JnStatus visit_node(Reading* reading, const struct aiScene* scene, const struct aiNode* node,
						   const struct aiMatrix4x4* parent, PlacedVisit visit) {
	const struct aiMatrix4x4 place = product(parent, &node->mTransformation);
	for (unsigned i = 0; i < node->mNumMeshes; i++) JN_TRY(visit(reading, scene->mMeshes[node->mMeshes[i]], &place));
	for (unsigned i = 0; i < node->mNumChildren; i++)
		JN_TRY(visit_node(reading, scene, node->mChildren[i], &place, visit));
	return JN_OK;
}

static JnStatus visit_scene(Reading* reading, const struct aiScene* scene, PlacedVisit visit) {
	struct aiMatrix4x4 identity;
	aiIdentityMatrix4(&identity);
	return scene->mRootNode != NULL ? visit_node(reading, scene, scene->mRootNode, &identity, visit) : JN_OK;
}

/// Points and lines are left out.
static bool is_triangle(const struct aiFace* face) {
	return face->mNumIndices == 3;
}

static JnStatus count_mesh(Reading* reading, const struct aiMesh* mesh, const struct aiMatrix4x4* place) {
	(void)place;
	long long triangles = reading->triangle_count;
	for (unsigned i = 0; i < mesh->mNumFaces; i++) triangles += is_triangle(&mesh->mFaces[i]);
	if (triangles > MOST_TRIANGLES || reading->node_count + (long long)mesh->mNumVertices > 3LL * MOST_TRIANGLES) {
		return jn_error(JN_BAD_INPUT, "%s: has more than %d triangles; simplify it (in Blender: the modifier Decimate)",
						reading->path, MOST_TRIANGLES);
	}
	reading->triangle_count = triangles;
	reading->node_count += (int)mesh->mNumVertices;
	return JN_OK;
}

static JnStatus write_bytes(Reading* reading, const void* data, size_t size) {
	if (fwrite(data, size, 1, reading->result) == 1) return JN_OK;
	return jn_error(JN_OUT_OF_MEMORY, "%s: no memory for its mesh", reading->path);
}

static JnStatus write_nodes(Reading* reading, const struct aiMesh* mesh, const struct aiMatrix4x4* m) {
	for (unsigned i = 0; i < mesh->mNumVertices; i++) {
		const double x = mesh->mVertices[i].x, y = mesh->mVertices[i].y, z = mesh->mVertices[i].z;
		const double at[3] = {m->a1 * x + m->a2 * y + m->a3 * z + m->a4, m->b1 * x + m->b2 * y + m->b3 * z + m->b4,
							  m->c1 * x + m->c2 * y + m->c3 * z + m->c4};
		JN_TRY(write_bytes(reading, at, sizeof at));
	}
	return JN_OK;
}

static JnStatus write_triangles(Reading* reading, const struct aiMesh* mesh, const struct aiMatrix4x4* place) {
	(void)place;
	for (unsigned i = 0; i < mesh->mNumFaces; i++) {
		if (!is_triangle(&mesh->mFaces[i])) continue;
		int nodes[3];
		for (int k = 0; k < 3; k++) nodes[k] = reading->node_count + (int)mesh->mFaces[i].mIndices[k];
		JN_TRY(write_bytes(reading, nodes, sizeof nodes));
	}
	reading->node_count += (int)mesh->mNumVertices;
	return JN_OK;
}

static JnStatus write_scene(Reading* reading, const struct aiScene* scene) {
	JN_TRY(visit_scene(reading, scene, count_mesh));
	if (reading->triangle_count == 0)
		return jn_error(JN_BAD_INPUT, "%s: has no triangles; it is damaged, or holds points and lines alone",
						reading->path);
	const Head head = {reading->node_count, (int)reading->triangle_count};
	JN_TRY(write_bytes(reading, &head, sizeof head));
	JN_TRY(visit_scene(reading, scene, write_nodes));
	reading->node_count = 0;
	return visit_scene(reading, scene, write_triangles);
}

static JnStatus read_in_child(void* user, FILE* result) {
	Reading* reading = user;
	reading->result = result;
	const struct aiLogStream log = {keep_complaint, (char*)user};
	aiAttachLogStream(&log);
	const struct aiScene* scene = aiImportFile(reading->path, aiProcess_ValidateDataStructure | aiProcess_Triangulate);
	aiDetachLogStream(&log);
	if (scene == NULL || reading->complaint[0] != '\0') {
		const char* words = reading->complaint[0] != '\0' ? reading->complaint : aiGetErrorString();
		return jn_error(JN_BAD_INPUT, "%s: is not what its extension says, or damaged: %.300s; export it again",
						reading->path, words);
	}
	const JnStatus status = write_scene(reading, scene);
	aiReleaseImport(scene);
	return status;
}

static JnStatus take_result(FILE* result, const char* path, JnArena* arena, JnSurface* surface) {
	Head head;
	size_t missing = fread(&head, sizeof head, 1, result) != 1;
	if (missing != 0) return jn_error(JN_IO_FAILED, "%s: lost what was read from it", path);
	*surface = (JnSurface){.node_count = head.node_count, .triangle_count = head.triangle_count};
	const size_t numbers = 3 * (size_t)head.node_count, corners = 3 * (size_t)head.triangle_count;
	JN_NEW(arena, surface->nodes, numbers);
	JN_NEW(arena, surface->triangles, corners);
	missing = numbers - fread(surface->nodes, sizeof *surface->nodes, numbers, result);
	missing += corners - fread(surface->triangles, sizeof *surface->triangles, corners, result);
	return missing == 0 ? JN_OK : jn_error(JN_IO_FAILED, "%s: lost what was read from it", path);
}

/// Memory is some 60 times the file's size at worst (OBJ); a second is enough for a megabyte.
static JnGuardLimits limits_for(size_t size) {
	return (JnGuardLimits){.memory = ((size_t)512 << 20) + 64 * size, .seconds = 10 + (int)(size >> 20)};
}

static JnStatus check_content(const char* path, size_t* size) {
	JnArena scratch = {0};
	JnContent content;
	JnStatus status = jn_content_read(path, &scratch, &content);
	const char* extension = strrchr(path, '.');
	if (status == JN_OK && extension != NULL && strcasecmp(extension, ".ply") == 0)
		status = jn_ply_check(path, &content);
	*size = content.size;
	jn_arena_free(&scratch);
	return status;
}

static JnStatus read_surface(const char* path, JnArena* arena, JnImport* out) {
	size_t size;
	JN_TRY(check_content(path, &size));
	Reading reading = {.path = path};
	FILE* result;
	JN_TRY(jn_guard_run(path, limits_for(size), read_in_child, &reading, &result));
	*out = (JnImport){.is_volume = false};
	const JnStatus status = take_result(result, path, arena, &out->surface);
	fclose(result);
	JN_TRY(status);
	JN_TRY(jn_surface_check_values(&out->surface, path));
	const int joined = jn_surface_weld(&out->surface, 0);
	const int unused = joined < 0 ? joined : jn_surface_drop_unused(&out->surface);
	return unused < 0 ? (JnStatus)unused : JN_OK;
}

extern const JnImportFormat jn_import_surface;
const JnImportFormat jn_import_surface = {"surface", "obj ply stl off gltf glb", read_surface};
