// Numbers with units: number [/ number] [unit], where unit is a product of SI symbols with prefixes and powers, such as
// "9.81 m/s^2", "33ms", "1/96 m", "5 1/s", "3 N m". A slash divides by the one symbol behind it.
// Powers of ten are counted and applied at the end by one exact division or product, so 33 ms is the double 0.033.
#include "base/quantity.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/key.h"

enum { LENGTH, MASS, TIME, ANGLE, DIMENSION_COUNT };
enum { NUMBER_LIMIT = 100, UNIT_LIMIT = 64 }; // characters

// A unit is factor * 10^ten * m^.. kg^.. s^.. rad^..; the angle counts, so that 1 Hz is never taken for 1 rad/s.
typedef struct Unit {
	const char* symbol;
	int power[DIMENSION_COUNT];
	double factor;
	int ten;
	bool takes_prefix;
} Unit;

static const Unit units[] = {
	{"m", {1, 0, 0, 0}, 1, 0, true},     {"s", {0, 0, 1, 0}, 1, 0, true},
	{"g", {0, 1, 0, 0}, 1, -3, true},    {"N", {1, 1, -2, 0}, 1, 0, true},
	{"Pa", {-1, 1, -2, 0}, 1, 0, true},  {"J", {2, 1, -2, 0}, 1, 0, true},
	{"W", {2, 1, -3, 0}, 1, 0, true},    {"Hz", {0, 0, -1, 0}, 1, 0, true},
	{"rad", {0, 0, 0, 1}, 1, 0, true},   {"deg", {0, 0, 0, 1}, 3.14159265358979323846 / 180, 0, false},
	{"min", {0, 0, 1, 0}, 60, 0, false}, {"h", {0, 0, 1, 0}, 3600, 0, false},
};

typedef struct Prefix {
	const char* symbol;
	int ten;
} Prefix;

static const Prefix prefixes[] = {
	{"n", -9}, {"u", -6}, {"\u00b5", -6}, {"\u03bc", -6}, {"m", -3}, {"c", -2},
	{"d", -1}, {"k", 3},  {"M", 6},       {"G", 9},       {"T", 12},
};

// What users call the quantities, for messages.
typedef struct Noun {
	const char *unit, *noun, *example;
} Noun;

static const Noun nouns[] = {
	{"s", "a time", "33 ms"},
	{"m", "a length", "10 cm"},
	{"kg", "a mass", "200 g"},
	{"N", "a force", "5 N"},
	{"Pa", "a pressure or modulus", "100 kPa"},
	{"J", "an energy", "2 J"},
	{"W", "a power", "5 W"},
	{"Hz", "a frequency", "50 Hz"},
	{"rad", "an angle", "30 deg"},
	{"1/s", "a rate", "5 1/s"},
	{"m^2", "an area", "4 cm^2"},
	{"m^3", "a volume", "2 cm^3"},
	{"m/s", "a speed", "2 m/s"},
	{"m/s^2", "an acceleration", "9.81 m/s^2"},
	{"rad/s", "an angular speed", "2 rad/s"},
	{"kg/m^2", "a mass per area", "0.2 kg/m^2"},
	{"kg/m^3", "a density", "1000 kg/m^3"},
	{"N/m", "a stiffness", "100 N/m"},
	{"J/m^2", "an energy per area", "100 J/m^2"},
	{"N m", "a torque", "2 N m"},
	{"N m/rad", "a torsional stiffness", "2 N m/rad"},
	{"Pa s", "a viscosity", "10 Pa s"},
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

static const char* skip_spaces(const char* cursor) {
	return cursor + strspn(cursor, " \t");
}

static bool starts_with(const char* text, const char* start) {
	return strncmp(text, start, strlen(start)) == 0;
}

static bool is_digit(char c) {
	return c >= '0' && c <= '9';
}

// Behind a decimal number (sign, digits, point, exponent), or NULL. Hexadecimals and words are none.
static const char* number_end(const char* cursor) {
	cursor += *cursor == '+' || *cursor == '-';
	const size_t whole = strspn(cursor, "0123456789");
	cursor += whole;
	size_t fraction = 0;
	if (*cursor == '.' && (whole > 0 || is_digit(cursor[1]))) {
		fraction = strspn(cursor + 1, "0123456789");
		cursor += 1 + fraction;
	}
	if (whole + fraction == 0) return NULL;
	if (*cursor != 'e' && *cursor != 'E') return cursor;
	const char* exponent = cursor + 1 + (cursor[1] == '+' || cursor[1] == '-');
	return is_digit(*exponent) ? exponent + strspn(exponent, "0123456789") : cursor;
}

// strtod expects the decimal point of the locale; files always have ".".
static const char* read_decimal(const char* text, double* value) {
	const char* end = number_end(text);
	if (end == NULL || end - text > NUMBER_LIMIT) return NULL;
	char copy[NUMBER_LIMIT + 16] = {0};
	const char* local = localeconv()->decimal_point;
	for (const char* c = text; c < end; c++) {
		if (*c == '.')
			strncat(copy, local, 8);
		else
			strncat(copy, c, 1);
	}
	*value = strtod(copy, NULL);
	return end;
}

static bool is_word_for_infinite(const char* text) {
	text += *text == '+' || *text == '-';
	text += *text == '.';
	return strncasecmp(text, "inf", 3) == 0 || strncasecmp(text, "nan", 3) == 0;
}

static JnQuantityFault read_number(const char** cursor, double* value) {
	if (is_word_for_infinite(*cursor)) return JN_QUANTITY_NOT_FINITE;
	const char* end = read_decimal(*cursor, value);
	if (end == NULL) return JN_QUANTITY_NO_NUMBER;
	const char* slash = skip_spaces(end);
	const char* below = *slash == '/' ? skip_spaces(slash + 1) : slash;
	if (*slash == '/' && (is_digit(*below) || *below == '.')) {
		double divisor = 0;
		end = read_decimal(below, &divisor);
		if (end == NULL) return JN_QUANTITY_NO_NUMBER;
		*value /= divisor;
	}
	*cursor = end;
	return isfinite(*value) ? JN_QUANTITY_FINE : JN_QUANTITY_NOT_FINITE;
}

static const Unit* find_unit(const char* symbol, size_t length) {
	for (size_t i = 0; i < COUNT(units); i++) {
		if (strlen(units[i].symbol) == length && strncmp(units[i].symbol, symbol, length) == 0) return &units[i];
	}
	return NULL;
}

static size_t symbol_length(const char* text) {
	size_t length = starts_with(text, "\u00b5") || starts_with(text, "\u03bc") ? 2 : 0;
	while ((text[length] >= 'a' && text[length] <= 'z') || (text[length] >= 'A' && text[length] <= 'Z')) length++;
	return length;
}

static const char* read_symbol(const char* text, Unit* unit) {
	const size_t length = symbol_length(text);
	const Unit* plain = find_unit(text, length);
	if (plain != NULL) *unit = *plain;
	for (size_t i = 0; plain == NULL && i < COUNT(prefixes); i++) {
		const size_t head = strlen(prefixes[i].symbol);
		if (head >= length || !starts_with(text, prefixes[i].symbol)) continue;
		plain = find_unit(text + head, length - head);
		if (plain == NULL || !plain->takes_prefix) return NULL;
		*unit = *plain;
		unit->ten += prefixes[i].ten;
	}
	return plain != NULL ? text + length : NULL;
}

// "^2", "2", "-1", "^-1" or a superscript; 1 when there is none.
static const char* read_power(const char* text, int* power) {
	*power = 1;
	if (starts_with(text, "\u00b2") || starts_with(text, "\u00b3")) {
		*power = starts_with(text, "\u00b2") ? 2 : 3;
		return text + 2;
	}
	const char* digit = text + (*text == '^');
	const int sign = *digit == '-' ? -1 : 1;
	digit += *digit == '-' || *digit == '+';
	if (!is_digit(*digit)) return digit == text ? text : NULL;
	if (is_digit(digit[1])) return NULL;
	*power = sign * (*digit - '0');
	return digit + 1;
}

static void multiply(Unit* product, const Unit* unit, int power) {
	for (int i = 0; i < DIMENSION_COUNT; i++) product->power[i] += power * unit->power[i];
	product->ten += power * unit->ten;
	for (int i = 0; i < abs(power); i++)
		product->factor = power > 0 ? product->factor * unit->factor : product->factor / unit->factor;
}

// One symbol with its power, or the "1" of "1/s".
static const char* read_factor(const char* text, int sign, Unit* product) {
	if (*text == '1' && !is_digit(text[1])) return text + 1;
	Unit unit;
	int power;
	const char* end = read_symbol(text, &unit);
	if (end != NULL) end = read_power(end, &power);
	if (end != NULL) multiply(product, &unit, sign * power);
	return end;
}

static bool read_unit(const char* text, Unit* product) {
	*product = (Unit){.factor = 1};
	if (strlen(text) > UNIT_LIMIT) return false;
	const char* cursor = skip_spaces(text);
	int sign = *cursor == '/' ? -1 : 1;
	cursor += *cursor == '/';
	while (cursor != NULL) {
		cursor = read_factor(skip_spaces(cursor), sign, product);
		if (cursor == NULL) return false;
		const char* next = skip_spaces(cursor);
		if (*next == '\0') return true;
		sign = *next == '/' ? -1 : 1;
		if (*next == '/' || *next == '*' || *next == '.')
			cursor = next + 1;
		else if (starts_with(next, "\u00b7"))
			cursor = next + 2;
		else if (next == cursor)
			return false;
	}
	return false;
}

static double scale_by_ten(double value, int ten) {
	double scale = 1;
	for (int i = 0; i < abs(ten); i++) scale *= 10;
	return ten < 0 ? value / scale : value * scale;
}

JnQuantityFault jn_quantity_read(const char* text, const char* unit, double* value, const char** unit_text) {
	const char* cursor = skip_spaces(text);
	double number = 0;
	const JnQuantityFault fault = read_number(&cursor, &number);
	*unit_text = skip_spaces(cursor);
	if (fault != JN_QUANTITY_FINE) return fault;
	*value = number;
	if (**unit_text == '\0') return JN_QUANTITY_FINE;
	const bool begins_well = symbol_length(*unit_text) > 0 || **unit_text == '/' || starts_with(*unit_text, "1/");
	if (!begins_well) return JN_QUANTITY_NO_NUMBER;
	Unit given, wanted = {.factor = 1};
	if (!read_unit(*unit_text, &given)) return JN_QUANTITY_UNKNOWN_UNIT;
	if (unit == NULL || unit[0] == '\0') return JN_QUANTITY_WRONG_UNIT;
	if (!read_unit(unit, &wanted)) return JN_QUANTITY_WRONG_UNIT;
	if (memcmp(given.power, wanted.power, sizeof given.power) != 0) return JN_QUANTITY_WRONG_UNIT;
	*value = scale_by_ten(number * (given.factor / wanted.factor), given.ten - wanted.ten);
	return isfinite(*value) ? JN_QUANTITY_FINE : JN_QUANTITY_NOT_FINITE;
}

const char* jn_quantity_parse(const char* text, const char* unit, double* value) {
	static const char* const faults[] = {[JN_QUANTITY_FINE] = NULL,
										 [JN_QUANTITY_NO_NUMBER] = "is no number",
										 [JN_QUANTITY_NOT_FINITE] = "is no finite number",
										 [JN_QUANTITY_UNKNOWN_UNIT] = "has an unknown unit",
										 [JN_QUANTITY_WRONG_UNIT] = "has the wrong unit"};
	const char* unit_text;
	return faults[jn_quantity_read(text, unit, value, &unit_text)];
}

void jn_quantity_expect(const char* unit, size_t size, char* sentence) {
	if (unit == NULL || unit[0] == '\0') {
		snprintf(sentence, size, "a number is expected");
		return;
	}
	for (size_t i = 0; i < COUNT(nouns); i++) {
		if (strcmp(nouns[i].unit, unit) != 0) continue;
		snprintf(sentence, size, "%s is expected, such as %s", nouns[i].noun, nouns[i].example);
		return;
	}
	snprintf(sentence, size, "a quantity in %s is expected", unit);
}

void jn_quantity_explain(const char* text, const char* unit, size_t size, char* sentence) {
	double value;
	const char* unit_text;
	char expected[160];
	const bool is_pure = unit == NULL || unit[0] == '\0';
	const JnQuantityFault fault = jn_quantity_read(text, unit, &value, &unit_text);
	jn_quantity_expect(unit, sizeof expected, expected);
	if (fault == JN_QUANTITY_NOT_FINITE) {
		snprintf(sentence, size, "'%s' is no finite number, but %s", text, expected);
	} else if (fault == JN_QUANTITY_NO_NUMBER) {
		const char* hint = is_digit(text[0]) && strchr(text, ',') != NULL ? "; write a decimal point" : "";
		snprintf(sentence, size, "'%s' is no number, but %s%s", text, expected, hint);
	} else if (fault == JN_QUANTITY_UNKNOWN_UNIT) {
		snprintf(sentence, size, "'%s' has the unknown unit %s, but %s", text, unit_text, expected);
	} else {
		snprintf(sentence, size, "'%s' has the unit %s, but %s", text, unit_text,
				 is_pure ? "a number without a unit is expected" : expected);
	}
}
