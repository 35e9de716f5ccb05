#include "support/units.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/// Powers of length and mass; seconds stay.
static const struct {
	const char* symbol;
	int length, mass;
} symbols[] = {{"kg", 0, 1}, {"Pa", -1, 1}, {"rad", 0, 0}, {"Hz", 0, 0}, {"m", 1, 0},
			   {"N", 1, 1},  {"J", 2, 1},   {"s", 0, 0},   {"1", 0, 0}};

double unit_factor(const char* unit, double length, double mass) {
	double factor = 1;
	int side = 1;
	while (*unit != '\0') {
		size_t i = 0;
		const size_t count = sizeof symbols / sizeof *symbols;
		while (i < count && strncmp(unit, symbols[i].symbol, strlen(symbols[i].symbol)) != 0) ++i;
		if (i == count) fail_msg("the unit %s is not known here", unit);
		unit += strlen(symbols[i].symbol);
		const int power = *unit == '^' ? (int)strtol(unit + 1, (char**)&unit, 10) : 1;
		factor *= pow(length, side * power * symbols[i].length) * pow(mass, side * power * symbols[i].mass);
		if (*unit == '/') side = -1;
		if (*unit == '/' || *unit == ' ') ++unit;
	}
	return factor;
}

void scale_units(const JnKey* keys, double length, double mass, void* options) {
	for (; keys != NULL && keys->name != NULL; ++keys) {
		const int count = keys->kind == JN_REAL ? 1 : keys->kind == JN_REAL2 ? 2 : keys->kind == JN_REAL3 ? 3 : 0;
		double* number = (double*)((char*)options + keys->field);
		for (int i = 0; i < count && keys->unit != NULL; ++i) number[i] *= unit_factor(keys->unit, length, mass);
	}
}
