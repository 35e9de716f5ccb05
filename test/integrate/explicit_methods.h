/// @file explicit_methods.h
/// The explicit methods with what theory says of each, and tiny models to see it on.
#ifndef JN_TEST_INTEGRATE_EXPLICIT_METHODS_H
#define JN_TEST_INTEGRATE_EXPLICIT_METHODS_H

#include "support/model_case.h"

#include "integrate/composition.h"
#include "integrate/explicit_runge_kutta.h"

typedef struct Method {
	const JnIntegratorType* type;
	int forces;                   ///< evaluations a step
	int damped_order;             ///< with forces that depend on v
	bool is_symplectic, reverses; ///< a step of -dt undoes one of dt
	/// Largest omega dt that is stable without damping, with damping ratio 0.01, and with 0.1 (0: not in the table).
	double limit, limit_001, limit_01;
} Method;

static const Method methods[] = {
	{&jn_explicit_euler, 1, 1, false, false, 0, 0.020, 0.200},
	{&jn_midpoint, 1, 1, false, false, 0, 0.040, 0.400},
	{&jn_half_step, 2, 2, false, false, 0, 0.444, 1.049},
	{&jn_modified_half_step, 2, 2, false, false, 2, 1.980, 1.843},
	{&jn_rk4, 4, 4, false, false, 2.828427, 2.848, 2.950},
	{&jn_symplectic_euler, 1, 1, true, false, 2, 1.980, 1.809},
	{&jn_modified_midpoint, 1, 1, true, true, 2, 1.980, 1.809},
	{&jn_verlet, 1, 1, true, true, 2, 0, 0},
	{&jn_ruth3, 3, 1, true, false, 2.507481, 0, 0},
	{&jn_forest_ruth, 3, 1, true, true, 1.573402, 0, 0},
	{&jn_pefrl, 4, 1, true, true, 2.989450, 0, 0},
};
enum { METHOD_COUNT = sizeof methods / sizeof *methods, MOST_FIXES = 6 };

/// A cube of 0.1 m with lumped mass whose lower nodes are clamped.
typedef struct Cube {
	ModelCase c;
	JnFixDef fix[MOST_FIXES];
} Cube;

static inline void cube_fix(Cube* cube, JnSelectDef where, const char* axes) {
	assert_true(cube->c.body.fix.count < MOST_FIXES);
	cube->fix[cube->c.body.fix.count++] = (JnFixDef){.where = where, .axes = axes};
}

/// All four upper nodes move: 12 free coordinates.
static inline void cube_create(Cube* cube, const char* law, const JnIntegratorType* type) {
	case_box(&cube->c, JN_HEX8, law);
	for (int axis = 0; axis < 3; ++axis) {
		cube->c.box.size[axis] = 0.1;
		cube->c.box.cells[axis] = 1;
	}
	cube->c.body.mass = 1;
	cube->c.sim.integrator.row = &type->row;
	cube->c.body.fix = (JnItems){0, cube->fix};
	cube_fix(cube, face_select(FACE_Z_LOW), "xyz");
}

/// An oscillator: of all nodes, the corner (0.1, 0.1, 0.1) alone moves, along z.
static inline void oscillator_create(Cube* cube, const char* law, const JnIntegratorType* type) {
	cube_create(cube, law, type);
	cube_fix(cube, face_select(FACE_ALL), "xy");
	for (int corner = 0; corner < 3; ++corner)
		cube_fix(cube, (JnSelectDef){.nearest = {0.1 * (corner & 1), 0.1 * (corner >> 1), 0.1}}, "z");
}

/// Entries that no node's support holds.
static inline int find_free(const Rig* rig, int most, int entries[]) {
	double* ones = rig->space->ops->create(rig->space);
	int count = 0;
	assert_non_null(ones);
	for (int k = 0; k < rig->length; ++k) ones[k] = 1;
	rig->sys->ops->hold(rig->sys, ones);
	for (int k = 0; k < rig->length; ++k) {
		if (ones[k] == 0) continue;
		assert_true(count < most);
		entries[count++] = k;
	}
	rig->space->ops->destroy(rig->space, ones);
	return count;
}

/// matrix * e_k at the start, entry k.
static inline double diagonal_entry(Rig* rig, JnShift shift, int k) {
	double *unit = rig->space->ops->create(rig->space), *out = rig->space->ops->create(rig->space);
	JnMatrix* matrix = NULL;
	assert_non_null(unit);
	assert_non_null(out);
	unit[k] = 1;
	assert_int_equal(rig->sys->ops->linearize(rig->sys, &rig->start), JN_OK);
	assert_int_equal(rig->sys->ops->matrix(rig->sys, shift, &matrix), JN_OK);
	matrix->ops->apply(matrix, unit, out);
	const double entry = out[k];
	rig->space->ops->destroy(rig->space, unit);
	rig->space->ops->destroy(rig->space, out);
	return entry;
}

#endif
