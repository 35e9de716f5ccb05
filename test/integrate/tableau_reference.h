/// @file tableau_reference.h
/// Properties of Runge-Kutta methods, computed apart from jounce in 50-digit arithmetic and printed with 8 digits.
/// One row a method: name, order, stage order, implicit solves, A-stable, L-stable, stiffly accurate, first stage
/// explicit, R(infinity), dispersion order and constant, dissipation order and constant (0, 0: none), order and
/// R(infinity) of the embedded weights (0, 0: none). The rows are the output, aligned, of
/// `jq -r -f rows.jq properties.json` where rows.jq is
///     {BE:"backward_euler", IMR:"implicit_midpoint", TRAP:"trapezoid", SDIRK2:"sdirk2", SDIRK3:"sdirk3",
///      TRBDF2:"tr_bdf2", TRBDF2B:"tr_bdf2_b", SDIRK_NCS23:"sdirk_ncs23", SDIRK_NC34:"sdirk_nc34",
///      SDIRK_3345:"sdirk_3345", SDIRK_4347:"sdirk_4347", ESDIRK324:"esdirk324", ESDIRK325:"esdirk325",
///      ESDIRK436:"esdirk436", EE:"explicit_euler", RK4:"rk4"} as $names |
///     .rk | to_entries[] | select($names[.key]) | .value as $m |
///     [$names[.key], $m.order, $m.stage_order, $m.nsol, $m.A, $m.L, $m.SA, $m.efs, $m.Rinf,
///      $m.q, $m.cq, $m.r // 0, $m.cr // 0, $m.eo // 0, $m.er // 0] |
///     map({"true": "1", "false": "0", "inf": "INFINITY"}[tostring] // tostring) | "ROW(" + join(", ") + ")"
#ifndef JN_TEST_TABLEAU_REFERENCE_H
#define JN_TEST_TABLEAU_REFERENCE_H

// clang-format off
#define IMPLICIT_REFERENCES(ROW)                                                                                 \
	ROW(backward_euler   , 1, 1, 1, 1, 1, 1, 0,         0.0, 2,    0.33333333, 1,           0.5, 0,           0) \
	ROW(implicit_midpoint, 2, 1, 1, 1, 0, 0, 0,        -1.0, 2,   0.083333333, 0,             0, 0,           0) \
	ROW(trapezoid        , 2, 2, 1, 1, 0, 1, 1,        -1.0, 2,   0.083333333, 0,             0, 0,           0) \
	ROW(sdirk2           , 2, 1, 2, 1, 1, 1, 0,         0.0, 2,   0.040440115, 3,  0.0036796564, 1,  0.33333333) \
	ROW(sdirk3           , 3, 1, 3, 1, 1, 1, 0,         0.0, 4,   0.015402883, 3,   0.025897085, 2, -0.95669953) \
	ROW(tr_bdf2          , 2, 2, 2, 1, 1, 1, 1,         0.0, 2,   0.040440115, 3,  0.0036796564, 3,    INFINITY) \
	ROW(tr_bdf2_b        , 2, 2, 2, 1, 1, 1, 1,         0.0, 2,   0.041666667, 3,  0.0034722222, 3,    INFINITY) \
	ROW(sdirk_ncs23      , 3, 1, 2, 1, 0, 0, 0, -0.73205081, 4,   0.098112522, 3,   0.089779189, 0,           0) \
	ROW(sdirk_nc34       , 4, 1, 3, 1, 0, 0, 0, -0.63041494, 4,    -0.1643929, 5,    0.44856194, 2,         0.0) \
	ROW(sdirk_3345       , 3, 1, 3, 1, 0, 0, 0, -0.63041494, 4,    -0.1643929, 5,    0.44856194, 2,         0.0) \
	ROW(sdirk_4347       , 3, 1, 4, 1, 0, 0, 0, -0.59615403, 4,  -0.075996714, 7,     2.3308463, 2,         0.0) \
	ROW(esdirk324        , 3, 2, 3, 1, 1, 1, 1,         0.0, 4,   0.015402883, 3,   0.025897085, 2,  0.21793326) \
	ROW(esdirk325        , 3, 2, 4, 1, 1, 1, 1,         0.0, 4,  0.0011857682, 3, 0.00054205729, 2,         0.0) \
	ROW(esdirk436        , 4, 2, 5, 1, 1, 1, 1,         0.0, 4, 0.00084635417, 5,  2.7126736e-5, 3,         0.0)

#define EXPLICIT_REFERENCES(ROW)                                                                                 \
	ROW(explicit_euler   , 1, 1, 0, 0, 0, 0, 1,    INFINITY, 2,    0.33333333, 1,          -0.5, 0,           0) \
	ROW(rk4              , 4, 1, 0, 0, 0, 0, 1,    INFINITY, 4,  0.0083333333, 5,  0.0069444444, 0,           0)
// clang-format on

#endif
