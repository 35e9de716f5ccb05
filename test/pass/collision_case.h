/// @file collision_case.h
/// Threads for tests of collisions: where their axes are, and how far apart.
#ifndef JN_TEST_PASS_COLLISION_CASE_H
#define JN_TEST_PASS_COLLISION_CASE_H

#include "detect/segment.h"
#include "math/vec3.h"
#include "mesh/thread.h"
#include "pass/collision.h"
#include "pass/pass_case.h"

/// A soft rod of 2 mm radius: steps of 0.05 ms are well within what it needs at links of 4 mm or more.
#define SOFT_ROD "material: {law: rod, density: 1000, young: 2e5, damping: 0.02 ms}, mass: lumped"

/// The pass that runs of a type, of several.
static inline JnPass* run_pass_of(const Run* run, const JnPassType* type) {
	int count;
	JnPass* const* passes = jn_sim_passes(run->sim, &count);
	for (int i = 0; i < count; ++i)
		if (passes[i]->type == type) return passes[i];
	fail_msg("no pass '%s' runs", type->row.name);
	return NULL;
}

static inline double pass_column(const JnPass* pass, const char* name) {
	double values[32];
	pass->type->measure(pass, values);
	for (int i = 0; i < pass->type->column_count; ++i)
		if (strcmp(pass->type->columns[i].name, name) == 0) return values[i];
	fail_msg("there is no column '%s'", name);
	return NAN;
}

static inline const JnCollision* run_collision(const Run* run) {
	return (const JnCollision*)run_pass_of(run, &jn_pass_collision);
}

/// The point of a vector of positions or velocities that a frame of a thread has on its axis.
static inline void axis_of(const Run* run, int body, int frame, const double* vector, double out[3]) {
	const JnBody* thread = &run->model->bodies[body];
	const double* at = vector + 3 * ((ptrdiff_t)thread->first_node + JN_FRAME_NODES * frame);
	for (int a = 0; a < 3; ++a) {
		out[a] = 0;
		for (int i = 0; i < 3; ++i) out[a] += thread->mesh.thread->axis[i] * at[3 * i + a];
	}
}

static inline int frames_of(const Run* run, int body) {
	return run->model->bodies[body].mesh.thread->frame_count;
}

/// Least and greatest of one axis over the frames of a thread.
static inline double axis_low(const Run* run, int body, const double* vector, int axis) {
	double low = INFINITY, at[3];
	for (int k = 0; k < frames_of(run, body); ++k) {
		axis_of(run, body, k, vector, at);
		low = fmin(low, at[axis]);
	}
	return low;
}

static inline double axis_high(const Run* run, int body, const double* vector, int axis) {
	double high = -INFINITY, at[3];
	for (int k = 0; k < frames_of(run, body); ++k) {
		axis_of(run, body, k, vector, at);
		high = fmax(high, at[axis]);
	}
	return high;
}

/// Mass of a body [kg].
static inline double body_mass(const Run* run, int body) {
	double sum = 0;
	for (int k = 0; k < body_length(run, body) / 3; ++k)
		sum += run->model->nodal_mass[run->model->bodies[body].first_node + k];
	return sum;
}

/// Momentum of a body along an axis, of lumped masses [kg m/s].
static inline double body_momentum(const Run* run, int body, int axis) {
	double sum = 0;
	const int first = run->model->bodies[body].first_node;
	for (int k = first; k < first + body_length(run, body) / 3; ++k)
		sum += run->model->nodal_mass[k] * run_state(run)->v[3 * (ptrdiff_t)k + axis];
	return sum;
}

/// Smallest distance of two links, of two threads or of one and then `apart` numbers apart at least [m].
static inline double links_apart(const Run* run, int first, int second, int apart) {
	double least = INFINITY;
	const double* x = run_state(run)->x;
	for (int i = 0; i + 1 < frames_of(run, first); ++i)
		for (int k = first == second ? i + apart : 0; k + 1 < frames_of(run, second); ++k) {
			double a[2][3], b[2][3], share[2], offset[3];
			for (int e = 0; e < 2; ++e) {
				axis_of(run, first, i + e, x, a[e]);
				axis_of(run, second, k + e, x, b[e]);
			}
			least = fmin(least, sqrt(jn_segments_nearest(a, b, share, offset)));
		}
	return least;
}

#endif
