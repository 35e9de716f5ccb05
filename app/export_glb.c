// glTF 2.0 in one binary file. Each part is a mesh; one that moves has a morph target for every frame but the first,
// whose weight the animation raises to 1 at its time, so that positions between frames are interpolated. What is stored
// is the difference of rounded positions. Vertices at sharp edges are doubled, each with its own normal. All is below a
// node that turns up to y, as glTF wants it.
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "export_crease.h"
#include "export_gltf.h"
#include "export_look.h"
#include "recording_surface.h"

enum { MANY_TARGETS = 1024, POINTS = 0, TRIANGLES = 4 };

/// A part on its way into the file.
typedef struct Mesh {
	ExportCrease crease;         // its vertices and triangles
	double *positions, *normals; // of the first frame; normals of triangles only
	json_t *primitive, *targets; // of the file
} Mesh;

typedef struct Glb {
	Export* export;
	Gltf gltf;
	Mesh* meshes;                        // one a part
	double *positions, *normals, *delta; // room for those of any part
} Glb;

/// Rounded positions of the vertices of a part in the frame in hand.
static void mesh_positions(const Glb* glb, int index, double* out) {
	const ExportCrease* crease = &glb->meshes[index].crease;
	const double* vertices = glb->export->vertices;
	export_vertices(glb->export, &glb->export->parts[index], glb->export->vertices);
	for (int i = 0; i < crease->vertex_count; ++i)
		for (int a = 0; a < 3; ++a) out[3 * i + a] = (float)vertices[3 * (ptrdiff_t)crease->sources[i] + a];
}

/// Rounded unit normals; at a sharp edge each side has its own.
static void mesh_normals(const Glb* glb, int index, const double* positions, double* out) {
	const ExportCrease* crease = &glb->meshes[index].crease;
	recording_normals(crease->vertex_count, positions, glb->export->parts[index].triangle_count, crease->triangles,
					  out);
	for (int i = 0; i < 3 * crease->vertex_count; ++i) out[i] = (float)out[i];
}

static json_t* attributes_of(Glb* glb, int count, const double* positions, const double* normals) {
	json_t* attributes = json_pack("{so}", "POSITION", gltf_vectors(&glb->gltf, count, positions));
	if (normals != NULL) json_object_set_new(attributes, "NORMAL", gltf_vectors(&glb->gltf, count, normals));
	return attributes;
}

/// Sharp edges are those of the frame in hand.
static JnStatus find_creases(Glb* glb) {
	Export* export = glb->export;
	size_t most = 0;
	for (int i = 0; i < export->part_count; ++i) {
		const ExportPart* part = &export->parts[i];
		ExportCrease* crease = &glb->meshes[i].crease;
		export_vertices(export, part, export->vertices);
		JN_TRY(export_crease(part->vertex_count, export->vertices, part->triangle_count, part->triangles,
							 &export->arena, crease));
		if (most < (size_t)crease->vertex_count) most = (size_t)crease->vertex_count;
	}
	JN_NEW(&export->arena, glb->positions, 3 * most + 1);
	JN_NEW(&export->arena, glb->normals, 3 * most + 1);
	JN_NEW(&export->arena, glb->delta, 3 * most + 1);
	return JN_OK;
}

/// The part in the first frame.
static JnStatus add_mesh(Glb* glb, int index) {
	const ExportPart* part = &glb->export->parts[index];
	const bool has_triangles = part->triangle_count > 0;
	Mesh* mesh = &glb->meshes[index];
	const int count = mesh->crease.vertex_count;
	JN_NEW(&glb->export->arena, mesh->positions, 3 * (size_t)count + 1);
	mesh_positions(glb, index, mesh->positions);
	if (has_triangles) {
		JN_NEW(&glb->export->arena, mesh->normals, 3 * (size_t)count + 1);
		mesh_normals(glb, index, mesh->positions, mesh->normals);
	}
	mesh->primitive = json_pack("{so, si, si}", "attributes", attributes_of(glb, count, mesh->positions, mesh->normals),
								"material", index, "mode", has_triangles ? TRIANGLES : POINTS);
	if (has_triangles)
		json_object_set_new(mesh->primitive, "indices",
							gltf_indices(&glb->gltf, 3 * part->triangle_count, mesh->crease.triangles));
	if (part->fixed == NULL && glb->export->frame_count > 1) {
		mesh->targets = json_array();
		json_object_set_new(mesh->primitive, "targets", mesh->targets);
	}
	return JN_OK;
}

/// The part in the frame in hand.
static void add_target(Glb* glb, int index) {
	const Mesh* mesh = &glb->meshes[index];
	const int count = mesh->crease.vertex_count;
	mesh_positions(glb, index, glb->positions);
	for (int i = 0; i < 3 * count; ++i) glb->delta[i] = glb->positions[i] - mesh->positions[i];
	if (mesh->normals != NULL) {
		mesh_normals(glb, index, glb->positions, glb->normals);
		for (int i = 0; i < 3 * count; ++i) glb->normals[i] -= mesh->normals[i];
	}
	json_array_append_new(mesh->targets,
						  attributes_of(glb, count, glb->delta, mesh->normals != NULL ? glb->normals : NULL));
}

// ---- the animation ----

/// Weights of all targets at each time: at frame k, 1 for target k - 1.
static JnStatus add_animation(Glb* glb, json_t* root) {
	const Export* export = glb->export;
	const long frames = export->frame_count, targets = frames - 1;
	double *times, *weights;
	if (targets == 0) return JN_OK;
	JN_NEW(&glb->export->arena, times, frames);
	JN_NEW(&glb->export->arena, weights, frames * targets);
	for (long i = 0; i < frames; ++i) times[i] = export->times[i] - export->times[0];
	for (long i = 1; i < frames; ++i) weights[i * targets + i - 1] = 1;
	json_t* input = gltf_scalars(&glb->gltf, frames, times);
	json_t* output = gltf_scalars(&glb->gltf, frames * targets, weights);
	json_t* channels = json_array();
	for (int i = 0; i < export->part_count; ++i)
		if (glb->meshes[i].targets != NULL)
			json_array_append_new(
				channels, json_pack("{si, s{si, ss}}", "sampler", 0, "target", "node", i + 1, "path", "weights"));
	json_object_set_new(root, "animations",
						json_pack("[{ss, so, s[{so, so, ss}]}]", "name", "run", "channels", channels, "samplers",
								  "input", input, "output", output, "interpolation", "LINEAR"));
	return JN_OK;
}

// ---- all of it ----

static json_t* describe_mesh(const Glb* glb, int index) {
	const Mesh* mesh = &glb->meshes[index];
	json_t* out = json_pack("{ss, s[O]}", "name", glb->export->parts[index].name, "primitives", mesh->primitive);
	if (mesh->targets == NULL) return out;
	json_t* weights = json_array();
	for (int i = 1; i < glb->export->frame_count; ++i) json_array_append_new(weights, json_integer(0));
	json_object_set_new(out, "weights", weights);
	return out;
}

static json_t* describe_material(const Export* export, int index) {
	const double* color = export_look_color(export, index);
	return json_pack("{ss, sb, s{s[f, f, f, f], sf, sf}}", "name", export->parts[index].name, "doubleSided", 1,
					 "pbrMetallicRoughness", "baseColorFactor", color[0], color[1], color[2], 1.0, "metallicFactor",
					 0.0, "roughnessFactor", 0.6);
}

static json_t* describe(const Glb* glb) {
	const Export* export = glb->export;
	json_t *nodes = json_array(), *children = json_array(), *meshes = json_array(), *materials = json_array();
	double q[4];
	export_look_upright(export, q);
	json_array_append_new(nodes, json_pack("{ss, s[f, f, f, f], so}", "name", export->recording.scene_name, "rotation",
										   q[0], q[1], q[2], q[3], "children", children));
	for (int i = 0; i < export->part_count; ++i) {
		json_array_append_new(children, json_integer(i + 1));
		json_array_append_new(nodes, json_pack("{ss, si}", "name", export->parts[i].name, "mesh", i));
		json_array_append_new(meshes, describe_mesh(glb, i));
		json_array_append_new(materials, describe_material(export, i));
	}
	return json_pack("{s{ss, ss}, si, s[{s[i]}], so, so, so}", "asset", "version", "2.0", "generator",
					 "jounce " JN_VERSION, "scene", 0, "scenes", "nodes", 0, "nodes", nodes, "meshes", meshes,
					 "materials", materials);
}

static JnStatus write_data(Glb* glb) {
	Export* export = glb->export;
	JN_NEW(&export->arena, glb->meshes, export->part_count);
	JN_TRY(recording_points(&export->recording, 0, export->points)); // unbent, most likely
	JN_TRY(find_creases(glb));
	for (int frame = 0; frame < export->frame_count; ++frame) {
		JN_TRY(export_load(export, frame));
		for (int i = 0; i < export->part_count; ++i) {
			if (frame == 0) JN_TRY(add_mesh(glb, i));
			if (frame > 0 && glb->meshes[i].targets != NULL) add_target(glb, i);
		}
	}
	return JN_OK;
}

static JnStatus write_all(Glb* glb) {
	JN_TRY(gltf_create(glb->export->path, &glb->gltf));
	JN_TRY(write_data(glb));
	json_t* root = describe(glb);
	JnStatus status = root != NULL ? add_animation(glb, root) : JN_OUT_OF_MEMORY;
	if (status == JN_OK) status = gltf_write(&glb->gltf, root, glb->export->path);
	json_decref(root);
	return status;
}

JnStatus export_glb(Export* export) {
	Glb glb = {.export = export};
	if (export->frame_count - 1 > MANY_TARGETS)
		jn_warn(
			"%d frames are as many shapes of each mesh; browsers show 256 to 2048 of them, depending on the graphics "
			"card. Choose fewer with --frames ::%d if it does not play",
			export->frame_count, (export->frame_count + MANY_TARGETS - 1) / MANY_TARGETS);
	const JnStatus status = write_all(&glb);
	for (int i = 0; glb.meshes != NULL && i < export->part_count; ++i) json_decref(glb.meshes[i].primitive);
	gltf_destroy(&glb.gltf);
	return status;
}
