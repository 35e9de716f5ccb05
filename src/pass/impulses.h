/// @file impulses.h
/// Impulses between points that nodes carry along, by projected Gauss-Seidel on the lumped masses of the nodes. What acts
/// between two points is a block of three rows, in its frame d0, d1, d2:
///
///   contact   row 0 pushes: lambda_0 >= 0;        rows 1 and 2 rub: |(lambda_1, lambda_2)| <= mu lambda_0
///   site      rows 1 and 2 hold, with any force;  row 0 rubs: |lambda_0| <= mu |(lambda_1, lambda_2)| + hold
///
/// The same blocks are solved at two levels: positions, with multipliers mu of y = x in kg m, and velocities, with impulses of
/// y = v in N s. A row wants d . (sum of weight * y of its nodes) = target; the multipliers' effect is y += M^-1 J^T lambda.
#ifndef JN_PASS_IMPULSES_H
#define JN_PASS_IMPULSES_H

#include "base/arena.h"
#include "jounce/extend.h"

typedef enum JnBlockKind { JN_BLOCK_CONTACT, JN_BLOCK_SITE } JnBlockKind;
typedef enum JnLevel { JN_LEVEL_POSITION, JN_LEVEL_VELOCITY, JN_LEVELS } JnLevel;

/// A node of a block, and the weight of its motion in row 0 and in rows 1 and 2.
typedef struct JnBlockEntry {
	int node;
	double weight[2];
} JnBlockEntry;

typedef struct JnBlock {
	uint64_t id; ///< the same from step to step: blocks are sorted by it
	JnBlockKind kind;
	bool is_active;         ///< takes part at the level of velocities
	int first, count;       ///< of its entries
	double frame[3][3];     ///< unit vectors d0, d1, d2
	double friction;        ///< mu
	double hold[JN_LEVELS]; ///< what friction of a site holds without lateral force
	double target[JN_LEVELS][3];
	double touch; ///< of a contact: motion of row 0 at which two touch, where the target may be less [m]
	double impulse[JN_LEVELS][3]; ///< lambda
	double inverse[3];            ///< 1 / (J M^-1 J^T) of each row; 0: nothing moves
	double couple[3]; ///< motion of row 0 along each axis for an impulse of the other rows along it, and the other way
} JnBlock;

/// Blocks of one attempt. All zero is empty; jn_impulses_release frees what has grown.
typedef struct JnImpulses {
	int count, entry_count;
	JnBlock* blocks;
	JnBlockEntry* entries;
	size_t capacity, entry_capacity;
	double dt; ///< of the step that they belong to [s]
} JnImpulses;

void jn_impulses_release(JnImpulses* set);

/// Room for so many, so that steps need not grow.
JnStatus jn_impulses_reserve(JnImpulses* set, int blocks, int entries);

/// Append a block of `count` entries, for the caller to fill: all zero but `id`, `kind`, `first` and `count`. The pointer
/// holds until the next is appended.
JnStatus jn_impulses_add(JnImpulses* set, uint64_t id, JnBlockKind kind, int count, JnBlock** out);

/// Write or read blocks whose entries are of nodes below `nodes`.
void jn_impulses_archive(JnImpulses* set, JnArchive* archive, int nodes);

/// Two unit vectors that make a right-handed frame with frame[0].
void jn_block_complete_frame(double frame[3][3]);

/// out[row] = relative motion of its points along the frame, of a vector of three entries a node.
void jn_block_motion(const JnImpulses* set, const JnBlock* block, const double* y, double out[3]);

/// y += scale M^-1 J^T lambda, or J^T lambda where inverse_mass (one an entry of y) is NULL.
void jn_block_push(const JnImpulses* set, const JnBlock* block, const double lambda[3], double scale,
				   const double* inverse_mass, double* y);

/// Sort by id, and compute block->inverse.
void jn_impulses_finish(JnImpulses* set, const double* inverse_mass);

/// Begin with the impulses of the same blocks in `old`, scaled to the step dt, but no more than ten times as large.
void jn_impulses_warm(JnImpulses* set, const JnImpulses* old);

/// Add the multipliers of the same blocks in `old`, whose effect is in y already, and begin with their impulses.
void jn_impulses_join(JnImpulses* set, const JnImpulses* old);

/// Sweep until a sweep moves no row by more than `tolerance` times the largest motion that an impulse makes, or `most` times.
/// At the level of velocities only active blocks take part. y begins with the prediction; returns the number of sweeps.
int jn_impulses_solve(JnImpulses* set, JnLevel level, const double* inverse_mass, int most, double tolerance,
					  double* y);

#endif
