/// @file measure.h
/// Numbers that say how alike two motions look.
#ifndef JN_APP_REPRODUCE_MEASURE_H
#define JN_APP_REPRODUCE_MEASURE_H

#include "base/arena.h"

/// Highest minus lowest of the values at times in [from, to]; NAN when there is none. Times rise.
double measure_span(int count, const double times[], const double values[], double from, double to);

/// The middle surface of a sheet whose nodes lie on a grid at rest.
typedef struct SheetGrid {
	int cells[2];   ///< along x and y
	int* node;      ///< grid point of each of the nodes
	int* members;   ///< nodes at each grid point
	double* middle; ///< their mean positions, 3 a grid point; set by measure_wrinkles
	double* work;   ///< 6 a grid point
} SheetGrid;

/// Find the grid of `count` nodes that are evenly spaced along x and y. JN_BAD_INPUT, after a message, when they are
/// not.
JnStatus sheet_grid_create(int count, const double* rest, JnArena* arena, SheetGrid* grid);

/// Height of the wrinkles [m]: root mean square of w = (I - S)(I - S) p over the grid points p of the middle surface
/// whose windows lie on the sheet; S is the mean over a square window of an eighth of the sheet's edge (or the next
/// odd number of grid points). It is 0 for a surface that is a polynomial of third degree in the sheet's coordinates,
/// and passes waves of an eighth of the edge as they are.
double measure_wrinkles(SheetGrid* grid, int count, const double* points);

#endif
