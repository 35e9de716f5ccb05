// Units, axes, size and place of what comes from a file.
#include "mesh/shape/placement.h"

#include <math.h>

#include "base/log.h"

const char* const jn_placement_axes[] = {"y", "z", "x", NULL};

/// axis[up][i]: where the file's axis goes that becomes x, y, z; the sign of z makes it a rotation.
static void turn_up(int up, double x[3]) {
	static const int axis[3][3] = {{0, 1, 2}, {0, 2, 1}, {2, 0, 1}};
	const double old[3] = {x[0], x[1], x[2]};
	for (int a = 0; a < 3; a++) x[a] = old[axis[up][a]];
	if (up == 1) x[2] = -x[2];
}

/// Right-handed turn about an axis; quarter turns are exact.
static void turn_about(int axis, double angle, double x[3]) {
	const double quarters = angle / 1.57079632679489661923;
	const bool is_exact = fabs(quarters - nearbyint(quarters)) < 1e-15 * fmax(1, fabs(quarters));
	const double c = is_exact ? nearbyint(cos(angle)) : cos(angle), s = is_exact ? nearbyint(sin(angle)) : sin(angle);
	double *u = &x[(axis + 1) % 3], *v = &x[(axis + 2) % 3];
	const double old = *u;
	*u = c * old - s * *v;
	*v = s * old + c * *v;
}

static double extent(int count, const double* points) {
	double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (ptrdiff_t i = 0; i < 3 * (ptrdiff_t)count; i++) {
		low[i % 3] = fmin(low[i % 3], points[i]);
		high[i % 3] = fmax(high[i % 3], points[i]);
	}
	return fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
}

// Far away few digits of a mesh are left: edges cannot be halved any more, and cells are flat.
static JnStatus check_digits(const char* what, int count, const double* points) {
	static const double most = 1e8; // of the size, which leaves eight digits
	const double size = extent(count, points);
	double farthest = 0;
	for (ptrdiff_t i = 0; i < 3 * (ptrdiff_t)count; i++) farthest = fmax(farthest, fabs(points[i]));
	if (!(size > 0) || farthest <= most * size) return JN_OK;
	return jn_error(JN_BAD_INPUT,
					"%s.translate: a mesh of %g m would lie %g m from the origin, where too few digits of it are left; "
					"bring it nearer, within %g m",
					what, size, farthest, most * size);
}

JnStatus jn_placement_apply(const JnPlacementDef* def, const char* what, int count, double* points) {
	for (ptrdiff_t i = 0; i < count; i++) {
		double* x = points + 3 * i;
		turn_up(def->up, x);
		for (int a = 0; a < 3; a++) x[a] *= def->scale;
		for (int a = 0; a < 3; a++)
			if (def->rotate[a] != 0) turn_about(a, def->rotate[a], x);
	}
	const double size = extent(count, points);
	if (def->fit > 0 && !(size > 0)) {
		return jn_error(JN_BAD_INPUT, "%s.fit: all %d nodes lie at one place, which cannot be made %g m large", what,
						count, def->fit);
	}
	const double factor = def->fit > 0 ? def->fit / size : 1;
	for (ptrdiff_t i = 0; i < 3 * (ptrdiff_t)count; i++) points[i] = factor * points[i] + def->translate[i % 3];
	for (ptrdiff_t i = 0; i < 3 * (ptrdiff_t)count; i++) {
		if (isfinite(points[i])) continue;
		return jn_error(JN_BAD_INPUT, "%s: node %td is not at a finite place; use a smaller scale", what, i / 3);
	}
	return check_digits(what, count, points);
}
