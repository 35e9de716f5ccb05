/// @file contact_problem.h
/// The contact problem of one step: the velocities v nearest to the predicted ones that no contact forbids.
///
///   minimise 1/2 (v - vp)' C (v - vp)   with   n . u_i >= g_i   at every contact i,   u_i = sum_k weight_k v_node_k
///
/// (the corrector of Higher-Order Time Integration for Deformable Solids, equation 20), and Coulomb's law of friction on
/// the multipliers, with w = u - bound: |lambda_t| <= mu lambda_n, and where w_t is not zero
/// lambda_t = -mu lambda_n w_t / |w_t|. With friction it is no minimisation but the complementarity problem
/// C (v - vp) = G' lambda with those laws: sliding makes no normal velocity. Solvers are in qp.h.
#ifndef JN_SOLVE_CONTACT_PROBLEM_H
#define JN_SOLVE_CONTACT_PROBLEM_H

#include "math/pattern.h"
#include "solve/half.h"

/// The matrix C by its verbs: symmetric, positive definite on the entries that are not held, block diagonal over bodies.
/// All vectors have 3 * nodes entries. apply, solve and diagonal are required.
typedef struct JnContactMatrix {
	void* user; ///< handed to every verb
	/// out = C x; x is 0 in held entries, out is not read there.
	void (*apply)(void* user, const double* x, double* out);
	/// out = C^-1 rhs on the free entries, 0 on held ones; out and rhs do not overlap.
	JnStatus (*solve)(void* user, const double* rhs, double* out);
	/// The same for `count` vectors, one behind the other. NULL: solve is called for each, which takes up to 4 times as long.
	JnStatus (*solve_many)(void* user, int count, const double* rhs, double* out);
	void (*diagonal)(void* user, double* out); ///< out = the diagonal of C, positive; not read in held entries
	const JnPattern* pattern;                  ///< of the blocks below; NULL: only the verbs are known
	const double* blocks; ///< C itself, 9 a block of the pattern, as jn_blocks_apply reads them; NULL: not known
	/// Append to `out` the halves of sparse right-hand sides of one body, whose dot products are those of C^-1: the verb of
	/// JnSolverType. Entries count from the first node of the body. NULL: `solve_many` is used, which takes much longer.
	JnStatus (*half)(void* user, int body, const JnColumns* columns, JnHalf* out);
} JnContactMatrix;

/// All that a solver reads. Nothing is kept after the call.
typedef struct JnContactProblem {
	int nodes;
	JnContactMatrix matrix;
	const bool* held;      ///< 3 * nodes: entries whose velocity is given, by vp; NULL: none
	const double* vp;      ///< predicted velocities, 3 * nodes [m/s]
	int body_count;        ///< 0: all nodes are one body
	const int* first_node; ///< body_count + 1: nodes of body b are first_node[b] .. first_node[b + 1] - 1

	int count;                ///< contacts
	const int* start;         ///< count + 1, into node and weight
	const int* node;          ///< nodes of a contact, in any number of bodies, each once
	const double* weight;     ///< their weights in the relative velocity: 1 for a vertex, -w_k for the point it touches
	const double (*frame)[9]; ///< orthonormal rows n, t1, t2; the tangents are not read where friction is 0
	/// Least normal relative velocity g, then the tangential ones at which the contact sticks; the law holds for
	/// w = u - bound. Tangents are 0 for friction in velocities; others state it for displacements over a step, or carry a
	/// belt. They are not read where friction is 0. [m/s]
	const double (*bound)[3];
	const double* friction; ///< mu >= 0; NULL: 0 everywhere
} JnContactProblem;

/// How well v and lambda solve a problem: all relative, so that 1e-6 means six digits. The scales are, with E_i =
/// 1 / max |entries of the normal row i|: velocity, the largest |E_i u_i| at vp and at v and |E_i bound_i|, at least 1e-8 of
/// the nodes' own; impulse, the
/// largest |lambda_i / E_i|. P is 1 / diag(C). Tangential components count where mu > 0 alone.
typedef struct JnContactResidual {
	double
		stationarity; ///< |P^1/2 (C (v - vp) - G' lambda)| over max(|P^1/2 G' lambda|, 1e-6 |P^-1/2 v|), free entries, largest
	double primal;          ///< largest violation of n . u >= g, in velocity scales
	double dual;            ///< largest violation of lambda_n >= 0 and of |lambda_t| <= mu lambda_n, in impulse scales
	double complementarity; ///< largest |min(lambda_n, w_n)|, each in its scale
	double friction;        ///< largest |lambda_t - nearest point to lambda_t - w_t in the disk of radius mu lambda_n|
	double velocity_scale;  ///< [m/s]
	double impulse_scale;   ///< [N s]
} JnContactResidual;

/// Measure a solution by the verbs of the problem alone. `v` has 3 * nodes entries; `lambda` has 3 a contact in its frame
/// (normal, tangents) [N s]; `work` has 3 * 3 * nodes. NAN anywhere gives NAN.
void jn_contact_residual(const JnContactProblem* problem, const double* v, const double* lambda, double* work,
						 JnContactResidual* out);

/// The largest of the five numbers; NAN if one is.
double jn_contact_residual_max(const JnContactResidual* residual);

/// Scale of a contact's rows: 1 / max |weight_k n_axis| (HO section 4.1), one for its three rows so that the friction cone
/// stays round; 0 when all weights are 0.
double jn_contact_row_scale(const JnContactProblem* problem, int contact);

/// u[3] = relative velocity of a contact in its frame: normal, tangents [m/s].
void jn_contact_velocity(const JnContactProblem* problem, int contact, const double* v, double u[3]);

/// A relative velocity that cannot be told from the rounding of a contact's nodes: 1e-8 of the largest entry of v there, so
/// that rounding stays 1e-8 of the velocity scale [m/s].
double jn_contact_least_velocity(const JnContactProblem* problem, int contact, const double* v);

/// bound[3] of a contact as its rows see it: tangents are 0 where friction is 0 [m/s].
void jn_contact_bound(const JnContactProblem* problem, int contact, double bound[3]);

/// f += G_i' lambda, the impulses on the nodes of a contact whose multiplier is lambda[3], in its frame.
void jn_contact_add_impulse(const JnContactProblem* problem, int contact, const double lambda[3], double* f);

#endif
