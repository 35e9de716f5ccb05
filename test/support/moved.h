/// @file moved.h
/// A scene that is another one seen from elsewhere: turned, mirrored, shifted, in other units, its mesh renumbered. What
/// it does must be what the other does, moved alike.
#ifndef JN_TEST_SUPPORT_MOVED_H
#define JN_TEST_SUPPORT_MOVED_H

#include "base/arena.h"
#include "jounce/scene.h"

/// x becomes length turn x + shift.
typedef struct Move {
	const char* name;
	double turn[3][3];   ///< orthogonal
	bool mirrors;        ///< the determinant of turn is -1
	double shift[3];     ///< [m], in the copy's units
	double length, mass; ///< units of the original in those of the copy: 1000 where the copy has mm, or g
	uint64_t shuffle;    ///< seed of a new order of each body's nodes and cells; 0: the old one
	bool renumbers;      ///< the nodes of each cell begin elsewhere, cells keep their orientation
} Move;

/// What became of a scene.
typedef struct Moved {
	int* order; ///< node `k` of the original is node order[k] of the copy
	int nodes;
} Moved;

/// Can `move` be applied to what the scene holds? Else *why says what stands against it.
bool can_move(const JnSceneDef* def, const Move* move, const char** why);

/// Change the definitions, which then need the arena. The order of nodes is known once the model is built.
void move_scene(JnSceneDef* def, const Move* move, JnArena* arena, Moved* moved);

/// Where a point of the original is in the copy.
void move_point(const Move* move, const double x[3], double out[3]);

#endif
