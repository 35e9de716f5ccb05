/// @file determinism_test.c
/// The same bits for one, two, three and four threads, on bars long enough that all of them are woken: 4096 nodes a
/// thread in products, 2048 elements in forces, 256 in tangents. Vector sums, which need 21846 nodes a thread, are woken
/// in the last test.
#include "support/model_case.h"

static const int two_to_four[] = {2, 3, 4, 0};

// Everything that threads have a part in, as bytes.
typedef struct Picture {
	int length;
	double *x, *v, *force, *product, *solution;
	double dot, potential;
	JnEnergies energies;
	JnReport report;
} Picture;

static double* kept(const Rig* rig, const double* vector) {
	const size_t bytes = (size_t)rig->length * sizeof *vector;
	double* copy = malloc(bytes);
	assert_non_null(copy);
	return memcpy(copy, vector, bytes);
}

static Picture take_picture(Rig* rig) {
	Picture p = {.length = rig->length, .report = rig->report};
	JnSystem* sys = rig->sys;
	JnVec work = rig->end.x; // not needed any more
	JnMatrix* matrix = NULL;
	p.x = kept(rig, rig->start.x);
	p.v = kept(rig, rig->start.v);
	assert_int_equal(sys->ops->force(sys, &rig->start, work), JN_OK);
	p.force = kept(rig, work);
	assert_int_equal(sys->ops->linearize(sys, &rig->start), JN_OK);
	assert_int_equal(sys->ops->matrix(sys, (JnShift){1, 0.01, 0.0001}, &matrix), JN_OK);
	matrix->ops->apply(matrix, p.x, work);
	p.product = kept(rig, work);
	assert_int_equal(matrix->ops->solve(matrix, p.force, work), JN_OK);
	p.solution = kept(rig, work);
	p.dot = rig->space->ops->dot(rig->space, p.x, p.force);
	p.potential = sys->ops->energy(sys, &rig->start);
	p.energies = jn_model_energies(rig->model, &rig->start);
	return p;
}

static void free_picture(Picture* p) {
	free(p->x);
	free(p->v);
	free(p->force);
	free(p->product);
	free(p->solution);
}

static void expect_same_bytes(const void* a, const void* b, size_t bytes, const char* what, int threads) {
	if (memcmp(a, b, bytes) != 0) fail_msg("%s with %d threads differ from those with one", what, threads);
}

static void expect_same(const Picture* a, const Picture* b, int threads) {
	const size_t bytes = (size_t)a->length * sizeof(double);
	expect_same_bytes(a->x, b->x, bytes, "positions", threads);
	expect_same_bytes(a->v, b->v, bytes, "velocities", threads);
	expect_same_bytes(a->force, b->force, bytes, "forces", threads);
	expect_same_bytes(a->product, b->product, bytes, "products with M + kv D + kx K", threads);
	expect_same_bytes(a->solution, b->solution, bytes, "solutions", threads);
	expect_same_bytes(&a->dot, &b->dot, sizeof a->dot, "dot products", threads);
	expect_same_bytes(&a->potential, &b->potential, sizeof a->potential, "potentials", threads);
	expect_same_bytes(&a->energies, &b->energies, sizeof a->energies, "energies", threads);
	assert_int_equal(a->report.newton, b->report.newton);
}

static void bar_case(ModelCase* c, int element, const char* law, int across, int along) {
	case_box(c, element, law);
	c->box = (JnBoxDef){.size = {0.1 * across, 0.1 * across, 0.1 * along}, .cells = {across, across, along}};
	c->box.element = element;
	case_gravity(c, 0.3, -9.81, 0.2);
	c->body.velocity[0] = 1;
	c->sim.newton = (JnNewtonDef){.tolerance = 1e-6, .max_iterations = 60, .guess = 2};
}

// One thread against each of those that `more` lists, up to a 0.
static void check_threads(const ModelCase* c, int steps, const int more[]) {
	Picture one = {0};
	for (int i = 0; i == 0 || more[i - 1] != 0; ++i) {
		const int threads = i == 0 ? 1 : more[i - 1];
		Rig rig;
		rig_create(&rig, c, threads);
		for (int step = 0; step < steps; ++step) rig_step(&rig, 1.0 / 256);
		Picture now = take_picture(&rig);
		rig_destroy(&rig);
		if (threads == 1) {
			one = now;
			continue;
		}
		expect_same(&now, &one, threads);
		free_picture(&now);
	}
	free_picture(&one);
}

static void hexahedra_move_the_same_for_any_number_of_threads(void** state) {
	(void)state;
	ModelCase c;
	bar_case(&c, JN_HEX8, "stable_neo_hookean", 2, 2050); // 8200 elements, 18459 nodes
	check_threads(&c, 20, two_to_four);
}

static void tetrahedra_move_the_same_for_any_number_of_threads(void** state) {
	(void)state;
	ModelCase c;
	bar_case(&c, JN_TET4, "corotated_frozen", 2, 1824); // 43776 elements, 16425 nodes
	c.body.damping = (JnDampingDef){.alpha = 0.1, .beta = 1e-3};
	check_threads(&c, 3, two_to_four);
}

static void long_vectors_are_summed_the_same_for_any_number_of_threads(void** state) {
	(void)state;
	ModelCase c;
	bar_case(&c, JN_TET4, "linear", 1, 22000); // 88004 nodes: 264012 numbers, for four threads of 65536
	c.body.mass = 1;
	check_threads(&c, 1, (const int[]){4, 0});
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(hexahedra_move_the_same_for_any_number_of_threads),
		cmocka_unit_test(tetrahedra_move_the_same_for_any_number_of_threads),
		cmocka_unit_test(long_vectors_are_summed_the_same_for_any_number_of_threads),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
