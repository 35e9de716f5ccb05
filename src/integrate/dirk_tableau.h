/// @file dirk_tableau.h
/// Diagonally implicit Runge-Kutta methods as coefficients. Sources and closed forms stand beside the numbers.
#ifndef JN_INTEGRATE_DIRK_TABLEAU_H
#define JN_INTEGRATE_DIRK_TABLEAU_H

#include "integrate/tableau.h"

extern const JnTableau jn_tableau_backward_euler;    ///< 1 solve, order 1, L-stable
extern const JnTableau jn_tableau_implicit_midpoint; ///< 1 solve, order 2, no dissipation
extern const JnTableau jn_tableau_trapezoid;         ///< 1 solve, order 2, no dissipation; Newmark(1/4, 1/2)
extern const JnTableau jn_tableau_sdirk2;            ///< 2 solves, order 2, L-stable
extern const JnTableau jn_tableau_sdirk3;            ///< 3 solves, order 3, L-stable
extern const JnTableau jn_tableau_tr_bdf2;           ///< 2 solves, order 2, L-stable, stage order 2; one diagonal
extern const JnTableau jn_tableau_tr_bdf2_b;         ///< 2 solves, order 2, L-stable, stage order 2; two diagonals
extern const JnTableau jn_tableau_sdirk_ncs23;       ///< 2 solves, order 3, A-stable
extern const JnTableau jn_tableau_sdirk_nc34;        ///< 3 solves, order 4, A-stable
extern const JnTableau jn_tableau_sdirk_3345;        ///< 3 solves, order 3, dispersion 4, dissipation 5
extern const JnTableau jn_tableau_sdirk_4347;        ///< 4 solves, order 3, dispersion 4, dissipation 7
extern const JnTableau jn_tableau_esdirk324;         ///< 3 solves, order 3, L-stable, stage order 2
extern const JnTableau jn_tableau_esdirk325;         ///< 4 solves, order 3, L-stable, stage order 2
extern const JnTableau jn_tableau_esdirk436;         ///< 5 solves, order 4, L-stable, stage order 2

#endif
