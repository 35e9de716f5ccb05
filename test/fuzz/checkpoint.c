// Checkpoints. The first byte chooses: a file of raw bytes, with its head, its check sum and the scene in it; or the saved
// state of one of some small simulations with edits, which a simulation of the same scene takes up, and then steps once. A
// check sum keeps damage from getting that far, but not someone who writes their own.
//
//   0, bytes of the file          1 + scene, then edits: kind, place (2 bytes), value
#include <stdlib.h>
#include <string.h>

#include "record/checkpoint.h"
#include "scene/checkpoint.h"
#include "scene/scene.h"
#include "support/fuzz.h"

enum { MOST_EDITS = 16, STEPS_BEFORE = 2 };

static const char* const texts[] = {
	"gravity: [0, -9.81, 0]\n"
	"bodies:\n"
	"  - name: block\n"
	"    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1]}\n"
	"    material: {law: corotated_frozen, density: 1000, young: 1e5, poisson: 0.3}\n"
	"    velocity: [0, -1, 0]\n"
	"obstacles: [{name: floor, shape: {type: plane}}]\n"
	"contact: {friction: 0.3}\n"
	"integrator: {method: bdf2}\n"
	"step: {dt: 1 ms}\n"
	"duration: 1 s\n",
	"bodies:\n"
	"  - name: thread\n"
	"    shape: {type: thread, curve: {type: circle, radius: 3 cm}, radius: 4 mm, links: 8}\n"
	"    material: {law: constraints, density: 1000, stiffness: 10 kPa, damping: 1 ms}\n"
	"    mass: lumped\n"
	"obstacles: [{name: floor, shape: {type: plane, point: [0, -0.034, 0]}}]\n"
	"collision: {friction: 0.3, residue: 0.5}\n"
	"relax: {sweeps: 2}\n"
	"integrator: {method: symplectic_euler}\n"
	"step: {controller: stretch_limit, dt: 0.1 ms}\n"
	"duration: 1 s\n",
	"bodies:\n"
	"  - name: plate\n"
	"    shape: {type: points_box, size: [0.02, 0.02, 0.01], spacing: 5 mm}\n"
	"    material: {law: peridynamic, density: 1200, young: 1e6, fracture_energy: 0.001, horizon_spacings: 2}\n"
	"    velocity: [1, 0, 0]\n"
	"  - name: ball\n"
	"    shape: {type: rigid_sphere, center: [0.01, 0.01, 0.018], radius: 6 mm}\n"
	"    material: {law: rigid, density: 7800}\n"
	"    velocity: [0, 0, -50]\n"
	"repulsion: {}\n"
	"integrator: {method: newmark}\n"
	"step: {controller: force_error, dt: 10 us}\n"
	"duration: 1 s\n",
	"system: {type: pendulum}\n"
	"integrator: {method: rodas4}\n"
	"step: {controller: embedded, dt: 10 ms}\n"
	"duration: 1 s\n",
};
enum { SCENES = sizeof texts / sizeof texts[0] };

static JnScene* scene_of(int number) {
	static JnScene* scenes[SCENES];
	if (scenes[number] == NULL && jn_scene_parse("scene.yaml", texts[number], 0, NULL, &scenes[number]) != JN_OK)
		abort();
	return scenes[number];
}

static JnSim* build(int number) {
	JnSim* sim;
	if (jn_scene_build(scene_of(number), 1, &sim) != JN_OK) abort();
	return sim;
}

/// What a simulation saves after two steps.
static const JnArchive* saved_of(int number) {
	static JnArchive saved[SCENES];
	if (saved[number].bytes != NULL) return &saved[number];
	JnSim* sim = build(number);
	for (int i = 0; i < STEPS_BEFORE; ++i)
		if (jn_sim_step(sim) != JN_OK) abort();
	if (jn_sim_save(sim, &saved[number]) != JN_OK) abort();
	jn_sim_destroy(sim);
	return &saved[number];
}

static size_t edit(FuzzBytes* edits, unsigned char* bytes, size_t size) {
	const int kind = fuzz_byte(edits) % 5;
	const size_t at = (size_t)fuzz_number(edits, 2) * (kind == 1 ? 8 : 1) % size;
	const uint64_t value = fuzz_number(edits, kind == 0 ? 1 : kind == 1 ? 8 : kind == 2 ? 4 : 2);
	const size_t width = kind == 0 ? 1 : kind == 1 ? 8 : 4, length = (size_t)value % (size - at);
	if (kind < 3) memcpy(bytes + at, &value, width < size - at ? width : size - at);
	if (kind == 3) memmove(bytes + at, bytes + at + length, size - at - length);
	return kind == 3 ? size - length : kind == 4 ? at + 1 : size;
}

static JnStatus restore(int number, FuzzBytes edits) {
	const JnArchive* saved = saved_of(number);
	size_t size = saved->size;
	unsigned char* bytes = malloc(size);
	if (bytes == NULL) abort();
	memcpy(bytes, saved->bytes, size);
	for (int i = 0; i < MOST_EDITS && edits.left > 0 && size > 1; ++i) size = edit(&edits, bytes, size);
	JnSim* sim = build(number);
	JnArchive archive = jn_archive_reader(bytes, size);
	JnStatus status = jn_sim_restore(sim, &archive);
	if (status == JN_OK) status = jn_sim_step(sim);
	jn_sim_destroy(sim);
	free(bytes);
	return status;
}

static JnStatus read_file(FuzzBytes bytes) {
	const void* content;
	size_t size;
	JnRunOrigin origin = {0};
	const JnStatus whole = jn_checkpoint_check("step.jnc", bytes.at, bytes.left, &content, &size);
	JnArchive archive = whole == JN_OK ? jn_archive_reader(content, size) : jn_archive_reader(bytes.at, bytes.left);
	const JnStatus status = jn_run_origin_read(&archive, &origin);
	jn_run_origin_free(&origin);
	return status;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	FuzzBytes bytes = {data, size};
	const int choice = fuzz_byte(&bytes) % (SCENES + 1);
	fuzz_listen();
	fuzz_judge(choice == 0 ? read_file(bytes) : restore(choice - 1, bytes));
	return 0;
}
