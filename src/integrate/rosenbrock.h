/// @file rosenbrock.h
/// Rosenbrock methods: a fixed number of linear solves with one matrix a step, no iteration. Their coefficients stand in
/// rosenbrock_tableau.c.
#ifndef JN_INTEGRATE_ROSENBROCK_H
#define JN_INTEGRATE_ROSENBROCK_H

#include "jounce/extend.h"

extern const JnIntegratorType jn_linearized_euler, jn_linearized_midpoint, jn_ros2, jn_ros3p, jn_ros3pl, jn_ros3prl2,
	jn_ros34pw2, jn_ros34pw3, jn_rodas3, jn_rodas4;

#endif
