/// @file qp_delassus.h
/// The matrix W = G C^-1 G' that tells what velocity at each contact an impulse at another makes (Delassus 1917), of the
/// contacts that work: those that press or are violated on the way. Most contacts that may touch within a step never do.
/// W is the sum of a dense matrix for each body, over the rows of the contacts that touch it. Rows have slots:
///
///   contact working[0]   slots start[0] .. start[1] - 1      touches touch_start[0] .. touch_start[1] - 1
///   contact working[1]   slots start[1] .. start[2] - 1      ...
///   touch                the contact's rows are rows local, local + 1 .. of the body's matrix
#ifndef JN_SOLVE_QP_DELASSUS_H
#define JN_SOLVE_QP_DELASSUS_H

#include "solve/block_factor.h"

/// A working contact at a body.
typedef struct JnTouch {
	int contact; ///< number among the working ones
	int body, local;
	int next; ///< the next touch of the body, or -1
} JnTouch;

/// Contacts that touch the same bodies: what a contact does to others depends on their groups.
typedef struct JnDelassusGroup {
	int contact; ///< the first one
	int next;    ///< the next group whose least body is the same, or -1
} JnDelassusGroup;

typedef struct JnDelassusBody {
	int rows, first, first_new, last; ///< touches of all contacts, of those that have just arrived, and the last; or -1
	int group;                        ///< the last group whose least body this is, or -1
	double* w;                        ///< w[row + stride * column], both triangles
	double *lambda, *after;           ///< of its rows; after: what this body adds to it, W lambda
	size_t stride, w_capacity, lambda_capacity, after_capacity;
	JnHalf half; ///< of its rows, where the matrix knows them
} JnDelassusBody;

typedef struct JnDelassus {
	JnQp base;
	int working_count, slots;
	int *working, *start, *touch_start; ///< the last two: working_count + 1
	int *group_of, *met;                ///< one a working contact; work of jn_delassus_meet
	int* is_working;                    ///< one a contact of the problem
	double* mu;                         ///< one a working contact
	double *before, *lambda, *after;    ///< of the rows in slots; see JnQpRows
	double* diagonal;                   ///< of W, by slots
	JnDelassusBody* bodies;
	int body_count, body_capacity;
	JnTouch* touches;
	size_t touch_capacity;
	JnDelassusGroup* groups;
	int group_count;
	size_t group_capacity;
	JnBlockFactor factor;          ///< of the method
	JnNumbers slot_numbers, batch; ///< behind the arrays of slots; right-hand sides and solutions
	JnIndices slot_indices;
	JnNumbers column_values; ///< of the columns of a body
	JnIndices column_entries;
	JnNumbers numbers; ///< vectors of the method
	JnIndices marks;   ///< integers of the method
} JnDelassus;

/// No contact works; room for all.
JnStatus jn_delassus_begin(JnDelassus* d);

/// Let contacts work that press or are below their bound by more than `slack` at the lambda of the slots; *added counts
/// them. Until the first call lambda is that of the rows.
JnStatus jn_delassus_extend(JnDelassus* d, double slack, int* added);

/// Largest entry of the natural map over the working contacts, relative as that of jn_qp_rows_residual.
double jn_delassus_residual(const JnDelassus* d);

/// Bring the multipliers into their cones.
void jn_delassus_clip(JnDelassus* d);

/// Forget all bodies.
JnStatus jn_delassus_begin_matrix(JnDelassus* d);
/// Write W for the working contacts from `first` on, whose slots are assigned.
JnStatus jn_delassus_fill(JnDelassus* d, int first);
void jn_delassus_release_matrix(JnDelassus* d);

/// Tell the factor which groups touch the same body.
void jn_delassus_meet(JnDelassus* d);

/// after = before + W lambda, and the same for each body.
void jn_delassus_velocities(JnDelassus* d);

/// out = W x, by slots; the bodies' lambda and after are those of x.
void jn_delassus_multiply(JnDelassus* d, const double* x, double* out);

/// The block of W of a working contact with itself, block[column][row].
void jn_delassus_block(const JnDelassus* d, int contact, double block[3][3]);

/// Let the bodies' `after` follow a change of lambda, and sum them up for one contact.
void jn_delassus_push(JnDelassus* d, int contact, const double change[3]);
void jn_delassus_collect(JnDelassus* d, int contact);

/// Gauss-Seidel sweeps until the residual is small, or would take longer to become so, at the rate of the last ones, than
/// the factorisations that would do; at least `least` of them. *is_quick: it is small.
JnStatus jn_delassus_sweep(JnDelassus* d, double tolerance, int least, bool* is_quick);

/// Sweeps and Newton steps until the residual is small.
JnStatus jn_delassus_iterate(JnDelassus* d);

/// Newton steps on Coulomb's law until the residual is below `tolerance` or grows; lambda and `after` are then the best
/// met. *worked: the residual fell to a tenth.
JnStatus jn_delassus_newton(JnDelassus* d, double tolerance, bool* worked);

static inline int jn_delassus_row_count(const JnDelassus* d, int contact) {
	return d->start[contact + 1] - d->start[contact];
}

/// The touch after t of the same body; NULL after the last.
static inline const JnTouch* jn_touch_at(const JnDelassus* d, int touch) {
	return touch >= 0 ? &d->touches[touch] : NULL;
}

#endif
