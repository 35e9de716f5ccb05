// Signed distances of obstacles: formulas, normals against differences of the distance, the Lipschitz bound, odd points.
#include "detect/obstacle.h"

#include "detect_case.h"

static const double turned[9] = {0.8, 0.6, 0, -0.36, 0.48, 0.8, 0.48, -0.64, 0.6}; // orthonormal rows

static const JnPlaneDef plane = {.point = {1, 2, 3}, .normal = {0, 3, 4}};
static const JnSphereDef ball = {.center = {0.1, 0.2, -0.1}, .radius = 0.7};
static const JnSphereDef hollow = {.center = {0.1, 0.2, -0.1}, .radius = 0.7, .inside = true};
static const JnBlockDef block = {
	.center = {0.3, 0.1, 0.2}, .half = {0.5, 0.3, 0.8}, .axes = {0.8, 0.6, 0, -0.36, 0.48, 0.8, 0.48, -0.64, 0.6}};
static const JnCapsuleDef capsule = {.ends = {{-0.5, 0, 0.1}, {0.6, 0.4, 0.2}}, .radius = 0.25};

static void random_point(JnRandom* random, double reach, double p[3]) {
	for (int a = 0; a < 3; a++) p[a] = reach * (2 * jn_random_uniform(random) - 1);
}

/// Central differences of the distance are the normal, save where the distance has a kink within the difference.
static void check_normals(const char* name, const JnObstacle* obstacle) {
	JnRandom random = {1};
	int kinks = 0;
	double worst = 0;
	const double h = 1e-5;
	for (int i = 0; i < 2000; i++) {
		double p[3], normal[3], unused[3], slope[3], error = 0;
		random_point(&random, 1.5, p);
		jn_obstacle_distance(obstacle, p, normal);
		assert_true(fabs(vec3_length(normal) - 1) < 1e-14); // a handful of roundings
		for (int a = 0; a < 3; a++) {
			double low[3] = {p[0], p[1], p[2]}, high[3] = {p[0], p[1], p[2]};
			low[a] -= h;
			high[a] += h;
			slope[a] =
				(jn_obstacle_distance(obstacle, high, unused) - jn_obstacle_distance(obstacle, low, unused)) / (2 * h);
			error = fmax(error, fabs(slope[a] - normal[a]));
		}
		if (error > 1e-6)
			kinks++;
		else
			worst = fmax(worst, error);
	}
	print_message("%s: worst difference of a normal %g, kinks %d of 2000\n", name, worst, kinks);
	assert_true(kinks <=
				4); // a difference of 1e-5 meets surfaces of measure zero in a cube of 3 about 1e-5 of the times
}

static void check_lipschitz(const JnObstacle* obstacle) {
	JnRandom random = {2};
	for (int i = 0; i < 2000; i++) {
		double p[3], q[3], normal[3];
		random_point(&random, 1.5, p);
		random_point(&random, 1.5, q);
		const double change = jn_obstacle_distance(obstacle, p, normal) - jn_obstacle_distance(obstacle, q, normal);
		assert_true(fabs(change) <= vec3_distance(p, q) + 1e-14); // rounding of numbers near 1
	}
}

static void normals_are_slopes_and_slopes_are_at_most_one(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnTriangleTree tree;
	const JnSurface sphere = surface_sphere(&arena, 0.8, 6);
	assert_int_equal(jn_triangle_tree_create(&sphere, &arena, &tree), JN_OK);
	const JnMeshDef mesh = {&tree};
	const JnObstacle all[] = {{&jn_obstacle_plane, &plane},     {&jn_obstacle_sphere, &ball},
							  {&jn_obstacle_sphere, &hollow},   {&jn_obstacle_block, &block},
							  {&jn_obstacle_capsule, &capsule}, {&jn_obstacle_mesh, &mesh}};
	for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
		check_normals(all[i].type->row.name, &all[i]);
		check_lipschitz(&all[i]);
	}
	jn_arena_free(&arena);
}

static void distances_are_those_of_formulas(void** unused) {
	(void)unused;
	double n[3];
	const double p[3] = {0, 5, 7};
	const JnObstacle floor = {&jn_obstacle_plane, &plane}, round = {&jn_obstacle_sphere, &ball};
	const JnObstacle cave = {&jn_obstacle_sphere, &hollow}, rod = {&jn_obstacle_capsule, &capsule};
	// tolerances: some roundings of numbers up to 10
	assert_near("plane", jn_obstacle_distance(&floor, p, n), (3 * 3 + 4 * 4) / 5.0, 1e-14);
	assert_near("ball", jn_obstacle_distance(&round, (double[]){0.1, 0.2, 1.9}, n), 1.3, 1e-14);
	assert_near("its normal", n[2], 1, 1e-15);
	assert_near("cave", jn_obstacle_distance(&cave, (double[]){0.1, 0.2, 0.4}, n), 0.2, 1e-14);
	assert_near("its normal", n[2], -1, 1e-15);
	assert_near("beyond an end", jn_obstacle_distance(&rod, (double[]){-0.5, -3, 4.1}, n), 4.75, 1e-14);
}

/// The block against its six sides: outside by the clamped point, inside by the nearest side.
static void block_distance_is_that_in_its_own_axes(void** unused) {
	(void)unused;
	JnRandom random = {3};
	const JnObstacle obstacle = {&jn_obstacle_block, &block};
	for (int i = 0; i < 1000; i++) {
		double own[3], p[3], n[3], outside = 0, inside = INFINITY;
		random_point(&random, 1.5, own);
		for (int a = 0; a < 3; a++) {
			p[a] = block.center[a];
			for (int r = 0; r < 3; r++) p[a] += turned[3 * r + a] * own[r];
			outside += pow(fmax(fabs(own[a]) - block.half[a], 0), 2);
			inside = fmin(inside, block.half[a] - fabs(own[a]));
		}
		const double distance = jn_obstacle_distance(&obstacle, p, n);
		assert_true(fabs(distance - (outside > 0 ? sqrt(outside) : -inside)) < 1e-14); // roundings of numbers near 1
	}
}

static void mesh_of_a_cube_has_the_distance_of_the_block(void** unused) {
	(void)unused;
	JnArena arena = {0};
	JnRandom random = {4};
	JnTriangleTree tree;
	const JnSurface cube = surface_cube(&arena, -1, 2);
	assert_int_equal(jn_triangle_tree_create(&cube, &arena, &tree), JN_OK);
	const JnMeshDef mesh = {&tree};
	const JnBlockDef same = {.half = {1, 1, 1}, .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
	const JnObstacle one = {&jn_obstacle_mesh, &mesh}, other = {&jn_obstacle_block, &same};
	for (int i = 0; i < 1000; i++) {
		double p[3], n[3], m[3];
		random_point(&random, 2, p);
		const double a = jn_obstacle_distance(&one, p, n), b = jn_obstacle_distance(&other, p, m);
		assert_true(fabs(a - b) < 1e-14);        // roundings of numbers near 1
		assert_true(vec3_distance(n, m) < 1e-9); // offsets of 1e-5 and more: 1e-16 / 1e-5, with room
	}
	jn_arena_free(&arena);
}

static void points_without_a_direction_have_a_unit_normal(void** unused) {
	(void)unused;
	const JnCapsuleDef point = {.ends = {{1, 1, 1}, {1, 1, 1}}, .radius = 0.5};
	const JnObstacle all[] = {{&jn_obstacle_sphere, &ball},
							  {&jn_obstacle_sphere, &hollow},
							  {&jn_obstacle_block, &block},
							  {&jn_obstacle_capsule, &capsule},
							  {&jn_obstacle_capsule, &point}};
	const double* at[] = {ball.center, ball.center, block.center, capsule.ends[0], point.ends[0]};
	for (int i = 0; i < 5; i++) {
		double n[3];
		const double distance = jn_obstacle_distance(&all[i], at[i], n);
		assert_true(isfinite(distance));
		assert_true(fabs(vec3_length(n) - 1) < 1e-14); // roundings of a unit vector
	}
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(normals_are_slopes_and_slopes_are_at_most_one),
		cmocka_unit_test(distances_are_those_of_formulas),
		cmocka_unit_test(block_distance_is_that_in_its_own_axes),
		cmocka_unit_test(mesh_of_a_cube_has_the_distance_of_the_block),
		cmocka_unit_test(points_without_a_direction_have_a_unit_normal),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
