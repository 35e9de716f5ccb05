// Links against their parts one by one, and what the definite form that damps them leaves alone.
#include "force/constraint/link.h"
#include "thread_case.h"

static const double bow[] = {0, 0, 0, 0.05, 0.02, 0, 0.1, 0, 0.03};
enum { LINKS = 13 };

static const Setting soft[] = {{"density", 1000},
							   {"stiffness", 5e4},
							   {"volume", 2e4},
							   {"collapse", 3e4},
							   {"torsion", 1e-5},
							   {"torsion_damping", NAN},
							   {0}};
static const Setting stiff[] = {{"density", 1000}, {"young", 1e6}, {"poisson", 0.4}, {0}};

/// Every node moved by up to 20 % of the radius, which leaves some cells smaller and some larger.
static ThreadCase moved_thread(const char* law, const Setting* settings) {
	ThreadCase c = thread_case(3, bow, 4e-3, LINKS, 0);
	uint64_t seed = 3;
	assert_int_equal(thread_build(&c, law, settings), JN_OK);
	for (int k = 0; k < c.reals; ++k) c.x[k] += 8e-4 * random_real(&seed);
	return c;
}

static double rest_of(const JnGroup* group, int element, int k) {
	const int width = group->kernel->width;
	return group->rest[((ptrdiff_t)(element / width) * group->kernel->rest_reals + k) * width + element % width];
}

/// Add a part of every link as a group of its own, with the numbers from `first` of the link.
static void split(const JnGroup* links, JnConstraintKernel which, const int* nodes, int first, ThreadCase* parts) {
	JnConstraint elements[LINKS] = {0};
	const JnKernel* kernel = jn_constraint_kernel(which, 0);
	for (int e = 0; e < LINKS; ++e) {
		for (int i = 0; i < kernel->nodes; ++i) elements[e].nodes[i] = jn_group_node(links, e, nodes[i]);
		for (int k = 0; k < kernel->rest_reals; ++k) elements[e].rest[k] = rest_of(links, e, first + k);
	}
	assert_int_equal(jn_constraint_add(which, LINKS, elements, 0, 0, &parts->arena, &parts->groups), JN_OK);
}

static ThreadCase split_links(const ThreadCase* whole, const LinkKind* kind) {
	static const int all[LINK_NODES] = {0, 1, 2, 3, 4, 5};
	const JnGroup* links = &whole->groups.list[0];
	ThreadCase parts = {.reals = whole->reals, .x = whole->x};
	int first = 0;
	parts.groups.list = jn_arena_take(&parts.arena, 16, sizeof(JnGroup));
	for (int k = 0; k < kind->struts; ++k, first += STRUT_REALS)
		split(links, JN_CONSTRAINT_strut, link_struts[k], first, &parts);
	for (int k = 0; k < kind->cells; ++k, first += VOLUME_REALS)
		split(links, JN_CONSTRAINT_volume, link_cells[k], first, &parts);
	split(links, JN_CONSTRAINT_torsion, all, first, &parts);
	if (kind->has_skew) split(links, JN_CONSTRAINT_skew, all, first + TORSION_REALS, &parts);
	for (int g = 1; g < whole->groups.count; ++g) parts.groups.list[parts.groups.count++] = whole->groups.list[g];
	return parts;
}

static void expect_same(const double* value, const double* expected, int count, const char* what) {
	const double most = largest(expected, count);
	assert_true(most > 0);
	for (int k = 0; k < count; ++k)
		if (!(fabs(value[k] - expected[k]) <= 1e-13 * most)) // other sums of some 20 terms
			fail_msg("%s, entry %d: %.17g, expected %.17g", what, k, value[k], expected[k]);
}

static void compare(const char* law, const Setting* settings, const LinkKind* kind) {
	enum { REALS = 9 * (LINKS + 1) };
	ThreadCase whole = moved_thread(law, settings), parts = split_links(&whole, kind);
	double p[REALS], fused[REALS], split_up[REALS];
	uint64_t seed = 8;
	for (int k = 0; k < REALS; ++k) p[k] = random_real(&seed);
	thread_forces(&whole, fused);
	thread_forces(&parts, split_up);
	expect_same(fused, split_up, REALS, "force");
	for (int definite = 0; definite < 2; ++definite) {
		thread_product(&whole, definite, p, fused);
		thread_product(&parts, definite, p, split_up);
		expect_same(fused, split_up, REALS, definite ? "definite product" : "product");
	}
	const double energy = thread_energy(&whole), expected = thread_energy(&parts);
	expect_same(&energy, &expected, 1, "energy");
	jn_arena_free(&parts.arena);
	jn_arena_free(&whole.arena);
}

static void a_thread_link_does_what_its_parts_do(void** unused) {
	(void)unused;
	compare("constraints", soft, &thread_link_kind);
}

static void a_rod_link_does_what_its_parts_do(void** unused) {
	(void)unused;
	compare("rod", stiff, &rod_link_kind);
}

// v = a + w x x: no strain changes, so that damping by the definite form has no force, as far as rounding of strains goes.
static void damping_leaves_rigid_motion_alone(void** unused) {
	(void)unused;
	for (int i = 0; i < 2; ++i) {
		ThreadCase c = moved_thread(i == 0 ? "constraints" : "rod", i == 0 ? soft : stiff);
		double v[9 * (LINKS + 1)], f[9 * (LINKS + 1)], other[9 * (LINKS + 1)];
		uint64_t seed = 4;
		for (int k = 0; k < c.reals; ++k) {
			static const double a[3] = {0.3, -0.2, 0.7}, w[3] = {2, -3, 5};
			const double* x = c.x + k / 3 * 3;
			v[k] = a[k % 3] + w[(k + 1) % 3] * x[(k + 2) % 3] - w[(k + 2) % 3] * x[(k + 1) % 3];
		}
		thread_product(&c, true, v, f);
		const double speed = largest(v, c.reals);
		for (int k = 0; k < c.reals; ++k) v[k] = speed * random_real(&seed);
		thread_product(&c, true, v, other);
		print_message("damping of a rigid motion %.3g, of another %.3g\n", largest(f, c.reals),
					  largest(other, c.reals));
		assert_true(largest(f, c.reals) < 1e-12 * largest(other, c.reals));
		jn_arena_free(&c.arena);
	}
}

static void torsion_with_another_damping_stands_by_itself(void** unused) {
	(void)unused;
	Setting settings[] = {{"density", 1000}, {"stiffness", 5e4},        {"volume", 2e4},   {"collapse", 3e4},
						  {"torsion", 1e-5}, {"torsion_damping", 2e-3}, {"damping", 1e-3}, {0}};
	ThreadCase together = moved_thread("constraints", soft), apart = moved_thread("constraints", settings);
	double expected[9 * (LINKS + 1)], found[9 * (LINKS + 1)];
	assert_int_equal(together.groups.count, 2); // links and the sides of the last section
	assert_int_equal(apart.groups.count, 3);
	assert_string_equal(apart.groups.list[2].kernel->name, "torsion");
	assert_true(apart.groups.list[0].damping == 1e-3 && apart.groups.list[2].damping == 2e-3);
	thread_forces(&together, expected);
	thread_forces(&apart, found);
	expect_same(found, expected, together.reals, "force");
	jn_arena_free(&together.arena);
	jn_arena_free(&apart.arena);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_thread_link_does_what_its_parts_do),
		cmocka_unit_test(a_rod_link_does_what_its_parts_do),
		cmocka_unit_test(damping_leaves_rigid_motion_alone),
		cmocka_unit_test(torsion_with_another_damping_stands_by_itself),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
