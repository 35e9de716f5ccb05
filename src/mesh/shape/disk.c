#include "mesh/shape/disk.h"

#include <math.h>

#include "base/log.h"

static const double quarter_pi = 0.78539816339744830962;
static const double SQUARE = 0.55; // corners of the square lie at this share of the radius
static const double BULGE = 0.5;   // of its sides: 0 straight, 1 arcs about the middle

/// (a, b) in [-1, 1]^2, blended from a straight square and a disk, both with corners at distance SQUARE.
static void square_point(double a, double b, double p[2]) {
	const double reach = fmax(fabs(a), fabs(b));
	const double straight = SQUARE * sqrt(0.5);
	double x = reach, y = 0;
	if (reach > 0 && fabs(a) >= fabs(b)) {
		x = a * cos(quarter_pi * b / a);
		y = a * sin(quarter_pi * b / a);
	} else if (reach > 0) {
		x = b * sin(quarter_pi * a / b);
		y = b * cos(quarter_pi * a / b);
	}
	p[0] = (1 - BULGE) * straight * a + BULGE * SQUARE * x;
	p[1] = (1 - BULGE) * straight * b + BULGE * SQUARE * y;
}

static void turn(int quarters, double p[2]) {
	for (int i = 0; i < quarters; ++i) {
		const double x = p[0];
		p[0] = -p[1];
		p[1] = x;
	}
}

void jn_disk_point(int patch, double u, double v, double p[2]) {
	if (patch == JN_DISK_SQUARE) {
		square_point(2 * u - 1, 2 * v - 1, p);
		return;
	}
	const double angle = quarter_pi * (2 * v - 1);
	square_point(1, 2 * v - 1, p);
	p[0] = (1 - u) * p[0] + u * cos(angle);
	p[1] = (1 - u) * p[1] + u * sin(angle);
	turn(patch - 1, p);
}

void jn_disk_cells(int patch, int around, int rings, int cells[2]) {
	cells[0] = patch == JN_DISK_SQUARE ? around / 4 : rings;
	cells[1] = around / 4;
}

JnStatus jn_disk_check(int around, const char* what) {
	if (around % 4 == 0) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s.cells[0]: %d cells around are no multiple of 4; use %d or %d", what, around,
					around / 4 * 4, around / 4 * 4 + 4);
}
