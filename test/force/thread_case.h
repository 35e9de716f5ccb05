/// @file thread_case.h
/// Threads for tests of their laws: a mesh along points, the groups of a law with chosen keys, forces and K of all groups.
#ifndef JN_TEST_FORCE_THREAD_CASE_H
#define JN_TEST_FORCE_THREAD_CASE_H

#include "base/key.h"
#include "constraint_sample.h"
#include "force/constraint/rest.h"
#include "mesh/shape/shape.h"
#include "mesh/thread.h"
#include "support/support.h"

/// A number for a key.
typedef struct Setting {
	const char* key;
	double value;
} Setting;

typedef struct ThreadCase {
	JnArena arena;
	JnMesh mesh;
	JnGroups groups;
	int reals; ///< 3 * nodes
	double* x;
} ThreadCase;

static inline void* thread_field(const JnRow* row, void* options, const char* name) {
	for (const JnKey* key = row->keys; key->name != NULL; ++key)
		if (strcmp(key->name, name) == 0) return (char*)options + key->field;
	fail_msg("%s has no key '%s'", row->name, name);
	return NULL;
}

/// A thread along the points; section 0: centred, 1: corner.
static inline ThreadCase thread_case(int points, const double* at, double radius, int links, int section) {
	ThreadCase c = {0};
	double options[32] = {0};
	const JnRow* row = jn_row_find(&jn_shape_list, "thread");
	assert_non_null(row);
	assert_true(row->options_size <= sizeof options);
	*(JnItems*)thread_field(row, options, "points") = (JnItems){.count = points, .data = (void*)at};
	*(double*)thread_field(row, options, "radius") = radius;
	*(int*)thread_field(row, options, "links") = links;
	*(int*)thread_field(row, options, "section") = section;
	assert_int_equal(((const JnShapeType*)row)->generate(options, "shape", &c.arena, &c.mesh), JN_OK);
	c.reals = 3 * c.mesh.node_count;
	c.x = jn_arena_take(&c.arena, (size_t)c.reals, sizeof(double));
	memcpy(c.x, c.mesh.nodes, (size_t)c.reals * sizeof(double));
	return c;
}

/// Build the groups by a law, whose other keys are 0; ends with a setting without key.
static inline JnStatus thread_build(ThreadCase* c, const char* law, const Setting* settings) {
	double options[32] = {0};
	const JnRow* row = jn_row_find(&jn_law_list, law);
	assert_non_null(row);
	assert_true(row->options_size <= sizeof options);
	for (; settings->key != NULL; ++settings) *(double*)thread_field(row, options, settings->key) = settings->value;
	const JnLaw* chosen = (const JnLaw*)row;
	return chosen->build(chosen, options, &c->mesh, 0, "bodies[0]", &c->arena, &c->groups);
}

/// f += forces of a group.
static inline void thread_add_group(const JnGroup* group, const double* x, double* f) {
	const int width = group->kernel->width, nodes = group->kernel->nodes;
	double* lanes = malloc((size_t)group->batches * 3 * (size_t)nodes * (size_t)width * sizeof *lanes);
	group->kernel->force(group, 0, group->batches, x, lanes);
	for (int k = 0; k < group->count * nodes; ++k) {
		const int e = k / nodes, i = k % nodes, node = jn_group_node(group, e, i);
		for (int a = 0; a < 3; ++a) f[3 * node + a] += lanes[((e / width * nodes + i) * 3 + a) * width + e % width];
	}
	free(lanes);
}

/// f = forces of all groups.
static inline void thread_forces(const ThreadCase* c, double* f) {
	memset(f, 0, (size_t)c->reals * sizeof *f);
	for (int g = 0; g < c->groups.count; ++g) thread_add_group(&c->groups.list[g], c->x, f);
}

static inline double thread_energy(const ThreadCase* c) {
	double sum = 0;
	for (int g = 0; g < c->groups.count; ++g) {
		const JnGroup* group = &c->groups.list[g];
		double* lanes = malloc((size_t)group->batches * (size_t)group->kernel->width * sizeof *lanes);
		group->kernel->energy(group, 0, group->batches, c->x, lanes);
		for (int e = 0; e < group->count; ++e) sum += lanes[e];
		free(lanes);
	}
	return sum;
}

/// out = K p of all groups.
static inline void thread_product(const ThreadCase* c, bool definite, const double* p, double* out) {
	memset(out, 0, (size_t)c->reals * sizeof *out);
	for (int g = 0; g < c->groups.count; ++g) {
		const JnGroup* group = &c->groups.list[g];
		const int width = group->kernel->width, nodes = group->kernel->nodes;
		double* lanes = malloc((size_t)group->batches * 3 * (size_t)nodes * (size_t)width * sizeof *lanes);
		group->kernel->product(group, 0, group->batches, c->x, definite, p, lanes);
		for (int k = 0; k < group->count * nodes; ++k) {
			const int e = k / nodes, i = k % nodes, node = jn_group_node(group, e, i);
			for (int a = 0; a < 3; ++a)
				out[3 * node + a] += lanes[((e / width * nodes + i) * 3 + a) * width + e % width];
		}
		free(lanes);
	}
}

/// K u = f by elimination with pivots; f becomes u.
static inline void thread_solve(int n, double* K, double* f) {
	for (int k = 0; k < n; ++k) {
		int pivot = k;
		for (int i = k + 1; i < n; ++i)
			if (fabs(K[i * n + k]) > fabs(K[pivot * n + k])) pivot = i;
		for (int j = k; j <= n; ++j) { // the last: f
			double *a = j < n ? &K[k * n + j] : &f[k], *b = j < n ? &K[pivot * n + j] : &f[pivot];
			const double swap = *a;
			*a = *b;
			*b = swap;
		}
		for (int i = k + 1; i < n; ++i) {
			const double factor = K[i * n + k] / K[k * n + k];
			for (int j = k; j < n; ++j) K[i * n + j] -= factor * K[k * n + j];
			f[i] -= factor * f[k];
		}
	}
	for (int k = n - 1; k >= 0; --k) {
		for (int j = k + 1; j < n; ++j) f[k] -= K[k * n + j] * f[j];
		f[k] /= K[k * n + k];
	}
}

/// Displacements u under small loads f, with the first frame clamped.
static inline void thread_bend(const ThreadCase* c, const double* f, double* u) {
	enum { CLAMPED_REALS = 9 };
	const int n = c->reals - CLAMPED_REALS;
	double *K = malloc((size_t)(n * n) * sizeof *K), *p = calloc((size_t)c->reals, sizeof *p);
	double* column = malloc((size_t)c->reals * sizeof *column);
	for (int j = 0; j < n; ++j) {
		p[CLAMPED_REALS + j] = 1;
		thread_product(c, false, p, column);
		p[CLAMPED_REALS + j] = 0;
		for (int i = 0; i < n; ++i) K[i * n + j] = column[CLAMPED_REALS + i];
	}
	memset(u, 0, CLAMPED_REALS * sizeof *u);
	memcpy(u + CLAMPED_REALS, f + CLAMPED_REALS, (size_t)n * sizeof *u);
	thread_solve(n, K, u + CLAMPED_REALS);
	free(K);
	free(p);
	free(column);
}

#endif
