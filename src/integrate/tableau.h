/// @file tableau.h
/// Butcher tableaus and what can be computed from them.
#ifndef JN_INTEGRATE_TABLEAU_H
#define JN_INTEGRATE_TABLEAU_H

#include <stdbool.h>

enum { JN_MAX_STAGES = 8 };

/// Coefficients of a Runge-Kutta method whose A is lower triangular. c is the row sum of A.
typedef struct JnTableau {
	int stages;
	double a[JN_MAX_STAGES][JN_MAX_STAGES];
	double b[JN_MAX_STAGES], c[JN_MAX_STAGES];
	bool has_embedded;
	double b_embedded[JN_MAX_STAGES];
	bool has_start_estimate; ///< error = dt (error_start f_n + sum error_stage_i f_i) instead of b - b_embedded
	double error_start, error_stage[JN_MAX_STAGES];
	int embedded_order;
} JnTableau;

/// Properties recomputed from the coefficients.
typedef struct JnTableauProperties {
	int order, stage_order; ///< by the rooted-tree conditions up to order 5, to 1e-13; C(q), at most the order
	int stages;
	int implicit_solves; ///< stages with a_ii != 0
	bool a_stable, l_stable, stiffly_accurate, first_explicit;
	double r_infinity;    ///< lim R(z); INFINITY when deg P > deg Q, as for explicit methods
	int dispersion_order; ///< q: nu - arg R(i nu) = constant nu^(q+1) + ...
	double dispersion;
	int dissipation_order; ///< r: 1 - |R(i nu)| = constant nu^(r+1) + ...; 0: none
	double dissipation;
	int error_order;       ///< the embedded estimate falls like dt^error_order; 0: there is none
	double order_residual; ///< largest violation of a condition up to `order`, relative to its terms if above 1
} JnTableauProperties;

JnTableauProperties jn_tableau_properties(const JnTableau* tableau);

/// Coefficients of R(z) = P(z) / Q(z) = sum p[k] z^k / sum q[k] z^k, k = 0 .. stages, and zeros above.
/// Coefficients of P that are mere rounding of their terms are exact zeros.
void jn_tableau_stability(const JnTableau* tableau, double p[JN_MAX_STAGES + 1], double q[JN_MAX_STAGES + 1]);

#endif
