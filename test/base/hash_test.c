// Fingerprints: the published values of FNV-1a with 128 bits.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/hash.h"

static void expect_hash(const char* bytes, const char* expected) {
	char text[33];
	jn_hash_text(jn_hash_add(jn_hash_start(), bytes, strlen(bytes)), text);
	assert_string_equal(text, expected);
}

static void values_are_those_of_the_authors(void** unused) {
	(void)unused;
	expect_hash("", "6c62272e07bb014262b821756295c58d");
	expect_hash("a", "d228cb696f1a8caf78912b704e4a8964");
	expect_hash("foobar", "343e1662793c64bf6f0d3597ba446f18");
}

static void pieces_give_the_hash_of_the_whole(void** unused) {
	(void)unused;
	const JnHash whole = jn_hash_add(jn_hash_start(), "foobar", 6);
	assert_true(whole == jn_hash_add(jn_hash_add(jn_hash_start(), "foo", 3), "bar", 3));
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(values_are_those_of_the_authors),
		cmocka_unit_test(pieces_give_the_hash_of_the_whole),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
