#define _GNU_SOURCE // mkdtemp
#include "sample_recordings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "scene/scene.h"

static const char* const scenes[SAMPLE_COUNT] = {
	"name: solids\n"
	"duration: 4 ms\n"
	"bodies:\n"
	"  - name: beam\n"
	"    shape: {type: box, size: [0.2, 0.1, 0.1], cells: [2, 1, 1]}\n"
	"    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
	"    mass: lumped\n"
	"    fix: [{where: {face: x-}}]\n"
	"  - name: loop\n"
	"    shape: {type: thread, curve: {type: circle, radius: 6 cm}, radius: 4 mm, links: 6, origin: [0, 0.8, 0]}\n"
	"    material: {law: constraints, density: 1000, stiffness: 10 kPa}\n"
	"    mass: lumped\n"
	"obstacles:\n"
	"  - {name: floor, shape: {type: plane, point: [0, -1, 0]}}\n"
	"probes: [{name: tip, at: [0.2, 0, 0]}]\n"
	"integrator: {method: backward_euler}\n"
	"step: {dt: 2 ms}\n"
	"record: {plots: no, interval: 2 ms}\n",
	"name: points\n"
	"duration: 0.1 ms\n"
	"bodies:\n"
	"  - name: plate\n"
	"    shape: {type: points_box, size: [0.01, 0.01, 0.01], spacing: 5 mm}\n"
	"    material: {law: peridynamic, density: 1200, young: 1e6, fracture_energy: 8, horizon_spacings: 2}\n"
	"  - name: ball\n"
	"    shape: {type: rigid_sphere, center: [0.02, 0.02, 0.04], radius: 15 mm}\n"
	"    material: {law: rigid, density: 7800}\n"
	"    velocity: [0, 0, -5]\n"
	"repulsion: {}\n"
	"integrator: {method: symplectic_euler}\n"
	"step: {dt: 50 us}\n"
	"record: {plots: no, interval: 50 us}\n",
	"name: pendulum\n"
	"duration: 20 ms\n"
	"system: {type: pendulum}\n"
	"integrator: {method: sdirk2}\n"
	"step: {dt: 10 ms}\n"
	"record: {plots: no, interval: 10 ms}\n",
};

static Sample read_image(const char* path) {
	Sample sample = {0};
	FILE* file = fopen(path, "rb");
	if (file == NULL || fseek(file, 0, SEEK_END) != 0) abort();
	sample.size = (size_t)ftell(file);
	sample.image = malloc(sample.size);
	rewind(file);
	if (sample.image == NULL || fread(sample.image, 1, sample.size, file) != sample.size) abort();
	fclose(file);
	return sample;
}

static Sample record(const char* text) {
	char folder[] = "/tmp/jounce_fuzz_XXXXXX", path[80];
	if (mkdtemp(folder) == NULL) abort();
	JnScene* scene = NULL;
	JnRunResult result;
	const JnRunOptions options = {.directory = folder, .threads = 1};
	if (jn_scene_parse("sample.yaml", text, 0, NULL, &scene) != JN_OK) abort();
	if (jn_scene_run(scene, &options, &result) != JN_OK) abort();
	jn_scene_destroy(scene);
	snprintf(path, sizeof path, "%s/run.h5", folder);
	const Sample sample = read_image(path);
	static const char* const names[] = {"run.h5",     "run.xdmf",    "run_surface.xdmf", "run_obstacles.xdmf",
										"series.csv", "summary.json"};
	for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
		snprintf(path, sizeof path, "%s/%s", folder, names[i]);
		unlink(path);
	}
	rmdir(folder);
	return sample;
}

const Sample* sample_recordings(void) {
	static Sample samples[SAMPLE_COUNT];
	for (int i = 0; i < SAMPLE_COUNT; ++i)
		if (samples[i].image == NULL) samples[i] = record(scenes[i]);
	return samples;
}
