/// @file units.h
/// Numbers of a key table in other units of length and mass.
#ifndef JN_TEST_SUPPORT_UNITS_H
#define JN_TEST_SUPPORT_UNITS_H

#include "jounce/extend.h"

/// How a number with a unit such as "kg/m^3" or "N m" grows when a metre counts `length` and a kilogram `mass`.
double unit_factor(const char* unit, double length, double mass);

/// Multiply all numbers that `keys` describe in `options`. The test fails at nested tables that hold units.
void scale_units(const JnKey* keys, double length, double mass, void* options);

#endif
