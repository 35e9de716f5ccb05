/// @file rosenbrock_tableau.h
/// Rosenbrock methods as coefficients, and what can be computed from them.
#ifndef JN_INTEGRATE_ROSENBROCK_TABLEAU_H
#define JN_INTEGRATE_ROSENBROCK_TABLEAU_H

#include "integrate/tableau.h"

/// Coefficients in the transformed form of Hairer and Wanner II, IV.7, for y' = g(t, y) with the exact Jacobian J:
///     (1 / (gamma h) - J) u_i = g(t + alpha_i h, y + sum_j a_ij u_j) + sum_j c_ij / h u_j + gamma_i h dg/dt
///     y+ = y + sum_i m_i u_i,   j < i throughout
typedef struct JnRosenbrock {
	int stages;
	double gamma;                                                            ///< the diagonal, the same in every stage
	double a[JN_MAX_STAGES][JN_MAX_STAGES], c[JN_MAX_STAGES][JN_MAX_STAGES]; ///< strictly lower triangular
	double m[JN_MAX_STAGES];
	double alpha[JN_MAX_STAGES], gamma_sum[JN_MAX_STAGES]; ///< alpha_i and gamma_i: row sums of the slope form
	bool has_embedded;
	double m_embedded[JN_MAX_STAGES];
	int embedded_order;
} JnRosenbrock;

/// The same method in its slope form: k_i = h g(y + sum_(j < i) alpha_ij k_j) + h J sum_(j <= i) gamma_ij k_j,
/// y+ = y + sum b_i k_i.
typedef struct JnSlopeForm {
	double alpha[JN_MAX_STAGES][JN_MAX_STAGES], gamma[JN_MAX_STAGES][JN_MAX_STAGES];
	double b[JN_MAX_STAGES], b_embedded[JN_MAX_STAGES];
} JnSlopeForm;

JnSlopeForm jn_rosenbrock_slopes(const JnRosenbrock* method);

/// Order by the conditions with the exact Jacobian up to order 4; all else from R(z) of the slope form. The stage order
/// is 1 for every method; stiffly accurate: b is the last row of alpha + gamma, and alpha is 1 there.
JnTableauProperties jn_rosenbrock_properties(const JnRosenbrock* method);

extern const JnRosenbrock jn_rosenbrock_linearized_euler;    ///< 1 solve, order 1, L-stable
extern const JnRosenbrock jn_rosenbrock_linearized_midpoint; ///< 1 solve, order 2, no dissipation
extern const JnRosenbrock jn_rosenbrock_ros2;                ///< 2 solves, order 2 with any tangent, L-stable
extern const JnRosenbrock jn_rosenbrock_ros3p;               ///< 3 solves, order 3, A-stable
extern const JnRosenbrock jn_rosenbrock_ros3pl;              ///< 4 solves, order 3, L-stable, stiffly accurate
extern const JnRosenbrock jn_rosenbrock_ros3prl2;            ///< 4 solves, order 3, L-stable, stiffly accurate
extern const JnRosenbrock jn_rosenbrock_ros34pw2;            ///< 4 solves, order 3 with any tangent, L-stable
extern const JnRosenbrock jn_rosenbrock_ros34pw3;            ///< 4 solves, order 4, A-stable
extern const JnRosenbrock jn_rosenbrock_rodas3;              ///< 4 solves, order 3, L-stable, stiffly accurate
extern const JnRosenbrock jn_rosenbrock_rodas4;              ///< 6 solves, order 4, L-stable, stiffly accurate

#endif
