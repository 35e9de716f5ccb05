// Scenes whose keys are each in order, but do not fit together: refused when the model is built, with the place and the remedy.
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "detect/obstacle.h"
#include "jounce/scene.h"
#include "jounce/sim.h"
#include "support/model_case.h"
#include "support/support.h"

static char folder[256];

static int set_up(void** state) {
	(void)state;
	return folder_create(folder);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

/// Build the scene, and step once if that works; `words` must be in what is said.
static void expect_refusal(const char* text, const char* words) {
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	file_write(path_join(folder, "scene.yaml"), text);
	log_capture();
	JnStatus status = jn_scene_load(path_join(folder, "scene.yaml"), 0, NULL, &scene);
	if (status == JN_OK) status = jn_scene_build(scene, 1, &sim);
	if (status == JN_OK) status = jn_sim_step(sim);
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	log_release();
	if (status != JN_BAD_INPUT) fail_msg("'%s' ended in %s: %s", words, jn_status_name(status), log_text());
	log_expect(words);
}

#define HEAD "duration: 1 s\nbodies:\n"
#define NAMED(name, shape, material)                                                                                   \
	"  - name: " name "\n    shape: " shape "\n    material: " material "\n    mass: lumped\n"
#define BODY(shape, material) NAMED("body", shape, material)
#define BOX "{type: box, size: [1, 1, 1], cells: [1, 1, 1]}"
#define LINEAR "{law: linear, density: 1000, young: 1e5, poisson: 0.3}"
#define POINTS "{type: points_box, size: [0.1, 0.1, 0.1], counts: [4, 4, 4]}"
#define BONDS "{law: peridynamic, density: 1200, young: 1e6, fracture_energy: 8}"
#define BALL "{type: rigid_sphere, radius: 0.1}"

static void laws_tell_which_shapes_they_are_for(void** state) {
	(void)state;
	expect_refusal(HEAD BODY(BOX, "{law: rod, density: 1000, young: 1e5}"),
				   "bodies[0].material.law: 'rod' runs on threads alone; use `shape: {type: thread}`");
	expect_refusal(HEAD BODY(BOX, "{law: rigid, mass: 1}"),
				   "bodies[0].material.law: 'rigid' is for the shapes rigid_sphere and rigid_plate");
	expect_refusal("repulsion: {}\n" HEAD BODY(BALL, "{law: rigid}"),
				   "bodies[0].material: give exactly one of mass and density");
	expect_refusal("repulsion: {}\n" HEAD BODY(BALL, "{law: rigid, mass: 1, density: 1000}"),
				   "bodies[0].material: give exactly one of mass and density");
	expect_refusal("repulsion: {}\n" HEAD BODY("{type: rigid_plate, thickness: 0.1}", "{law: rigid, density: 1000}"),
				   "bodies[0].material.density: a plate without end has no volume; give mass, or shape.size");
	expect_refusal(
		"integrator: {method: verlet}\n" HEAD BODY(POINTS, "{law: peridynamic, density: 1200, young: 1e6, horizon: 1 "
														   "mm, fracture_energy: 8}"),
		"bodies[0].material.horizon: ");
}

static void damping_of_bodies_must_agree(void** state) {
	(void)state;
	expect_refusal(HEAD NAMED("a", BOX, LINEAR) "    damping: {beta: 1 ms, stiffness: rest}\n" NAMED(
					   "b", BOX, LINEAR) "    damping: {beta: 1 ms, stiffness: current}\n",
				   "bodies[1].damping.stiffness: differs from that of an earlier body; use one for all");
}

static void what_repels_must_be_points_or_rigid(void** state) {
	(void)state;
	expect_refusal("integrator: {method: verlet}\n" HEAD BODY(BALL, "{law: rigid, mass: 1}"),
				   "bodies[0]: 'body' is rigid and acts by repulsion alone; add `repulsion: {}`");
	expect_refusal("integrator: {method: verlet}\nrepulsion: {}\n" HEAD BODY(BOX, LINEAR),
				   "repulsion: 'body' is a mesh of hex8 elements");
	expect_refusal("integrator: {method: verlet}\nrepulsion: {}\n" HEAD BODY(BALL, "{law: rigid, mass: 1}"),
				   "repulsion: nothing says how stiff rigid bodies are; give material.stiffness");
}

static void implicit_methods_need_repulsion_as_products(void** state) {
	(void)state;
	expect_refusal("integrator: {method: sdirk2}\nsolver: {method: direct}\nrepulsion: {}\n" HEAD BODY(POINTS, BONDS),
				   "repulsion: implicit methods need it as products; set solver.method: cg, and solver.matrix: auto");
}

static void contact_tells_what_it_cannot_serve(void** state) {
	(void)state;
	expect_refusal("contact: {}\n" HEAD BODY(POINTS, BONDS),
				   "contact: 'body' is made of points, which have no surface");
	expect_refusal("contact: {}\nsolver: {method: cg}\n" HEAD BODY(POINTS, BONDS) "    contact: {active: false}\n",
				   "contact: needs assembled matrices; set solver.matrix: assembled, or take away contact");
}

static void motions_and_holds_that_say_nothing_are_refused(void** state) {
	(void)state;
	expect_refusal(HEAD BODY(BOX, LINEAR) "    drive: [{where: {face: z+}, x: {type: keyframes, points: []}}]\n",
				   "points: empty; give at least one [time, displacement] pair");
	expect_refusal(HEAD BODY(BOX, LINEAR) "    fix: [{where: {face: z+}, axes: ''}]\n",
				   "axes: empty; name at least one of x, y, z");
}

static void a_set_without_nodes_cannot_be_held(void** state) {
	(void)state;
	file_write(path_join(folder, "marked.vtu"),
			   "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid>"
			   "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData><DataArray type=\"Int32\" Name=\"set:none\" "
			   "format=\"ascii\">0 0 0 0</DataArray></PointData><Points><DataArray type=\"Float64\" "
			   "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
			   "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
			   "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
			   "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray>"
			   "</Cells></Piece></UnstructuredGrid></VTKFile>\n");
	expect_refusal(HEAD BODY("{type: file, path: marked.vtu}", LINEAR) "    fix: [{where: {set: none}}]\n",
				   "set: the set 'none' has no nodes; choose another");
}

static void shapes_of_points_must_stand_on_a_line_that_goes_on(void** state) {
	(void)state;
	expect_refusal(HEAD BODY("{type: thread, points: [{at: [0, 0, 0]}, {at: [1, 0, 0]}, {at: [1.0000000000000002, 0, "
							 "0]}], radius: 1 mm, "
							 "links: 4}",
							 "{law: rod, density: 1000, young: 1e5}"),
				   "take out points that lie at one place");
	expect_refusal(HEAD BODY("{type: rigid_plate, thickness: 0.1, normal: [0, 0, 0]}", "{law: rigid, mass: 1}"),
				   "bodies[0].shape.normal: has no length; give a direction");
}

// ---- models built in C: scenes are looked at by their reader

static void expect_no_model(const ModelCase* c, const char* words) {
	JnModel* model = NULL;
	log_capture();
	const JnStatus status = jn_model_create(&c->sim.model, 1, &model);
	log_release();
	assert_int_equal(status, JN_BAD_INPUT);
	assert_null(model);
	log_expect(words);
}

static void names_that_are_there_twice_are_refused(void** state) {
	(void)state;
	ModelCase c;
	case_box(&c, JN_HEX8, "linear");
	JnBodyDef bodies[2] = {c.body, c.body};
	c.sim.model.bodies = (JnItems){2, bodies};
	expect_no_model(&c, "bodies[1].name: 'box' is the name of bodies[0] already; use another");
	bodies[1].name = "other";
	JnObstacleDef obstacles[2] = {
		{.name = "floor", .shape = {row_named(&jn_obstacle_list, "plane"), &(JnPlaneDef){.normal = {0, 1, 0}}}}};
	obstacles[1] = obstacles[0];
	c.sim.model.obstacles = (JnItems){2, obstacles};
	expect_no_model(&c, "obstacles[1].name: 'floor' is the name of obstacles[0] already; use another");
	c.sim.model.bodies.count = 0;
	expect_no_model(&c, "bodies: there are none; a scene needs at least one");
}

// ---- files

#define FILE_SHAPE(keys) "{type: file, path: cube.obj" keys "}"
#define VOLUME_SHAPE(keys) "{type: file, path: cell.vtk" keys "}"

static void write_files(void) {
	file_write(path_join(folder, "cube.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
											  "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
	file_write(path_join(folder, "cell.vtk"),
			   "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n"
			   "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
}

static void keys_of_files_that_exclude_each_other_are_named(void** state) {
	(void)state;
	write_files();
	expect_refusal(HEAD BODY(FILE_SHAPE(", voxels: {size: 0.5}, tetrahedra: {size: 0.5}"), LINEAR),
				   "bodies[0].shape.voxels: tetrahedra are asked for as well; give one of them");
	expect_refusal(HEAD BODY(VOLUME_SHAPE(", voxels: {size: 0.5}"), LINEAR), "bodies[0].shape.voxels: ");
	expect_refusal(HEAD BODY(VOLUME_SHAPE(", tetrahedra: {size: 0.5}"), LINEAR),
				   "cell.vtk holds cells already; leave this key out");
	expect_refusal(HEAD BODY(VOLUME_SHAPE(", triangles: true"), LINEAR), "bodies[0].shape.triangles: ");
	expect_refusal(HEAD BODY(FILE_SHAPE(", voxels: {size: 0.5}, triangles: true"), LINEAR),
				   "is a volume, or filled to be one; leave this key out");
	expect_refusal(HEAD BODY(FILE_SHAPE(", voxels: {size: 1 mm}"), LINEAR), "make them larger than ");
}

static void surfaces_that_hold_no_points_are_refused(void** state) {
	(void)state;
	write_files();
	expect_refusal(HEAD BODY("{type: points_file, path: cell.vtk, spacing: 0.1}", BONDS), "bodies[0].shape.path: ");
	file_write(path_join(folder, "thin.obj"), // a wedge, in whose plane lie the lattice's middles, but not inside
			   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.01 0.01 0.01\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
	expect_refusal(HEAD BODY("{type: points_file, path: thin.obj, spacing: 1}", BONDS),
				   "bodies[0].shape.spacing: no point of a lattice of 1 m lies inside the surface; use a smaller one");
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(laws_tell_which_shapes_they_are_for),
		cmocka_unit_test(damping_of_bodies_must_agree),
		cmocka_unit_test(what_repels_must_be_points_or_rigid),
		cmocka_unit_test(implicit_methods_need_repulsion_as_products),
		cmocka_unit_test(contact_tells_what_it_cannot_serve),
		cmocka_unit_test(motions_and_holds_that_say_nothing_are_refused),
		cmocka_unit_test(a_set_without_nodes_cannot_be_held),
		cmocka_unit_test(shapes_of_points_must_stand_on_a_line_that_goes_on),
		cmocka_unit_test(names_that_are_there_twice_are_refused),
		cmocka_unit_test(keys_of_files_that_exclude_each_other_are_named),
		cmocka_unit_test(surfaces_that_hold_no_points_are_refused),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
