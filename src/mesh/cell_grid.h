/// @file cell_grid.h
/// Which cells of a mesh may hold a point: a grid of buckets over their boxes.
#ifndef JN_MESH_CELL_GRID_H
#define JN_MESH_CELL_GRID_H

#include "mesh/mesh.h"

/// Buckets of edge `width`, numbered along x first: bucket b has the cells list[starts[b]] up to starts[b + 1].
typedef struct JnCellGrid {
	double low[3]; ///< corner of the first bucket [m]
	double width;  ///< [m]
	int counts[3]; ///< buckets along each axis
	int* starts;   ///< one more than buckets
	int* list;     ///< cell numbers, ascending within a bucket
} JnCellGrid;

/// Lowest and highest coordinates of a cell's nodes [m].
void jn_cell_box(const JnMesh* mesh, int cell, double low[3], double high[3]);

/// Is a point in a cell's box, or hardly outside of it?
bool jn_cell_grid_is_near(const JnCellGrid* grid, const JnMesh* mesh, int cell, const double point[3]);

/// Sort the cells of a mesh into buckets about as large as a cell; memory comes from the arena.
JnStatus jn_cell_grid_create(const JnMesh* mesh, JnArena* arena, JnCellGrid* grid);

/// The cells whose boxes come near a point, in ascending order: *cells is inside the grid. Every cell that holds the
/// point is among them. Returns how many; 0 outside the grid.
int jn_cell_grid_at(const JnCellGrid* grid, const double point[3], const int** cells);

#endif
