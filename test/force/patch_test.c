// Whole meshes: the patch test on distorted boxes, and consistent masses against integrals known in closed form.
#include "mesh/shape/shape.h"
#include "sample.h"

/// A box of 3 x 3 x 3 hexahedra, 0.3 x 0.6 x 0.9 m, interior nodes moved at random; mid-edge nodes stay in the middle.
static void distorted_box(JnShape shape, JnArena* arena, JnMesh* mesh) {
	const JnBoxDef def = {.size = {0.3, 0.6, 0.9}, .cells = {3, 3, 3}, .element = (int)shape};
	uint64_t seed = 3;
	assert_int_equal(jn_generate_box(&def, arena, mesh), JN_OK);
	for (int i = 0; i < mesh->node_count; i++) {
		bool inside = true;
		for (int a = 0; a < 3; a++) {
			const double X = mesh->nodes[3 * i + a];
			inside = inside && X > 1e-9 && X < def.size[a] - 1e-9;
		}
		for (int a = 0; a < 3 && inside; a++) mesh->nodes[3 * i + a] += 0.015 * random_real(&seed);
	}
	static const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
	for (int k = 0; k < mesh->cell_count * 6 && shape == JN_TET10; k++) {
		const int* cell = mesh->cells + k / 6 * 10;
		const double *p = mesh->nodes + 3 * cell[edges[k % 6][0]], *q = mesh->nodes + 3 * cell[edges[k % 6][1]];
		for (int a = 0; a < 3; a++) mesh->nodes[3 * cell[4 + k % 6] + a] = 0.5 * (p[a] + q[a]);
	}
}

static const double box_size[3] = {0.3, 0.6, 0.9};

static bool is_inside(const double* X) {
	for (int a = 0; a < 3; a++) {
		if (X[a] < 1e-9 || X[a] > box_size[a] - 1e-9) return false;
	}
	return true;
}

/// Net nodal forces of a group, by lanes that are no padding.
static void assemble(const JnGroup* g, const double* x, double* f) {
	const int width = g->kernel->width, reals = 3 * g->kernel->nodes;
	double* lanes = malloc((size_t)g->batches * reals * width * sizeof(double));
	g->kernel->force(g, 0, g->batches, x, lanes);
	for (int k = 0; k < g->count * reals; k++) {
		const int e = k / reals, i = k % reals / 3, batch = e / width, lane = e % width;
		const int node = g->nodes[(batch * g->kernel->nodes + i) * width + lane];
		f[3 * node + k % 3] += lanes[(batch * reals + k % reals) * width + lane];
	}
	free(lanes);
}

static void check_patch(const JnKernel* kernel) {
	static const double F[3][3] = {{1.2, 0.1, -0.2}, {0.05, 0.9, 0.3}, {0.1, -0.15, 1.1}};
	JnArena arena = {0};
	JnMesh mesh;
	JnGroup group;
	distorted_box(kernel->shape, &arena, &mesh);
	const JnMaterialDef material = {.density = 1000, .young = 1e5, .poisson = 0.3};
	assert_int_equal(jn_group_create(kernel, &mesh, 0, &material, "body", &arena, &group), JN_OK);
	double* x = jn_arena_take(&arena, 3 * (size_t)mesh.node_count, sizeof(double));
	double* f = jn_arena_take(&arena, 3 * (size_t)mesh.node_count, sizeof(double));
	double* energy = jn_arena_take(&arena, (size_t)group.batches * kernel->width, sizeof(double));
	for (int k = 0; k < 3 * mesh.node_count; k++) {
		const double* X = mesh.nodes + k / 3 * 3;
		x[k] = F[k % 3][0] * X[0] + F[k % 3][1] * X[1] + F[k % 3][2] * X[2] + 0.5;
	}
	if (kernel->freeze != NULL) kernel->freeze(&group, 0, group.batches, x);
	kernel->energy(&group, 0, group.batches, x, energy);
	assemble(&group, x, f);
	const double scale = largest(f, 3 * mesh.node_count), density = energy[0] / jn_mesh_cell_volume(&mesh, 0);
	const Sample s = {.mesh = mesh, .group = group};
	for (int k = 0; k < 3 * mesh.node_count; k++) {
		// sums of some 100 terms with rounding 1e-16
		if (is_inside(mesh.nodes + k / 3 * 3)) expect_near(f[k], 0, 1e-12 * scale, "interior force", &s, LARGE);
	}
	for (int e = 0; e < mesh.cell_count; e++) {
		const double expected = density * jn_mesh_cell_volume(&mesh, e);
		expect_near(energy[e], expected, 1e-12 * expected, "energy of a cell", &s, LARGE);
	}
	jn_arena_free(&arena);
}

static void affine_displacements_have_uniform_energy_and_no_interior_force(void** unused) {
	(void)unused;
	for (int row = 0; row < JN_SOLID_LAW_COUNT; row++) {
		for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
			check_patch(jn_kernel_find(shape, (const JnLaw*)jn_law_list.rows[row], 0));
		}
	}
}

/// integral of u w over a mesh with density 2, from the mass matrices; u = X_0^p, w = X_1^q at the nodes.
static double mass_product(const JnMesh* mesh, int p, int q) {
	const int n = jn_shape_info[mesh->shape].nodes;
	double sum = 0, mass[100];
	for (int cell = 0; cell < mesh->cell_count; cell++) {
		jn_group_cell_mass(mesh, cell, 2, mass);
		for (int k = 0; k < n * n; k++) {
			const double* Xi = mesh->nodes + 3 * mesh->cells[cell * n + k / n];
			const double* Xj = mesh->nodes + 3 * mesh->cells[cell * n + k % n];
			sum += mass[k] * pow(Xi[0], p) * pow(Xj[1], q);
		}
	}
	return sum;
}

static void masses_integrate_what_the_elements_can_represent(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		JnArena arena = {0};
		JnMesh mesh;
		distorted_box(shape, &arena, &mesh);
		const int most = shape == JN_TET10 ? 2 : 1; // degree of the shape functions in full
		for (int p = 0; p <= most; p++) {
			for (int q = 0; q <= most; q++) {
				const double exact = 2 * pow(0.3, p + 1) / (p + 1) * pow(0.6, q + 1) / (q + 1) * 0.9;
				assert_true(fabs(mass_product(&mesh, p, q) - exact) < 1e-13 * exact); // rounding of 1e4 terms
			}
		}
		jn_arena_free(&arena);
	}
}

static void cell_masses_sum_to_density_times_volume(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		JnArena arena = {0};
		JnMesh mesh;
		distorted_box(shape, &arena, &mesh);
		const int n = jn_shape_info[shape].nodes;
		for (int cell = 0; cell < mesh.cell_count; cell++) {
			double mass[100], sum = 0;
			jn_group_cell_mass(&mesh, cell, 1000, mass);
			for (int k = 0; k < n * n; k++) {
				sum += mass[k];
				assert_true(fabs(mass[k] - mass[k % n * n + k / n]) < 1e-14 * fabs(mass[0]));
			}
			const double expected = 1000 * jn_mesh_cell_volume(&mesh, cell);
			assert_true(fabs(sum - expected) < 1e-13 * expected);
		}
		jn_arena_free(&arena);
	}
}

static char last_message[2048];

static void keep_message(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level;
	snprintf(last_message, sizeof last_message, "%s", message);
}

static void a_group_names_the_first_cell_that_is_inside_out(void** unused) {
	(void)unused;
	for (int shape = 0; shape < JN_SOLID_SHAPE_COUNT; shape++) {
		JnArena arena = {0};
		JnMesh mesh;
		JnGroup group;
		distorted_box(shape, &arena, &mesh);
		int* cell = mesh.cells + 17 * jn_shape_info[shape].nodes;
		const int kept = cell[0];
		cell[0] = cell[1];
		cell[1] = kept;
		jn_log_set_sink(keep_message, NULL);
		const JnMaterialDef material = {.density = 1000, .young = 1e5, .poisson = 0.3};
		const JnKernel* kernel = jn_kernel_find(shape, (const JnLaw*)jn_law_list.rows[0], 0);
		assert_int_equal(jn_group_create(kernel, &mesh, 0, &material, "body", &arena, &group), JN_BAD_INPUT);
		jn_log_set_sink(NULL, NULL);
		assert_non_null(strstr(last_message, "cell 17 "));
		jn_arena_free(&arena);
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(affine_displacements_have_uniform_energy_and_no_interior_force),
		cmocka_unit_test(masses_integrate_what_the_elements_can_represent),
		cmocka_unit_test(cell_masses_sum_to_density_times_volume),
		cmocka_unit_test(a_group_names_the_first_cell_that_is_inside_out),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
