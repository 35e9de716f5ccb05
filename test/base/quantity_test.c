// Numbers with units. Expected values are compared bit for bit: a power of ten is one correctly rounded operation.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "base/key.h"
#include "base/quantity.h"

typedef struct Sample {
	const char *text, *unit;
	double expected;
} Sample;

static void check_samples(const Sample* samples, size_t count) {
	for (size_t i = 0; i < count; i++) {
		double value = NAN;
		const char* fault = jn_quantity_parse(samples[i].text, samples[i].unit, &value);
		if (fault != NULL || value != samples[i].expected) {
			fail_msg("'%s' as %s: value %.17g, expected %.17g, tolerance 0 (%s)", samples[i].text, samples[i].unit,
					 value, samples[i].expected, fault != NULL ? fault : "no fault");
		}
	}
}

#define CHECK(samples) check_samples((samples), sizeof(samples) / sizeof *(samples))

static void bare_numbers_are_in_the_wanted_unit(void** state) {
	(void)state;
	static const Sample samples[] = {
		{"5", "s", 5},      {"-2.5e3", "Pa", -2500}, {"1e5", "", 1e5},        {".5", NULL, 0.5},
		{"+3", "m", 3},     {"5.", "m", 5},          {"1/96", "m", 1.0 / 96}, {" 7 ", "kg", 7},
		{"-1/4", "", -.25}, {"1 / 8", "", 0.125},    {"9.81", "m/s^2", 9.81}, {"0", "rad", 0},
	};
	CHECK(samples);
}

static void prefixes_scale_by_exact_powers_of_ten(void** state) {
	(void)state;
	static const Sample samples[] = {
		{"33 ms", "s", 0.033},    {"33ms", "s", 0.033}, {"1 us", "s", 1e-6},       {"7 \u00b5s", "s", 7e-6},
		{"7 \u03bcs", "s", 7e-6}, {"3 ns", "s", 3e-9},  {"10 cm", "m", 0.1},       {"2 dm", "m", 0.2},
		{"4 km", "m", 4000},      {"5 MPa", "Pa", 5e6}, {"5 GPa", "Pa", 5e9},      {"1 TW", "W", 1e12},
		{"200 g", "kg", 0.2},     {"3 kg", "kg", 3},    {"3 mg", "kg", 3e-6},      {"2 kHz", "Hz", 2000},
		{"5 mrad", "rad", 0.005}, {"3 mJ", "J", 0.003}, {"1/96 m", "m", 1.0 / 96}, {"2 kN", "N", 2000},
	};
	CHECK(samples);
}

static void minutes_hours_and_degrees_convert(void** state) {
	(void)state;
	static const Sample samples[] = {
		{"2 min", "s", 120},
		{"1.5 h", "s", 5400},
		{"180 deg", "rad", 3.14159265358979323846},
	};
	CHECK(samples);
}

static void products_quotients_and_powers_convert(void** state) {
	(void)state;
	static const Sample samples[] = {
		{"-9.81 m/s^2", "m/s^2", -9.81},
		{"-9.81 m/s2", "m/s^2", -9.81},
		{"9.81 m s^-2", "m/s^2", 9.81},
		{"9.81 m*s-2", "m/s^2", 9.81},
		{"9.81 m.s-2", "m/s^2", 9.81},
		{"9.81 m\u00b7s-2", "m/s^2", 9.81},
		{"9.81 m/s/s", "m/s^2", 9.81},
		{"9.81 m/s\u00b2", "m/s^2", 9.81},
		{"9.81 N/kg", "m/s^2", 9.81},
		{"1 g/cm^3", "kg/m^3", 1000},
		{"1 g/cm\u00b3", "kg/m^3", 1000},
		{"4 cm^2", "m^2", 4e-4},
		{"3 N m", "J", 3},
		{"3 N*m", "N m", 3},
		{"5 1/s", "1/s", 5},
		{"5/s", "1/s", 5},
		{"5 s^-1", "1/s", 5},
		{"5 s-1", "Hz", 5},
		{"2 kN/mm", "N/m", 2e6},
		{"10 mPa s", "Pa s", 0.01},
		{"36 km/h", "m/s", 10},
	};
	CHECK(samples);
}

typedef struct Refusal {
	const char *text, *unit;
	JnQuantityFault fault;
} Refusal;

static void faults_are_told_apart(void** state) {
	(void)state;
	static const Refusal refusals[] = {
		{"", "s", JN_QUANTITY_NO_NUMBER},
		{"fast", "s", JN_QUANTITY_NO_NUMBER},
		{"1,5", "s", JN_QUANTITY_NO_NUMBER},
		{"--3", "", JN_QUANTITY_NO_NUMBER},
		{"1_000", "", JN_QUANTITY_NO_NUMBER},
		{"1 2", "", JN_QUANTITY_NO_NUMBER},
		{".", "", JN_QUANTITY_NO_NUMBER},
		{"1/.", "", JN_QUANTITY_NO_NUMBER},
		{"inf", "s", JN_QUANTITY_NOT_FINITE},
		{"-.inf", "s", JN_QUANTITY_NOT_FINITE},
		{"NaN", "s", JN_QUANTITY_NOT_FINITE},
		{".nan", "", JN_QUANTITY_NOT_FINITE},
		{"1e400", "", JN_QUANTITY_NOT_FINITE},
		{"1/0", "", JN_QUANTITY_NOT_FINITE},
		{"1e305 GPa", "Pa", JN_QUANTITY_NOT_FINITE},
		{"0x10", "", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 lb", "kg", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 kmin", "s", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 mdeg", "rad", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 kh", "s", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 kkg", "kg", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 m/", "m", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 m^", "m", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 m2s", "m", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 m^22", "m", JN_QUANTITY_UNKNOWN_UNIT},
		{"3 Ms x", "s", JN_QUANTITY_UNKNOWN_UNIT},
		{"33 kg", "s", JN_QUANTITY_WRONG_UNIT},
		{"3 m", "", JN_QUANTITY_WRONG_UNIT},
		{"3 deg", NULL, JN_QUANTITY_WRONG_UNIT},
		{"3 Hz", "rad/s", JN_QUANTITY_WRONG_UNIT},
	};
	for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
		double value;
		const char* unit_text;
		const JnQuantityFault fault = jn_quantity_read(refusals[i].text, refusals[i].unit, &value, &unit_text);
		if (fault != refusals[i].fault) {
			fail_msg("'%s': fault %d, expected %d", refusals[i].text, fault, refusals[i].fault);
		}
		assert_non_null(jn_quantity_parse(refusals[i].text, refusals[i].unit, &value));
	}
}

static void check_sentence(const char* text, const char* unit, const char* expected) {
	char sentence[300];
	jn_quantity_explain(text, unit, sizeof sentence, sentence);
	assert_string_equal(sentence, expected);
}

static void explanations_name_the_quantity_and_an_example(void** state) {
	(void)state;
	check_sentence("33 kg", "s", "'33 kg' has the unit kg, but a time is expected, such as 33 ms");
	check_sentence("3 lb", "kg", "'3 lb' has the unknown unit lb, but a mass is expected, such as 200 g");
	check_sentence("3 m", "", "'3 m' has the unit m, but a number without a unit is expected");
	check_sentence("inf", "m", "'inf' is no finite number, but a length is expected, such as 10 cm");
	check_sentence("1,5", "", "'1,5' is no number, but a number is expected; write a decimal point");
	check_sentence("3 s", "m^4", "'3 s' has the unit s, but a quantity in m^4 is expected");
}

// Every example in a message must be a value that the parser takes: anything else would mislead.
static void examples_in_messages_parse(void** state) {
	(void)state;
	static const char* const units[] = {"s",     "m",      "kg",     "N",   "Pa",  "J",       "W",
										"Hz",    "rad",    "1/s",    "m^2", "m^3", "m/s",     "m/s^2",
										"rad/s", "kg/m^2", "kg/m^3", "N/m", "N m", "N m/rad", "Pa s"};
	for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
		char sentence[200];
		double value;
		jn_quantity_expect(units[i], sizeof sentence, sentence);
		const char* example = strstr(sentence, "such as ");
		assert_non_null(example);
		assert_null(jn_quantity_parse(example + strlen("such as "), units[i], &value));
	}
}

static void a_comma_locale_changes_nothing(void** state) {
	(void)state;
	const char* const locales[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"};
	bool found = false;
	for (int i = 0; i < 3 && !found; i++) found = setlocale(LC_NUMERIC, locales[i]) != NULL;
	if (!found) skip(); // no such locale is installed
	double value = 0;
	const char* fault = jn_quantity_parse("2.5 m", "m", &value);
	setlocale(LC_NUMERIC, "C");
	assert_null(fault);
	assert_true(value == 2.5);
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(bare_numbers_are_in_the_wanted_unit),
		cmocka_unit_test(prefixes_scale_by_exact_powers_of_ten),
		cmocka_unit_test(minutes_hours_and_degrees_convert),
		cmocka_unit_test(products_quotients_and_powers_convert),
		cmocka_unit_test(faults_are_told_apart),
		cmocka_unit_test(explanations_name_the_quantity_and_an_example),
		cmocka_unit_test(examples_in_messages_parse),
		cmocka_unit_test(a_comma_locale_changes_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
